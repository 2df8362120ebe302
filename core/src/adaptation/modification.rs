//! Modifications that keep an adaptation law bounded where its assumptions fail: noise, disturbances, no excitation.
//!
//! Each changes the gradient that the law descends along, `Yᵀ s`, before the law's own gain multiplies it, so they go with every
//! law and with each other:
//! `Yᵀ s_Δ / (1 + ν ‖Y‖²_F) + (σ + κ ‖s‖₁) θ̂`, `s_Δ,i = s_i − clamp(s_i, −φ, φ)`.

use crate::regressor::gradient;
use crate::robots::{Regressor, Robot};
use crate::scalar::Scalar;
use nalgebra::SVector;

/// The modifications; what is `None` is not even computed.
#[derive(Debug, Clone, Copy)]
pub struct Modification<T> {
    /// σ of σ-modification: a pull to zero. Bounded estimates under any bounded disturbance, at the price of a bias even
    /// without one. Source: Ioannou and Kokotović (1983).
    pub sigma: Option<T>,
    /// κ of e-modification: the pull fades with the error, and with it the bias. Source: Narendra and Annaswamy (1987).
    pub e_modification: Option<T>,
    /// φ of the dead zone, rad/s: errors that a disturbance of known bound can cause do not move the estimates. Continuous,
    /// as Slotine and Coetsee (1986) have it.
    pub dead_zone: Option<T>,
    /// ν of normalisation: adaptation does not speed up with the size of the regressor. Source: Ioannou and Sun, *Robust
    /// Adaptive Control*, chapter 4.
    pub normalisation: Option<T>,
}

impl<T: Scalar> Modification<T> {
    /// The gradient as modified. Equation, source and assumptions: this file's head and fields.
    #[inline(always)]
    pub fn gradient<R: Robot<N, P>, const N: usize, const P: usize>(
        &self,
        y: &Regressor<T, N, P>,
        s: &SVector<T, N>,
        theta_hat: &[T],
    ) -> SVector<T, P> {
        let mut modified = match self.dead_zone {
            Some(width) => gradient::<R, T, N, P>(y, &beyond(s, width)),
            None => gradient::<R, T, N, P>(y, s),
        };
        if let Some(strength) = self.normalisation {
            let mut size = T::zero();
            for &entry in R::ENTRIES {
                size += y[entry] * y[entry];
            }
            modified *= T::one() / (T::one() + strength * size);
        }
        let leak = match (self.sigma, self.e_modification) {
            (Some(sigma), Some(e)) => Some(sigma + e * one_norm(s)),
            (Some(sigma), None) => Some(sigma),
            (None, Some(e)) => Some(e * one_norm(s)),
            (None, None) => None,
        };
        if let Some(leak) = leak {
            for k in 0..P {
                modified[k] += leak * theta_hat[k];
            }
        }
        modified
    }
}

/// `s_i − clamp(s_i, −width, width)`.
#[inline(always)]
fn beyond<T: Scalar, const N: usize>(s: &SVector<T, N>, width: T) -> SVector<T, N> {
    let mut rest = SVector::<T, N>::zeros();
    for i in 0..N {
        rest[i] = T::select(width.less_than(s[i].abs()), s[i] - width * s[i].sign(), T::zero());
    }
    rest
}

#[inline(always)]
fn one_norm<T: Scalar, const N: usize>(s: &SVector<T, N>) -> T {
    let mut sum = T::zero();
    for i in 0..N {
        sum += s[i].abs();
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robots::CrsA465;
    use nalgebra::Vector3;

    const NONE: Modification<f64> =
        Modification { sigma: None, e_modification: None, dead_zone: None, normalisation: None };

    fn regressor() -> Regressor<f64, 3, 18> {
        let v = |x: f64| Vector3::new(x, -0.7 * x, 0.4);
        CrsA465::regressor(&CrsA465::geometry(&v(1.1)), &v(0.3), &v(0.5), &v(-2.0), &v(1.0))
    }

    fn modified(modification: Modification<f64>, s: &Vector3<f64>, theta_hat: &[f64]) -> SVector<f64, 18> {
        modification.gradient::<CrsA465, 3, 18>(&regressor(), s, theta_hat)
    }

    /// Under a constant gradient the estimates settle where the pull balances it: θ̂ = −Yᵀ s / σ.
    #[test]
    fn sigma_modification_settles_at_its_fixed_point() {
        let (s, sigma, gain) = (Vector3::new(0.2, -0.1, 0.3), 0.5, 0.3);
        let pull = Modification { sigma: Some(sigma), ..NONE };
        let mut theta_hat = [1.0; 18];
        for _ in 0..2000 {
            let g = modified(pull, &s, &theta_hat);
            (0..18).for_each(|k| theta_hat[k] -= gain * g[k]);
        }
        let plain = regressor().transpose() * s;
        assert!((0..18).all(|k| (theta_hat[k] + plain[k] / sigma).abs() < 1e-12), "{theta_hat:?}");
    }

    /// The pull of e-modification is σ-modification's with σ = κ ‖s‖₁: none where nothing is wrong.
    #[test]
    fn e_modification_pulls_as_hard_as_the_error_is_large() {
        let s = Vector3::new(0.2, -0.1, 0.3);
        let theta_hat: [f64; 18] = std::array::from_fn(|k| k as f64);
        let e = Modification { e_modification: Some(2.0), ..NONE };
        let sigma = Modification { sigma: Some(2.0 * (0.2 + 0.1 + 0.3)), ..NONE };
        assert!((modified(e, &s, &theta_hat) - modified(sigma, &s, &theta_hat)).amax() < 1e-12);
        assert_eq!(modified(e, &Vector3::zeros(), &theta_hat).amax(), 0.0);
    }

    #[test]
    fn the_dead_zone_is_dead_inside_and_continuous_at_its_edge() {
        let zone = Modification { dead_zone: Some(0.1), ..NONE };
        assert_eq!(modified(zone, &Vector3::new(0.1, -0.05, 0.0), &[0.0; 18]).amax(), 0.0);
        let outside = modified(zone, &Vector3::new(0.1 + 1e-9, -0.4, 0.0), &[0.0; 18]);
        let expected = regressor().transpose() * Vector3::new(1e-9, -0.3, 0.0);
        assert!((outside - expected).amax() < 1e-12);
    }

    /// However large the regressor: `‖Yᵀ s‖ / (1 + ν ‖Y‖²) ≤ ‖s‖ / (2 √ν)`.
    #[test]
    fn normalisation_bounds_the_gradient() {
        let (s, nu) = (Vector3::new(0.2, -0.1, 0.3), 0.3);
        let normalised = Modification { normalisation: Some(nu), ..NONE };
        for scale in [1e-3, 0.1, 1.0, 10.0, 1e4] {
            let y = regressor() * scale;
            let g = normalised.gradient::<CrsA465, 3, 18>(&y, &s, &[0.0; 18]);
            assert!((g - y.transpose() * s / (1.0 + nu * y.norm_squared())).amax() < 1e-12 * scale);
            assert!(g.norm() <= s.norm() / (2.0 * nu.sqrt()) * (1.0 + 1e-12));
        }
    }

    #[test]
    fn nothing_modified_is_the_gradient_itself() {
        let s = Vector3::new(0.2, -0.1, 0.3);
        assert_eq!(modified(NONE, &s, &[1.0; 18]), gradient::<CrsA465, f64, 3, 18>(&regressor(), &s));
    }
}
