//! Lanes of x86-64: 2 with SSE2, which every such machine has, 4 with AVX2, 8 with AVX-512.
//!
//! The unsafe code is that `std::arch` asks the caller to know that the machine has an instruction. Here
//! [`super::with_lanes`] asks first, or who works with [`super::Neighbour`]; the types are the crate's own, and nothing else
//! makes a value of them (docs/decisions/0015-lanes.md). And one `asm!` without an instruction, which touches nothing but the two registers that it is given.
#![allow(unsafe_code, reason = "each instruction's presence is checked before a value of its type can exist")]

use super::impl_scalar;
use crate::scalar::{Kernel, MOST_PACKED, Scalar};
use crate::transcendental::{self, ROUNDING, SIN_COS_LIMIT};
use crate::unroll::unrolled;
use std::arch::asm;
#[allow(clippy::wildcard_imports, reason = "fifty intrinsics")]
use std::arch::x86_64::*;

/// How many lanes this machine has instructions for, most first; ends in 1.
pub(super) fn widths() -> &'static [usize] {
    if is_x86_feature_detected!("avx512f") && is_x86_feature_detected!("avx512dq") {
        &[8, 4, 2, 1]
    } else if has_four() {
        &[4, 2, 1]
    } else {
        &[2, 1]
    }
}

/// Whether this machine has four lanes: asked several times per step.
#[inline(always)]
pub(super) fn has_four() -> bool {
    is_x86_feature_detected!("avx2")
}

/// A type of lanes from its vector, its mask and one intrinsic per operation.
macro_rules! lanes {
    (
        $(#[$doc:meta])* $lanes:ident, $width:literal, $vector:ty, $mask:ty, $features:literal, $register:ident,
        $add:ident, $sub:ident, $mul:ident, $div:ident, $repeat:ident, $xor:ident, $andnot:ident,
        less: $less:expr, any: $any:expr, select: $select:expr,
        bit: $bit:expr, power: $power:expr,
    ) => {
        $(#[$doc])*
        #[derive(Clone, Copy)]
        #[repr(transparent)]
        pub(crate) struct $lanes($vector);

        // SAFETY, of every block below: a value of this type exists only on a machine with the instructions named here; see
        // the head of this file. Arrays and vectors of as many numbers have the same layout.
        impl $lanes {
            #[inline(always)]
            pub(super) fn repeat(value: f64) -> Self {
                unsafe { Self($repeat(value)) }
            }
            #[inline(always)]
            pub(super) fn from_array(numbers: [f64; $width]) -> Self {
                unsafe { Self(std::mem::transmute::<[f64; $width], $vector>(numbers)) }
            }
            #[inline(always)]
            #[allow(dead_code, reason = "one type of lanes is that of neighbours")]
            pub(super) fn load(numbers: &[f64; $width]) -> Self {
                Self::from_array(*numbers)
            }
            #[inline(always)]
            #[allow(dead_code, reason = "as above")]
            pub(super) fn gather(numbers: &[f64], at: [Option<usize>; MOST_PACKED]) -> Self {
                let mut found = [0.0; $width];
                for lane in 0..$width.min(MOST_PACKED) {
                    found[lane] = at[lane].map_or(0.0, |n| numbers[n]);
                }
                Self::from_array(found)
            }
            #[inline(always)]
            pub(super) fn to_array(self) -> [f64; $width] {
                unsafe { std::mem::transmute::<$vector, [f64; $width]>(self.0) }
            }
            #[inline(always)]
            fn negated(self) -> Self {
                unsafe { Self($xor(self.0, $repeat(-0.0))) }
            }
            #[inline(always)]
            fn add(self, other: Self) -> Self {
                unsafe { Self($add(self.0, other.0)) }
            }
            #[inline(always)]
            fn sub(self, other: Self) -> Self {
                unsafe { Self($sub(self.0, other.0)) }
            }
            #[inline(always)]
            fn mul(self, other: Self) -> Self {
                unsafe { Self($mul(self.0, other.0)) }
            }
            #[inline(always)]
            fn div(self, other: Self) -> Self {
                unsafe { Self($div(self.0, other.0)) }
            }
            #[inline(always)]
            fn magnitude(self) -> Self {
                unsafe { Self($andnot($repeat(-0.0), self.0)) }
            }
            #[inline(always)]
            fn is_less(self, other: Self) -> $mask {
                unsafe { $less(self.0, other.0) }
            }
            #[inline(always)]
            fn is_anywhere(mask: $mask) -> bool {
                #[allow(unused_unsafe, reason = "masks of eight lanes are plain numbers")]
                unsafe {
                    $any(mask)
                }
            }
            #[inline(always)]
            fn choose(mask: $mask, if_true: Self, if_false: Self) -> Self {
                unsafe { Self($select(mask, if_true.0, if_false.0)) }
            }
            /// Whether a bit is set.
            #[inline(always)]
            fn bit(self, bit: i64) -> $mask {
                unsafe { $bit(self.0, bit) }
            }
            #[inline(always)]
            fn last_bits_as_exponent(self) -> Self {
                unsafe { Self($power(self.0)) }
            }
            /// The same vectors, neither to be used before both are computed: for the compiler they come out of an instruction of which it knows
            /// nothing, and which is none.
            #[inline(always)]
            fn held(one: Self, other: Self) -> (Self, Self) {
                #[inline]
                #[target_feature(enable = $features)]
                fn with_instructions(mut one: $vector, mut other: $vector) -> ($vector, $vector) {
                    unsafe {
                        asm!(
                            "/* {0} {1} */",
                            inout($register) one,
                            inout($register) other,
                            options(pure, nomem, nostack, preserves_flags)
                        );
                    }
                    (one, other)
                }
                let (one, other) = unsafe { with_instructions(one.0, other.0) };
                (Self(one), Self(other))
            }
            #[inline(always)]
            fn run_with_instructions<K: Kernel>(kernel: K) -> K::Output {
                #[target_feature(enable = $features)]
                fn with_instructions<K: Kernel>(kernel: K) -> K::Output {
                    // A variable that is aligned as a vector is, and that the compiler must take to be read: else the frame of a kernel
                    // without a vector variable is aligned to 16 bytes only, and vectors on it may lie across two cache lines.
                    std::hint::black_box(&std::mem::MaybeUninit::<$vector>::uninit());
                    kernel.run()
                }
                unsafe { with_instructions(kernel) }
            }
        }
        impl_scalar!($lanes, $width, $mask);
    };
}

lanes! {
    /// Two lanes, SSE2.
    F64x2, 2, __m128d, __m128d, "sse2", xmm_reg,
    _mm_add_pd, _mm_sub_pd, _mm_mul_pd, _mm_div_pd, _mm_set1_pd, _mm_xor_pd, _mm_andnot_pd,
    less: _mm_cmplt_pd,
    any: |mask| _mm_movemask_pd(mask) != 0,
    select: |mask, a, b| _mm_or_pd(_mm_and_pd(mask, a), _mm_andnot_pd(mask, b)),
    // The bit goes where the sign is, and from there over the lane.
    bit: |n, bit: i64| {
        let top = _mm_sll_epi64(_mm_castpd_si128(n), _mm_cvtsi64_si128(63 - bit));
        _mm_castsi128_pd(_mm_shuffle_epi32::<0b11_11_01_01>(_mm_srai_epi32::<31>(top)))
    },
    power: |n| _mm_castsi128_pd(_mm_slli_epi64::<52>(_mm_castpd_si128(n))),
}

lanes! {
    /// Four lanes, AVX2.
    F64x4, 4, __m256d, __m256d, "avx2", ymm_reg,
    _mm256_add_pd, _mm256_sub_pd, _mm256_mul_pd, _mm256_div_pd, _mm256_set1_pd, _mm256_xor_pd, _mm256_andnot_pd,
    less: _mm256_cmp_pd::<_CMP_LT_OQ>,
    any: |mask| _mm256_movemask_pd(mask) != 0,
    select: |mask, a, b| _mm256_blendv_pd(b, a, mask),
    // Selection looks at the sign only.
    bit: |n, bit: i64| _mm256_castsi256_pd(_mm256_sll_epi64(_mm256_castpd_si256(n), _mm_cvtsi64_si128(63 - bit))),
    power: |n| _mm256_castsi256_pd(_mm256_slli_epi64::<52>(_mm256_castpd_si256(n))),
}

lanes! {
    /// Eight lanes, AVX-512.
    F64x8, 8, __m512d, __mmask8, "avx512f,avx512dq", zmm_reg,
    _mm512_add_pd, _mm512_sub_pd, _mm512_mul_pd, _mm512_div_pd, _mm512_set1_pd, _mm512_xor_pd, _mm512_andnot_pd,
    less: _mm512_cmp_pd_mask::<_CMP_LT_OQ>,
    any: |mask: __mmask8| mask != 0,
    select: |mask, a, b| _mm512_mask_blend_pd(mask, b, a),
    bit: |n, bit: i64| _mm512_test_epi64_mask(_mm512_castpd_si512(n), _mm512_set1_epi64(1 << bit)),
    power: |n| _mm512_castsi512_pd(_mm512_slli_epi64::<52>(_mm512_castpd_si512(n))),
}
