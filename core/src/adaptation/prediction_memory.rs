//! Memory of past prediction errors, with exponential forgetting: w and Z of paper eq. (16) to (18).
//!
//! `ε = Yf θ̂ − τf`, `Z' = −λ Z + γ Yfᵀ Yf`, `w' = −λ w + γ Yfᵀ ε + Z θ̂'`, both zero at the start, which keeps
//! `w = Z (θ̂ − θ)` as long as `τf = Yf θ`. Tang and Arteaga's g is the same w (their eq. prints `Γ1 Z`, right only for a
//! scalar Γ1). Z is symmetric and has zeros: [`SymmetricLayout`] says which of its numbers are kept and where.

use crate::regressor::gradient;
use crate::robots::{NONE, Regressor, Robot, SymmetricLayout};
use crate::scalar::{MOST_PACKED, Pack, Scalar};
use crate::states::States;
use crate::sum::Sum;
use crate::unroll::unrolled;
use nalgebra::SVector;
use std::marker::PhantomData;

/// The memory; its states are w in the layout's order, filled up with zeros to whole vectors, then the kept vectors of Z.
#[derive(Debug, Clone, Copy)]
pub struct PredictionMemory<R, T, const N: usize, const P: usize> {
    /// Gain γ of new errors.
    pub gain: T,
    /// Forgetting rate λ, 1/s.
    pub forgetting: T,
    robot: PhantomData<R>,
}

impl<R: Robot<N, P>, T: Scalar, const N: usize, const P: usize> PredictionMemory<R, T, N, P> {
    /// A memory with gain γ and forgetting rate λ (1/s).
    pub fn new(gain: T, forgetting: T) -> Self {
        Self { gain, forgetting, robot: PhantomData }
    }

    const WIDTH: usize = <T::Pack as Pack<T>>::WIDTH;
    const LAYOUT: &'static SymmetricLayout<P> = &SymmetricLayout::new::<N>(&R::LIVE, Self::WIDTH);
    /// States of w.
    const W: usize = Self::LAYOUT.groups * Self::WIDTH;
    /// Number of states.
    pub const STATES: usize = Self::W + Self::LAYOUT.kept_len * Self::WIDTH;
    /// Number of states without what is kept for vectors only.
    pub const PLAIN_STATES: usize = P + R::PAIRS.len();

    /// `Yf` in packs, row by row: its columns in the layout's groups. Only filled in where packs hold more than a number.
    #[inline(always)]
    pub fn rows(filtered: &Regressor<T, N, P>) -> [[T::Pack; P]; N] {
        let mut rows = [[<T::Pack as Pack<T>>::repeat(T::zero()); P]; N];
        if Self::WIDTH > 1 {
            unrolled!(Self::LAYOUT.groups, g => {
                for row in 0..N {
                    if Self::is_live(row, g) {
                        rows[row][g] =
                            Self::neighbours(g, |k| if R::LIVE[row][k] { filtered[(row, k)] } else { T::zero() });
                    }
                }
            });
        }
        rows
    }

    /// Writes `Z'`, given `Yf` and what [`Self::rows`] made of it, where packs hold more than a number; elsewhere
    /// [`Self::derivative`] does. Source: paper eq. (18).
    #[inline(always)]
    pub fn correlation_rate(
        &self,
        filtered: &Regressor<T, N, P>,
        rows: &[[T::Pack; P]; N],
        states: impl States<T>,
        rate: &mut [T],
    ) {
        if Self::WIDTH > 1 {
            self.write_kept(filtered, rows, states.after(Self::W), &mut rate[Self::W..Self::STATES]);
        }
    }

    /// Writes `w'` and what [`Self::correlation_rate`] left of `Z'`, given `Yf`, its rows, `ε` and θ̂'. Source: paper eq. (16) to (18).
    #[inline(always)]
    pub fn derivative(
        &self,
        filtered: &Regressor<T, N, P>,
        rows: &[[T::Pack; P]; N],
        prediction_error: &SVector<T, N>,
        theta_hat_rate: &[T],
        states: impl States<T>,
        rate: &mut [T],
    ) {
        let (w, z) = (states.first(Self::W), states.first(Self::STATES).after(Self::W));
        let (w_rate, z_rate) = rate[..Self::STATES].split_at_mut(Self::W);
        let theta_hat_rate = &theta_hat_rate[..P];
        if Self::WIDTH == 1 {
            self.number_by_number(filtered, prediction_error, theta_hat_rate, (w, z), (w_rate, z_rate));
        } else {
            self.vector_by_vector(rows, prediction_error, theta_hat_rate, (w, z), w_rate);
        }
    }

    /// Once over the upper triangle, each number used in its row and in its column: fewest operations.
    #[inline(always)]
    fn number_by_number(
        &self,
        filtered: &Regressor<T, N, P>,
        prediction_error: &SVector<T, N>,
        theta_hat_rate: &[T],
        (w, z): (impl States<T>, impl States<T>),
        (w_rate, z_rate): (&mut [T], &mut [T]),
    ) {
        let correlation = gradient::<R, T, N, P>(filtered, prediction_error);
        // Copies, of which the compiler knows that writing rates does not change them: else all is read and written again for each pair.
        let (gain, forgetting) = (self.gain, self.forgetting);
        let theta_hat_rate = SVector::<T, P>::from_column_slice(theta_hat_rate);
        let mut sum = [T::zero(); P];
        for k in 0..P {
            sum[k] = gain * correlation[k] - forgetting * w.at(k);
        }
        unrolled!(R::PAIRS.len(), n => {
            let (i, j) = R::PAIRS[n];
            let mut product = Sum::EMPTY;
            for row in 0..N {
                if R::LIVE[row][i] && R::LIVE[row][j] {
                    product = product.plus(filtered[(row, i)] * filtered[(row, j)]);
                }
            }
            let z = z.at(n);
            z_rate[n] = gain * product.total(T::zero()) - forgetting * z;
            sum[i] += z * theta_hat_rate[j];
            if i != j {
                sum[j] += z * theta_hat_rate[i];
            }
        });
        w_rate[..P].copy_from_slice(&sum);
    }

    /// The same sums of `w'`, each in the same order, for neighbouring parameters at once (docs/decisions/0021-neighbours.md).
    #[inline(always)]
    fn vector_by_vector(
        &self,
        rows: &[[T::Pack; P]; N],
        prediction_error: &SVector<T, N>,
        theta_hat_rate: &[T],
        (w, z): (impl States<T>, impl States<T>),
        w_rate: &mut [T],
    ) {
        let repeat = <T::Pack as Pack<T>>::repeat;
        let (gain, forgetting) = (repeat(self.gain), repeat(self.forgetting));
        let mut sum = [repeat(T::zero()); P];
        unrolled!(Self::LAYOUT.groups, g => {
            let mut correlation = Sum::EMPTY;
            for row in 0..N {
                if Self::is_live(row, g) {
                    correlation = correlation.plus(rows[row][g] * repeat(prediction_error[row]));
                }
            }
            sum[g] = gain * correlation.total(repeat(T::zero())) - forgetting * w.load::<T::Pack>(g * Self::WIDTH);
        });
        Self::add_rows(z, theta_hat_rate, &mut sum);
        unrolled!(Self::LAYOUT.groups, g => {
            sum[g].store(&mut w_rate[g * Self::WIDTH..]);
        });
    }

    /// `sum += Z θ̂'`. A function of its own in the browser's module, which is smaller then and as fast.
    #[cfg_attr(target_arch = "wasm32", inline(never))]
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn add_rows(z: impl States<T>, theta_hat_rate: &[T], sum: &mut [T::Pack; P]) {
        let (z, theta_hat_rate) = (z.first(Self::LAYOUT.kept_len * Self::WIDTH), &theta_hat_rate[..P]);
        unrolled!(Self::LAYOUT.whole_len, n => {
            let (j, g) = Self::LAYOUT.whole[n];
            let kept = Self::LAYOUT.kept_as[j][g];
            let of_z = if kept == NONE { Self::gathered(z, j, g) } else { z.load(kept * Self::WIDTH) };
            sum[g] += of_z * <T::Pack as Pack<T>>::repeat(theta_hat_rate[j]);
        });
    }

    /// `Z' = γ Yfᵀ Yf − λ Z` of the kept vectors; `rows` is `Yf` in packs.
    #[inline(always)]
    fn write_kept(&self, filtered: &Regressor<T, N, P>, rows: &[[T::Pack; P]; N], z: impl States<T>, z_rate: &mut [T]) {
        let repeat = <T::Pack as Pack<T>>::repeat;
        let (gain, forgetting) = (repeat(self.gain), repeat(self.forgetting));
        let len = Self::LAYOUT.kept_len * Self::WIDTH;
        let (z, z_rate) = (z.first(len), &mut z_rate[..len]);
        unrolled!(Self::LAYOUT.kept_len, n => {
            let (i, g) = Self::LAYOUT.kept[n];
            let mut product = Sum::EMPTY;
            for row in 0..N {
                if R::LIVE[row][i] && Self::is_live(row, g) {
                    product = product.plus(repeat(filtered[(row, i)]) * rows[row][g]);
                }
            }
            let product = product.total(repeat(T::zero()));
            let z = z.load::<T::Pack>(n * Self::WIDTH);
            (gain * product - forgetting * z).store(&mut z_rate[n * Self::WIDTH..]);
        });
    }

    /// Whether a row of the regressor is live anywhere in the columns of group `g`.
    #[inline(always)]
    fn is_live(row: usize, g: usize) -> bool {
        let mut is_live = false;
        for lane in 0..Self::WIDTH {
            if let Some(k) = Self::LAYOUT.column(g, lane) {
                is_live |= R::LIVE[row][k];
            }
        }
        is_live
    }

    /// The numbers of the columns of group `g`, zeros beyond the last.
    #[inline(always)]
    fn neighbours(g: usize, number: impl Fn(usize) -> T) -> T::Pack {
        let mut numbers = [T::zero(); MOST_PACKED];
        for lane in 0..Self::WIDTH {
            if let Some(k) = Self::LAYOUT.column(g, lane) {
                numbers[lane] = number(k);
            }
        }
        T::Pack::load(&numbers)
    }

    /// Row `j` of Z in the columns of group `g`, from what lies across; given Z's states.
    #[inline(always)]
    fn gathered(z: impl States<T>, j: usize, g: usize) -> T::Pack {
        let mut at = [None; MOST_PACKED];
        for lane in 0..Self::WIDTH {
            if let Some(column) = Self::LAYOUT.column(g, lane)
                && Self::LAYOUT.at[j][column] != NONE
            {
                at[lane] = Some(Self::LAYOUT.at[j][column]);
            }
        }
        z.gather(at)
    }

    /// w of as many parameters as a pack `S` holds, from the `k`th on.
    #[inline(always)]
    pub fn w<S: Pack<T>>(states: impl States<T>, k: usize) -> S {
        let mut at = [None; MOST_PACKED];
        for lane in 0..S::WIDTH {
            at[lane] = Some(Self::LAYOUT.place[k + lane]);
        }
        states.first(Self::W).gather(at)
    }

    /// Entry (i, j) of Z.
    pub fn correlation(states: impl States<T>, i: usize, j: usize) -> T {
        Self::entry(states.after(Self::W), i, j)
    }

    /// Entry (i, j) of Z, given its states.
    #[inline(always)]
    fn entry(z: impl States<T>, i: usize, j: usize) -> T {
        match Self::LAYOUT.at[i][j] {
            NONE => T::zero(),
            n => z.at(n),
        }
    }

    /// Writes the states as snapshots hold them: w, then the live upper triangle of Z.
    pub fn write_plain(states: &[T], plain: &mut [T]) {
        let (w, z) = states.split_at(Self::W);
        for k in 0..P {
            plain[k] = w[Self::LAYOUT.place[k]];
        }
        for (number, &(i, j)) in plain[P..].iter_mut().zip(R::PAIRS) {
            *number = Self::entry(z, i, j);
        }
    }

    /// Writes the states from what [`Self::write_plain`] wrote.
    pub fn read_plain(plain: &[T], states: &mut [T]) {
        states.fill(T::zero());
        let (w, z) = states.split_at_mut(Self::W);
        for k in 0..P {
            w[Self::LAYOUT.place[k]] = plain[k];
        }
        for (number, &(i, j)) in plain[P..].iter().zip(R::PAIRS) {
            z[Self::LAYOUT.at[i][j]] = *number;
            z[Self::LAYOUT.at[j][i]] = *number;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::regressor::model_torque;
    use crate::robots::{CrsA465, Pendulum, TwoLink};
    use crate::scalar::Kernel;
    use crate::states::Stage;
    use nalgebra::SMatrix;
    use proptest::prelude::*;

    /// A memory somewhere, with gain 1.3 and forgetting rate 0.7.
    struct Given<R, const N: usize, const P: usize> {
        filtered: Regressor<f64, N, P>,
        torque: SVector<f64, N>,
        theta_hat: SVector<f64, P>,
        theta_hat_rate: SVector<f64, P>,
        /// w, then the live upper triangle of Z.
        states: Vec<f64>,
        robot: PhantomData<R>,
    }

    impl<R: Robot<N, P>, const N: usize, const P: usize> Given<R, N, P> {
        fn new(numbers: &[f64]) -> Self {
            let mut numbers = numbers.iter().copied();
            let mut next = || numbers.next().unwrap();
            Self {
                filtered: Regressor::from_fn(|i, k| if R::LIVE[i][k] { next() } else { 0.0 }),
                torque: SVector::from_fn(|_, _| next()),
                theta_hat: SVector::from_fn(|_, _| next()),
                theta_hat_rate: SVector::from_fn(|_, _| next()),
                states: (0..P + R::PAIRS.len()).map(|_| next()).collect(),
                robot: PhantomData,
            }
        }

        /// The derivative of the plain states, from whole matrices.
        fn expected(&self) -> Vec<f64> {
            let (w, triangle) = self.states.split_at(P);
            let mut z = SMatrix::<f64, P, P>::zeros();
            for (number, &(i, j)) in triangle.iter().zip(R::PAIRS) {
                (z[(i, j)], z[(j, i)]) = (*number, *number);
            }
            let (y, w) = (self.filtered, SVector::<f64, P>::from_column_slice(w));
            let error = y * self.theta_hat - self.torque;
            let w_rate = y.transpose() * error * 1.3 - w * 0.7 + z * self.theta_hat_rate;
            let z_rate = y.transpose() * y * 1.3 - z * 0.7;
            w_rate.iter().copied().chain(R::PAIRS.iter().map(|&at| z_rate[at])).collect()
        }
    }

    /// The derivative of the plain states, in numbers of kind `T`.
    struct In<'a, T, R, const N: usize, const P: usize>(&'a Given<R, N, P>, PhantomData<T>);

    impl<R: Robot<N, P>, T: Scalar, const N: usize, const P: usize> Kernel for In<'_, T, R, N, P> {
        type Output = Vec<f64>;

        fn run(self) -> Vec<f64> {
            let plain: Vec<_> = self.0.states.iter().map(|x| T::splat(*x)).collect();
            // What is not written is not zero.
            let ones = |len: usize| vec![T::one(); len];
            let len = PredictionMemory::<R, T, N, P>::STATES;
            let (mut states, mut rate, mut written) = (ones(len), ones(len), ones(plain.len()));
            PredictionMemory::<R, T, N, P>::read_plain(&plain, &mut states);
            PredictionMemory::<R, T, N, P>::write_plain(&states, &mut written);
            assert!(written == plain, "what is read is written again");
            let memory = PredictionMemory::<R, T, N, P>::new(T::splat(1.3), T::splat(0.7));
            let filtered = self.0.filtered.map(T::splat);
            let rows = PredictionMemory::<R, T, N, P>::rows(&filtered);
            let theta_hat = self.0.theta_hat.map(T::splat);
            let error = model_torque::<R, T, N, P>(&filtered, theta_hat.as_slice()) - self.0.torque.map(T::splat);
            let theta_hat_rate = self.0.theta_hat_rate.map(T::splat);
            memory.correlation_rate(&filtered, &rows, states.as_slice(), &mut rate);
            memory.derivative(&filtered, &rows, &error, theta_hat_rate.as_slice(), states.as_slice(), &mut rate);
            // At a stage that is nowhere in memory, too.
            let (still, mut at_stage) = (ones(len), ones(len));
            let stage = Stage { x: &states, h: 0.0, slope: &still };
            memory.correlation_rate(&filtered, &rows, stage, &mut at_stage);
            memory.derivative(&filtered, &rows, &error, theta_hat_rate.as_slice(), stage, &mut at_stage);
            assert!(at_stage == rate, "{at_stage:?}");
            PredictionMemory::<R, T, N, P>::write_plain(&rate, &mut written);
            // Numbers that are kept twice stay the same.
            let mut again = ones(len);
            PredictionMemory::<R, T, N, P>::read_plain(&written, &mut again);
            assert!(rate == again, "{rate:?}");
            written.into_iter().map(|number| number.lane(0)).collect()
        }
    }

    fn examine<R: Robot<N, P>, const N: usize, const P: usize>(numbers: &[f64]) {
        let given = Given::<R, N, P>::new(numbers);
        let alone = f64::compiled(In::<f64, R, N, P>(&given, PhantomData));
        for (expected, found) in given.expected().into_iter().zip(&alone) {
            assert!((expected - found).abs() < 1e-11, "{found} instead of {expected}");
        }
        #[cfg(any(target_arch = "x86_64", all(target_arch = "wasm32", target_feature = "simd128")))]
        if crate::lanes::Neighbour::is_here() {
            use crate::lanes::Neighbour;
            let neighbours = Neighbour::compiled(In::<Neighbour, R, N, P>(&given, PhantomData));
            assert!(alone.into_iter().map(f64::to_bits).eq(neighbours.into_iter().map(f64::to_bits)));
        }
    }

    proptest! {
        #[test]
        fn vectors_of_neighbours_have_the_bits_of_numbers_alone(numbers in prop::collection::vec(-10.0..10.0_f64, 250)) {
            examine::<CrsA465, 3, 18>(&numbers);
            examine::<TwoLink, 2, 11>(&numbers);
            examine::<Pendulum, 1, 4>(&numbers);
        }
    }
}
