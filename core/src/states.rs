//! States as an evaluation reads them: numbers in memory, or a stage of a step, of which only the parts are in memory.

use crate::scalar::{MOST_PACKED, Pack, Scalar};
use nalgebra::SVector;

/// States to be read, number by number or several at once.
pub trait States<T: Scalar>: Copy {
    /// Number `n`.
    fn at(self, n: usize) -> T;
    /// Those from number `start` on.
    fn after(self, start: usize) -> Self;
    /// The first `len`; indices below it are in range then.
    fn first(self, len: usize) -> Self;
    /// Some of them in memory: where they are, or a copy.
    type InMemory<const K: usize>: Copy + AsRef<[T]>;
    /// The first `K`, for those who need them more than once.
    fn in_memory<const K: usize>(self) -> Self::InMemory<K>;

    /// The first `K`.
    #[inline(always)]
    fn vector<const K: usize>(self) -> SVector<T, K> {
        let states = self.first(K);
        let mut vector = SVector::zeros();
        for n in 0..K {
            vector[n] = states.at(n);
        }
        vector
    }

    /// As many as a pack holds, from number `n` on.
    #[inline(always)]
    fn load<S: Pack<T>>(self, n: usize) -> S {
        let mut numbers = [T::zero(); MOST_PACKED];
        for lane in 0..S::WIDTH {
            numbers[lane] = self.at(n + lane);
        }
        S::load(&numbers)
    }

    /// The numbers at the first places of `at`, as many as a pack holds; zero where there is no place.
    #[inline(always)]
    fn gather<S: Pack<T>>(self, at: [Option<usize>; MOST_PACKED]) -> S {
        let mut numbers = [T::zero(); MOST_PACKED];
        for lane in 0..S::WIDTH {
            if let Some(n) = at[lane] {
                numbers[lane] = self.at(n);
            }
        }
        S::load(&numbers)
    }
}

impl<T: Scalar> States<T> for &[T] {
    type InMemory<const K: usize> = Self;

    #[inline(always)]
    fn in_memory<const K: usize>(self) -> Self {
        &self[..K]
    }
    #[inline(always)]
    fn at(self, n: usize) -> T {
        self[n]
    }
    #[inline(always)]
    fn after(self, start: usize) -> Self {
        &self[start..]
    }
    #[inline(always)]
    fn first(self, len: usize) -> Self {
        &self[..len]
    }
    #[inline(always)]
    fn vector<const K: usize>(self) -> SVector<T, K> {
        SVector::from_column_slice(&self[..K])
    }
    #[inline(always)]
    fn load<S: Pack<T>>(self, n: usize) -> S {
        S::load(&self[n..])
    }
    #[inline(always)]
    fn gather<S: Pack<T>>(self, at: [Option<usize>; MOST_PACKED]) -> S {
        S::gather(self, at)
    }
}

/// `x + h k`, computed where it is read.
#[derive(Debug, Clone, Copy)]
pub struct Stage<'a, T> {
    /// x.
    pub x: &'a [T],
    /// h, the same in every lane.
    pub h: f64,
    /// k.
    pub slope: &'a [T],
}

impl<T: Scalar> Stage<'_, T> {
    /// The stage in memory.
    pub fn to_vec(self) -> Vec<T> {
        (0..self.x.len()).map(|n| self.at(n)).collect()
    }
}

impl<T: Scalar> States<T> for Stage<'_, T> {
    type InMemory<const K: usize> = [T; K];

    #[inline(always)]
    fn in_memory<const K: usize>(self) -> [T; K] {
        self.vector::<K>().into()
    }
    #[inline(always)]
    fn at(self, n: usize) -> T {
        self.x[n] + T::splat(self.h) * self.slope[n]
    }
    #[inline(always)]
    fn after(self, start: usize) -> Self {
        Self { x: &self.x[start..], slope: &self.slope[start..], ..self }
    }
    #[inline(always)]
    fn first(self, len: usize) -> Self {
        Self { x: &self.x[..len], slope: &self.slope[..len], ..self }
    }
}
