//! A number of one run whose neighbours are worked on four at a time, AVX2 (docs/decisions/0021-neighbours.md).
//!
//! It computes as an ordinary number does. What differs is its [`Pack`], and that it is compiled with AVX2 throughout: like
//! [`F64x4`], it may be used only where [`OneOfFour::is_here`].
#![allow(unsafe_code, reason = "slices of a type that is one number are slices of numbers")]

use super::{F64x4, impl_scalar, widths};
use crate::scalar::{Kernel, Pack, Scalar};

/// One number, AVX2.
#[derive(Clone, Copy)]
#[repr(transparent)]
pub(crate) struct OneOfFour(f64);

impl OneOfFour {
    /// Whether this machine has the instructions.
    pub fn is_here() -> bool {
        widths().contains(&F64x4::LANES)
    }

    /// These numbers.
    pub fn of(numbers: &[f64]) -> &[Self] {
        // SAFETY: a transparent struct has the layout of its one field, and any bits are a number; the lifetime is kept.
        unsafe { std::slice::from_raw_parts(numbers.as_ptr().cast(), numbers.len()) }
    }

    /// These numbers, to be written.
    pub fn of_mut(numbers: &mut [f64]) -> &mut [Self] {
        // SAFETY: as above; the borrow stays exclusive.
        unsafe { std::slice::from_raw_parts_mut(numbers.as_mut_ptr().cast(), numbers.len()) }
    }

    /// Plain numbers again.
    pub fn plain(numbers: &[Self]) -> &[f64] {
        // SAFETY: as above.
        unsafe { std::slice::from_raw_parts(numbers.as_ptr().cast(), numbers.len()) }
    }

    #[inline(always)]
    fn repeat(value: f64) -> Self {
        Self(value)
    }
    #[inline(always)]
    fn to_array(self) -> [f64; 1] {
        [self.0]
    }
    #[inline(always)]
    fn negated(self) -> Self {
        Self(-self.0)
    }
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0)
    }
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self(self.0 - other.0)
    }
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self(self.0 * other.0)
    }
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        Self(self.0 / other.0)
    }
}
impl_scalar!(@operators OneOfFour, 1);

impl Pack<OneOfFour> for F64x4 {
    const WIDTH: usize = 4;
    #[inline(always)]
    fn repeat(number: OneOfFour) -> Self {
        Self::repeat(number.0)
    }
    #[inline(always)]
    fn load(numbers: &[OneOfFour]) -> Self {
        let numbers = &numbers[..4];
        Self::from_array([numbers[0].0, numbers[1].0, numbers[2].0, numbers[3].0])
    }
    #[inline(always)]
    fn store(self, numbers: &mut [OneOfFour]) {
        let [a, b, c, d] = self.to_array();
        numbers[..4].copy_from_slice(&[OneOfFour(a), OneOfFour(b), OneOfFour(c), OneOfFour(d)]);
    }
}

impl Scalar for OneOfFour {
    type Mask = bool;
    type Pack = F64x4;
    const LANES: usize = 1;

    #[inline(always)]
    fn from_lanes(number: impl FnMut(usize) -> f64) -> Self {
        Self(f64::from_lanes(number))
    }
    #[inline(always)]
    fn lane(self, n: usize) -> f64 {
        self.0.lane(n)
    }
    #[inline(always)]
    fn compiled<K: Kernel>(kernel: K) -> K::Output {
        F64x4::compiled(kernel)
    }
    #[inline(always)]
    fn splat(value: f64) -> Self {
        Self(value)
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = Scalar::sin_cos(self.0);
        (Self(sin), Self(cos))
    }
    #[inline(always)]
    fn sin_cos_of_two(a: Self, b: Self) -> ((Self, Self), (Self, Self)) {
        let ((sin_a, cos_a), (sin_b, cos_b)) = f64::sin_cos_of_two(a.0, b.0);
        ((Self(sin_a), Self(cos_a)), (Self(sin_b), Self(cos_b)))
    }
    #[inline(always)]
    fn tanh(self) -> Self {
        Self(Scalar::tanh(self.0))
    }
    #[inline(always)]
    fn tanh_each(x: &mut [Self]) {
        let (fours, rest) = x.as_chunks_mut::<4>();
        for four in fours {
            <F64x4 as Pack<Self>>::load(four).tanh().store(four);
        }
        for x in rest {
            *x = x.tanh();
        }
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self(Scalar::abs(self.0))
    }
    #[inline(always)]
    fn less_than(self, other: Self) -> bool {
        self.0 < other.0
    }
    #[inline(always)]
    fn any(mask: bool) -> bool {
        mask
    }
    #[inline(always)]
    fn quadrant(self) -> (bool, bool, bool) {
        self.0.quadrant()
    }
    #[inline(always)]
    fn power_of_two(self) -> Self {
        Self(self.0.power_of_two())
    }
    #[inline(always)]
    fn select(mask: bool, if_true: Self, if_false: Self) -> Self {
        if mask { if_true } else { if_false }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn slices_keep_their_numbers(mut numbers in prop::collection::vec(any::<f64>(), 0..9)) {
            let before = numbers.clone();
            let bits = |numbers: &[f64]| numbers.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
            prop_assert_eq!(bits(OneOfFour::plain(OneOfFour::of(&numbers))), bits(&before));
            for number in OneOfFour::of_mut(&mut numbers) {
                *number = -*number;
            }
            prop_assert_eq!(bits(&numbers), before.iter().map(|x| (-x).to_bits()).collect::<Vec<_>>());
        }

        #[test]
        fn each_neighbour_has_the_bits_that_it_has_alone(
            x in prop::array::uniform6(-30.0..30.0_f64),
            y in prop::array::uniform6(-30.0..30.0_f64),
        ) {
            struct Together([f64; 6], [f64; 6]);
            impl Kernel for Together {
                type Output = ([f64; 6], [f64; 6]);
                fn run(mut self) -> Self::Output {
                    let mut out = [0.0; 6];
                    let load = <F64x4 as Pack<OneOfFour>>::load;
                    let (x, y) = (load(OneOfFour::of(&self.0)), load(OneOfFour::of(&self.1)));
                    let three = <F64x4 as Pack<OneOfFour>>::repeat(OneOfFour(3.0));
                    Pack::store(x * three + y - x * y, OneOfFour::of_mut(&mut out));
                    OneOfFour::tanh_each(OneOfFour::of_mut(&mut self.0));
                    (out, self.0)
                }
            }
            // Without the instructions it is never used.
            if OneOfFour::is_here() {
                let (out, tanh) = OneOfFour::compiled(Together(x, y));
                for n in 0..4 {
                    prop_assert_eq!(out[n].to_bits(), (x[n] * 3.0 + y[n] - x[n] * y[n]).to_bits());
                }
                prop_assert_eq!(out[4..].to_vec(), vec![0.0; 2], "only four are written");
                prop_assert_eq!(tanh.map(f64::to_bits), x.map(|x| Scalar::tanh(x).to_bits()));
            }
        }
    }
}
