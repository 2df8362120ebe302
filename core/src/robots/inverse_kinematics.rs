//! From the tip to the joints: angles, velocities and accelerations in closed form.
//!
//! Waist `q1 = atan2(y, x)`; in the plane that it turns, a two-link arm to the distance r and height z:
//! `cos q3 = (r² + z² − l² − m²) / (2 l m)`, `q2 = atan2(z, r) − atan2(m sin q3, l + m cos q3)`. Rates come from solving
//! `ṙ = −l s2 a − m s23 b`, `ż = l c2 a + m c23 b` for `a = q̇2`, `b = q̇2 + q̇3`, and the same again for accelerations.

use super::{Kinematics, RobotKind};
use crate::scalar::{self, Scalar};
use nalgebra::Vector3;
use std::f64::consts::{FRAC_PI_2, TAU};

/// Which way the elbow points where the tip allows two.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Bend {
    /// q3 < 0.
    #[default]
    Up,
    /// q3 > 0.
    Down,
}

/// How far a point may be off a planar robot's plane or a pendulum's circle, m.
const TOLERANCE_M: f64 = 1e-9;
/// Least |sin q3| and least distance from the waist's axis (m): nearer, joints would have to turn without bound.
const LEAST_BEND: f64 = 1e-3;

impl Kinematics {
    /// Joint angles (rad), velocities (rad/s) and accelerations (rad/s²) at which the tip has this position (m), velocity (m/s)
    /// and acceleration (m/s²), in the order of the robot's joints and zeros behind them. `None` where the tip cannot be or
    /// where the arm is stretched, folded or above its waist. Angles are principal values.
    pub fn follow(&self, tip: &[Vector3<f64>; 3], bend: Bend) -> Option<[[f64; 3]; 3]> {
        let [height, upper, fore, flange] = self.lengths_m();
        let [place, rate, change] = *tip;
        let up = [place.z - height, rate.z, change.z];
        let ahead = [place.x, rate.x, change.x];
        match self.kind() {
            RobotKind::CrsA465 => {
                let (waist, out) = turn(tip)?;
                let [q2, q3] = two_links(upper, fore + flange, out, up, bend)?;
                Some(std::array::from_fn(|order| [waist[order], q2[order], q3[order]]))
            }
            RobotKind::TwoLink => {
                let in_plane = f64::abs(place.y) <= TOLERANCE_M;
                let [q1, q2] = two_links(upper, fore + flange, ahead, up, bend).filter(|_| in_plane)?;
                Some(std::array::from_fn(|order| [q1[order], q2[order], 0.0]))
            }
            RobotKind::Pendulum => {
                let distance = (ahead[0] * ahead[0] + up[0] * up[0]).sqrt();
                let off = f64::abs(distance - upper).max(f64::abs(place.y));
                let square = upper * upper;
                // The angle from straight down, in the sense in which x is the sine.
                let angle = scalar::arc_tangent(ahead[0], -up[0]);
                let velocity = (ahead[0] * up[1] - up[0] * ahead[1]) / square;
                let acceleration = (ahead[0] * up[2] - up[0] * ahead[2]) / square;
                (off <= TOLERANCE_M).then_some([[angle, 0.0, 0.0], [velocity, 0.0, 0.0], [acceleration, 0.0, 0.0]])
            }
        }
    }
}

/// The waist's angle and the distance from its axis, each with two derivatives.
fn turn([place, rate, change]: &[Vector3<f64>; 3]) -> Option<([f64; 3], [f64; 3])> {
    let r = (place.x * place.x + place.y * place.y).sqrt();
    if r < LEAST_BEND {
        return None;
    }
    let r1 = (place.x * rate.x + place.y * rate.y) / r;
    let turning = (place.x * rate.y - place.y * rate.x) / (r * r);
    let r2 = (place.x * change.x + place.y * change.y) / r + r * turning * turning;
    let speeding = (place.x * change.y - place.y * change.x) / (r * r) - 2.0 * r1 * turning / r;
    Some(([scalar::arc_tangent(place.y, place.x), turning, speeding], [r, r1, r2]))
}

/// Both angles of a planar arm with links `l` and `m` whose tip is at `(x, z)`, each with two derivatives.
fn two_links(l: f64, m: f64, x: [f64; 3], z: [f64; 3], bend: Bend) -> Option<[[f64; 3]; 2]> {
    let cos = (x[0] * x[0] + z[0] * z[0] - l * l - m * m) / (2.0 * l * m);
    let square = 1.0 - cos * cos;
    if square.is_nan() || square < LEAST_BEND * LEAST_BEND {
        return None;
    }
    let sin = match bend {
        Bend::Up => -square.sqrt(),
        Bend::Down => square.sqrt(),
    };
    let elbow = scalar::arc_tangent(sin, cos);
    let mut shoulder = scalar::arc_tangent(z[0], x[0]) - scalar::arc_tangent(m * sin, l + m * cos);
    // Between −90° and 270°: its cut is straight down, where no arm here works.
    if shoulder < -FRAC_PI_2 {
        shoulder += TAU;
    } else if shoulder >= TAU - FRAC_PI_2 {
        shoulder -= TAU;
    }
    let (sa, ca) = Scalar::sin_cos(shoulder);
    let (sb, cb) = Scalar::sin_cos(shoulder + elbow);
    let determinant = l * m * sin;
    let solve = |x: f64, z: f64| {
        let first = m * (cb * x + sb * z) / determinant;
        let both = -l * (ca * x + sa * z) / determinant;
        [first, both]
    };
    let [a, b] = solve(x[1], z[1]);
    let [a1, b1] = solve(x[2] + l * ca * a * a + m * cb * b * b, z[2] + l * sa * a * a + m * sb * b * b);
    Some([[shoulder, a, a1], [elbow, b - a, b1 - a1]])
}
