//! A table of joint angles, interpolated so that position, velocity and acceleration are continuous, at rest at both ends.
//!
//! Velocities in the table's times are those of the cubic spline with zero velocity at both ends, accelerations its second
//! derivatives, but zero at both ends; each piece is the quintic that meets them. Inside, it is the cubic spline itself;
//! the first and last piece differ so that the arm starts and ends without a jump, for after the last time it is held.

use super::{Desired, Motion};
use nalgebra::SVector;

/// The table with what the spline makes of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Samples<const N: usize> {
    times_s: Vec<f64>,
    knots: Vec<Desired<f64, N>>,
}

impl<const N: usize> Samples<N> {
    /// Through `angles` (rad) at increasing `times_s`; as many of each, two at least.
    pub fn new(times_s: Vec<f64>, angles: &[SVector<f64, N>]) -> Self {
        let velocities = spline_velocities(&times_s, angles);
        let last = angles.len() - 1;
        let knots = (0..=last).map(|n| Desired {
            position: angles[n],
            velocity: velocities[n],
            acceleration: if n == 0 || n == last {
                SVector::zeros()
            } else {
                let span = times_s[n + 1] - times_s[n];
                (angles[n + 1] - angles[n]) * (6.0 / (span * span))
                    - (velocities[n] * 4.0 + velocities[n + 1] * 2.0) * (1.0 / span)
            },
        });
        Self { knots: knots.collect(), times_s }
    }
}

/// Velocities of the cubic spline at its knots: `v_{n−1}/h_{n−1} + 2 (1/h_{n−1} + 1/h_n) v_n + v_{n+1}/h_n =
/// 3 (Δ_{n−1}/h_{n−1}² + Δ_n/h_n²)` inside, zero at both ends. Diagonally dominant: elimination needs no pivots.
fn spline_velocities<const N: usize>(times_s: &[f64], angles: &[SVector<f64, N>]) -> Vec<SVector<f64, N>> {
    let last = angles.len() - 1;
    let span = |n: usize| times_s[n + 1] - times_s[n];
    let slope = |n: usize| (angles[n + 1] - angles[n]) * (3.0 / (span(n) * span(n)));
    let mut velocities = vec![SVector::zeros(); last + 1];
    let mut above = vec![0.0; last + 1];
    for n in 1..last {
        let pivot = 2.0 / span(n - 1) + 2.0 / span(n) - above[n - 1] / span(n - 1);
        above[n] = 1.0 / (span(n) * pivot);
        velocities[n] = (slope(n - 1) + slope(n) - velocities[n - 1] * (1.0 / span(n - 1))) * (1.0 / pivot);
    }
    for n in (1..last).rev() {
        let next = velocities[n + 1];
        velocities[n] -= next * above[n];
    }
    velocities
}

impl<const N: usize> Motion<N> for Samples<N> {
    fn at(&self, time_s: f64) -> Desired<f64, N> {
        let last = self.times_s.len() - 1;
        if time_s <= self.times_s[0] {
            return self.knots[0];
        }
        if time_s >= self.times_s[last] {
            return self.knots[last];
        }
        let n = self.times_s.partition_point(|&knot_s| knot_s <= time_s) - 1;
        let (from, to) = (&self.knots[n], &self.knots[n + 1]);
        let span = self.times_s[n + 1] - self.times_s[n];
        let s = (time_s - self.times_s[n]) / span;
        // In multiples of the span: c0 + c1 s + ... + c5 s⁵ with the ends' position, velocity and acceleration.
        let (c0, c1, c2) = (from.position, from.velocity * span, from.acceleration * (0.5 * span * span));
        let place = to.position - c0 - c1 - c2;
        let rate = to.velocity * span - c1 - c2 * 2.0;
        let change = to.acceleration * (span * span) - c2 * 2.0;
        let c3 = place * 10.0 - rate * 4.0 + change * 0.5;
        let c4 = place * -15.0 + rate * 7.0 - change;
        let c5 = place * 6.0 - rate * 3.0 + change * 0.5;
        Desired {
            position: c0 + (c1 + (c2 + (c3 + (c4 + c5 * s) * s) * s) * s) * s,
            velocity: (c1 + (c2 * 2.0 + (c3 * 3.0 + (c4 * 4.0 + c5 * (5.0 * s)) * s) * s) * s) * (1.0 / span),
            acceleration: (c2 * 2.0 + (c3 * 6.0 + (c4 * 12.0 + c5 * (20.0 * s)) * s) * s) * (1.0 / (span * span)),
        }
    }
}
