//! Paths of the tip, straight or round, turned into joint motion by the robot's inverse kinematics.
//!
//! A line is gone to and fro with minimum jerk, at rest at both ends; a circle at constant speed.

use super::{Desired, Motion, minimum_jerk};
use crate::robots::{Bend, Kinematics, Point};
use crate::scalar::Scalar;
use nalgebra::{SVector, Vector3};
use std::f64::consts::TAU;

/// A path in space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Path {
    /// From one point to another and back, for ever.
    Line {
        /// Start, m.
        from: Point,
        /// Other end, m.
        to: Point,
        /// Time of one way, s.
        move_s: f64,
    },
    /// Round and round: `centre + radius (e1 cos φ + e2 sin φ)`, `φ = 2πt / period`.
    Circle {
        /// Centre, m.
        centre: Point,
        /// Radius, m.
        radius_m: f64,
        /// Across the circle's plane; about it the tip turns counter-clockwise. Of any length but zero.
        normal: Point,
        /// Time of one round, s.
        period_s: f64,
    },
}

impl Path {
    /// Position (m), velocity (m/s) and acceleration (m/s²) of the tip at `time_s`.
    pub fn at(&self, time_s: f64) -> [Vector3<f64>; 3] {
        match *self {
            Self::Line { from, to, move_s } => {
                let (from, way) = (Vector3::from(from), Vector3::from(to) - Vector3::from(from));
                let phase = time_s % (2.0 * move_s) / move_s;
                let (s, sign) = if phase <= 1.0 { (phase, 1.0) } else { (2.0 - phase, -1.0) };
                let [place, rate, change] = minimum_jerk(s);
                [from + way * place, way * (sign * rate / move_s), way * (change / (move_s * move_s))]
            }
            Self::Circle { centre, radius_m, normal, period_s } => {
                let [e1, e2] = in_plane(Vector3::from(normal));
                let rate = TAU / period_s;
                let (sin, cos) = Scalar::sin_cos(rate * (time_s % period_s));
                let (out, along) = ((e1 * cos + e2 * sin) * radius_m, (e2 * cos - e1 * sin) * radius_m);
                [Vector3::from(centre) + out, along * rate, -out * (rate * rate)]
            }
        }
    }

    /// After this time it repeats, s.
    pub fn period_s(&self) -> f64 {
        match *self {
            Self::Line { move_s, .. } => 2.0 * move_s,
            Self::Circle { period_s, .. } => period_s,
        }
    }
}

/// Two unit vectors across `normal`, right-handed with it. The first is level, or ahead (x) where the circle itself is.
fn in_plane(normal: Vector3<f64>) -> [Vector3<f64>; 2] {
    let unit = normal / (normal.dot(&normal)).sqrt();
    let level = Vector3::z().cross(&unit);
    let first = if level.dot(&level) > 1e-12 { level } else { Vector3::x() - unit * unit.x };
    let first = first / first.dot(&first).sqrt();
    [first, unit.cross(&first)]
}

/// A path followed by a robot's tip.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TipPath {
    /// Where the tip goes.
    pub path: Path,
    /// The robot's geometry.
    pub kinematics: Kinematics,
    /// Which way the elbow points.
    pub bend: Bend,
}

impl<const N: usize> Motion<N> for TipPath {
    /// Not a number where the tip cannot go, which validation rules out.
    fn at(&self, time_s: f64) -> Desired<f64, N> {
        let followed = self.kinematics.follow(&self.path.at(time_s), self.bend);
        let [position, velocity, acceleration] = match followed {
            Some(motion) => motion.map(|of| SVector::from_fn(|joint, _| of[joint])),
            None => [SVector::repeat(f64::NAN); 3],
        };
        Desired { position, velocity, acceleration }
    }
}
