//! Where an arm's joints are: waist, shoulder and elbow angles to points in space, for pictures and read-outs.
//!
//! Right-handed frame at the foot of the base, z up, x ahead at q1 = 0. Angles as in docs/physics.md section 1: q2 = 90° is
//! the upper arm vertical, q3 is relative, `[0, 90, −90]°` is upper arm up and forearm horizontal. The wrist's joints are not
//! part of the study and stay fixed, so the flange continues the forearm. No dynamics here.

use super::RobotData;
use crate::scalar::Scalar;

/// A point, m.
pub type Point = [f64; 3];

/// Geometry of an arm that turns at its waist and bends at shoulder and elbow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Kinematics {
    lengths_m: [f64; 4],
    zero_rad: [f64; 3],
    limit_rad: [f64; 3],
}

/// The arm's points at some joint angles, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ArmPoints {
    /// Foot of the base, the origin.
    pub base: Point,
    /// Axis of joint 2 above the base.
    pub shoulder: Point,
    /// Axis of joint 3.
    pub elbow: Point,
    /// Where the forearm ends.
    pub wrist: Point,
    /// Centre of the tool flange.
    pub tip: Point,
}

impl Kinematics {
    /// An arm's geometry from its data; `None` for a robot that is not waist, shoulder and elbow.
    pub fn new(robot: &RobotData) -> Option<Self> {
        Some(Self {
            lengths_m: robot.link_lengths_m.try_into().ok()?,
            zero_rad: robot.joint_zero_rad.try_into().ok()?,
            limit_rad: robot.joint_limit_rad.try_into().ok()?,
        })
    }

    /// Base to shoulder, shoulder to elbow, elbow to wrist, wrist to flange, m.
    pub fn lengths_m(&self) -> [f64; 4] {
        self.lengths_m
    }

    /// Points at joint angles `q` (rad). With `r` along `(cos q1, sin q1, 0)`: elbow = shoulder + l2 (c2 r + s2 z),
    /// wrist = elbow + l3 (c23 r + s23 z), tip = wrist + l4 (c23 r + s23 z); m.
    pub fn points(&self, q: [f64; 3]) -> ArmPoints {
        let [height, upper, fore, flange] = self.lengths_m;
        let (s1, c1) = Scalar::sin_cos(q[0]);
        let (s2, c2) = Scalar::sin_cos(q[1]);
        let (s23, c23) = Scalar::sin_cos(q[1] + q[2]);
        let along = |from: Point, length: f64, sin: f64, cos: f64| {
            [from[0] + length * cos * c1, from[1] + length * cos * s1, from[2] + length * sin]
        };
        let shoulder = [0.0, 0.0, height];
        let elbow = along(shoulder, upper, s2, c2);
        let wrist = along(elbow, fore, s23, c23);
        ArmPoints { base: [0.0; 3], shoulder, elbow, wrist, tip: along(wrist, flange, s23, c23) }
    }

    /// Joint angles that the maker allows at a joint (0 is the first), rad, lowest first.
    pub fn range_rad(&self, joint: usize) -> [f64; 2] {
        [self.zero_rad[joint] - self.limit_rad[joint], self.zero_rad[joint] + self.limit_rad[joint]]
    }

    /// The joints (0 is the first) that are beyond the maker's limits at angles `q` (rad).
    pub fn beyond_limits(&self, q: [f64; 3]) -> impl Iterator<Item = usize> {
        let ranges = [0, 1, 2].map(|joint| self.range_rad(joint));
        (0..3).filter(move |&joint| q[joint] < ranges[joint][0] || q[joint] > ranges[joint][1])
    }
}

impl ArmPoints {
    /// All points from base to tip.
    pub fn all(&self) -> [Point; 5] {
        [self.base, self.shoulder, self.elbow, self.wrist, self.tip]
    }
}

/// Distance between two points, m.
pub fn distance_m(a: Point, b: Point) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robots::ROBOTS;
    use proptest::prelude::*;

    fn a465() -> Kinematics {
        Kinematics::new(ROBOTS[0]).unwrap()
    }

    fn degrees(q: [f64; 3]) -> [f64; 3] {
        q.map(f64::to_radians)
    }

    fn assert_near(a: Point, b: Point) {
        assert!(distance_m(a, b) < 1e-12, "{a:?} is not {b:?}");
    }

    #[test]
    fn home_is_upper_arm_up_and_forearm_ahead() {
        let points = a465().points(degrees([0.0, 90.0, -90.0]));
        assert_near(points.shoulder, [0.0, 0.0, 0.3302]);
        assert_near(points.elbow, [0.0, 0.0, 0.6350]);
        assert_near(points.wrist, [0.3302, 0.0, 0.6350]);
        assert_near(points.tip, [0.4064, 0.0, 0.6350]);
    }

    #[test]
    fn the_makers_zero_is_straight_up() {
        let arm = a465();
        let points = arm.points(arm.zero_rad);
        assert_near(points.tip, [0.0, 0.0, arm.lengths_m.iter().sum()]);
        assert_eq!(arm.beyond_limits(arm.zero_rad).count(), 0);
    }

    #[test]
    fn stretched_ahead_it_reaches_the_sum_of_its_links_and_the_waist_turns_it() {
        let arm = a465();
        let reach = arm.lengths_m[1..].iter().sum();
        assert_near(arm.points([0.0; 3]).tip, [reach, 0.0, arm.lengths_m[0]]);
        assert_near(arm.points(degrees([90.0, 0.0, 0.0])).tip, [0.0, reach, arm.lengths_m[0]]);
    }

    #[test]
    fn limits_are_about_the_makers_zero() {
        let arm = a465();
        assert_eq!(arm.range_rad(1).map(f64::to_degrees).map(f64::round), [0.0, 180.0]);
        let beyond = |q| arm.beyond_limits(degrees(q)).collect::<Vec<_>>();
        assert_eq!(beyond([0.0, 90.0, -90.0]), []);
        assert_eq!(beyond([176.0, -1.0, -90.0]), [0, 1]);
        assert_eq!(beyond([0.0, 90.0, -110.1]), [2]);
    }

    proptest! {
        #[test]
        fn links_keep_their_lengths(q1 in -7.0..7.0, q2 in -7.0..7.0, q3 in -7.0..7.0) {
            let arm = a465();
            let points = arm.points([q1, q2, q3]).all();
            for (link, length) in arm.lengths_m.iter().enumerate() {
                prop_assert!((distance_m(points[link], points[link + 1]) - length).abs() < 1e-12);
            }
            let within = arm.lengths_m[1..].iter().sum::<f64>() + 1e-12;
            prop_assert!(distance_m(points[1], points[4]) <= within);
        }
    }
}
