//! Least squares with bounded-gain forgetting, driven by tracking and prediction errors.
//!
//! `θ̂' = −P (Yᵀ s + γ Yfᵀ ε)`, `ε = Yf θ̂ − τf`, `P' = λ(t) P − γ P Yfᵀ Yf P`, `λ(t) = λ0 (1 − tr P / k0)`.
//! Since `(P⁻¹)' = −λ P⁻¹ + γ Yfᵀ Yf`, the estimates without tracking error are those of weighted least squares, old data fading
//! at rate λ; as tr P nears k0 forgetting stops, so gains stay bounded without excitation.
//! Source: Slotine and Li, *Applied Nonlinear Control*, section 8.7.6; as composite adaptation, Slotine and Li (1989). The trace
//! stands for their norm: for P ≥ 0 it bounds it, and needs no eigenvalues.

use super::{AdaptationInput, AdaptationLaw, FilteredRegressor};
use crate::regressor::{gradient, model_torque};
use crate::robots::{Regressor, Robot};
use crate::scalar::Scalar;
use crate::states::States;
use nalgebra::{SMatrix, SVector};

/// The law. States: the filter's, then P's upper triangle row by row.
#[derive(Debug, Clone, Copy)]
pub struct LeastSquaresAdaptation<R, T, const N: usize, const P: usize> {
    /// The filtered regressor.
    pub filter: FilteredRegressor<R, T, N, P>,
    /// Diagonal of P(0).
    pub initial_gain: SVector<T, P>,
    /// γ: weight of prediction errors.
    pub weight: T,
    /// λ0, 1/s.
    pub forgetting: T,
    /// k0, which the trace of P cannot pass.
    pub gain_limit: T,
}

impl<R: Robot<N, P>, T: Scalar, const N: usize, const P: usize> LeastSquaresAdaptation<R, T, N, P> {
    const TRIANGLE: usize = P * (P + 1) / 2;

    /// `Yf P`, and the trace of P; `packed` is P's upper triangle.
    #[inline(always)]
    fn times_gain(filtered: &Regressor<T, N, P>, packed: impl States<T>) -> (Regressor<T, N, P>, T) {
        let (mut product, mut trace, mut n) = (Regressor::<T, N, P>::zeros(), T::zero(), 0);
        for i in 0..P {
            trace += packed.at(n);
            for j in i..P {
                for row in 0..N {
                    product[(row, j)] += filtered[(row, i)] * packed.at(n);
                    if i != j {
                        product[(row, i)] += filtered[(row, j)] * packed.at(n);
                    }
                }
                n += 1;
            }
        }
        (product, trace)
    }

    /// P as a matrix, from a state of the law: for people and tests.
    pub fn gain(states: &[T]) -> SMatrix<T, P, P> {
        let (mut gain, mut n) = (SMatrix::<T, P, P>::zeros(), FilteredRegressor::<R, T, N, P>::STATES);
        for i in 0..P {
            for j in i..P {
                gain[(i, j)] = states[n];
                gain[(j, i)] = states[n];
                n += 1;
            }
        }
        gain
    }
}

impl<R: Robot<N, P>, T: Scalar, const N: usize, const P: usize> AdaptationLaw<R, T, N, P>
    for LeastSquaresAdaptation<R, T, N, P>
{
    const FILTERS: bool = true;

    fn states(&self) -> usize {
        FilteredRegressor::<R, T, N, P>::STATES + Self::TRIANGLE
    }

    fn initialize(&self, geometry: &R::Geometry<T>, velocity: &SVector<T, N>, states: &mut [T]) {
        let (filter, gain) = states.split_at_mut(FilteredRegressor::<R, T, N, P>::STATES);
        self.filter.initialize(geometry, velocity, filter);
        gain.fill(T::zero());
        let mut n = 0;
        for i in 0..P {
            gain[n] = self.initial_gain[i];
            n += P - i;
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
        let (filter, packed) = (states, states.after(FilteredRegressor::<R, T, N, P>::STATES));
        let (filter_rate, packed_rate) = states_rate.split_at_mut(FilteredRegressor::<R, T, N, P>::STATES);
        let (filtered, filtered_torque) =
            self.filter.advance(input.geometry, input.velocity, input.sign_velocity, input.torque, filter, filter_rate);
        let prediction_error = model_torque::<R, T, N, P>(&filtered, input.theta_hat) - filtered_torque;
        let drive = input.gradient + gradient::<R, T, N, P>(&filtered, &prediction_error) * self.weight;
        let (product, trace) = Self::times_gain(&filtered, packed);
        let forgetting = self.forgetting * (T::one() - trace / self.gain_limit);
        for k in 0..P {
            theta_hat_rate[k] = T::zero();
        }
        let mut n = 0;
        for i in 0..P {
            for j in i..P {
                let mut known = T::zero();
                for row in 0..N {
                    known += product[(row, i)] * product[(row, j)];
                }
                packed_rate[n] = forgetting * packed.at(n) - self.weight * known;
                theta_hat_rate[i] -= packed.at(n) * drive[j];
                if i != j {
                    theta_hat_rate[j] -= packed.at(n) * drive[i];
                }
                n += 1;
            }
        }
    }
}
