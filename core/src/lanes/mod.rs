//! Several runs side by side: numbers of 2, 4 or 8 lanes that take part in the physics as one [`Scalar`].
//!
//! Every operation works lane by lane, so that each lane has the bits that it would have alone. Which kinds of lanes a
//! machine has is asked once, at run time ([`widths`]); vector instructions are used only inside [`Scalar::compiled`].

#[cfg(any(target_arch = "x86_64", all(target_arch = "wasm32", target_feature = "simd128")))]
mod neighbour;
mod one;
#[cfg(test)]
mod tests;
#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
mod wasm;
#[cfg(target_arch = "x86_64")]
mod x86_64;

#[cfg(any(target_arch = "x86_64", all(target_arch = "wasm32", target_feature = "simd128")))]
pub(crate) use neighbour::Neighbour;
#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
pub(crate) use wasm::F64x2;
#[cfg(target_arch = "x86_64")]
pub(crate) use x86_64::{F64x2, F64x4, F64x8};

use crate::scalar::{Kernel, Scalar};

/// How many hyperbolic tangents are computed in step: with what they need, they fill sixteen registers. Eight lanes have twice as many
/// registers and first take twice as many at a time. Browsers order instructions themselves.
#[cfg(any(target_arch = "x86_64", all(target_arch = "wasm32", target_feature = "simd128")))]
const IN_STEP: usize = if cfg!(target_arch = "wasm32") { 1 } else { 3 };

/// Something to do with a kind of lanes that this machine has.
pub(crate) trait WithLanes {
    /// What comes of it.
    type Output;
    /// Does it.
    fn with<T: Scalar>(self) -> Self::Output;
}

/// How many lanes this machine can work on side by side, most first; always ends in 1.
pub fn widths() -> &'static [usize] {
    #[cfg(target_arch = "x86_64")]
    let widths = x86_64::widths();
    #[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
    let widths = &[2, 1];
    #[cfg(not(any(target_arch = "x86_64", all(target_arch = "wasm32", target_feature = "simd128"))))]
    let widths = &[1];
    widths
}

/// Does `work` with lanes of this width; `None` where the machine has none.
pub(crate) fn with_lanes<W: WithLanes>(width: usize, work: W) -> Option<W::Output> {
    if !widths().contains(&width) {
        return None;
    }
    match width {
        1 => Some(work.with::<f64>()),
        #[cfg(any(target_arch = "x86_64", all(target_arch = "wasm32", target_feature = "simd128")))]
        2 => Some(work.with::<F64x2>()),
        #[cfg(target_arch = "x86_64")]
        4 => Some(work.with::<F64x4>()),
        #[cfg(target_arch = "x86_64")]
        8 => Some(work.with::<F64x8>()),
        _ => None,
    }
}

/// Runs `kernel` in a function of its own, of which there is one copy however often it is called: a page loads all of them.
#[inline(never)]
fn once<K: Kernel>(kernel: K) -> K::Output {
    kernel.run()
}

/// Hyperbolic tangents in place, `MOST` at a time; gives back those that are left.
#[cfg(any(target_arch = "x86_64", all(target_arch = "wasm32", target_feature = "simd128")))]
#[inline(always)]
fn tanh_in_step<T: Scalar, const MOST: usize>(x: &mut [T]) -> &mut [T] {
    let (together, rest) = x.as_chunks_mut::<MOST>();
    for n in 0..together.len() {
        together[n] = crate::transcendental::tanh_and_sin_cos(together[n], []).0;
    }
    rest
}

/// Makes a type of lanes a [`Scalar`], with the operators that nalgebra and num-traits ask for, out of what differs between
/// types: the functions of its own `impl`, one instruction or two each.
#[cfg(any(target_arch = "x86_64", all(target_arch = "wasm32", target_feature = "simd128")))]
macro_rules! impl_scalar {
    ($lanes:ident, $width:literal, $mask:ty) => {
        impl_scalar!(@operators $lanes, $width);

        impl Scalar for $lanes {
            type Mask = $mask;
            type Pack = Self;
            const LANES: usize = $width;

            #[inline(always)]
            fn splat(value: f64) -> Self {
                Self::repeat(value)
            }
            #[inline(always)]
            fn from_lanes(number: impl FnMut(usize) -> f64) -> Self {
                Self::from_array(std::array::from_fn(number))
            }
            #[inline(always)]
            fn lane(self, n: usize) -> f64 {
                self.to_array()[n]
            }
            #[inline(always)]
            fn compiled<K: Kernel>(kernel: K) -> K::Output {
                Self::run_with_instructions(kernel)
            }
            #[inline(always)]
            fn sin_cos(self) -> (Self, Self) {
                if Self::any(Self::repeat(SIN_COS_LIMIT).less_than(self.abs())) {
                    let both = self.to_array().map(Scalar::sin_cos);
                    return (Self::from_array(both.map(|b| b.0)), Self::from_array(both.map(|b| b.1)));
                }
                transcendental::sin_cos(self)
            }
            #[inline(always)]
            fn tanh(self) -> Self {
                transcendental::tanh(self)
            }
            #[inline(always)]
            fn tanh_and_sin_cos<const A: usize>(
                x: &mut [Self],
                angles: [Self; A],
                wanted: &[bool; A],
            ) -> [(Self, Self); A] {
                const MOST: usize = if $width == 8 { 2 * $crate::lanes::IN_STEP } else { $crate::lanes::IN_STEP };
                let rest = $crate::lanes::tanh_in_step::<Self, MOST>(x);
                let rest = $crate::lanes::tanh_in_step::<Self, { $crate::lanes::IN_STEP }>(rest);
                for n in 0..rest.len() {
                    rest[n] = rest[n].tanh();
                }
                let mut sines = [(Self::repeat(0.0), Self::repeat(0.0)); A];
                unrolled!(A, n => {
                    if wanted[n] {
                        sines[n] = angles[n].sin_cos();
                    }
                });
                sines
            }
            #[cfg(target_arch = "x86_64")]
            #[inline(always)]
            fn in_step(one: Self, other: Self) -> (Self, Self) {
                Self::held(one, other)
            }
            #[inline(always)]
            fn abs(self) -> Self {
                self.magnitude()
            }
            #[inline(always)]
            fn less_than(self, other: Self) -> $mask {
                self.is_less(other)
            }
            #[inline(always)]
            fn any(mask: $mask) -> bool {
                Self::is_anywhere(mask)
            }
            #[inline(always)]
            fn quadrant(self) -> ($mask, $mask, $mask) {
                let n = self + Self::repeat(ROUNDING);
                (n.bit(0), n.bit(1), (n + Self::repeat(1.0)).bit(1))
            }
            #[inline(always)]
            fn power_of_two(self) -> Self {
                // ROUNDING + 1023 is exact too, and its last bits are those of 1023.
                (self + Self::repeat(ROUNDING + 1023.0)).last_bits_as_exponent()
            }
            #[inline(always)]
            fn select(mask: $mask, if_true: Self, if_false: Self) -> Self {
                Self::choose(mask, if_true, if_false)
            }
        }
    };
    (@operators $lanes:ident, $width:literal) => {
        impl_scalar!($lanes, Add, add, AddAssign, add_assign);
        impl_scalar!($lanes, Sub, sub, SubAssign, sub_assign);
        impl_scalar!($lanes, Mul, mul, MulAssign, mul_assign);
        impl_scalar!($lanes, Div, div, DivAssign, div_assign);

        impl std::ops::Neg for $lanes {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                self.negated()
            }
        }

        impl num_traits::Zero for $lanes {
            #[inline(always)]
            fn zero() -> Self {
                Self::repeat(0.0)
            }
            #[inline(always)]
            fn is_zero(&self) -> bool {
                self.to_array() == [0.0; $width]
            }
        }

        impl num_traits::One for $lanes {
            #[inline(always)]
            fn one() -> Self {
                Self::repeat(1.0)
            }
        }

        impl PartialEq for $lanes {
            fn eq(&self, other: &Self) -> bool {
                self.to_array() == other.to_array()
            }
        }

        impl std::fmt::Debug for $lanes {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                self.to_array().fmt(f)
            }
        }
    };
    ($lanes:ident, $trait:ident, $method:ident, $assign:ident, $assign_method:ident) => {
        impl std::ops::$trait for $lanes {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                self.$method(other)
            }
        }

        impl std::ops::$assign for $lanes {
            #[inline(always)]
            fn $assign_method(&mut self, other: Self) {
                *self = self.$method(other);
            }
        }
    };
}
#[cfg(any(target_arch = "x86_64", all(target_arch = "wasm32", target_feature = "simd128")))]
use impl_scalar;
