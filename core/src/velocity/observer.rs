//! The paper's model-free velocity observer, eq. (21) to (23).
//!
//! `z = q − q̂`, `ξ̇ = z`, `ζ = q̇_d − Λx e + Kd Λz ξ`, `q̂̇ = ζ + Λz z + Kd z`, and the velocity handed out is
//! `v* = q̂̇ − Λz z = ζ + Kd z`. The paper prints q̇ where q̂̇ must stand: with q̇ it could not be computed without the sensor.
//! Eliminating ξ, `q̇ − v* = s/(s + Kd) · (q̇ − q̇_d + Λx e)`: of the deviation from what is desired a filtered difference of
//! bandwidth Kd. Λz shapes z alone.

use super::{VelocityEstimate, VelocitySource};
use crate::scalar::Scalar;
use crate::states::States;
use crate::trajectories::Desired;
use nalgebra::SVector;

/// The observer with diagonal gains; states q̂ then ξ. Source: paper eq. (21) to (23).
#[derive(Debug, Clone, Copy)]
pub struct ModelFreeObserver<T, const N: usize> {
    /// Λz, 1/s.
    pub lambda_z: SVector<T, N>,
    /// Λx, 1/s.
    pub lambda_x: SVector<T, N>,
    /// Kd, 1/s.
    pub k_d: SVector<T, N>,
}

impl<T: Scalar, const N: usize> VelocitySource<T, N> for ModelFreeObserver<T, N> {
    const MEASURED: bool = false;

    fn states(&self) -> usize {
        2 * N
    }

    /// q̂(0) = q(0), ξ(0) = 0 (chosen; docs/physics.md section 2).
    fn initialize(&self, position: &SVector<T, N>, _desired: &Desired<T, N>, states: &mut [T]) {
        states[..N].copy_from_slice(position.as_slice());
        states[N..].fill(T::zero());
    }

    #[inline(always)]
    fn estimate(
        &self,
        position: &SVector<T, N>,
        _velocity: &SVector<T, N>,
        desired: &Desired<T, N>,
        states: impl States<T>,
    ) -> VelocityEstimate<T, N> {
        let (q_hat, xi) = (states.first(N), states.after(N).first(N));
        let mut z = SVector::<T, N>::zeros();
        let mut velocity = SVector::<T, N>::zeros();
        for i in 0..N {
            z[i] = position[i] - q_hat.at(i);
            let e = position[i] - desired.position[i];
            let zeta = desired.velocity[i] - self.lambda_x[i] * e + self.k_d[i] * self.lambda_z[i] * xi.at(i);
            velocity[i] = zeta + self.k_d[i] * z[i];
        }
        VelocityEstimate { velocity, observer_error: z }
    }

    #[inline(always)]
    fn derivative(&self, estimate: &VelocityEstimate<T, N>, derivative: &mut [T]) {
        let (q_hat_rate, xi_rate) = derivative.split_at_mut(N);
        let z = &estimate.observer_error;
        for i in 0..N {
            q_hat_rate[i] = estimate.velocity[i] + self.lambda_z[i] * z[i];
            xi_rate[i] = z[i];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::response;
    use super::*;

    /// With q_d = 0, `v* = jΩ (Kd − Λx) / (jΩ + Kd)` on `q = sin Ω t`, whatever Λz is.
    #[test]
    fn lambda_z_has_no_say_in_the_velocity() {
        for (lambda_z, lambda_x, k_d, frequency) in
            [(100.0, 60.0, 150.0, 10.0), (20.0, 60.0, 150.0, 10.0), (50.0, 10.0, 300.0, 40.0)]
        {
            let [lambda_z, lambda_x, k_d] = [lambda_z, lambda_x, k_d].map(|gain| SVector::from([gain]));
            let source = ModelFreeObserver { lambda_z, lambda_x, k_d };
            let worst = response(&source, frequency, |t: f64| {
                let (a, b, share) = (k_d[0], frequency, k_d[0] - lambda_x[0]);
                // Im of jb share / (a + jb) e^{jbt}.
                share * b * (b * (b * t).sin() + a * (b * t).cos()) / (a * a + b * b)
            });
            assert!(worst < 1e-6 * frequency, "Λz = {lambda_z}, Λx = {lambda_x}, Kd = {k_d}: {worst}");
        }
    }
}
