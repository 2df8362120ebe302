//! Each lane does what a number alone does, to the bit.

use super::{WithLanes, widths, with_lanes};
use crate::scalar::{Kernel, Scalar};
use proptest::prelude::*;

/// Every operation on `x` and `y`, lane by lane and alone.
struct SameBits<'a> {
    x: &'a [f64; 8],
    y: &'a [f64; 8],
}

struct Operations<T> {
    x: T,
    y: T,
}

impl<T: Scalar> Kernel for Operations<T> {
    type Output = [T; 14];
    #[inline(always)]
    fn run(self) -> [T; 14] {
        let Self { x, y } = self;
        let (sin, cos) = x.sin_cos();
        let less = x.less_than(y);
        let whole = (y + T::splat(crate::transcendental::ROUNDING)) - T::splat(crate::transcendental::ROUNDING);
        let (odd, sine, cosine) = whole.quadrant();
        let choose = |mask| T::select(mask, x, y);
        [
            x + y,
            x - y,
            x * y,
            x / y,
            -x,
            x.abs(),
            sin,
            cos,
            x.tanh(),
            whole.power_of_two(),
            choose(less),
            choose(odd),
            choose(sine) + choose(cosine),
            x.sign(),
        ]
    }
}

impl WithLanes for SameBits<'_> {
    type Output = Vec<(usize, usize, f64, f64)>;
    fn with<T: Scalar>(self) -> Self::Output {
        let x = T::from_lanes(|n| self.x[n]);
        let y = T::from_lanes(|n| self.y[n]);
        let together = T::compiled(Operations { x, y });
        let mut different = Vec::new();
        for lane in 0..T::LANES {
            let alone = Operations { x: self.x[lane], y: self.y[lane] }.run();
            for (operation, (together, alone)) in together.iter().zip(alone).enumerate() {
                let together = together.lane(lane);
                if together.to_bits() != alone.to_bits() && !(together.is_nan() && alone.is_nan()) {
                    different.push((operation, lane, together, alone));
                }
            }
        }
        different
    }
}

fn numbers() -> impl Strategy<Value = [f64; 8]> {
    prop::array::uniform8(prop_oneof![-30.0..30.0_f64, -900.0..900.0_f64, -2e5..2e5_f64, Just(0.0), Just(-0.0)])
}

proptest! {
    #[test]
    fn every_lane_has_the_bits_of_a_number_alone(x in numbers(), y in prop::array::uniform8(-900.0..900.0_f64)) {
        for width in widths() {
            let different = with_lanes(*width, SameBits { x: &x, y: &y }).unwrap();
            prop_assert!(different.is_empty(), "{width} lanes: {different:?}");
        }
        #[cfg(any(target_arch = "x86_64", all(target_arch = "wasm32", target_feature = "simd128")))]
        if super::Neighbour::is_here() {
            let different = SameBits { x: &x, y: &y }.with::<super::Neighbour>();
            prop_assert!(different.is_empty(), "a neighbour: {different:?}");
        }
    }
}

#[test]
fn what_is_not_finite_stays_in_its_lane() {
    let x = [1.0, f64::NAN, f64::INFINITY, -2.0, f64::NEG_INFINITY, 0.5, 1e300, -0.0];
    for width in widths() {
        let different = with_lanes(*width, SameBits { x: &x, y: &[3.0; 8] }).unwrap();
        assert!(different.is_empty(), "{width} lanes: {different:?}");
    }
    assert_eq!(with_lanes(3, SameBits { x: &x, y: &x }).map(|_| ()), None);
}

/// Tangents of `x`, and sines and cosines of some angles, together and alone.
struct Together<'a> {
    x: &'a [[f64; 8]],
    angles: &'a [[f64; 8]; ANGLES],
    wanted: [bool; ANGLES],
}

const ANGLES: usize = 5;

struct Each<'a, T> {
    x: &'a mut [T],
    angles: [T; ANGLES],
    wanted: &'a [bool; ANGLES],
}

impl<T: Scalar> Kernel for Each<'_, T> {
    type Output = [(T, T); ANGLES];
    #[inline(always)]
    fn run(self) -> Self::Output {
        T::tanh_and_sin_cos(self.x, self.angles, self.wanted)
    }
}

impl WithLanes for Together<'_> {
    type Output = Vec<(usize, f64, f64)>;
    fn with<T: Scalar>(self) -> Self::Output {
        let of = |numbers: &[f64; 8]| T::from_lanes(|n| numbers[n]);
        let mut x: Vec<T> = self.x.iter().map(of).collect();
        let sines = T::compiled(Each { x: &mut x, angles: self.angles.each_ref().map(of), wanted: &self.wanted });
        let mut different = Vec::new();
        for lane in 0..T::LANES {
            let tangents = x.iter().zip(self.x).map(|(found, x)| (found.lane(lane), Scalar::tanh(x[lane])));
            let sines = sines.iter().zip(self.angles).zip(self.wanted).flat_map(|(((sin, cos), angle), wanted)| {
                let alone = if wanted { Scalar::sin_cos(angle[lane]) } else { (0.0, 0.0) };
                [(sin.lane(lane), alone.0), (cos.lane(lane), alone.1)]
            });
            different.extend(tangents.chain(sines).enumerate().filter_map(|(place, (found, alone))| {
                let is_same = found.to_bits() == alone.to_bits() || found.is_nan() && alone.is_nan();
                (!is_same).then_some((place, found, alone))
            }));
        }
        different
    }
}

fn angles() -> impl Strategy<Value = [f64; 8]> {
    prop::array::uniform8(
        prop_oneof![20 => -30.0..30.0_f64, 1 => -2e5..2e5_f64, 1 => Just(f64::INFINITY), 1 => Just(f64::NAN)],
    )
}

proptest! {
    /// Lists of any length: the last vector is not full.
    #[test]
    fn tangents_and_sines_of_several_have_the_bits_of_one(
        x in prop::collection::vec(numbers(), 0..15),
        angles in prop::array::uniform5(angles()),
        wanted in any::<[bool; ANGLES]>(),
    ) {
        let together = || Together { x: &x, angles: &angles, wanted };
        for width in widths() {
            let different = with_lanes(*width, together()).unwrap();
            prop_assert!(different.is_empty(), "{width} lanes: {different:?}");
        }
        #[cfg(any(target_arch = "x86_64", all(target_arch = "wasm32", target_feature = "simd128")))]
        if super::Neighbour::is_here() {
            let different = together().with::<super::Neighbour>();
            prop_assert!(different.is_empty(), "neighbours: {different:?}");
        }
    }
}
