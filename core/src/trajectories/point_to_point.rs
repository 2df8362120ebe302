//! Minimum-jerk moves from point to point in joint space: C2, at rest in every point.
//!
//! `q = a + (b − a) σ(t / T)`, `σ(s) = 10 s³ − 15 s⁴ + 6 s⁵`, which among all moves at rest at both ends has the least
//! integrated squared jerk. Source: Flash and Hogan, *The coordination of arm movements*, J. Neuroscience 5(7), 1985.

use super::{Desired, Motion};
use crate::scalar::Scalar;
use nalgebra::SVector;

/// σ, σ' and σ'' at `s` between 0 and 1.
pub fn minimum_jerk<T: Scalar>(s: T) -> [T; 3] {
    let n = T::splat;
    let rest = T::one() - s;
    [
        s * s * s * (n(10.0) + s * (n(6.0) * s - n(15.0))),
        n(30.0) * s * s * rest * rest,
        n(60.0) * s * rest * (T::one() - s - s),
    ]
}

/// A sequence of points, each move as long as the others, with pauses between them; the last point is held.
#[derive(Debug, Clone, PartialEq)]
pub struct PointToPoint<const N: usize> {
    points: Vec<SVector<f64, N>>,
    move_s: f64,
    dwell_s: f64,
}

impl<const N: usize> PointToPoint<N> {
    /// Through at least one point (rad); `move_s > 0` per move, `dwell_s ≥ 0` in each point in between.
    pub fn new(points: Vec<SVector<f64, N>>, move_s: f64, dwell_s: f64) -> Self {
        Self { points, move_s, dwell_s }
    }
}

impl<const N: usize> Motion<N> for PointToPoint<N> {
    fn at(&self, time_s: f64) -> Desired<f64, N> {
        let moves = self.points.len() - 1;
        let leg_s = self.move_s + self.dwell_s;
        let leg = (time_s / leg_s).floor().clamp(0.0, moves as f64);
        let n = leg as usize;
        let (from, to) = (self.points[n], self.points[(n + 1).min(moves)]);
        let s = ((time_s - leg * leg_s) / self.move_s).clamp(0.0, 1.0);
        let [place, rate, change] = minimum_jerk(s);
        let way = to - from;
        Desired {
            position: from + way * place,
            velocity: way * (rate / self.move_s),
            acceleration: way * (change / (self.move_s * self.move_s)),
        }
    }
}
