//! Sliding-variable feedback with a linear-in-parameters model: paper eq. (3), (8) and (13) in one form.
//!
//! `e = q − q_d`, `v_r = q̇_d − Λ e`, `a_r = q̈_d − Λ (v* − q̇_d)`, `s = v* − v_r`, `τ = −K s + Y(q, u, v_r, a_r) θ̂`.
//! The schemes differ in the velocity `u` of the Coriolis term. Eq. (8) prints both signs turned, because its source
//! defines s the other way round; this is the consistent reading.

use crate::scalar::Scalar;
use crate::trajectories::Desired;
use nalgebra::SVector;

/// Which velocity the Coriolis matrix `C(q, u)` of the model is evaluated at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CoriolisVelocity {
    /// `u = v*`: paper eq. (3), (8).
    Estimated,
    /// `u = v_r`: paper eq. (13).
    Reference,
}

/// The feedback law's gains.
#[derive(Debug, Clone, Copy)]
pub struct SlidingFeedback<T, const N: usize> {
    /// K, N·m·s.
    pub gain: SVector<T, N>,
    /// Λ, 1/s.
    pub lambda: SVector<T, N>,
    /// Velocity of the Coriolis term.
    pub coriolis_velocity: CoriolisVelocity,
}

/// What the feedback law computes before it knows the model.
#[derive(Debug, Clone, Copy)]
pub struct SlidingSignals<T, const N: usize> {
    /// Tracking error `e = q − q_d`, rad.
    pub error: SVector<T, N>,
    /// Coriolis velocity `u`, rad/s.
    pub coriolis_velocity: SVector<T, N>,
    /// Reference velocity `v_r = q̇_d − Λ e`, rad/s.
    pub reference_velocity: SVector<T, N>,
    /// Reference acceleration `a_r = q̈_d − Λ (v* − q̇_d)`, rad/s².
    pub reference_acceleration: SVector<T, N>,
    /// Sliding variable `s = v* − v_r`, rad/s.
    pub sliding_variable: SVector<T, N>,
}

impl<T: Scalar, const N: usize> SlidingFeedback<T, N> {
    /// Error, references and sliding variable for velocity `v*`. Source: paper eq. (5) to (7), (15).
    #[inline(always)]
    pub fn signals(
        &self,
        position: &SVector<T, N>,
        velocity: &SVector<T, N>,
        desired: &Desired<T, N>,
    ) -> SlidingSignals<T, N> {
        let error = position - desired.position;
        let reference_velocity = desired.velocity - self.lambda.component_mul(&error);
        let reference_acceleration = desired.acceleration - self.lambda.component_mul(&(velocity - desired.velocity));
        SlidingSignals {
            error,
            coriolis_velocity: match self.coriolis_velocity {
                CoriolisVelocity::Estimated => *velocity,
                CoriolisVelocity::Reference => reference_velocity,
            },
            reference_velocity,
            reference_acceleration,
            sliding_variable: velocity - reference_velocity,
        }
    }

    /// `τ = −K s + Y θ̂`, N·m. Source: paper eq. (3), (13).
    #[inline(always)]
    pub fn torque(&self, signals: &SlidingSignals<T, N>, model_torque: &SVector<T, N>) -> SVector<T, N> {
        model_torque - self.gain.component_mul(&signals.sliding_variable)
    }
}
