//! Sine, cosine and hyperbolic tangent in plain arithmetic over [`Scalar`]: what is computed does not depend on the argument, so that
//! one lane or several, native code and WASM execute the same operations and return the same bits. The one branch leaves out
//! tangents whose bits are known.
//!
//! Error at most 2 ulp: `tanh` everywhere, `sin_cos` for `|x| ≤` [`SIN_COS_LIMIT`]. Coefficients are those of the power
//! series; on the reduced ranges its remainder is below the rounding.

use crate::scalar::Scalar;

/// Up to here the argument's reduction keeps its accuracy, rad.
pub(crate) const SIN_COS_LIMIT: f64 = 1e5;
/// From here on the hyperbolic tangent rounds to one: `e^{2x}` is beyond 2⁵⁵, which adding two leaves as it is.
const TANH_LIMIT: f64 = 19.07;

/// Adding and subtracting this rounds a number below 2⁵¹ to the nearest whole one; after adding it, the last bits of the sum
/// are those of that whole number.
pub(crate) const ROUNDING: f64 = 6_755_399_441_055_744.0;

/// π/2 in parts: whole multiples up to 2²⁰ of the first two (33 bits each) are exact.
const HALF_PI: [f64; 3] = [
    f64::from_bits(0x3ff9_21fb_5440_0000),
    f64::from_bits(0x3dd0_b461_1a60_0000),
    f64::from_bits(0x3ba3_198a_2e03_7073),
];

/// ln 2 in parts: whole multiples up to 2²⁰ of the first (32 bits) are exact.
const LN_2: [f64; 2] = [f64::from_bits(0x3fe6_2e42_fee0_0000), f64::from_bits(0x3dea_39ef_3579_3c76)];

/// `1/n!`.
const fn inverse_factorial(n: u32) -> f64 {
    let (mut product, mut k) = (1.0, 2);
    while k <= n {
        // Exact up to 18!, which is all that is asked for.
        product *= k as f64;
        k += 1;
    }
    1.0 / product
}

/// A power series `Σ c_k z^k` being summed in pairs from the last to the first, which leaves less to wait for than Horner's scheme.
#[derive(Clone, Copy)]
struct Series<T, const K: usize> {
    coefficients: &'static [f64; K],
    z: T,
    z2: T,
    sum: T,
}

impl<T: Scalar, const K: usize> Series<T, K> {
    /// Pairs that follow the last.
    const STEPS: usize = (K - 1) / 2;

    /// With its last pair summed.
    #[inline(always)]
    fn new(coefficients: &'static [f64; K], z: T) -> Self {
        let series = Self { coefficients, z, z2: z * z, sum: T::zero() };
        Self { sum: series.pair(2 * Self::STEPS), ..series }
    }

    /// Adds the pair that is `step`th after the last, counted from 0; nothing where there is none.
    #[inline(always)]
    fn step(&mut self, step: usize) {
        if step < Self::STEPS {
            self.sum = self.sum * self.z2 + self.pair(2 * (Self::STEPS - 1 - step));
        }
    }

    /// `c_k + c_{k+1} z`.
    #[inline(always)]
    fn pair(&self, k: usize) -> T {
        let c = self.coefficients;
        if k + 1 < K { T::splat(c[k]) + T::splat(c[k + 1]) * self.z } else { T::splat(c[k]) }
    }
}

#[inline(always)]
fn round<T: Scalar>(x: T) -> T {
    (x + T::splat(ROUNDING)) - T::splat(ROUNDING)
}

/// An angle on its way to sine and cosine: `x = n π/2 + r + tail` with `|r| ≤ π/4`, and series in r².
#[derive(Clone, Copy)]
struct Turn<T> {
    n: T,
    r: T,
    tail: T,
    sine: Series<T, 8>,
    cosine: Series<T, 7>,
}

impl<T: Scalar> Turn<T> {
    const SINE: [f64; 8] = [
        -inverse_factorial(3),
        inverse_factorial(5),
        -inverse_factorial(7),
        inverse_factorial(9),
        -inverse_factorial(11),
        inverse_factorial(13),
        -inverse_factorial(15),
        inverse_factorial(17),
    ];
    const COSINE: [f64; 7] = [
        inverse_factorial(4),
        -inverse_factorial(6),
        inverse_factorial(8),
        -inverse_factorial(10),
        inverse_factorial(12),
        -inverse_factorial(14),
        inverse_factorial(16),
    ];

    #[inline(always)]
    fn of(x: T) -> Self {
        // The third part and what its subtraction loses are added last.
        let n = round(x * T::splat(std::f64::consts::FRAC_2_PI));
        let first = x - n * T::splat(HALF_PI[0]);
        let second = n * T::splat(HALF_PI[1]);
        let near = first - second;
        let third = n * T::splat(HALF_PI[2]) - ((first - near) - second);
        let r = near - third;
        let tail = (near - r) - third;
        let z = r * r;
        Self { n, r, tail, sine: Series::new(&Self::SINE, z), cosine: Series::new(&Self::COSINE, z) }
    }

    /// `(sin x, cos x)`, once the series are summed.
    #[inline(always)]
    fn sin_cos(self) -> (T, T) {
        let Self { n, r, tail, sine: Series { z, sum: sine, .. }, cosine: Series { sum: cosine, .. } } = self;
        let half = T::splat(0.5);
        let sine = r + (tail * (T::one() - half * z) + z * r * sine);
        let half_z = half * z;
        let top = T::one() - half_z;
        let cosine = top + (((T::one() - top) - half_z) + (z * z * cosine - r * tail));

        let (odd, sine_negative, cosine_negative) = n.quadrant();
        let (sin, cos) = (T::select(odd, cosine, sine), T::select(odd, sine, cosine));
        (T::select(sine_negative, -sin, sin), T::select(cosine_negative, -cos, cos))
    }
}

/// A number on its way to its hyperbolic tangent `t/(t + 2)`, `t = e^{2|x|} − 1`: `2|x| = n ln 2 + r + tail` with
/// `|r| ≤ ½ ln 2`, and a series in r.
#[derive(Clone, Copy)]
struct Exponent<T> {
    x: T,
    n: T,
    tail: T,
    cubic: Series<T, 11>,
}

impl<T: Scalar> Exponent<T> {
    const CUBIC: [f64; 11] = [
        inverse_factorial(3),
        inverse_factorial(4),
        inverse_factorial(5),
        inverse_factorial(6),
        inverse_factorial(7),
        inverse_factorial(8),
        inverse_factorial(9),
        inverse_factorial(10),
        inverse_factorial(11),
        inverse_factorial(12),
        inverse_factorial(13),
    ];

    #[inline(always)]
    fn of(x: T) -> Self {
        let magnitude = up_to_limit(x.abs());
        let doubled = magnitude + magnitude;
        let n = round(doubled * T::splat(std::f64::consts::LOG2_E));
        let high = doubled - n * T::splat(LN_2[0]);
        let low = n * T::splat(LN_2[1]);
        let r = high - low;
        let tail = (high - r) - low;
        Self { x, n, tail, cubic: Series::new(&Self::CUBIC, r) }
    }

    /// `tanh x`, once the series is summed.
    #[inline(always)]
    fn tanh(self) -> T {
        let Self { x, n, tail, cubic: Series { z: r, z2: z, sum, .. } } = self;
        let exponential = r + (T::splat(0.5) * z + (z * r * sum + (tail + tail * r)));
        let power = n.power_of_two();
        let t = power * exponential + (power - T::one());
        let tanh = t / (t + T::splat(2.0));
        T::select(x.less_than(T::zero()), -tanh, tanh)
    }
}

#[inline(always)]
fn up_to_limit<T: Scalar>(magnitude: T) -> T {
    let limit = T::splat(TANH_LIMIT);
    T::select(limit.less_than(magnitude), limit, magnitude)
}

/// `(sin x, cos x)`; `x` in rad.
#[inline(always)]
pub(crate) fn sin_cos<T: Scalar>(x: T) -> (T, T) {
    series([], [x]).1[0]
}

/// `tanh x`.
#[inline(always)]
pub(crate) fn tanh<T: Scalar>(x: T) -> T {
    tanh_and_sin_cos([x], []).0[0]
}

/// Hyperbolic tangents, and sines and cosines of angles in rad, in step. Where all tangents are ±1 none is computed: dry friction is there
/// a good part of the time. Their bits are the same.
#[inline(always)]
pub(crate) fn tanh_and_sin_cos<T: Scalar, const X: usize, const A: usize>(
    x: [T; X],
    angles: [T; A],
) -> ([T; X], [(T, T); A]) {
    match saturated(x) {
        Some(ones) => (ones, series([], angles).1),
        None => series(x, angles),
    }
}

/// `tanh x` where each is ±1 (or no number) in every lane; `None` elsewhere.
#[inline(always)]
fn saturated<T: Scalar, const X: usize>(x: [T; X]) -> Option<[T; X]> {
    let limit = T::splat(TANH_LIMIT);
    let (mut magnitudes, mut least) = (x, limit);
    for n in 0..X {
        magnitudes[n] = up_to_limit(x[n].abs());
        least = T::select(magnitudes[n].less_than(least), magnitudes[n], least);
    }
    if T::any(least.less_than(limit)) {
        return None;
    }
    let mut ones = x;
    for n in 0..X {
        // What is no number stays so.
        let one = T::one() + (magnitudes[n] - limit);
        ones[n] = T::select(x[n].less_than(T::zero()), -one, one);
    }
    Some(ones)
}

/// The same without exception. In step, because each series is a chain in which every instruction waits for the one before, and processors
/// do not look far enough ahead to find the next chain by themselves.
#[inline(always)]
fn series<T: Scalar, const X: usize, const A: usize>(x: [T; X], angles: [T; A]) -> ([T; X], [(T, T); A]) {
    // As many as the longest series takes.
    const STEPS: usize = Series::<f64, 11>::STEPS;
    let (mut exponents, mut turns) = ([Exponent::of(T::zero()); X], [Turn::of(T::zero()); A]);
    for n in 0..X {
        exponents[n] = Exponent::of(x[n]);
    }
    for n in 0..A {
        turns[n] = Turn::of(angles[n]);
    }
    for step in 0..STEPS {
        for n in 0..X {
            exponents[n].cubic.step(step);
        }
        for n in 0..A {
            turns[n].sine.step(step);
            turns[n].cosine.step(step);
        }
        for n in 1..X {
            let (one, other) = T::in_step(exponents[n - 1].cubic.sum, exponents[n].cubic.sum);
            (exponents[n - 1].cubic.sum, exponents[n].cubic.sum) = (one, other);
        }
        for n in 0..A.min(X) {
            let (one, other) = T::in_step(exponents[n].cubic.sum, turns[n].sine.sum);
            (exponents[n].cubic.sum, turns[n].sine.sum) = (one, other);
            let (one, other) = T::in_step(turns[n].sine.sum, turns[n].cosine.sum);
            (turns[n].sine.sum, turns[n].cosine.sum) = (one, other);
        }
    }
    let (mut tangents, mut sines) = ([T::zero(); X], [(T::zero(), T::zero()); A]);
    for n in 0..X {
        tangents[n] = exponents[n].tanh();
    }
    for n in 0..A {
        sines[n] = turns[n].sin_cos();
    }
    (tangents, sines)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Rows of numbers written as the hexadecimal digits of their bits. High-precision values come as the nearest number
    /// and the rest; the tables were computed with 300 bits by an arbitrary-precision library.
    fn table<const K: usize>(csv: &str) -> impl Iterator<Item = [f64; K]> {
        csv.lines().skip(1).map(|line| {
            let mut numbers = line.split(',').map(|digits| f64::from_bits(u64::from_str_radix(digits, 16).unwrap()));
            std::array::from_fn(|_| numbers.next().unwrap())
        })
    }

    /// Error in units of the last place of the exact value `nearest + rest`.
    fn ulps(computed: f64, nearest: f64, rest: f64) -> f64 {
        let ulp = nearest.abs().next_up() - nearest.abs();
        ((computed - nearest) - rest).abs() / ulp
    }

    #[test]
    fn tables_are_met_to_two_ulp() {
        let (mut worst, mut rows) = ([0.0_f64; 3], 0);
        for [x, sin, sin_rest, cos, cos_rest] in table(include_str!("../tests/sin_cos.csv")) {
            let (s, c) = sin_cos(x);
            worst[0] = worst[0].max(ulps(s, sin, sin_rest));
            worst[1] = worst[1].max(ulps(c, cos, cos_rest));
            rows += 1;
        }
        for [x, nearest, rest] in table(include_str!("../tests/tanh.csv")) {
            worst[2] = worst[2].max(ulps(tanh(x), nearest, rest));
            rows += 1;
        }
        println!("sin, cos, tanh: {worst:?} ulp over {rows} rows");
        assert!(rows > 500 && worst.iter().all(|ulps| *ulps <= 2.0), "{worst:?}");
    }

    #[test]
    fn what_is_not_a_number_stays_so_and_infinities_saturate() {
        assert!(tanh(f64::NAN).is_nan() && Scalar::tanh(f64::NAN).is_nan());
        assert_eq!([f64::INFINITY, f64::NEG_INFINITY, 1e300].map(tanh), [1.0, -1.0, 1.0]);
        assert!([f64::NAN, f64::INFINITY].iter().all(|x| Scalar::sin_cos(*x).0.is_nan()));
    }

    proptest! {
        /// The short cut for saturated friction must not be seen in the bits.
        #[test]
        fn saturation_has_the_bits_of_the_whole_computation(
            x in prop::array::uniform3(prop_oneof![-30.0..30.0_f64, 18.9..19.2_f64, -1e6..1e6_f64]),
        ) {
            let (whole, []) = series(x, []);
            prop_assert_eq!(tanh_and_sin_cos(x, []).0.map(f64::to_bits), whole.map(f64::to_bits));
            prop_assert_eq!(x.map(|x| Scalar::tanh(x).to_bits()), whole.map(f64::to_bits));
        }

        #[test]
        fn another_library_agrees(x in -30.0..30.0_f64, angle in prop_oneof![-7.0..7.0_f64, -1e5..1e5_f64]) {
            prop_assert!(ulps(tanh(x), libm::tanh(x), 0.0) <= 4.0);
            let ((s, c), (sin, cos)) = (sin_cos(angle), libm::sincos(angle));
            prop_assert!(ulps(s, sin, 0.0) <= 2.5 && ulps(c, cos, 0.0) <= 2.5);
        }
    }
}
