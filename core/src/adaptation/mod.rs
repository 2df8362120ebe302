//! Adaptation laws: how the parameter estimates θ̂ move.
//!
//! The third of the three choices that make a scheme. A law may integrate states of its own beside θ̂.

mod any;
mod composite;
mod concurrent;
mod filtered_regressor;
mod gradient;
mod least_squares;
mod mixing;
mod modification;
mod prediction_memory;
mod projection;

pub use any::AnyAdaptation;
pub use composite::{CompositeAdaptation, CompositeLaw};
pub use concurrent::ConcurrentLearning;
pub use filtered_regressor::FilteredRegressor;
pub use gradient::GradientAdaptation;
pub use least_squares::LeastSquaresAdaptation;
pub use mixing::Mixing;
pub use modification::Modification;
pub use prediction_memory::PredictionMemory;
pub use projection::Projection;

use crate::robots::Robot;
use crate::scalar::Scalar;
use crate::states::States;
use nalgebra::SVector;

/// What an adaptation law sees at one instant.
#[derive(Debug, Clone, Copy)]
pub struct AdaptationInput<'a, R: Robot<N, P>, T: Scalar, const N: usize, const P: usize> {
    /// Geometry at the joint angles.
    pub geometry: &'a R::Geometry<T>,
    /// Velocity v*, rad/s.
    pub velocity: &'a SVector<T, N>,
    /// `sgn(v*)`, as regularised; only filled in for laws that filter.
    pub sign_velocity: &'a SVector<T, N>,
    /// Torque that the controller commands, N·m; without actuator limits it is the applied one.
    pub torque: &'a SVector<T, N>,
    /// `Yᵀ s` of the feedback law, modified where a [`Modification`] says so.
    pub gradient: &'a SVector<T, P>,
    /// Estimates θ̂.
    pub theta_hat: &'a [T],
}

/// An adaptation law.
pub trait AdaptationLaw<R: Robot<N, P>, T: Scalar, const N: usize, const P: usize>: Send {
    /// Whether the law filters the dynamics and so needs `sgn(v*)`.
    const FILTERS: bool;

    /// Number of states beside θ̂.
    fn states(&self) -> usize;

    /// Number of states as [`Self::write_plain`] writes them.
    fn plain_states(&self) -> usize {
        self.states()
    }

    /// Writes the states without what is kept for vector instructions only.
    fn write_plain(&self, states: &[T], plain: &mut [T]) {
        plain.copy_from_slice(states);
    }

    /// Writes the states from what [`Self::write_plain`] wrote.
    fn read_plain(&self, plain: &[T], states: &mut [T]) {
        states.copy_from_slice(plain);
    }

    /// Writes the initial states for a start at this configuration and velocity v*.
    fn initialize(&self, geometry: &R::Geometry<T>, velocity: &SVector<T, N>, states: &mut [T]);

    /// What [`Self::begin`] hands to [`Self::derivative`]; nothing where a law has nothing to begin.
    type Begun: Copy;

    /// The part of the states' derivative that needs neither torque nor gradient, at this configuration and velocity v*: the
    /// processor can work on it while both are still being computed. Writes nothing without `states_rate`.
    fn begin(
        &self,
        geometry: &R::Geometry<T>,
        velocity: &SVector<T, N>,
        sign_velocity: &SVector<T, N>,
        states: impl States<T>,
        states_rate: Option<&mut [T]>,
    ) -> Self::Begun;

    /// Writes `θ̂'` and the states' derivative, or what is left of it where that has been begun.
    fn derivative(
        &self,
        begun: Option<Self::Begun>,
        input: &AdaptationInput<'_, R, T, N, P>,
        states: impl States<T>,
        theta_hat_rate: &mut [T],
        states_rate: &mut [T],
    );
}
