//! Filtered regressor without acceleration: `Yf θ = W(s) Y(q, q̇, q̈) θ`, `W(s) = λf / (s + λf)`. Paper eq. (10) to (12).
//!
//! With the momentum `p = H v` and `ṗ + B θ = τ` (see [`Robot::balance_regressor`]), filtering gives
//! `Yf θ = λf (p − W p) + W B θ`, so no acceleration is needed. Both filters of an entry share one state:
//! `Yf = λf P + x`, `x' = λf (B − λf P − x)`, with `x(0) = −λf P(0)` so that the filter of p starts at p(0) and
//! `Yf(0) = 0`. One state per live entry of the regressor, and one per joint for the filtered torque `τf = W τ`.

use crate::robots::{Regressor, Robot};
use crate::scalar::{MOST_PACKED, Pack, Scalar};
use crate::states::States;
use crate::unroll::unrolled;
use nalgebra::SVector;
use std::marker::PhantomData;

/// The filter; its states are the live entries' `x`, row by row, then `τf`.
#[derive(Debug, Clone, Copy)]
pub struct FilteredRegressor<R, T, const N: usize, const P: usize> {
    /// λf, rad/s.
    bandwidth: T,
    robot: PhantomData<R>,
}

impl<R: Robot<N, P>, T: Scalar, const N: usize, const P: usize> FilteredRegressor<R, T, N, P> {
    /// A filter with bandwidth `λf` (rad/s).
    pub fn new(bandwidth: T) -> Self {
        Self { bandwidth, robot: PhantomData }
    }

    /// Number of states.
    pub const STATES: usize = R::ENTRIES.len() + N;

    /// States at the start: `Yf = 0`, `τf = 0`.
    pub fn initialize(&self, geometry: &R::Geometry<T>, velocity: &SVector<T, N>, states: &mut [T]) {
        let momentum = R::momentum_regressor(geometry, velocity);
        let (x, tau_f) = states.split_at_mut(R::ENTRIES.len());
        for (x, &entry) in x.iter_mut().zip(R::ENTRIES) {
            // Subtracted, so that nothing starts at −0: packs add λf · 0 where an entry has no momentum, which would turn it into +0.
            *x = T::zero() - self.bandwidth * momentum[entry];
        }
        tau_f.fill(T::zero());
    }

    /// Filtered regressor `Yf` and filtered torque `τf` (N·m). Source: paper eq. (10) to (12).
    pub fn outputs(
        &self,
        geometry: &R::Geometry<T>,
        velocity: &SVector<T, N>,
        states: impl States<T>,
    ) -> (Regressor<T, N, P>, SVector<T, N>) {
        (self.regressor(geometry, velocity, states), Self::filtered_torque(states))
    }

    /// Filtered regressor `Yf`. Source: paper eq. (10) to (12).
    #[inline(always)]
    pub fn regressor(
        &self,
        geometry: &R::Geometry<T>,
        velocity: &SVector<T, N>,
        states: impl States<T>,
    ) -> Regressor<T, N, P> {
        let momentum = R::momentum_regressor(geometry, velocity);
        let x = states.first(R::ENTRIES.len());
        let mut filtered = Regressor::<T, N, P>::zeros();
        let bandwidth = <T::Pack as Pack<T>>::repeat(self.bandwidth);
        unrolled!(Self::PACKS, pack => {
            let start = pack * Self::WIDTH;
            let x = x.load::<T::Pack>(start);
            let packed =
                if Self::has_momentum(start) { bandwidth * Self::entries(&momentum, start) + x } else { x };
            let mut numbers = [T::zero(); MOST_PACKED];
            packed.store(&mut numbers);
            for lane in 0..Self::WIDTH {
                filtered[R::ENTRIES[start + lane]] = numbers[lane];
            }
        });
        for n in Self::PACKS * Self::WIDTH..R::ENTRIES.len() {
            let entry = R::ENTRIES[n];
            filtered[entry] = self.filtered(&momentum, entry, x.at(n));
        }
        filtered
    }

    const WIDTH: usize = <T::Pack as Pack<T>>::WIDTH;
    const PACKS: usize = R::ENTRIES.len() / Self::WIDTH;

    /// Whether any of a pack's entries is live in the momentum.
    #[inline(always)]
    fn has_momentum(start: usize) -> bool {
        let mut live = false;
        for lane in 0..Self::WIDTH {
            let (row, column) = R::ENTRIES[start + lane];
            live |= R::MOMENTUM_LIVE[row][column];
        }
        live
    }

    /// Neighbouring entries of a regressor.
    #[inline(always)]
    fn entries(y: &Regressor<T, N, P>, start: usize) -> T::Pack {
        let mut numbers = [T::zero(); MOST_PACKED];
        for lane in 0..Self::WIDTH {
            numbers[lane] = y[R::ENTRIES[start + lane]];
        }
        T::Pack::load(&numbers)
    }

    /// An entry of `Yf = λf P + x`.
    #[inline(always)]
    fn filtered(&self, momentum: &Regressor<T, N, P>, (row, column): (usize, usize), x: T) -> T {
        if R::MOMENTUM_LIVE[row][column] { self.bandwidth * momentum[(row, column)] + x } else { x }
    }

    /// Writes `x' = λf (B − Yf)`, given `Yf`. Source: paper eq. (10) to (12).
    #[inline(always)]
    pub fn regressor_rate(
        &self,
        geometry: &R::Geometry<T>,
        velocity: &SVector<T, N>,
        sign_velocity: &SVector<T, N>,
        filtered: &Regressor<T, N, P>,
        rate: &mut [T],
    ) {
        let balance = R::balance_regressor(geometry, velocity, sign_velocity);
        let x_rate = &mut rate[..R::ENTRIES.len()];
        let bandwidth = <T::Pack as Pack<T>>::repeat(self.bandwidth);
        unrolled!(Self::PACKS, pack => {
            let start = pack * Self::WIDTH;
            let rate = bandwidth * (Self::entries(&balance, start) - Self::entries(filtered, start));
            rate.store(&mut x_rate[start..]);
        });
        for n in Self::PACKS * Self::WIDTH..R::ENTRIES.len() {
            let entry = R::ENTRIES[n];
            x_rate[n] = self.bandwidth * (balance[entry] - filtered[entry]);
        }
    }

    /// Filtered torque `τf` (N·m), and writes `τf' = λf (τ − τf)`. Source: paper eq. (10).
    #[inline(always)]
    pub fn torque(&self, torque: &SVector<T, N>, states: impl States<T>, rate: &mut [T]) -> SVector<T, N> {
        let tau_f = Self::filtered_torque(states);
        let tau_f_rate = &mut rate[R::ENTRIES.len()..Self::STATES];
        for i in 0..N {
            tau_f_rate[i] = self.bandwidth * (torque[i] - tau_f[i]);
        }
        tau_f
    }

    #[inline(always)]
    fn filtered_torque(states: impl States<T>) -> SVector<T, N> {
        states.after(R::ENTRIES.len()).vector()
    }

    /// Filtered regressor `Yf` and filtered torque `τf` (N·m), and the states' derivative.
    #[inline(always)]
    pub fn advance(
        &self,
        geometry: &R::Geometry<T>,
        velocity: &SVector<T, N>,
        sign_velocity: &SVector<T, N>,
        torque: &SVector<T, N>,
        states: impl States<T>,
        rate: &mut [T],
    ) -> (Regressor<T, N, P>, SVector<T, N>) {
        let filtered = self.regressor(geometry, velocity, states);
        self.regressor_rate(geometry, velocity, sign_velocity, &filtered, rate);
        (filtered, self.torque(torque, states, rate))
    }
}
