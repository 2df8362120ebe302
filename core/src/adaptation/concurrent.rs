//! Concurrent learning: the gradient law, and beside it the prediction errors of moments that were worth remembering.
//!
//! `θ̂' = −Γ (Yᵀ s + γ/n Σ_j Yf_jᵀ (Yf_j θ̂ − τf_j))` over the n moments of a stack. Once `Σ Yf_jᵀ Yf_j` is positive, which takes excitation
//! for a while only, θ̃ → 0 exponentially without persistent excitation. A full stack exchanges a moment for a new one where that raises
//! the sum's smallest eigenvalue most. Source: Chowdhary and Johnson (2010), and (2011) for the choice; that their equation error is here
//! the filtered one, which needs no acceleration, and that the sum is a mean, is chosen. Assumes an exact velocity and nothing from outside.

use super::{AdaptationInput, AdaptationLaw, FilteredRegressor};
use crate::eigen::symmetric_eigen;
use crate::regressor::{gradient, model_torque};
use crate::robots::{Regressor, Robot};
use crate::scalar::Scalar;
use crate::states::States;
use nalgebra::SVector;

/// A moment is new if it differs by this share from the one recorded last.
const NOVELTY: f64 = 0.1;

/// The law. States: the filter's, the number of moments recorded, then per moment the live entries of Yf and τf.
#[derive(Debug, Clone, Copy)]
pub struct ConcurrentLearning<R, T, const N: usize, const P: usize> {
    /// The filtered regressor.
    pub filter: FilteredRegressor<R, T, N, P>,
    /// Diagonal of Γ.
    pub gain: SVector<T, P>,
    /// γ: weight of the remembered prediction errors.
    pub weight: T,
    /// Moments that the stack can hold.
    pub capacity: usize,
    /// Sizes of the parameters, in which eigenvalues are compared.
    pub scale: SVector<f64, P>,
}

impl<R: Robot<N, P>, T: Scalar, const N: usize, const P: usize> ConcurrentLearning<R, T, N, P> {
    const FILTER: usize = FilteredRegressor::<R, T, N, P>::STATES;
    const MOMENT: usize = R::ENTRIES.len() + N;

    /// Moments recorded.
    pub fn recorded(states: impl States<T>) -> usize {
        states.at(Self::FILTER).lane(0) as usize
    }

    /// A moment's Yf and τf.
    fn read(moment: impl States<T>) -> (Regressor<T, N, P>, SVector<T, N>) {
        let mut filtered = Regressor::<T, N, P>::zeros();
        for (n, entry) in R::ENTRIES.iter().enumerate() {
            filtered[*entry] = moment.at(n);
        }
        (filtered, moment.after(R::ENTRIES.len()).vector())
    }

    /// `(Yf S)ᵀ (Yf S)` by rows, S the diagonal of the scales.
    fn gram(&self, filtered: &Regressor<T, N, P>) -> Vec<f64> {
        let scaled = |row, k: usize| filtered[(row, k)].lane(0) * self.scale[k];
        let entry = |n: usize| (0..N).map(|row| scaled(row, n / P) * scaled(row, n % P)).sum();
        (0..P * P).map(entry).collect()
    }

    /// Records this moment if it is new and there is room, or if the stack is better with it than with another one.
    pub fn record(&self, geometry: &R::Geometry<T>, velocity: &SVector<T, N>, states: &mut [T]) {
        let (filter, stack) = states.split_at_mut(Self::FILTER);
        let (filtered, filtered_torque) = self.filter.outputs(geometry, velocity, &*filter);
        let count = stack[0].lane(0) as usize;
        let (number, moments) = stack.split_at_mut(1);
        let moment = |n: usize| n * Self::MOMENT..(n + 1) * Self::MOMENT;
        let new = self.gram(&filtered);
        let grams: Vec<_> = (0..count).map(|n| self.gram(&Self::read(&moments[moment(n)]).0)).collect();
        let place = if count < self.capacity {
            is_new(&new, grams.last()).then_some(count)
        } else {
            best_place(&grams, &new, P)
        };
        let Some(place) = place else { return };
        if place == count {
            number[0] = T::splat((count + 1) as f64);
        }
        let into = &mut moments[moment(place)];
        for (number, entry) in into.iter_mut().zip(R::ENTRIES) {
            *number = filtered[*entry];
        }
        into[R::ENTRIES.len()..].copy_from_slice(filtered_torque.as_slice());
    }
}

/// Whether there is something to learn from a moment that the one recorded last has not.
fn is_new(gram: &[f64], last: Option<&Vec<f64>>) -> bool {
    let size: f64 = gram.iter().map(|x| x * x).sum();
    let other = |last: &Vec<f64>| gram.iter().zip(last).map(|(a, b)| (a - b) * (a - b)).sum::<f64>();
    size > 0.0 && last.is_none_or(|last| other(last) > NOVELTY * NOVELTY * size)
}

/// Whose place a moment takes so that the smallest eigenvalue of the sum is largest; `None` if it is largest without it.
fn best_place(grams: &[Vec<f64>], new: &[f64], p: usize) -> Option<usize> {
    let mut sum = vec![0.0; p * p];
    for gram in grams {
        sum.iter_mut().zip(gram).for_each(|(sum, x)| *sum += x);
    }
    let least = |matrix: &[f64]| symmetric_eigen(matrix, p).0.into_iter().fold(f64::INFINITY, f64::min);
    let (mut best, mut place) = (least(&sum), None);
    for (n, gram) in grams.iter().enumerate() {
        let exchanged: Vec<_> = sum.iter().zip(gram).zip(new).map(|((sum, old), new)| sum - old + new).collect();
        let found = least(&exchanged);
        if found > best {
            (best, place) = (found, Some(n));
        }
    }
    place
}

impl<R: Robot<N, P>, T: Scalar, const N: usize, const P: usize> AdaptationLaw<R, T, N, P>
    for ConcurrentLearning<R, T, N, P>
{
    const FILTERS: bool = true;

    fn states(&self) -> usize {
        Self::FILTER + 1 + self.capacity * Self::MOMENT
    }

    fn initialize(&self, geometry: &R::Geometry<T>, velocity: &SVector<T, N>, states: &mut [T]) {
        let (filter, stack) = states.split_at_mut(Self::FILTER);
        self.filter.initialize(geometry, velocity, filter);
        stack.fill(T::zero());
    }

    type Begun = ();

    fn begin(&self, _: &R::Geometry<T>, _: &SVector<T, N>, _: &SVector<T, N>, _: impl States<T>, _: Option<&mut [T]>) {}

    fn derivative(
        &self,
        _: Option<()>,
        input: &AdaptationInput<'_, R, T, N, P>,
        states: impl States<T>,
        theta_hat_rate: &mut [T],
        states_rate: &mut [T],
    ) {
        let moments = states.after(Self::FILTER + 1);
        let (filter_rate, stack_rate) = states_rate.split_at_mut(Self::FILTER);
        self.filter.advance(input.geometry, input.velocity, input.sign_velocity, input.torque, states, filter_rate);
        stack_rate.fill(T::zero());
        let count = Self::recorded(states);
        let mut drive = *input.gradient;
        for n in 0..count.min(self.capacity) {
            let (filtered, filtered_torque) = Self::read(moments.after(n * Self::MOMENT));
            let error = model_torque::<R, T, N, P>(&filtered, input.theta_hat) - filtered_torque;
            drive += gradient::<R, T, N, P>(&filtered, &error) * (self.weight / T::splat(count as f64));
        }
        for k in 0..P {
            theta_hat_rate[k] = -self.gain[k] * drive[k];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_full_stack_takes_what_it_lacks_in_the_place_of_what_it_has_twice() {
        let diagonal = |a: f64, b: f64| vec![a, 0.0, 0.0, b];
        let stack = [diagonal(4.0, 0.0), diagonal(4.0, 0.0), diagonal(0.0, 1.0)];
        // With it in the place of one of the twins: 4 and 3; in the place of the third: 8 and 2.
        assert_eq!(best_place(&stack, &diagonal(0.0, 2.0), 2), Some(0));
        assert_eq!(best_place(&stack, &diagonal(9.0, 0.0), 2), None);
        assert!(is_new(&diagonal(1.0, 0.0), None) && !is_new(&diagonal(0.0, 0.0), None));
        assert!(!is_new(&diagonal(1.0, 0.0), Some(&diagonal(1.05, 0.0))));
    }
}
