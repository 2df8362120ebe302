//! Composite adaptation: tracking error and remembered prediction error together.
//!
//! Tang and Arteaga: `θ̂' = −δ g − Γ1 Yᵀ s` (paper eq. 9). Proposed: `θ̂' = −Γ (β w + Yᵀ s + f_b)` (paper eq. 14), with
//! the projection of eq. (19), (20). The memory is the same in both.

use super::{AdaptationInput, AdaptationLaw, FilteredRegressor, Mixing, PredictionMemory, Projection};
use crate::regressor::model_torque;
use crate::robots::{Regressor, Robot};
use crate::scalar::{Pack, Scalar};
use crate::states::States;
use crate::unroll::unrolled;
use nalgebra::SVector;

/// How θ̂ follows the gradient and the memory.
#[derive(Debug, Clone, Copy)]
pub enum CompositeLaw<T, const P: usize> {
    /// `θ̂' = −δ g − Γ1 Yᵀ s`. Source: paper eq. (9).
    Additive {
        /// Diagonal of Γ1.
        gain: SVector<T, P>,
        /// δ.
        memory_gain: T,
    },
    /// `θ̂' = −Γ (β w + Yᵀ s + f_b)`. Source: paper eq. (14).
    Projected {
        /// Diagonal of Γ.
        gain: SVector<T, P>,
        /// β.
        memory_gain: T,
        /// f_b.
        projection: Projection<T, P>,
    },
    /// Each parameter by itself, without the gradient: see [`Mixing`].
    Mixed(Mixing<P>),
}

/// A composite law: filter, memory, and how they move θ̂. States: filter, filled up to a whole vector, then memory.
#[derive(Debug, Clone, Copy)]
pub struct CompositeAdaptation<R, T, const N: usize, const P: usize> {
    /// The filtered regressor.
    pub filter: FilteredRegressor<R, T, N, P>,
    /// The memory of prediction errors.
    pub memory: PredictionMemory<R, T, N, P>,
    /// How both move θ̂.
    pub law: CompositeLaw<T, P>,
}

impl<T: Scalar, const P: usize> CompositeLaw<T, P> {
    #[inline(always)]
    fn theta_hat_rate<R: Robot<N, P>, const N: usize>(
        &self,
        memory: impl States<T>,
        gradient: &SVector<T, P>,
        theta_hat: &[T],
        rate: &mut [T],
    ) {
        let (theta_hat, rate) = (&theta_hat[..P], &mut rate[..P]);
        if let Self::Mixed(mixing) = self {
            let w = |k| PredictionMemory::<R, T, N, P>::w(memory, k);
            mixing.theta_hat_rate(w, |i, j| PredictionMemory::<R, T, N, P>::correlation(memory, i, j), rate);
            return;
        }
        let width = <T::Pack as Pack<T>>::WIDTH;
        unrolled!(P / width, n => {
            let from = n * width;
            let w = PredictionMemory::<R, T, N, P>::w(memory, from);
            self.rate_from::<T::Pack>(from, w, gradient, theta_hat).store(&mut rate[from..]);
        });
        for k in P / width * width..P {
            let w = PredictionMemory::<R, T, N, P>::w(memory, k);
            rate[k] = self.rate_from::<T>(k, w, gradient, theta_hat);
        }
    }

    /// `θ̂'` of the parameters from the `k`th on that a pack `S` holds, w being theirs; not for [`Self::Mixed`].
    #[inline(always)]
    fn rate_from<S: Scalar + Pack<T>>(&self, k: usize, w: S, gradient: &SVector<T, P>, theta_hat: &[T]) -> S {
        let (repeat, load) = (<S as Pack<T>>::repeat, <S as Pack<T>>::load);
        let gradient = load(&gradient.as_slice()[k..]);
        match self {
            Self::Additive { gain, memory_gain } => {
                -(repeat(*memory_gain) * w) - load(&gain.as_slice()[k..]) * gradient
            }
            Self::Projected { gain, memory_gain, projection } => {
                let drive = repeat(*memory_gain) * w + gradient;
                let correction = projection.correction(k, load(&theta_hat[k..]), drive);
                -load(&gain.as_slice()[k..]) * (drive + correction)
            }
            // Never asked: the caller has its rates from elsewhere.
            Self::Mixed(_) => <S as num_traits::Zero>::zero(),
        }
    }
}

impl<R: Robot<N, P>, T: Scalar, const N: usize, const P: usize> AdaptationLaw<R, T, N, P>
    for CompositeAdaptation<R, T, N, P>
{
    const FILTERS: bool = true;

    fn states(&self) -> usize {
        Self::MEMORY + PredictionMemory::<R, T, N, P>::STATES
    }

    fn plain_states(&self) -> usize {
        FilteredRegressor::<R, T, N, P>::STATES + PredictionMemory::<R, T, N, P>::PLAIN_STATES
    }

    fn write_plain(&self, states: &[T], plain: &mut [T]) {
        let filter = FilteredRegressor::<R, T, N, P>::STATES;
        plain[..filter].copy_from_slice(&states[..filter]);
        PredictionMemory::<R, T, N, P>::write_plain(&states[Self::MEMORY..], &mut plain[filter..]);
    }

    fn read_plain(&self, plain: &[T], states: &mut [T]) {
        let filter = FilteredRegressor::<R, T, N, P>::STATES;
        states[..filter].copy_from_slice(&plain[..filter]);
        PredictionMemory::<R, T, N, P>::read_plain(&plain[filter..], &mut states[Self::MEMORY..]);
    }

    fn initialize(&self, geometry: &R::Geometry<T>, velocity: &SVector<T, N>, states: &mut [T]) {
        let (filter, memory) = states.split_at_mut(Self::MEMORY);
        self.filter.initialize(geometry, velocity, filter);
        memory.fill(T::zero());
    }

    /// `Yf`, one by one and in packs.
    type Begun = (Regressor<T, N, P>, [[T::Pack; P]; N]);

    #[inline(always)]
    fn begin(
        &self,
        geometry: &R::Geometry<T>,
        velocity: &SVector<T, N>,
        sign_velocity: &SVector<T, N>,
        states: impl States<T>,
        states_rate: Option<&mut [T]>,
    ) -> Self::Begun {
        let (filter, memory) = (states, states.after(Self::MEMORY));
        let filtered = self.filter.regressor(geometry, velocity, filter);
        let rows = PredictionMemory::<R, T, N, P>::rows(&filtered);
        if let Some(rate) = states_rate {
            let (filter_rate, memory_rate) = rate.split_at_mut(Self::MEMORY);
            self.filter.regressor_rate(geometry, velocity, sign_velocity, &filtered, filter_rate);
            self.memory.correlation_rate(&filtered, &rows, memory, memory_rate);
        }
        (filtered, rows)
    }

    #[inline(always)]
    fn derivative(
        &self,
        begun: Option<Self::Begun>,
        input: &AdaptationInput<'_, R, T, N, P>,
        states: impl States<T>,
        theta_hat_rate: &mut [T],
        states_rate: &mut [T],
    ) {
        if T::IS_PLAIN && begun.is_none() {
            self.derivative_apart(input, states, theta_hat_rate, states_rate);
        } else {
            self.derivative_within(begun, input, states, theta_hat_rate, states_rate);
        }
    }
}

impl<R: Robot<N, P>, T: Scalar, const N: usize, const P: usize> CompositeAdaptation<R, T, N, P> {
    /// Where the memory's states begin: at a multiple of a vector's length.
    const MEMORY: usize = FilteredRegressor::<R, T, N, P>::STATES.next_multiple_of(<T::Pack as Pack<T>>::WIDTH);

    /// A function of its own: the compiler then knows that its arguments do not overlap, and works on numbers in pairs.
    #[inline(never)]
    fn derivative_apart(
        &self,
        input: &AdaptationInput<'_, R, T, N, P>,
        states: impl States<T>,
        theta_hat_rate: &mut [T],
        states_rate: &mut [T],
    ) {
        self.derivative_within(None, input, states, theta_hat_rate, states_rate);
    }

    #[inline(always)]
    fn derivative_within(
        &self,
        begun: Option<<Self as AdaptationLaw<R, T, N, P>>::Begun>,
        input: &AdaptationInput<'_, R, T, N, P>,
        states: impl States<T>,
        theta_hat_rate: &mut [T],
        states_rate: &mut [T],
    ) {
        let (filter, memory) = (states, states.after(Self::MEMORY));
        // First, because it asks for no Yf: where that is not begun yet, fewer numbers wait meanwhile, and fewer go to memory and back.
        self.law.theta_hat_rate::<R, N>(memory, input.gradient, input.theta_hat, theta_hat_rate);
        let (filtered, rows) = if let Some(begun) = begun {
            begun
        } else {
            let AdaptationInput { geometry, velocity, sign_velocity, .. } = input;
            self.begin(geometry, velocity, sign_velocity, states, Some(&mut *states_rate))
        };
        let (filter_rate, memory_rate) = states_rate.split_at_mut(Self::MEMORY);
        let filtered_torque = self.filter.torque(input.torque, filter, filter_rate);
        let prediction_error = model_torque::<R, T, N, P>(&filtered, input.theta_hat) - filtered_torque;
        self.memory.derivative(&filtered, &rows, &prediction_error, theta_hat_rate, memory, memory_rate);
    }
}
