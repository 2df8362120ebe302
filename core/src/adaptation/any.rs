//! Any adaptation law, chosen when the program runs; also none, for yardsticks whose θ̂ is given.

use super::{
    AdaptationInput, AdaptationLaw, CompositeAdaptation, CompositeLaw, ConcurrentLearning, GradientAdaptation,
    LeastSquaresAdaptation,
};
use crate::robots::Robot;
use crate::scalar::Scalar;
use crate::states::States;
use nalgebra::SVector;

/// One of the adaptation laws.
#[derive(Debug, Clone, Copy)]
pub enum AnyAdaptation<R, T, const N: usize, const P: usize> {
    /// `θ̂' = 0`.
    None,
    /// Slotine and Li's.
    Gradient(GradientAdaptation<T, P>),
    /// Tang and Arteaga's, the proposed one.
    Composite(CompositeAdaptation<R, T, N, P>),
    /// Least squares with bounded-gain forgetting.
    LeastSquares(LeastSquaresAdaptation<R, T, N, P>),
    /// Concurrent learning.
    Concurrent(ConcurrentLearning<R, T, N, P>),
}

impl<R: Robot<N, P>, T: Scalar, const N: usize, const P: usize> AnyAdaptation<R, T, N, P> {
    /// Diagonal of the Γ that weighs parameter errors in the scheme's Lyapunov function; `None` where there is no such constant.
    pub fn lyapunov_gain(&self) -> Option<SVector<T, P>> {
        match self {
            Self::Gradient(law) => Some(law.gain),
            Self::Concurrent(law) => Some(law.gain),
            Self::Composite(law) => match &law.law {
                CompositeLaw::Additive { gain, .. } | CompositeLaw::Projected { gain, .. } => Some(*gain),
                // It does not cancel what the errors do to the motion: they fade by themselves.
                CompositeLaw::Mixed(_) => None,
            },
            Self::None | Self::LeastSquares(_) => None,
        }
    }
}

impl<R: Robot<N, P>, T: Scalar, const N: usize, const P: usize> AdaptationLaw<R, T, N, P>
    for AnyAdaptation<R, T, N, P>
{
    const FILTERS: bool = true;

    fn states(&self) -> usize {
        match self {
            Self::None => 0,
            Self::Gradient(law) => AdaptationLaw::<R, T, N, P>::states(law),
            Self::Composite(law) => law.states(),
            Self::LeastSquares(law) => law.states(),
            Self::Concurrent(law) => law.states(),
        }
    }

    fn initialize(&self, geometry: &R::Geometry<T>, velocity: &SVector<T, N>, states: &mut [T]) {
        match self {
            Self::None => {}
            Self::Gradient(law) => AdaptationLaw::<R, T, N, P>::initialize(law, geometry, velocity, states),
            Self::Composite(law) => law.initialize(geometry, velocity, states),
            Self::LeastSquares(law) => law.initialize(geometry, velocity, states),
            Self::Concurrent(law) => law.initialize(geometry, velocity, states),
        }
    }

    type Begun = ();

    fn begin(&self, _: &R::Geometry<T>, _: &SVector<T, N>, _: &SVector<T, N>, _: impl States<T>, _: Option<&mut [T]>) {}

    #[inline(always)]
    fn derivative(
        &self,
        _: Option<()>,
        input: &AdaptationInput<'_, R, T, N, P>,
        states: impl States<T>,
        theta_hat_rate: &mut [T],
        states_rate: &mut [T],
    ) {
        match self {
            Self::None => theta_hat_rate.fill(T::zero()),
            Self::Gradient(law) => law.derivative(None, input, states, theta_hat_rate, states_rate),
            Self::Composite(law) => law.derivative(None, input, states, theta_hat_rate, states_rate),
            Self::LeastSquares(law) => law.derivative(None, input, states, theta_hat_rate, states_rate),
            Self::Concurrent(law) => law.derivative(None, input, states, theta_hat_rate, states_rate),
        }
    }
}
