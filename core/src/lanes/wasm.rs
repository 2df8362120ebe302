//! Two lanes of WASM's simd128.
#![allow(unsafe_code, reason = "two numbers in memory are read as one vector")]

use super::impl_scalar;
use crate::scalar::{Kernel, Scalar};
use crate::transcendental::{self, ROUNDING, SIN_COS_LIMIT};
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
