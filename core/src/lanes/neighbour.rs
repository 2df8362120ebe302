//! A number of one run whose neighbours are worked on together: four with AVX2, two with WASM's simd128
//! (docs/decisions/0021-neighbours.md).
//!
//! It computes as an ordinary number does. What differs is its [`Pack`], and that it is compiled with that one's instructions
//! throughout: like [`Vector`], it may be used only where [`Neighbour::is_here`].
#![allow(unsafe_code, reason = "slices of a type that is one number are slices of numbers")]

#[cfg(target_arch = "wasm32")]
use super::F64x2 as Vector;
#[cfg(target_arch = "x86_64")]
use super::F64x4 as Vector;
use super::{IN_STEP, impl_scalar};
use crate::scalar::{Kernel, MOST_PACKED, Pack, Scalar};
use crate::transcendental::{SIN_COS_LIMIT, tanh_and_sin_cos};

/// One number.
#[derive(Clone, Copy)]
#[repr(transparent)]
pub(crate) struct Neighbour(f64);

impl Neighbour {
    /// Whether this machine has the instructions.
    #[inline(always)]
    pub fn is_here() -> bool {
        #[cfg(target_arch = "x86_64")]
        return super::x86_64::has_four();
        #[cfg(target_arch = "wasm32")]
        true
    }

    /// These numbers.
    pub fn of(numbers: &[f64]) -> &[Self] {
        // SAFETY: a transparent struct has the layout of its one field, and any bits are a number; the lifetime is kept.
        unsafe { std::slice::from_raw_parts(numbers.as_ptr().cast(), numbers.len()) }
    }

    /// These numbers, to be written.
    pub fn of_mut(numbers: &mut [f64]) -> &mut [Self] {
        // SAFETY: as above; the borrow stays exclusive.
        unsafe { std::slice::from_raw_parts_mut(numbers.as_mut_ptr().cast(), numbers.len()) }
    }

    /// Plain numbers again.
    pub fn plain(numbers: &[Self]) -> &[f64] {
        // SAFETY: as above.
        unsafe { std::slice::from_raw_parts(numbers.as_ptr().cast(), numbers.len()) }
    }

    #[inline(always)]
    fn repeat(value: f64) -> Self {
        Self(value)
    }
    #[inline(always)]
    fn to_array(self) -> [f64; 1] {
        [self.0]
    }
    #[inline(always)]
    fn negated(self) -> Self {
        Self(-self.0)
    }
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0)
    }
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self(self.0 - other.0)
    }
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self(self.0 * other.0)
    }
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        Self(self.0 / other.0)
    }
}
impl_scalar!(@operators Neighbour, 1);

impl Pack<Neighbour> for Vector {
    const WIDTH: usize = Self::LANES;
    #[inline(always)]
    fn repeat(number: Neighbour) -> Self {
        Self::repeat(number.0)
    }
    #[inline(always)]
    fn load(numbers: &[Neighbour]) -> Self {
        let (first, _) =
            Neighbour::plain(numbers).split_first_chunk().expect("as many numbers as are worked on together");
        Self::load(first)
    }
    #[inline(always)]
    fn store(self, numbers: &mut [Neighbour]) {
        numbers[..Self::LANES].copy_from_slice(Neighbour::of(&self.to_array()));
    }
    #[inline(always)]
    fn gather(numbers: &[Neighbour], at: [Option<usize>; MOST_PACKED]) -> Self {
        Self::gather(Neighbour::plain(numbers), at)
    }
}

/// Tangents, in place, the first [`IN_STEP`] vectors of them in step with the sines and cosines of these angles. Vectors that are not full cost
/// as much as full ones.
#[inline(always)]
fn with_sines<const A: usize>(x: &mut [Neighbour], angles: [Vector; A]) -> [(Vector, Vector); A] {
    // A loop alone where nothing is in step: a page loads each copy of what stands in it.
    let together = if IN_STEP == 1 { 0 } else { x.len().min(IN_STEP * Vector::LANES) };
    let (first, rest) = x.split_at_mut(together);
    let sines = match first.len().div_ceil(Vector::LANES) {
        0 => vectors::<0, A>(first, angles),
        1 => vectors::<1, A>(first, angles),
        2 => vectors::<2, A>(first, angles),
        _ => vectors::<IN_STEP, A>(first, angles),
    };
    for x in rest.chunks_mut(Vector::LANES) {
        vectors::<1, 0>(x, []);
    }
    sines
}

/// The same for what fits `X` vectors.
#[inline(always)]
fn vectors<const X: usize, const A: usize>(x: &mut [Neighbour], angles: [Vector; A]) -> [(Vector, Vector); A] {
    // One more of the same, not zero: a zero beside saturated numbers would have all of them computed.
    let padding = x.first().copied().unwrap_or(Neighbour(0.0));
    let mut filled = [[padding; Vector::LANES]; X];
    filled.as_flattened_mut()[..x.len()].copy_from_slice(x);
    let mut packs = [Vector::repeat(0.0); X];
    for n in 0..X {
        packs[n] = Pack::load(&filled[n]);
    }
    let (packs, sines) = tanh_and_sin_cos(packs, angles);
    for n in 0..X {
        packs[n].store(&mut filled[n]);
    }
    x.copy_from_slice(&filled.as_flattened()[..x.len()]);
    sines
}

impl Scalar for Neighbour {
    type Mask = bool;
    type Pack = Vector;
    const LANES: usize = 1;

    #[inline(always)]
    fn from_lanes(number: impl FnMut(usize) -> f64) -> Self {
        Self(f64::from_lanes(number))
    }
    #[inline(always)]
    fn lane(self, n: usize) -> f64 {
        self.0.lane(n)
    }
    #[inline(always)]
    fn compiled<K: Kernel>(kernel: K) -> K::Output {
        Vector::compiled(kernel)
    }
    #[inline(always)]
    fn splat(value: f64) -> Self {
        Self(value)
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = Scalar::sin_cos(self.0);
        (Self(sin), Self(cos))
    }
    #[inline(always)]
    fn tanh(self) -> Self {
        Self(Scalar::tanh(self.0))
    }
    #[inline(always)]
    fn tanh_and_sin_cos<const A: usize>(x: &mut [Self], angles: [Self; A], wanted: &[bool; A]) -> [(Self, Self); A] {
        let mut sines = [(Self(0.0), Self(0.0)); A];
        // The first of those wanted, in one vector.
        let (mut first, mut count) = ([Self(0.0); Vector::LANES], 0);
        for n in 0..A {
            if wanted[n] && count < Vector::LANES {
                first[count] = angles[n];
                count += 1;
            }
        }
        let first = <Vector as Pack<Self>>::load(&first);
        if count == 0 {
            with_sines(x, []);
            return sines;
        }
        let (sin, cos) = if IN_STEP == 1 || Vector::any(Vector::repeat(SIN_COS_LIMIT).less_than(first.abs())) {
            // Not a function that is called: the numbers would have to be kept in memory for it.
            with_sines(x, []);
            first.sin_cos()
        } else {
            with_sines(x, [first])[0]
        };
        let mut place = 0;
        for n in 0..A {
            if wanted[n] {
                if place < Vector::LANES {
                    sines[n] = (Self(sin.lane(place)), Self(cos.lane(place)));
                }
                place += 1;
            }
        }
        // Apart, so that it is no part of a module whose robots have no more angles than fit a vector.
        if place > Vector::LANES {
            place = 0;
            for n in 0..A {
                if wanted[n] {
                    if place >= Vector::LANES {
                        sines[n] = angles[n].sin_cos();
                    }
                    place += 1;
                }
            }
        }
        sines
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self(Scalar::abs(self.0))
    }
    #[inline(always)]
    fn less_than(self, other: Self) -> bool {
        self.0 < other.0
    }
    #[inline(always)]
    fn any(mask: bool) -> bool {
        mask
    }
    #[inline(always)]
    fn quadrant(self) -> (bool, bool, bool) {
        self.0.quadrant()
    }
    #[inline(always)]
    fn power_of_two(self) -> Self {
        Self(self.0.power_of_two())
    }
    #[inline(always)]
    fn select(mask: bool, if_true: Self, if_false: Self) -> Self {
        if mask { if_true } else { if_false }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn slices_keep_their_numbers(mut numbers in prop::collection::vec(any::<f64>(), 0..9)) {
            let before = numbers.clone();
            let bits = |numbers: &[f64]| numbers.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
            prop_assert_eq!(bits(Neighbour::plain(Neighbour::of(&numbers))), bits(&before));
            for number in Neighbour::of_mut(&mut numbers) {
                *number = -*number;
            }
            prop_assert_eq!(bits(&numbers), before.iter().map(|x| (-x).to_bits()).collect::<Vec<_>>());
        }

        #[test]
        fn each_neighbour_has_the_bits_that_it_has_alone(
            x in prop::array::uniform6(-30.0..30.0_f64),
            y in prop::array::uniform6(-30.0..30.0_f64),
        ) {
            struct Together([f64; 6], [f64; 6]);
            impl Kernel for Together {
                type Output = ([f64; 6], [f64; 6]);
                fn run(mut self) -> Self::Output {
                    let mut out = [0.0; 6];
                    let load = <Vector as Pack<Neighbour>>::load;
                    let (x, y) = (load(Neighbour::of(&self.0)), load(Neighbour::of(&self.1)));
                    let three = <Vector as Pack<Neighbour>>::repeat(Neighbour(3.0));
                    Pack::store(x * three + y - x * y, Neighbour::of_mut(&mut out));
                    Neighbour::tanh_and_sin_cos(Neighbour::of_mut(&mut self.0), [], &[]);
                    (out, self.0)
                }
            }
            // Without the instructions it is never used.
            if Neighbour::is_here() {
                let (out, tanh) = Neighbour::compiled(Together(x, y));
                for n in 0..Vector::LANES {
                    prop_assert_eq!(out[n].to_bits(), (x[n] * 3.0 + y[n] - x[n] * y[n]).to_bits());
                }
                prop_assert_eq!(out[Vector::LANES..].to_vec(), vec![0.0; 6 - Vector::LANES], "no more are written");
                prop_assert_eq!(tanh.map(f64::to_bits), x.map(|x| Scalar::tanh(x).to_bits()));
            }
        }
    }
}
