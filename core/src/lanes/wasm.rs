//! Two lanes of WASM's simd128.
#![allow(unsafe_code, reason = "two numbers in memory are read as one vector")]

use super::impl_scalar;
use crate::scalar::{Kernel, MOST_PACKED, Scalar};
use crate::transcendental::{self, ROUNDING, SIN_COS_LIMIT};
use crate::unroll::unrolled;
#[allow(clippy::wildcard_imports, reason = "twenty intrinsics")]
use std::arch::wasm32::*;

/// Two lanes, simd128.
#[derive(Clone, Copy)]
#[repr(transparent)]
pub(crate) struct F64x2(v128);

impl F64x2 {
    #[inline(always)]
    pub(super) fn repeat(value: f64) -> Self {
        Self(f64x2_splat(value))
    }
    #[inline(always)]
    pub(super) fn from_array([a, b]: [f64; 2]) -> Self {
        Self(f64x2(a, b))
    }
    #[inline(always)]
    pub(super) fn load(numbers: &[f64; 2]) -> Self {
        // SAFETY: as many numbers as are read; they may begin anywhere.
        Self(unsafe { v128_load(numbers.as_ptr().cast()) })
    }
    /// The numbers at two places; zero where there is none. What is loaded whole is often there already: a pair put together
    /// from two others is one instruction, from two numbers in memory it is four.
    #[inline(always)]
    pub(super) fn gather(numbers: &[f64], at: [Option<usize>; MOST_PACKED]) -> Self {
        let pair = |at: Option<usize>| {
            at.map_or(f64x2_splat(0.0), |n| {
                let (pairs, rest) = numbers.as_chunks::<2>();
                match pairs.get(n / 2) {
                    Some(pair) => Self::load(pair).0,
                    None => f64x2_splat(rest[0]),
                }
            })
        };
        let is_second = |at: Option<usize>| at.is_some_and(|n| n % 2 == 1);
        let (a, b) = (pair(at[0]), pair(at[1]));
        Self(match (is_second(at[0]), is_second(at[1])) {
            (false, false) => i64x2_shuffle::<0, 2>(a, b),
            (false, true) => i64x2_shuffle::<0, 3>(a, b),
            (true, false) => i64x2_shuffle::<1, 2>(a, b),
            (true, true) => i64x2_shuffle::<1, 3>(a, b),
        })
    }
    #[inline(always)]
    pub(super) fn to_array(self) -> [f64; 2] {
        [f64x2_extract_lane::<0>(self.0), f64x2_extract_lane::<1>(self.0)]
    }
    #[inline(always)]
    fn negated(self) -> Self {
        Self(f64x2_neg(self.0))
    }
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self(f64x2_add(self.0, other.0))
    }
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self(f64x2_sub(self.0, other.0))
    }
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self(f64x2_mul(self.0, other.0))
    }
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        Self(f64x2_div(self.0, other.0))
    }
    #[inline(always)]
    fn magnitude(self) -> Self {
        Self(f64x2_abs(self.0))
    }
    #[inline(always)]
    fn is_less(self, other: Self) -> v128 {
        f64x2_lt(self.0, other.0)
    }
    #[inline(always)]
    fn is_anywhere(mask: v128) -> bool {
        v128_any_true(mask)
    }
    #[inline(always)]
    fn choose(mask: v128, if_true: Self, if_false: Self) -> Self {
        Self(v128_bitselect(if_true.0, if_false.0, mask))
    }
    /// Whether a bit is set, over the whole lane.
    #[inline(always)]
    fn bit(self, bit: u32) -> v128 {
        i64x2_shr(i64x2_shl(self.0, 63 - bit), 63)
    }
    #[inline(always)]
    fn last_bits_as_exponent(self) -> Self {
        Self(i64x2_shl(self.0, 52))
    }
    /// The whole module is compiled with them.
    #[inline(always)]
    fn run_with_instructions<K: Kernel>(kernel: K) -> K::Output {
        super::once(kernel)
    }
}
impl_scalar!(F64x2, 2, v128);
