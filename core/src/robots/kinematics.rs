//! Where a robot's joints are: joint angles to points in space, for pictures, read-outs and paths of the tip.
//!
//! Right-handed frame at the foot of the base, z up, x ahead at q1 = 0. Every robot here is an arm that turns at its waist and
//! bends at shoulder and elbow, some with joints that stay fixed: [`Kinematics::arm_angles`] says how its angles read as
//! those three. A465: q2 = 90° is the upper arm vertical, q3 is relative, `[0, 90, −90]°` is upper arm up and forearm
//! horizontal; its wrist stays fixed, so the flange continues the forearm. No dynamics here.

use super::{RobotData, RobotKind};
use crate::scalar::Scalar;
use std::f64::consts::FRAC_PI_2;

/// A point, m.
pub type Point = [f64; 3];

/// Geometry of an arm that turns at its waist and bends at shoulder and elbow, as far as it has those joints.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Kinematics {
    kind: RobotKind,
    lengths_m: [f64; 4],
    zero_rad: &'static [f64],
    limit_rad: &'static [f64],
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
    /// A robot's geometry from its data.
    pub fn new(robot: &RobotData) -> Self {
        Self {
            kind: robot.kind,
            lengths_m: robot.link_lengths_m,
            zero_rad: robot.joint_zero_rad,
            limit_rad: robot.joint_limit_rad,
        }
    }

    /// The robot's joint angles read as waist, shoulder and elbow, rad. The two-link arm has no waist; the pendulum is one
    /// link that hangs down at zero. Joints that `q` lacks count as 0.
    pub fn arm_angles<T: Scalar>(&self, q: &[T]) -> [T; 3] {
        let at = |joint: usize| q.get(joint).copied().unwrap_or_else(T::zero);
        match self.kind {
            RobotKind::CrsA465 => [at(0), at(1), at(2)],
            RobotKind::TwoLink => [T::zero(), at(0), at(1)],
            RobotKind::Pendulum => [T::zero(), at(0) - T::splat(FRAC_PI_2), T::zero()],
        }
    }

    /// Which robot's.
    pub fn kind(&self) -> RobotKind {
        self.kind
    }

    /// Base to shoulder, shoulder to elbow, elbow to wrist, wrist to flange, m.
    pub fn lengths_m(&self) -> [f64; 4] {
        self.lengths_m
    }

    /// Points at the robot's joint angles `q` (rad), [`Kinematics::arm_angles`] of which are q1, q2, q3. With `r` along
    /// `(cos q1, sin q1, 0)`: elbow = shoulder + l2 (c2 r + s2 z), wrist = elbow + l3 (c23 r + s23 z),
    /// tip = wrist + l4 (c23 r + s23 z); m.
    pub fn points(&self, q: &[f64]) -> ArmPoints {
        let q = self.arm_angles(q);
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
    pub fn beyond_limits(&self, q: &[f64]) -> impl Iterator<Item = usize> {
        q.iter().take(self.zero_rad.len()).enumerate().filter_map(|(joint, &angle)| {
            let [lowest, highest] = self.range_rad(joint);
            (angle < lowest || angle > highest).then_some(joint)
        })
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
        Kinematics::new(ROBOTS[0])
    }

    fn degrees(q: [f64; 3]) -> [f64; 3] {
        q.map(f64::to_radians)
    }

    fn assert_near(a: Point, b: Point) {
        assert!(distance_m(a, b) < 1e-12, "{a:?} is not {b:?}");
    }

    #[test]
    fn home_is_upper_arm_up_and_forearm_ahead() {
        let points = a465().points(&degrees([0.0, 90.0, -90.0]));
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
        assert_near(arm.points(&[0.0; 3]).tip, [reach, 0.0, arm.lengths_m[0]]);
        assert_near(arm.points(&degrees([90.0, 0.0, 0.0])).tip, [0.0, reach, arm.lengths_m[0]]);
    }

    #[test]
    fn limits_are_about_the_makers_zero() {
        let arm = a465();
        assert_eq!(arm.range_rad(1).map(f64::to_degrees).map(f64::round), [0.0, 180.0]);
        let beyond = |q| arm.beyond_limits(&degrees(q)).collect::<Vec<_>>();
        assert!(beyond([0.0, 90.0, -90.0]).is_empty());
        assert_eq!(beyond([176.0, -1.0, -90.0]), [0, 1]);
        assert_eq!(beyond([0.0, 90.0, -110.1]), [2]);
    }

    #[test]
    fn the_planar_arms_move_in_their_plane() {
        let [two_link, pendulum] = [1, 2].map(|n| Kinematics::new(ROBOTS[n]));
        assert_near(two_link.points(&degrees([90.0, -90.0, 0.0])[..2]).tip, [1.0, 0.0, 1.5]);
        assert_near(pendulum.points(&[0.0]).tip, [0.0, 0.0, 0.1]);
        assert_near(pendulum.points(&[FRAC_PI_2]).tip, [0.5, 0.0, 0.6]);
        assert_eq!(two_link.beyond_limits(&degrees([0.0, 161.0, 0.0])[..2]).collect::<Vec<_>>(), [1]);
    }

    proptest! {
        #[test]
        fn links_keep_their_lengths(q1 in -7.0..7.0, q2 in -7.0..7.0, q3 in -7.0..7.0) {
            let arm = a465();
            let points = arm.points(&[q1, q2, q3]).all();
            for (link, length) in arm.lengths_m.iter().enumerate() {
                prop_assert!((distance_m(points[link], points[link + 1]) - length).abs() < 1e-12);
            }
            let within = arm.lengths_m[1..].iter().sum::<f64>() + 1e-12;
            prop_assert!(distance_m(points[1], points[4]) <= within);
        }
    }
}
