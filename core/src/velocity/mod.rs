//! Velocity sources: what a controller may take for the joint velocity.
//!
//! The first of the three choices that make a scheme. A source may have states of its own, which the simulation integrates.

mod measured;
mod observer;

pub use measured::Measured;
pub use observer::ModelFreeObserver;

use crate::scalar::Scalar;
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

    /// Writes the initial states for a start at `position`.
    fn initialize(&self, position: &SVector<T, N>, states: &mut [T]);

    /// v* at this instant. `velocity` is the true joint velocity, for sources that measure it.
    fn estimate(
        &self,
        position: &SVector<T, N>,
        velocity: &SVector<T, N>,
        desired: &Desired<T, N>,
        states: &[T],
    ) -> VelocityEstimate<T, N>;

    /// Writes the states' derivative.
    fn derivative(&self, estimate: &VelocityEstimate<T, N>, derivative: &mut [T]);
}
