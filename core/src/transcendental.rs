//! Sine, cosine and hyperbolic tangent in plain arithmetic over [`Scalar`]: no branch depends on the argument, so that one
//! lane or several, native code and WASM execute the same operations and return the same bits.
//!
//! Error at most 2 ulp: `tanh` everywhere, `sin_cos` for `|x| ≤` [`SIN_COS_LIMIT`]. Coefficients are those of the power
//! series; on the reduced ranges its remainder is below the rounding.

use crate::scalar::Scalar;

/// Up to here the argument's reduction keeps its accuracy, rad.
pub(crate) const SIN_COS_LIMIT: f64 = 1e5;
/// From here on the hyperbolic tangent rounds to one.
pub(crate) const TANH_LIMIT: f64 = 22.0;

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

/// `Σ c_k z^k` in pairs, which leaves less to wait for than Horner's scheme.
#[inline(always)]
fn series<T: Scalar, const K: usize>(c: [f64; K], z: T) -> T {
    let z2 = z * z;
    let mut sum = pair(&c, (K - 1) / 2 * 2, z);
    for k in (0..(K - 1) / 2).rev() {
        sum = sum * z2 + pair(&c, 2 * k, z);
    }
    sum
}

/// `c_k + c_{k+1} z`.
#[inline(always)]
fn pair<T: Scalar, const K: usize>(c: &[f64; K], k: usize, z: T) -> T {
    if k + 1 < K { T::splat(c[k]) + T::splat(c[k + 1]) * z } else { T::splat(c[k]) }
}

#[inline(always)]
fn round<T: Scalar>(x: T) -> T {
    (x + T::splat(ROUNDING)) - T::splat(ROUNDING)
}

/// `(sin x, cos x)`; `x` in rad.
#[inline(always)]
pub(crate) fn sin_cos<T: Scalar>(x: T) -> (T, T) {
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
    // x = n π/2 + r + tail with |r| ≤ π/4: the third part and what its subtraction loses are added last.
    let n = round(x * T::splat(std::f64::consts::FRAC_2_PI));
    let first = x - n * T::splat(HALF_PI[0]);
    let second = n * T::splat(HALF_PI[1]);
    let near = first - second;
    let third = n * T::splat(HALF_PI[2]) - ((first - near) - second);
    let r = near - third;
    let tail = (near - r) - third;

    let z = r * r;
    let half = T::splat(0.5);
    let sine = r + (tail * (T::one() - half * z) + z * r * series(SINE, z));
    let half_z = half * z;
    let top = T::one() - half_z;
    let cosine = top + (((T::one() - top) - half_z) + (z * z * series(COSINE, z) - r * tail));

    let (odd, sine_negative, cosine_negative) = n.quadrant();
    let (sin, cos) = (T::select(odd, cosine, sine), T::select(odd, sine, cosine));
    (T::select(sine_negative, -sin, sin), T::select(cosine_negative, -cos, cos))
}

/// `tanh x = t/(t + 2)` with `t = e^{2|x|} − 1`.
#[inline(always)]
pub(crate) fn tanh<T: Scalar>(x: T) -> T {
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
    let limit = T::splat(TANH_LIMIT);
    let magnitude = x.abs();
    let magnitude = T::select(limit.less_than(magnitude), limit, magnitude);
    // 2|x| = n ln 2 + r + tail with |r| ≤ ½ ln 2.
    let doubled = magnitude + magnitude;
    let n = round(doubled * T::splat(std::f64::consts::LOG2_E));
    let high = doubled - n * T::splat(LN_2[0]);
    let low = n * T::splat(LN_2[1]);
    let r = high - low;
    let tail = (high - r) - low;

    let z = r * r;
    let exponential = r + (T::splat(0.5) * z + (z * r * series(CUBIC, r) + (tail + tail * r)));
    let power = n.power_of_two();
    let t = power * exponential + (power - T::one());
    let tanh = t / (t + T::splat(2.0));
    T::select(x.less_than(T::zero()), -tanh, tanh)
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
        fn saturation_has_the_bits_of_the_whole_computation(x in prop_oneof![-30.0..30.0_f64, -1e6..1e6_f64]) {
            prop_assert_eq!(Scalar::tanh(x).to_bits(), tanh(x).to_bits());
        }

        #[test]
        fn another_library_agrees(x in -30.0..30.0_f64, angle in prop_oneof![-7.0..7.0_f64, -1e5..1e5_f64]) {
            prop_assert!(ulps(tanh(x), libm::tanh(x), 0.0) <= 4.0);
            let ((s, c), (sin, cos)) = (sin_cos(angle), libm::sincos(angle));
            prop_assert!(ulps(s, sin, 0.0) <= 2.5 && ulps(c, cos, 0.0) <= 2.5);
        }
    }
}
