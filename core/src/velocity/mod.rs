//! Velocity sources: what a controller may take for the joint velocity.
//!
//! The first of the three choices that make a scheme. A source may have states of its own, which the simulation integrates.

mod any;
mod filtered_difference;
mod high_gain;
mod measured;
mod observer;

pub use any::AnySource;
pub use filtered_difference::FilteredDifference;
pub use high_gain::HighGainObserver;
pub use measured::Measured;
pub use observer::ModelFreeObserver;

use crate::scalar::Scalar;
use crate::states::States;
use crate::trajectories::Desired;
use nalgebra::SVector;

/// What a velocity source says at one instant.
#[derive(Debug, Clone, Copy)]
pub struct VelocityEstimate<T, const N: usize> {
    /// The velocity v* that the controller uses, rad/s.
    pub velocity: SVector<T, N>,
    /// Observer error `z = q − q̂`, rad; means nothing where velocity is measured.
    pub observer_error: SVector<T, N>,
}

/// A source of joint velocity.
pub trait VelocitySource<T: Scalar, const N: usize>: Send {
    /// Whether v* is the true joint velocity, so that work done for the plant at q̇ serves the controller too.
    const MEASURED: bool;

    /// Number of states to integrate.
    fn states(&self) -> usize;

    /// Writes the initial states for a start at `position`; `desired` is the motion wanted then.
    fn initialize(&self, position: &SVector<T, N>, desired: &Desired<T, N>, states: &mut [T]);

    /// v* at this instant. `velocity` is the true joint velocity, for sources that measure it.
    fn estimate(
        &self,
        position: &SVector<T, N>,
        velocity: &SVector<T, N>,
        desired: &Desired<T, N>,
        states: impl States<T>,
    ) -> VelocityEstimate<T, N>;

    /// Writes the states' derivative.
    fn derivative(&self, estimate: &VelocityEstimate<T, N>, derivative: &mut [T]);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::integrators::{Aligned, Rk4};

    /// Worst difference between a source's velocity for `q = sin Ω t` and `expected`, once its start is forgotten.
    pub(super) fn response(source: &impl VelocitySource<f64, 1>, frequency: f64, expected: impl Fn(f64) -> f64) -> f64 {
        let at = |t: f64| SVector::from([(frequency * t).sin()]);
        let still = Desired { position: SVector::zeros(), velocity: SVector::zeros(), acceleration: SVector::zeros() };
        let estimate = |t: f64, x: &[f64]| source.estimate(&at(t), &SVector::zeros(), &still, x);
        let mut x = Aligned::repeat(0.0, source.states());
        source.initialize(&at(0.0), &still, &mut x);
        let mut rk4 = Rk4::new(x.len());
        let (h, mut worst) = (1e-4, 0.0_f64);
        for n in 0..30_000 {
            let (start, end) = (f64::from(n) * h, f64::from(n + 1) * h);
            rk4.step(start, end, &mut x, |t, x, rate| source.derivative(&estimate(t, x), rate));
            if n > 20_000 {
                worst = worst.max((estimate(end, &x).velocity[0] - expected(end)).abs());
            }
        }
        worst
    }
}
