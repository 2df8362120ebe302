//! Linear high-gain observer with a double pole at −ω.
//!
//! `z = q − q̂`, `q̂' = v* + 2 ω z`, `v*' = ω² z`. From q to v*: `ω² s / (s + ω)²`, a derivative that falls off twice as
//! steeply beyond ω as the filtered difference does. Knows neither the arm nor its trajectory; its error is of the order of
//! `|q̈|/ω`. Source: Khalil, *Nonlinear Systems*, section 14.5, with α1 = 2, α2 = 1, ε = 1/ω.

use super::{VelocityEstimate, VelocitySource};
use crate::scalar::Scalar;
use crate::states::States;
use crate::trajectories::Desired;
use nalgebra::SVector;

/// The observer with bandwidth ω; states q̂ (rad), then v* (rad/s). Sampled with period T it is stable for `ω T < 2`.
#[derive(Debug, Clone, Copy)]
pub struct HighGainObserver<T> {
    /// ω, rad/s.
    pub bandwidth: T,
}

impl<T: Scalar, const N: usize> VelocitySource<T, N> for HighGainObserver<T> {
    const MEASURED: bool = false;

    fn states(&self) -> usize {
        2 * N
    }

    /// q̂(0) = q(0), `v*(0) = q̇_d(0)`: what the paper's observer starts from too (chosen).
    fn initialize(&self, position: &SVector<T, N>, desired: &Desired<T, N>, states: &mut [T]) {
        states[..N].copy_from_slice(position.as_slice());
        states[N..2 * N].copy_from_slice(desired.velocity.as_slice());
    }

    #[inline(always)]
    fn estimate(
        &self,
        position: &SVector<T, N>,
        _velocity: &SVector<T, N>,
        _desired: &Desired<T, N>,
        states: impl States<T>,
    ) -> VelocityEstimate<T, N> {
        VelocityEstimate { velocity: states.after(N).vector(), observer_error: position - states.vector::<N>() }
    }

    #[inline(always)]
    fn derivative(&self, estimate: &VelocityEstimate<T, N>, derivative: &mut [T]) {
        let two = T::splat(2.0);
        for i in 0..N {
            let pull = self.bandwidth * estimate.observer_error[i];
            derivative[i] = estimate.velocity[i] + two * pull;
            derivative[N + i] = self.bandwidth * pull;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::response;
    use super::*;

    /// `jΩ ω² / (jΩ + ω)²` on `q = sin Ω t`.
    #[test]
    fn answers_a_sine_as_its_transfer_function_says() {
        for (bandwidth, frequency) in [(50.0, 10.0), (20.0, 40.0), (300.0, 2.0)] {
            let source = HighGainObserver { bandwidth };
            let worst = response(&source, frequency, |t: f64| {
                let (a, b) = (bandwidth, frequency);
                // 1/(a + jb)² = (a² − b² − 2jab)/(a² + b²)², times jba².
                let scale = b * a * a / ((a * a + b * b) * (a * a + b * b));
                scale * (2.0 * a * b * (b * t).sin() + (a * a - b * b) * (b * t).cos())
            });
            assert!(worst < 1e-6 * frequency, "ω = {bandwidth}, Ω = {frequency}: {worst}");
        }
    }
}
