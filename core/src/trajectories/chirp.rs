//! A chirp: `q_d = offset + A sin φ(t)`, its frequency gliding from the lowest to the highest and back, for ever.
//!
//! `φ̇ = ω0 + (ω1 − ω0) (1 − cos(πt/S)) / 2` with S the time of one sweep, hence
//! `φ = ω0 t + (ω1 − ω0)/2 (t − S/π sin(πt/S))`: smooth, without a corner where the sweep turns. Chosen for that reason over
//! the usual linear sweep, whose acceleration jumps there.

use super::{Desired, Motion};
use crate::scalar::Scalar;
use nalgebra::SVector;
use std::f64::consts::PI;

/// The chirp's numbers; rad, rad/s, s.
#[derive(Debug, Clone, PartialEq)]
pub struct Chirp<const N: usize> {
    /// Constant part, rad.
    pub offset: SVector<f64, N>,
    /// Amplitudes, rad.
    pub amplitude: SVector<f64, N>,
    /// Lowest and highest angular frequency, rad/s.
    pub frequency_rad_s: [f64; 2],
    /// Time from the lowest to the highest, s.
    pub sweep_s: f64,
}

/// φ, φ̇ and φ̈ at `time`; rad, rad/s, rad/s².
pub fn chirp_phase<T: Scalar>([low, high]: [f64; 2], sweep_s: f64, time: T) -> [T; 3] {
    let n = T::splat;
    let turn = PI / sweep_s;
    let (sin, cos) = (n(turn) * time).sin_cos();
    let half = 0.5 * (high - low);
    [n(low) * time + n(half) * (time - sin / n(turn)), n(low) + n(half) * (T::one() - cos), n(half * turn) * sin]
}

impl<const N: usize> Motion<N> for Chirp<N> {
    fn at(&self, time_s: f64) -> Desired<f64, N> {
        let [phase, rate, change] = chirp_phase(self.frequency_rad_s, self.sweep_s, time_s);
        let (sin, cos) = Scalar::sin_cos(phase);
        Desired {
            position: self.offset + self.amplitude * sin,
            velocity: self.amplitude * (rate * cos),
            acceleration: self.amplitude * (change * cos - rate * rate * sin),
        }
    }
}
