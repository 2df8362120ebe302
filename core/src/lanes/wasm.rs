//! Two lanes of WASM's simd128.

use super::impl_operators;
use crate::scalar::{Kernel, Scalar};
use crate::transcendental::{self, ROUNDING, SIN_COS_LIMIT};
#[allow(clippy::wildcard_imports, reason = "twenty intrinsics")]
use std::arch::wasm32::*;

/// Two lanes, simd128.
#[derive(Clone, Copy)]
#[repr(transparent)]
pub struct F64x2(v128);

impl F64x2 {
    const WIDTH: usize = 2;

    #[inline(always)]
    fn repeat(value: f64) -> Self {
        Self(f64x2_splat(value))
    }
    #[inline(always)]
    pub(super) fn from_array([a, b]: [f64; 2]) -> Self {
        Self(f64x2(a, b))
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
    /// Whether bit `bit` is set, over the whole lane.
    #[inline(always)]
    fn bit(self, bit: u32) -> v128 {
        i64x2_shr(i64x2_shl(self.0, 63 - bit), 63)
    }
}
impl_operators!(F64x2);

impl Scalar for F64x2 {
    type Mask = v128;
    type Pack = Self;
    const LANES: usize = 2;

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
        kernel.run()
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
    fn abs(self) -> Self {
        Self(f64x2_abs(self.0))
    }
    #[inline(always)]
    fn less_than(self, other: Self) -> v128 {
        f64x2_lt(self.0, other.0)
    }
    #[inline(always)]
    fn any(mask: v128) -> bool {
        v128_any_true(mask)
    }
    #[inline(always)]
    fn quadrant(self) -> (v128, v128, v128) {
        let n = self + Self::repeat(ROUNDING);
        (n.bit(0), n.bit(1), (n + Self::repeat(1.0)).bit(1))
    }
    #[inline(always)]
    fn power_of_two(self) -> Self {
        // ROUNDING + 1023 is exact too, and its last bits are those of 1023.
        Self(i64x2_shl((self + Self::repeat(ROUNDING + 1023.0)).0, 52))
    }
    #[inline(always)]
    fn select(mask: v128, if_true: Self, if_false: Self) -> Self {
        Self(v128_bitselect(if_true.0, if_false.0, mask))
    }
}
