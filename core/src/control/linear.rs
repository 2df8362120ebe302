//! Yardsticks that do not adapt: PD, PD with gravity, computed torque. In each, θ̂ is a constant that the law is given.
//!
//! With `e = q − q_d` and `ė* = v* − q̇_d`:
//! PD with gravity `τ = g(q; θ̂) − Kp e − Kd ė*` (Takegaki and Arimoto 1981), PD the same with θ̂ = 0;
//! computed torque `τ = Y(q, v*, v*, q̈_d − Kd ė* − Kp e) θ̂` (Luh, Walker and Paul 1980), which with the true θ and the
//! true velocity makes the error obey `ë + Kd ė + Kp e = 0` exactly.

use super::SlidingSignals;
use crate::scalar::Scalar;
use crate::trajectories::Desired;
use nalgebra::SVector;

/// How the model enters.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LinearModel {
    /// Added to the feedback, at rest: gravity alone.
    Gravity,
    /// Inverse dynamics of the acceleration that the feedback asks for.
    Inverse,
}

/// A linear feedback law with diagonal gains.
#[derive(Debug, Clone, Copy)]
pub struct LinearFeedback<T, const N: usize> {
    /// Kp; N·m/rad beside gravity, 1/s² within inverse dynamics.
    pub k_p: SVector<T, N>,
    /// Kd; N·m·s/rad or 1/s.
    pub k_d: SVector<T, N>,
    /// How the model enters.
    pub model: LinearModel,
}

impl<T: Scalar, const N: usize> LinearFeedback<T, N> {
    /// Where the model is evaluated. The sliding variable is `ė*` here: there is no surface to slide on.
    #[inline(always)]
    pub fn signals(
        &self,
        position: &SVector<T, N>,
        velocity: &SVector<T, N>,
        desired: &Desired<T, N>,
    ) -> SlidingSignals<T, N> {
        let error = position - desired.position;
        let error_rate = velocity - desired.velocity;
        let (model_velocity, model_acceleration) = match self.model {
            LinearModel::Gravity => (SVector::zeros(), SVector::zeros()),
            LinearModel::Inverse => {
                let feedback = self.k_d.component_mul(&error_rate) + self.k_p.component_mul(&error);
                (*velocity, desired.acceleration - feedback)
            }
        };
        SlidingSignals {
            error,
            coriolis_velocity: model_velocity,
            reference_velocity: model_velocity,
            reference_acceleration: model_acceleration,
            sliding_variable: error_rate,
        }
    }

    /// The torque, N·m, given the model's.
    #[inline(always)]
    pub fn torque(&self, signals: &SlidingSignals<T, N>, model_torque: &SVector<T, N>) -> SVector<T, N> {
        match self.model {
            LinearModel::Gravity => {
                model_torque
                    - self.k_p.component_mul(&signals.error)
                    - self.k_d.component_mul(&signals.sliding_variable)
            }
            LinearModel::Inverse => *model_torque,
        }
    }
}
