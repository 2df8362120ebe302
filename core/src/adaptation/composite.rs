//! Composite adaptation: tracking error and remembered prediction error together.
//!
//! Tang and Arteaga: `θ̂' = −δ g − Γ1 Yᵀ s` (paper eq. 9). Proposed: `θ̂' = −Γ (β w + Yᵀ s + f_b)` (paper eq. 14), with
//! the projection of eq. (19), (20). The memory is the same in both.

use super::{AdaptationInput, AdaptationLaw, FilteredRegressor, Mixing, PredictionMemory, Projection};
use crate::robots::Robot;
use crate::scalar::{Pack, Scalar};
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
        memory: &[T],
        gradient: &SVector<T, P>,
        theta_hat: &[T],
        rate: &mut [T],
    ) {
        let (theta_hat, rate) = (&theta_hat[..P], &mut rate[..P]);
        if let Self::Mixed(mixing) = self {
            let w = |k| PredictionMemory::<R, T, N, P>::w::<T>(memory, k);
            mixing.theta_hat_rate(w, |i, j| PredictionMemory::<R, T, N, P>::correlation(memory, i, j), rate);
            return;
        }
        let width = <T::Pack as Pack<T>>::WIDTH;
        unrolled!(P / width, n => {
            let from = n * width;
            let w = PredictionMemory::<R, T, N, P>::w::<T::Pack>(memory, from);
            self.rate_from(from, w, gradient, theta_hat).store(&mut rate[from..]);
        });
        for k in P / width * width..P {
            let w = PredictionMemory::<R, T, N, P>::w::<T>(memory, k);
            rate[k] = self.rate_from(k, w, gradient, theta_hat);
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

    #[inline(always)]
    fn derivative(
        &self,
        input: &AdaptationInput<'_, R, T, N, P>,
        states: &[T],
        theta_hat_rate: &mut [T],
        states_rate: &mut [T],
    ) {
        if T::IS_PLAIN {
            self.derivative_apart(input, states, theta_hat_rate, states_rate);
        } else {
            self.derivative_within(input, states, theta_hat_rate, states_rate);
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
        states: &[T],
        theta_hat_rate: &mut [T],
        states_rate: &mut [T],
    ) {
        self.derivative_within(input, states, theta_hat_rate, states_rate);
    }

    #[inline(always)]
    fn derivative_within(
        &self,
        input: &AdaptationInput<'_, R, T, N, P>,
        states: &[T],
        theta_hat_rate: &mut [T],
        states_rate: &mut [T],
    ) {
        let (filter, memory) = states.split_at(Self::MEMORY);
        let (filter_rate, memory_rate) = states_rate.split_at_mut(Self::MEMORY);
        let (filtered, filtered_torque) =
            self.filter.advance(input.geometry, input.velocity, input.sign_velocity, input.torque, filter, filter_rate);
        self.law.theta_hat_rate::<R, N>(memory, input.gradient, input.theta_hat, theta_hat_rate);
        self.memory.derivative(&filtered, &filtered_torque, input.theta_hat, theta_hat_rate, memory, memory_rate);
    }
}
