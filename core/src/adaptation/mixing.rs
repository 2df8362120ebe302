//! Dynamic regressor extension and mixing: a scalar equation for each parameter, so that each error fades on its own.
//!
//! The extension is the composite laws' memory, `Z' = −λ Z + Yfᵀ Yf`, `w = Z θ̃` (Kreisselmeier 1977); mixing multiplies by the adjugate:
//! `adj(Z) w = Δ θ̃`, `Δ = det Z`. Then `θ̂_i' = −r Δ (adj(Z) w)_i / (φ^{2P} + Δ²)`, that is `θ̃_i' = −r Δ² / (φ^{2P} + Δ²) θ̃_i`: without
//! noise no parameter error ever grows. Source: Aranovskiy, Bobtsov, Ortega and Pyrkin (2017), with a normalised gain. Chosen: Z is taken
//! in relative parameters and divided by its mean eigenvalue, so that `Δ^{1/P}`, their geometric mean, is 1 where all directions are
//! excited alike, and φ is the value of it at which learning is half as fast.

use crate::dynamics::factorize;
use crate::scalar::{Scalar, power};
use nalgebra::{SMatrix, SVector};

/// The law's constants.
#[derive(Debug, Clone, Copy)]
pub struct Mixing<const P: usize> {
    /// r, 1/s.
    rate: f64,
    /// `φ^{2P}`.
    floor: f64,
    /// Sizes of the parameters.
    scale: SVector<f64, P>,
}

impl<const P: usize> Mixing<P> {
    /// With rate r (1/s), excitation floor φ between 0 and 1, and the sizes of the parameters.
    pub fn new(rate: f64, excitation_floor: f64, scale: SVector<f64, P>) -> Self {
        // A floor that underflows must still keep 0/0 away.
        let floor = power(excitation_floor, 2.0 * P as f64).max(f64::MIN_POSITIVE);
        Self { rate, floor, scale }
    }

    /// `θ̂'` for a memory: `w(k)` and `z(i, j)` are numbers of w and Z. Apart from the loops that it stands in, which seldom need it.
    #[cold]
    pub(super) fn theta_hat_rate<T: Scalar>(
        &self,
        w: impl Fn(usize) -> T,
        z: impl Fn(usize, usize) -> T,
        rate: &mut [T],
    ) {
        let mut lanes = [SVector::<f64, P>::zeros(); 16];
        for (lane, found) in lanes.iter_mut().enumerate().take(T::LANES) {
            let matrix = SMatrix::<f64, P, P>::from_fn(|i, j| z(i, j).lane(lane));
            *found = self.of_one(matrix, SVector::from_fn(|k, _| w(k).lane(lane)));
        }
        for k in 0..P {
            rate[k] = T::from_lanes(|lane| lanes[lane.min(15)][k]);
        }
    }

    #[inline(never)]
    fn of_one(&self, mut z: SMatrix<f64, P, P>, mut w: SVector<f64, P>) -> SVector<f64, P> {
        let mut mean = 0.0;
        for i in 0..P {
            w[i] *= self.scale[i];
            for j in 0..P {
                z[(i, j)] *= self.scale[i] * self.scale[j];
            }
            mean += z[(i, i)] / P as f64;
        }
        if mean <= 0.0 {
            return SVector::zeros();
        }
        let factors = factorize(&(z / mean), &[[true; P]; P]);
        // A matrix that rounding keeps from being positive has no excitation to speak of.
        if !factors.pivots.iter().all(|pivot| *pivot > 0.0) {
            return SVector::zeros();
        }
        let square = factors.pivots.iter().fold(1.0, |product, pivot| product * pivot * pivot);
        let error = factors.solve(w / mean);
        error.component_mul(&self.scale) * (-self.rate * (square / (self.floor + square)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Matrix4, Vector4};
    use proptest::prelude::*;

    proptest! {
        /// Against determinants of minors: `adj(Z) w` by Cramer's rule, column by column.
        #[test]
        fn mixing_is_the_adjugate(numbers in prop::collection::vec(-2.0..2.0, 32), floor in 0.01..0.9) {
            let root = Matrix4::from_column_slice(&numbers[..16]);
            let (z, w) = (root.transpose() * root, Vector4::from_column_slice(&numbers[16..20]));
            let scale = Vector4::from_fn(|k, _| 0.2 + f64::abs(numbers[20 + k]));
            let s = Matrix4::from_diagonal(&scale);
            let mean = (s * z * s).trace() / 4.0;
            prop_assume!(mean > 0.1);
            let (relative, right) = (s * z * s / mean, s * w / mean);
            let det = relative.determinant();
            let floor_8 = (0..8).fold(1.0, |product, _| product * floor);
            prop_assume!(det > 1e-6);
            let mixed = Vector4::from_fn(|k, _| {
                let mut column = relative;
                column.set_column(k, &right);
                column.determinant()
            });
            let expected = s * mixed * (-3.0 * det / (floor_8 + det * det));
            let found = Mixing::<4>::new(3.0, floor, scale).of_one(z, w);
            prop_assert!((found - expected).amax() < 1e-8 * (1.0 + expected.amax()), "{found} for {expected}");
        }
    }

    #[test]
    fn without_excitation_nothing_moves() {
        let mixing = Mixing::<2>::new(1.0, 1e-3, SVector::repeat(1.0));
        assert_eq!(mixing.of_one(SMatrix::zeros(), SVector::zeros()), SVector::<f64, 2>::zeros());
        let mut rate = [9.0; 2];
        mixing.theta_hat_rate(|_| 1.0, |_, _| 1.0, &mut rate);
        assert_eq!(rate, [0.0; 2], "of a singular memory nothing is learned");
    }
}
