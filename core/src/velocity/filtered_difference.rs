//! Filtered difference ("dirty derivative"): the joint angle through `W(s) = ω s / (s + ω)`.
//!
//! `x' = ω (q − x)`, `v* = ω (q − x)`, so x is q through a low-pass filter and v* the derivative of that. Assumes nothing
//! about the arm or its trajectory; lags by 1/ω and hands on noise times ω. Source: textbook; used in place of a sensor by
//! nearly every industrial servo.

use super::{VelocityEstimate, VelocitySource};
use crate::scalar::Scalar;
use crate::states::States;
use crate::trajectories::Desired;
use nalgebra::SVector;

/// The filter with bandwidth ω; states x, rad. Sampled with period T it is `v_k = ω (q_k − x_k)`, `x_{k+1} = x_k + T v_k`:
/// at `ω T = 1` the plain backward difference, stable for `ω T < 2`.
#[derive(Debug, Clone, Copy)]
pub struct FilteredDifference<T> {
    /// ω, rad/s.
    pub bandwidth: T,
}

impl<T: Scalar, const N: usize> VelocitySource<T, N> for FilteredDifference<T> {
    const MEASURED: bool = false;

    fn states(&self) -> usize {
        N
    }

    /// `x(0) = q(0) − q̇_d(0)/ω`, so that `v*(0) = q̇_d(0)`, which is what the paper's observer starts from too (chosen).
    fn initialize(&self, position: &SVector<T, N>, desired: &Desired<T, N>, states: &mut [T]) {
        for i in 0..N {
            states[i] = position[i] - desired.velocity[i] / self.bandwidth;
        }
    }

    #[inline(always)]
    fn estimate(
        &self,
        position: &SVector<T, N>,
        _velocity: &SVector<T, N>,
        _desired: &Desired<T, N>,
        states: impl States<T>,
    ) -> VelocityEstimate<T, N> {
        let lag = position - states.vector::<N>();
        VelocityEstimate { velocity: lag * self.bandwidth, observer_error: lag }
    }

    #[inline(always)]
    fn derivative(&self, estimate: &VelocityEstimate<T, N>, derivative: &mut [T]) {
        derivative[..N].copy_from_slice(estimate.velocity.as_slice());
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::response;
    use super::*;

    /// Gain `ω Ω / √(Ω² + ω²)` and phase `90° − atan(Ω/ω)` of its transfer function on `q = sin Ω t`.
    #[test]
    fn answers_a_sine_as_its_transfer_function_says() {
        for (bandwidth, frequency) in [(50.0, 10.0), (20.0, 40.0), (300.0, 2.0)] {
            let source = FilteredDifference { bandwidth };
            let worst = response(&source, frequency, |t: f64| {
                let (a, b) = (bandwidth, frequency);
                // Im of jΩ ω / (jΩ + ω) e^{jΩt}.
                let scale = a * b / (a * a + b * b);
                scale * (b * (b * t).sin() + a * (b * t).cos())
            });
            assert!(worst < 1e-6 * frequency, "ω = {bandwidth}, Ω = {frequency}: {worst}");
        }
    }

    #[test]
    fn sampled_at_its_own_bandwidth_it_is_the_backward_difference() {
        let (period, angles) = (0.01, [0.3, 0.5, 0.4, 0.45]);
        let source = FilteredDifference { bandwidth: 1.0 / period };
        let still = Desired {
            position: SVector::zeros(),
            velocity: SVector::<f64, 1>::zeros(),
            acceleration: SVector::zeros(),
        };
        let mut x = [angles[0]];
        for k in 0..angles.len() {
            let estimate = source.estimate(&SVector::from([angles[k]]), &SVector::zeros(), &still, x.as_slice());
            let difference = if k == 0 { 0.0 } else { (angles[k] - angles[k - 1]) / period };
            assert!((estimate.velocity[0] - difference).abs() < 1e-12);
            let mut rate = [0.0];
            VelocitySource::<f64, 1>::derivative(&source, &estimate, &mut rate);
            x[0] += period * rate[0];
        }
    }
}
