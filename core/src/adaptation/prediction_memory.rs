//! Memory of past prediction errors, with exponential forgetting: w and Z of paper eq. (16) to (18).
//!
//! `ε = Yf θ̂ − τf`, `Z' = −λ Z + γ Yfᵀ Yf`, `w' = −λ w + γ Yfᵀ ε + Z θ̂'`, both zero at the start, which keeps
//! `w = Z (θ̂ − θ)` as long as `τf = Yf θ`. Tang and Arteaga's g is the same w (their eq. prints `Γ1 Z`, right only for a
//! scalar Γ1). Z is symmetric and has zeros: [`SymmetricLayout`] says which of its numbers are kept and where.

use crate::regressor::model_torque;
use crate::robots::{NONE, Regressor, Robot, SymmetricLayout};
use crate::scalar::{MOST_PACKED, Pack, Scalar};
use crate::unroll::unrolled;
use nalgebra::SVector;
use std::marker::PhantomData;

/// The memory; its states are w by groups of parameters, then the kept vectors of Z.
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
    const LAYOUT: SymmetricLayout<P> = SymmetricLayout::new::<N>(&R::LIVE, Self::WIDTH);
    /// States of w.
    const W: usize = Self::LAYOUT.groups * Self::WIDTH;
    /// Number of states.
    pub const STATES: usize = Self::W + Self::LAYOUT.kept_len * Self::WIDTH;
    /// Number of states without what is kept for vectors only.
    pub const PLAIN_STATES: usize = P + R::PAIRS.len();

    /// w, by parameter.
    #[inline(always)]
    pub fn error(states: &[T]) -> SVector<T, P> {
        let (mut w, states) = (SVector::<T, P>::zeros(), &states[..Self::STATES]);
        unrolled!(Self::W, n => {
            let k = Self::LAYOUT.members[n / Self::WIDTH][n % Self::WIDTH];
            if k != NONE {
                w[k] = states[n];
            }
        });
        w
    }

    /// Writes `w'` and `Z'`, given `Yf`, `τf`, θ̂ and its rate. Source: paper eq. (16) to (18).
    #[inline(always)]
    pub fn derivative(
        &self,
        filtered: &Regressor<T, N, P>,
        filtered_torque: &SVector<T, N>,
        theta_hat: &[T],
        theta_hat_rate: &[T],
        states: &[T],
        rate: &mut [T],
    ) {
        let repeat = <T::Pack as Pack<T>>::repeat;
        let prediction_error = model_torque::<R, T, N, P>(filtered, theta_hat) - filtered_torque;
        let (w, z) = states[..Self::STATES].split_at(Self::W);
        let (w_rate, z_rate) = rate[..Self::STATES].split_at_mut(Self::W);
        let theta_hat_rate = &theta_hat_rate[..P];
        let (gain, forgetting) = (repeat(self.gain), repeat(self.forgetting));

        let mut rows = [[repeat(T::zero()); P]; N];
        let mut sum = [repeat(T::zero()); P];
        unrolled!(Self::LAYOUT.groups, g => {
            for row in 0..N {
                if let Some(numbers) = Self::group_of_row(filtered, row, g) {
                    rows[row][g] = T::Pack::load(&numbers);
                    sum[g] = sum[g] + rows[row][g] * repeat(prediction_error[row]);
                }
            }
            sum[g] = gain * sum[g] - forgetting * T::Pack::load(&w[g * Self::WIDTH..]);
        });
        unrolled!(Self::LAYOUT.pieces_len, n => {
            let piece = Self::LAYOUT.pieces[n];
            let (g, j) = (piece.group, piece.parameter);
            sum[g] = sum[g] + Self::piece(z, n) * repeat(theta_hat_rate[j]);
        });
        unrolled!(Self::LAYOUT.groups, g => {
            sum[g].store(&mut w_rate[g * Self::WIDTH..]);
        });
        unrolled!(Self::LAYOUT.kept_len, n => {
            let (i, g) = Self::LAYOUT.kept[n];
            let mut product = repeat(T::zero());
            let mut is_first = true;
            for row in 0..N {
                if R::LIVE[row][i] && Self::is_live(row, g) {
                    let term = repeat(filtered[(row, i)]) * rows[row][g];
                    product = if is_first { term } else { product + term };
                    is_first = false;
                }
            }
            let z = T::Pack::load(&z[n * Self::WIDTH..]);
            (gain * product - forgetting * z).store(&mut z_rate[n * Self::WIDTH..]);
        });
    }

    /// Whether a row of the regressor is live anywhere in the columns of group `g`.
    #[inline(always)]
    fn is_live(row: usize, g: usize) -> bool {
        let mut is_live = false;
        for lane in 0..Self::WIDTH {
            let k = Self::LAYOUT.members[g][lane];
            is_live |= k != NONE && R::LIVE[row][k];
        }
        is_live
    }

    /// A row of the regressor in the columns of group `g`; `None` where it is not live there.
    #[inline(always)]
    fn group_of_row(filtered: &Regressor<T, N, P>, row: usize, g: usize) -> Option<[T; MOST_PACKED]> {
        let mut numbers = [T::zero(); MOST_PACKED];
        for lane in 0..Self::WIDTH {
            let k = Self::LAYOUT.members[g][lane];
            if k != NONE && R::LIVE[row][k] {
                numbers[lane] = filtered[(row, k)];
            }
        }
        Self::is_live(row, g).then_some(numbers)
    }

    /// Piece `n` of Z.
    #[inline(always)]
    fn piece(z: &[T], n: usize) -> T::Pack {
        let piece = Self::LAYOUT.pieces[n];
        let mut rows = [<T::Pack as Pack<T>>::repeat(T::zero()); MOST_PACKED];
        for lane in 0..MOST_PACKED {
            if piece.from[lane] != NONE {
                rows[lane] = T::Pack::load(&z[piece.from[lane] * Self::WIDTH..]);
            }
        }
        if piece.lane == NONE { rows[0] } else { T::Pack::column(&rows, piece.lane) }
    }

    /// Entry (i, j) of Z.
    pub fn entry(states: &[T], i: usize, j: usize) -> T {
        match Self::LAYOUT.index(i, j).or(Self::LAYOUT.index(j, i)) {
            Some(n) if R::PAIRS.contains(&(i.min(j), i.max(j))) => states[Self::W + n],
            _ => T::zero(),
        }
    }

    /// Writes the states as people read them: w, then the live upper triangle of Z.
    pub fn write_plain(states: &[T], plain: &mut [T]) {
        let (w, z) = plain.split_at_mut(P);
        w.copy_from_slice(Self::error(states).as_slice());
        for (number, &(i, j)) in z.iter_mut().zip(R::PAIRS) {
            *number = Self::entry(states, i, j);
        }
    }

    /// Writes the states from what [`Self::write_plain`] wrote.
    pub fn read_plain(plain: &[T], states: &mut [T]) {
        states.fill(T::zero());
        let (w, z) = plain.split_at(P);
        for k in 0..P {
            let (group, lane) = Self::LAYOUT.place(k);
            states[group * Self::WIDTH + lane] = w[k];
        }
        for (number, &(i, j)) in z.iter().zip(R::PAIRS) {
            for (i, j) in [(i, j), (j, i)] {
                if let Some(n) = Self::LAYOUT.index(i, j) {
                    states[Self::W + n] = *number;
                }
            }
        }
    }
}
