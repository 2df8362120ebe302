//! Gradient adaptation of Slotine and Li: `θ̂' = −Γ Yᵀ s`. Source: paper eq. (4), with its sign mended (with the printed
//! plus the loop diverges).

use super::{AdaptationInput, AdaptationLaw};
use crate::robots::Robot;
use crate::scalar::Scalar;
use crate::states::States;
use nalgebra::SVector;

/// The law with diagonal gain Γ.
#[derive(Debug, Clone, Copy)]
pub struct GradientAdaptation<T, const P: usize> {
    /// Diagonal of Γ, per parameter.
    pub gain: SVector<T, P>,
}

impl<R: Robot<N, P>, T: Scalar, const N: usize, const P: usize> AdaptationLaw<R, T, N, P> for GradientAdaptation<T, P> {
    const FILTERS: bool = false;

    fn states(&self) -> usize {
        0
    }

    fn initialize(&self, _geometry: &R::Geometry<T>, _velocity: &SVector<T, N>, _states: &mut [T]) {}

    type Begun = ();

    fn begin(&self, _: &R::Geometry<T>, _: &SVector<T, N>, _: &SVector<T, N>, _: impl States<T>, _: Option<&mut [T]>) {}

    #[inline(always)]
    fn derivative(
        &self,
        _: Option<()>,
        input: &AdaptationInput<'_, R, T, N, P>,
        _states: impl States<T>,
        theta_hat_rate: &mut [T],
        _states_rate: &mut [T],
    ) {
        for k in 0..P {
            theta_hat_rate[k] = -self.gain[k] * input.gradient[k];
        }
    }
}
