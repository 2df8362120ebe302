//! Smooth projection that keeps estimates within bounds: f_b of paper eq. (19), (20).
//!
//! `f_b,i = ±ρ δ_i |β w_i + (Yᵀ s)_i|`, minus below the lower bound and plus above the upper one. δ rises from 0 at a
//! bound to 1 at the end of its margin and stays at 1 beyond, where the paper's eq. (20) leaves it undefined.

use crate::scalar::{Pack, Scalar};
use nalgebra::SVector;
use num_traits::Zero;

/// Bounds and strength of the projection.
#[derive(Debug, Clone, Copy)]
pub struct Projection<T, const P: usize> {
    /// ρ > 1.
    pub strength: T,
    /// θ2, where the lower margin starts.
    pub lower: SVector<T, P>,
    /// Width of the lower margin, θ2 − θ1.
    pub lower_margin: SVector<T, P>,
    /// θ3, where the upper margin starts.
    pub upper: SVector<T, P>,
    /// Width of the upper margin, θ4 − θ3.
    pub upper_margin: SVector<T, P>,
}

impl<T: Scalar, const P: usize> Projection<T, P> {
    /// Bounds from nominal values θo, `[soft, hard]` factors of them and the margin at zero: `[0, soft θo]` as in the paper where
    /// θo > 0, mirrored to `[soft θo, 0]` where θo < 0, and where θo = 0 says neither sign nor size, `±soft` SI units. The
    /// margin at zero is the one given, the other `(hard − soft) |θo|`. Source: paper eq. (20) for θo > 0; the rest chosen.
    pub fn around(nominal: impl Fn(usize) -> f64, strength: T, margin_at_zero: T, [soft, hard]: [T; 2]) -> Self {
        let far_margin = hard - soft;
        let mut bounds = Self {
            strength,
            lower: SVector::zeros(),
            lower_margin: SVector::from_element(margin_at_zero),
            upper: SVector::zeros(),
            upper_margin: SVector::from_element(margin_at_zero),
        };
        for k in 0..P {
            let value = nominal(k);
            let size = T::splat(if value == 0.0 { 1.0 } else { f64::abs(value) });
            if value >= 0.0 {
                bounds.upper[k] = soft * size;
                bounds.upper_margin[k] = far_margin * size;
            }
            if value <= 0.0 {
                bounds.lower[k] = -(soft * size);
                bounds.lower_margin[k] = far_margin * size;
            }
        }
        bounds
    }

    /// `f_b` for the estimates θ̂ from the `i`th on that a pack `S` holds, driven by `drive = β w + Yᵀ s`.
    /// Source: paper eq. (19), (20).
    #[inline(always)]
    pub fn correction<S: Scalar + Pack<T>>(&self, i: usize, theta_hat: S, drive: S) -> S {
        let from = |bounds: &SVector<T, P>| <S as Pack<T>>::load(&bounds.as_slice()[i..]);
        let (below, above) = (from(&self.lower) - theta_hat, theta_hat - from(&self.upper));
        // Where estimates are nearly always, it takes no division; where one is beyond a bound, one per side.
        let zero = <S as Zero>::zero();
        let (is_below, is_above) = (S::any(zero.less_than(below)), S::any(zero.less_than(above)));
        if !is_below && !is_above {
            return zero;
        }
        let upper = if is_above { fraction(above, from(&self.upper_margin)) } else { zero };
        let lower = if is_below { fraction(below, from(&self.lower_margin)) } else { zero };
        (upper - lower) * <S as Pack<T>>::repeat(self.strength) * drive.abs()
    }
}

/// δ: how deep into a margin, as a share of its width between 0 and 1.
#[inline(always)]
fn fraction<T: Scalar>(depth: T, width: T) -> T {
    let (zero, one) = (T::zero(), T::one());
    let share = depth / width;
    T::select(zero.less_than(depth), T::select(share.less_than(one), share, one), zero)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Paper's bounds for a parameter whose true value is 1: margins [−1e-4, 0] and [10, 10.1].
    fn projection() -> Projection<f64, 1> {
        Projection {
            strength: 2.5,
            lower: SVector::from([0.0]),
            lower_margin: SVector::from([1e-4]),
            upper: SVector::from([10.0]),
            upper_margin: SVector::from([0.1]),
        }
    }

    #[test]
    fn bounds_keep_a_meaning_whatever_the_nominal_value() {
        let p = Projection::<f64, 3>::around(|k| [2.0, -2.0, 0.0][k], 2.5, 1e-4, [10.0, 10.5]);
        assert_eq!(p.lower, SVector::from([0.0, -20.0, -10.0]));
        assert_eq!(p.upper, SVector::from([20.0, 0.0, 10.0]));
        assert_eq!(p.lower_margin, SVector::from([1e-4, 1.0, 0.5]));
        assert_eq!(p.upper_margin, SVector::from([1.0, 1e-4, 0.5]));
        for (k, inside) in [(0, 3.0), (1, -3.0), (2, 3.0), (2, -3.0)] {
            assert_eq!(p.correction::<f64>(k, inside, 1.0), 0.0);
            assert_eq!((p.correction::<f64>(k, 99.0, 1.0), p.correction::<f64>(k, -99.0, 1.0)), (2.5, -2.5));
        }
    }

    #[test]
    fn is_zero_inside_and_saturates_outside() {
        let p = projection();
        for (theta, drive, expected) in [
            (0.0, -3.0, 0.0),
            (5.0, -3.0, 0.0),
            (10.0, 3.0, 0.0),
            (-0.5e-4, 2.0, -2.5),
            (-1.0, 2.0, -5.0),
            (10.05, -2.0, 2.5),
            (99.0, -2.0, 5.0),
        ] {
            let correction = p.correction::<f64>(0, theta, drive);
            assert!((correction - expected).abs() < 1e-9, "θ̂ = {theta}: {correction} instead of {expected}");
        }
    }

    /// Four parameters of which each in turn is beyond a bound: the others in its vector have the bits that they have alone.
    #[cfg(any(target_arch = "x86_64", all(target_arch = "wasm32", target_feature = "simd128")))]
    #[test]
    fn one_parameter_beyond_its_bounds_leaves_its_neighbours_alone() {
        use crate::lanes::Neighbour;
        use crate::scalar::Kernel;
        type Vector = <Neighbour as Scalar>::Pack;

        struct OneBeyond;

        impl Kernel for OneBeyond {
            type Output = ();

            fn run(self) {
                let numbers = |numbers: [f64; 4]| numbers.map(Neighbour::splat);
                let [strength, margin, soft, hard] = numbers([2.5, 1e-4, 10.0, 10.5]);
                let nominal = |k: usize| [2.0, -2.0, 0.0, 5.0][k];
                let p = Projection::<_, 4>::around(nominal, strength, margin, [soft, hard]);
                let drive = numbers([3.0, -4.0, 5.0, -6.0]);
                for (beyond, by) in [(0, -1.0), (1, -20.5), (2, 10.25), (3, 51.0)] {
                    let mut theta_hat = numbers([1.0, -1.0, 0.5, 2.0]);
                    theta_hat[beyond] = Neighbour::splat(by);
                    let mut together = numbers([1.0; 4]);
                    for from in (0..4).step_by(<Vector as Pack<Neighbour>>::WIDTH) {
                        let load = |numbers: &[Neighbour; 4]| <Vector as Pack<Neighbour>>::load(&numbers[from..]);
                        p.correction(from, load(&theta_hat), load(&drive)).store(&mut together[from..]);
                    }
                    for k in 0..4 {
                        let alone = p.correction::<Neighbour>(k, theta_hat[k], drive[k]).lane(0);
                        assert_eq!(together[k].lane(0).to_bits(), alone.to_bits(), "θ̂{k}, {beyond} beyond");
                        assert_eq!(alone != 0.0, k == beyond, "θ̂{k}, {beyond} beyond");
                    }
                }
            }
        }

        // Without the instructions it is never used.
        if Neighbour::is_here() {
            Neighbour::compiled(OneBeyond);
        }
    }
}
