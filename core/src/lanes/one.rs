//! One lane: an ordinary number. Where it needs the same function of several numbers, it borrows two lanes, which every
//! machine that we know has.

#[cfg(any(target_arch = "x86_64", all(target_arch = "wasm32", target_feature = "simd128")))]
use super::F64x2;
use crate::scalar::{Kernel, Scalar, sin_cos_of_any};
use crate::transcendental::{self, ROUNDING, SIN_COS_LIMIT};

impl Scalar for f64 {
    type Mask = bool;
    type Pack = Self;
    const LANES: usize = 1;

    #[inline(always)]
    fn from_lanes(mut number: impl FnMut(usize) -> f64) -> Self {
        number(0)
    }
    #[inline(always)]
    fn lane(self, _n: usize) -> f64 {
        self
    }
    #[inline(always)]
    fn compiled<K: Kernel>(kernel: K) -> K::Output {
        // A number alone does as well without; loops over many, which the compiler turns into vectors, do not.
        #[cfg(target_arch = "x86_64")]
        if K::LOOPS_OVER_NUMBERS && super::Neighbour::is_here() {
            return super::F64x4::compiled(kernel);
        }
        if cfg!(target_arch = "wasm32") { super::once(kernel) } else { kernel.run() }
    }
    #[inline(always)]
    fn splat(value: f64) -> Self {
        value
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        // Only an arm that spins out of control gets here; its numbers should still be those of its angles.
        if SIN_COS_LIMIT < self.abs() { sin_cos_of_any(self) } else { transcendental::sin_cos(self) }
    }
    #[inline(always)]
    fn tanh(self) -> Self {
        transcendental::tanh(self)
    }
    #[cfg(any(target_arch = "x86_64", all(target_arch = "wasm32", target_feature = "simd128")))]
    #[inline(always)]
    fn tanh_and_sin_cos<const A: usize>(x: &mut [Self], angles: [Self; A], wanted: &[bool; A]) -> [(Self, Self); A] {
        tanh_each(x);
        let mut sines = [(0.0, 0.0); A];
        let (mut places, mut count) = ([0; A], 0);
        for n in 0..A {
            if wanted[n] {
                places[count] = n;
                count += 1;
            }
        }
        for pair in 0..count / 2 {
            let (a, b) = (places[2 * pair], places[2 * pair + 1]);
            (sines[a], sines[b]) = sin_cos_of_two(angles[a], angles[b]);
        }
        if count % 2 == 1 {
            let last = places[count - 1];
            sines[last] = Scalar::sin_cos(angles[last]);
        }
        sines
    }
    #[inline(always)]
    fn abs(self) -> Self {
        f64::abs(self)
    }
    #[inline(always)]
    fn less_than(self, other: Self) -> bool {
        self < other
    }
    #[inline(always)]
    fn any(mask: bool) -> bool {
        mask
    }
    #[inline(always)]
    fn quadrant(self) -> (bool, bool, bool) {
        let n = (self + ROUNDING).to_bits();
        (n & 1 != 0, n & 2 != 0, (n + 1) & 2 != 0)
    }
    #[inline(always)]
    fn power_of_two(self) -> Self {
        Self::from_bits(((self + ROUNDING).to_bits() + 1023) << 52)
    }
    #[inline(always)]
    fn select(mask: bool, if_true: Self, if_false: Self) -> Self {
        if mask { if_true } else { if_false }
    }
}

#[cfg(any(target_arch = "x86_64", all(target_arch = "wasm32", target_feature = "simd128")))]
#[inline(always)]
fn sin_cos_of_two(a: f64, b: f64) -> ((f64, f64), (f64, f64)) {
    let (sin, cos) = F64x2::from_array([a, b]).sin_cos();
    let ([sin_a, sin_b], [cos_a, cos_b]) = (sin.to_array(), cos.to_array());
    ((sin_a, cos_a), (sin_b, cos_b))
}

#[cfg(any(target_arch = "x86_64", all(target_arch = "wasm32", target_feature = "simd128")))]
#[inline(always)]
fn tanh_each(x: &mut [f64]) {
    let (pairs, rest) = x.as_chunks_mut();
    for pair in pairs {
        *pair = F64x2::from_array(*pair).tanh().to_array();
    }
    for x in rest {
        // Named in full: a number's own method of this name is the platform's.
        *x = Scalar::tanh(*x);
    }
}
