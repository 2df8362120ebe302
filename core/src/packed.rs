//! A short vector, such as one number per joint, in packs, the last filled up with numbers that nobody reads. Every number has the bits that it has alone.

use crate::scalar::{MOST_PACKED, Pack, Scalar};
use nalgebra::SVector;

/// `N` numbers in packs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Packed<T: Scalar, const N: usize> {
    /// As many as it takes; nothing is computed with the rest.
    packs: [T::Pack; N],
}

impl<T: Scalar, const N: usize> Packed<T, N> {
    const WIDTH: usize = <T::Pack as Pack<T>>::WIDTH;
    const PACKS: usize = N.div_ceil(Self::WIDTH);

    /// The same number everywhere.
    #[inline(always)]
    pub fn repeat(number: T) -> Self {
        Self { packs: [<T::Pack as Pack<T>>::repeat(number); N] }
    }

    /// These numbers.
    #[inline(always)]
    pub fn of(numbers: &SVector<T, N>) -> Self {
        let mut packed = Self::repeat(T::zero());
        for n in 0..Self::PACKS {
            let mut filled = [T::zero(); MOST_PACKED];
            for i in n * Self::WIDTH..N.min((n + 1) * Self::WIDTH) {
                filled[i - n * Self::WIDTH] = numbers[i];
            }
            packed.packs[n] = T::Pack::load(&filled);
        }
        packed
    }

    /// The numbers again.
    #[inline(always)]
    pub fn numbers(&self) -> SVector<T, N> {
        let mut numbers = SVector::<T, N>::zeros();
        for n in 0..Self::PACKS {
            let mut filled = [T::zero(); MOST_PACKED];
            self.packs[n].store(&mut filled);
            for i in n * Self::WIDTH..N.min((n + 1) * Self::WIDTH) {
                numbers[i] = filled[i - n * Self::WIDTH];
            }
        }
        numbers
    }
}

/// Number by number. Written out, because a closure is not always inlined to where its vector instructions are known.
macro_rules! impl_operator {
    ($trait:ident, $method:ident, $operator:tt) => {
        impl<T: Scalar, const N: usize> std::ops::$trait for Packed<T, N> {
            type Output = Self;
            #[inline(always)]
            fn $method(mut self, other: Self) -> Self {
                for n in 0..Self::PACKS {
                    self.packs[n] $operator other.packs[n];
                }
                self
            }
        }
    };
}
impl_operator!(Add, add, +=);
impl_operator!(Sub, sub, -=);
impl_operator!(Mul, mul, *=);

/// All of them times a number.
impl<T: Scalar, const N: usize> std::ops::Mul<T> for Packed<T, N> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, number: T) -> Self {
        self * Self::repeat(number)
    }
}
