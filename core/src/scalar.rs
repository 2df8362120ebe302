//! The one place where numbers become arithmetic: the scalar that all of the physics is generic over.
//!
//! Every transcendental function goes through here, so that native code and WASM execute the same operations and return
//! the same bits. Those of the closed loop are in [`crate::transcendental`]; the rest is libm, plain IEEE arithmetic too.
//! Square root is exact everywhere and uses the hardware.
//! A SIMD type takes part by implementing [`Scalar`]: comparisons give masks, and branches on data are [`Scalar::select`].

use nalgebra::{ClosedAddAssign, ClosedDivAssign, ClosedMulAssign, ClosedSubAssign};
use num_traits::{One, Zero};
use std::ops::{Add, Mul, Neg, Sub};

/// A computation to be compiled with a scalar's vector instructions. All that it calls on numbers must be inlined into it.
pub trait Kernel {
    /// What it computes.
    type Output;
    /// Whether it does the same with many numbers, one after another.
    const LOOPS_OVER_NUMBERS: bool = false;
    /// Computes it.
    fn run(self) -> Self::Output;
}

/// Room for the widest [`Pack`].
pub const MOST_PACKED: usize = 4;

/// Neighbours in a structure of one run, such as a matrix: what one instruction works on. Each has the bits that it has alone.
pub trait Pack<T>: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> {
    /// How many numbers; at most [`MOST_PACKED`].
    const WIDTH: usize;
    /// The same number everywhere.
    fn repeat(number: T) -> Self;
    /// The first [`Pack::WIDTH`] of `numbers`.
    fn load(numbers: &[T]) -> Self;
    /// Writes the first [`Pack::WIDTH`] of `numbers`.
    fn store(self, numbers: &mut [T]);
    /// The numbers at the first [`Pack::WIDTH`] places of `at`; zero where there is no place.
    fn gather(numbers: &[T], at: [Option<usize>; MOST_PACKED]) -> Self;
}

/// A number alone.
impl<T: Scalar> Pack<T> for T {
    const WIDTH: usize = 1;
    #[inline(always)]
    fn repeat(number: T) -> Self {
        number
    }
    #[inline(always)]
    fn load(numbers: &[T]) -> Self {
        numbers[0]
    }
    #[inline(always)]
    fn store(self, numbers: &mut [T]) {
        numbers[0] = self;
    }
    #[inline(always)]
    fn gather(numbers: &[T], at: [Option<usize>; MOST_PACKED]) -> Self {
        at[0].map_or(T::zero(), |n| numbers[n])
    }
}

/// A real number, or several side by side, with the operations that the closed loop needs.
pub trait Scalar:
    nalgebra::Scalar
    + Copy
    + Send
    + Sync
    + Zero
    + One
    + Neg<Output = Self>
    + ClosedAddAssign
    + ClosedSubAssign
    + ClosedMulAssign
    + ClosedDivAssign
{
    /// Result of a comparison: one truth value per lane.
    type Mask: Copy;
    /// How neighbours of one run are worked on together; the number alone wherever its lanes are runs.
    type Pack: Pack<Self> + Scalar;
    /// Numbers side by side.
    const LANES: usize;
    /// Whether this is a number without vector instructions of its own, so that the compiler has to find them.
    const IS_PLAIN: bool = Self::LANES == 1 && <Self::Pack as Pack<Self>>::WIDTH == 1;

    /// The number of each lane.
    fn from_lanes(number: impl FnMut(usize) -> f64) -> Self;
    /// The number in lane `n`, counted from 0.
    fn lane(self, n: usize) -> f64;
    /// Runs `kernel`, compiled with the vector instructions that this type uses.
    fn compiled<K: Kernel>(kernel: K) -> K::Output;
    /// The constant `value` in every lane.
    fn splat(value: f64) -> Self;
    /// `(sin x, cos x)`; `x` in rad.
    fn sin_cos(self) -> (Self, Self);
    /// Hyperbolic tangent.
    fn tanh(self) -> Self;
    /// Hyperbolic tangent of each of `x`, in place, and `(sin, cos)` of those angles (rad) that are `wanted`, zeros of the others;
    /// side by side where the machine gains by it, with the bits of [`Scalar::tanh`] and [`Scalar::sin_cos`].
    #[inline(always)]
    fn tanh_and_sin_cos<const A: usize>(x: &mut [Self], angles: [Self; A], wanted: &[bool; A]) -> [(Self, Self); A] {
        for x in x {
            *x = x.tanh();
        }
        let mut sines = [(Self::zero(), Self::zero()); A];
        for n in 0..A {
            if wanted[n] {
                sines[n] = angles[n].sin_cos();
            }
        }
        sines
    }
    /// The same two numbers. Where the compiler would compute first all that follows from the one and then all that follows from the
    /// other, it may not go on with either before it has both.
    #[inline(always)]
    fn in_step(one: Self, other: Self) -> (Self, Self) {
        (one, other)
    }
    /// Absolute value.
    fn abs(self) -> Self;
    /// `self < other`, lane by lane; false where either is not a number.
    fn less_than(self, other: Self) -> Self::Mask;
    /// Whether the mask holds anywhere.
    fn any(mask: Self::Mask) -> bool;
    /// Of a whole number n: whether it is odd, whether the sine changes sign after n quarter turns, whether the cosine does.
    fn quadrant(self) -> (Self::Mask, Self::Mask, Self::Mask);
    /// `2ⁿ` of a whole number n from −1022 to 1023.
    fn power_of_two(self) -> Self;
    /// `if_true` where the mask holds, `if_false` elsewhere.
    fn select(mask: Self::Mask, if_true: Self, if_false: Self) -> Self;

    /// Signum with `sign(0) = 0`, as friction at rest needs it.
    #[inline(always)]
    fn sign(self) -> Self {
        let zero = Self::zero();
        let negative = Self::select(self.less_than(zero), -Self::one(), zero);
        Self::select(zero.less_than(self), Self::one(), negative)
    }
}

/// Zero where every number is finite, no number elsewhere.
#[inline(always)]
pub(crate) fn zero_where_finite<T: Scalar>(numbers: &[T]) -> T {
    if T::LANES == 1 {
        // By their bits, which compilers look at many at a time: adding a one to an exponent of all ones carries into the sign's place.
        const EXPONENT: u64 = 0x7ff0_0000_0000_0000;
        const ONE: u64 = 0x0010_0000_0000_0000;
        let mut carries = 0;
        for n in 0..numbers.len() {
            carries |= (numbers[n].lane(0).to_bits() & EXPONENT) + ONE;
        }
        return T::splat(if carries >> 63 == 0 { 0.0 } else { f64::NAN });
    }
    // Zero times a number that is not finite is no number. Several sums side by side have less to wait for.
    let mut zeros = [T::zero(); 8];
    let (blocks, rest) = numbers.as_chunks::<8>();
    for n in 0..blocks.len() {
        for i in 0..8 {
            zeros[i] += blocks[n][i] * T::zero();
        }
    }
    for i in 0..rest.len() {
        zeros[i] += rest[i] * T::zero();
    }
    let mut all = T::zero();
    for i in 0..8 {
        all += zeros[i];
    }
    all
}

/// Whether all numbers are finite; without a branch per number.
pub(crate) fn are_finite(numbers: &[f64]) -> bool {
    zero_where_finite(numbers) == 0.0
}

/// `(sin x, cos x)` of any angle, rad; libm on every target.
pub(crate) fn sin_cos_of_any(x: f64) -> (f64, f64) {
    libm::sincos(x)
}

/// `base^exponent` for step-size control; libm on every target.
pub(crate) fn power(base: f64, exponent: f64) -> f64 {
    libm::pow(base, exponent)
}

/// `eˣ`; libm on every target, as all of these.
pub(crate) fn exponential(x: f64) -> f64 {
    libm::exp(x)
}

/// Natural logarithm.
pub(crate) fn logarithm(x: f64) -> f64 {
    libm::log(x)
}

/// Logarithm to the base ten.
#[cfg(feature = "figures")]
pub(crate) fn decimal_logarithm(x: f64) -> f64 {
    libm::log10(x)
}

/// `1 − erf(x)`, exact in the tail too.
pub(crate) fn complementary_error(x: f64) -> f64 {
    libm::erfc(x)
}

/// `ln Γ(x)`.
pub(crate) fn log_gamma(x: f64) -> f64 {
    libm::lgamma(x)
}

/// Angle of the point `(x, y)`, rad; libm on every target.
pub(crate) fn arc_tangent(y: f64, x: f64) -> f64 {
    libm::atan2(y, x)
}

/// Inverse hyperbolic sine, for axes that are linear about zero and logarithmic far from it; libm on every target.
#[cfg(feature = "figures")]
pub(crate) fn inverse_sinh(x: f64) -> f64 {
    libm::asinh(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sign_is_zero_at_rest() {
        assert_eq!([-2.0, -0.0, 0.0, 3.0].map(Scalar::sign), [-1.0, 0.0, 0.0, 1.0]);
        assert_eq!(f64::NAN.sign(), 0.0);
    }
}
