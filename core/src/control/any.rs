//! Any feedback law, chosen when the program runs.

use super::{LinearFeedback, SlidingFeedback, SlidingSignals};
use crate::scalar::Scalar;
use crate::trajectories::Desired;
use nalgebra::SVector;

/// One of the feedback laws.
#[derive(Debug, Clone, Copy)]
pub enum AnyFeedback<T, const N: usize> {
    /// The paper's form, with a model that adapts.
    Sliding(SlidingFeedback<T, N>),
    /// PD, PD with gravity, computed torque.
    Linear(LinearFeedback<T, N>),
}

impl<T: Scalar, const N: usize> AnyFeedback<T, N> {
    /// What the law computes before it knows the model.
    #[inline(always)]
    pub fn signals(
        &self,
        position: &SVector<T, N>,
        velocity: &SVector<T, N>,
        desired: &Desired<T, N>,
    ) -> SlidingSignals<T, N> {
        match self {
            Self::Sliding(law) => law.signals(position, velocity, desired),
            Self::Linear(law) => law.signals(position, velocity, desired),
        }
    }

    /// The torque, N·m, given the model's.
    #[inline(always)]
    pub fn torque(&self, signals: &SlidingSignals<T, N>, model_torque: &SVector<T, N>) -> SVector<T, N> {
        match self {
            Self::Sliding(law) => law.torque(signals, model_torque),
            Self::Linear(law) => law.torque(signals, model_torque),
        }
    }
}
