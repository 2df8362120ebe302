//! A joint-velocity sensor without imperfection: v* = q̇.

use super::{VelocityEstimate, VelocitySource};
use crate::scalar::Scalar;
use crate::states::States;
use crate::trajectories::Desired;
use nalgebra::SVector;

/// v* = q̇. Source: paper eq. (6), schemes of sections 3.1 and 3.2.
///
/// No observer runs, so q̂ never leaves its start and the recorded `z = q − q̂` is the distance travelled: what the
/// reference data record too. Figures and reports show z only where an observer runs.
#[derive(Debug, Clone, Copy)]
pub struct Measured<T, const N: usize> {
    /// q̂ = q(0), rad.
    pub start: SVector<T, N>,
}

impl<T: Scalar, const N: usize> VelocitySource<T, N> for Measured<T, N> {
    const MEASURED: bool = true;

    fn states(&self) -> usize {
        0
    }

    fn initialize(&self, _position: &SVector<T, N>, _desired: &Desired<T, N>, _states: &mut [T]) {}

    #[inline(always)]
    fn estimate(
        &self,
        position: &SVector<T, N>,
        velocity: &SVector<T, N>,
        _desired: &Desired<T, N>,
        _states: impl States<T>,
    ) -> VelocityEstimate<T, N> {
        VelocityEstimate { velocity: *velocity, observer_error: position - self.start }
    }

    fn derivative(&self, _estimate: &VelocityEstimate<T, N>, _derivative: &mut [T]) {}
}
