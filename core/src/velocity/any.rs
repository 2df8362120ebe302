//! Any velocity source, chosen when the program runs: what lets every scheme have every source.

use super::{FilteredDifference, HighGainObserver, Measured, ModelFreeObserver, VelocityEstimate, VelocitySource};
use crate::scalar::Scalar;
use crate::states::States;
use crate::trajectories::Desired;
use nalgebra::SVector;

/// One of the velocity sources.
#[derive(Debug, Clone, Copy)]
pub enum AnySource<T, const N: usize> {
    /// A sensor.
    Measured(Measured<T, N>),
    /// The paper's observer.
    Observer(ModelFreeObserver<T, N>),
    /// A difference behind a low-pass filter.
    FilteredDifference(FilteredDifference<T>),
    /// A linear observer.
    HighGain(HighGainObserver<T>),
}

/// The same call on whichever source it is.
macro_rules! each {
    ($self:ident, $source:ident => $call:expr) => {
        match $self {
            Self::Measured($source) => $call,
            Self::Observer($source) => $call,
            Self::FilteredDifference($source) => $call,
            Self::HighGain($source) => $call,
        }
    };
}

impl<T: Scalar, const N: usize> VelocitySource<T, N> for AnySource<T, N> {
    const MEASURED: bool = false;

    fn states(&self) -> usize {
        each!(self, source => VelocitySource::<T, N>::states(source))
    }

    fn initialize(&self, position: &SVector<T, N>, desired: &Desired<T, N>, states: &mut [T]) {
        each!(self, source => source.initialize(position, desired, states));
    }

    #[inline(always)]
    fn estimate(
        &self,
        position: &SVector<T, N>,
        velocity: &SVector<T, N>,
        desired: &Desired<T, N>,
        states: impl States<T>,
    ) -> VelocityEstimate<T, N> {
        each!(self, source => source.estimate(position, velocity, desired, states))
    }

    #[inline(always)]
    fn derivative(&self, estimate: &VelocityEstimate<T, N>, derivative: &mut [T]) {
        each!(self, source => source.derivative(estimate, derivative));
    }
}
