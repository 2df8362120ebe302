//! The normal and Student's distribution: what confidence intervals and random draws need of them.

use crate::scalar::{complementary_error, exponential, log_gamma, logarithm};
use std::f64::consts::{PI, SQRT_2};

/// `Φ(x)`: how probable a standard normal number below `x` is.
pub(super) fn normal_cdf(x: f64) -> f64 {
    0.5 * complementary_error(-x / SQRT_2)
}

/// `Φ⁻¹(p)` for p in (0, 1): a rational start (Abramowitz and Stegun 26.2.23), then Halley's steps to the last digits.
pub(super) fn normal_quantile(p: f64) -> f64 {
    // The lower half only: there erfc loses nothing.
    if p > 0.5 {
        return -normal_quantile(1.0 - p);
    }
    let t = (-2.0 * logarithm(p)).sqrt();
    let tail =
        (2.515_517 + t * (0.802_853 + t * 0.010_328)) / (1.0 + t * (1.432_788 + t * (0.189_269 + t * 0.001_308)));
    let mut x = tail - t;
    for _ in 0..3 {
        let density = exponential(-0.5 * x * x) / (2.0 * PI).sqrt();
        let u = (normal_cdf(x) - p) / density;
        x -= u / (1.0 + 0.5 * x * u);
    }
    x
}

/// `t` with `P(|T| ≤ t) = level` for Student's T of `freedom` ≥ 1 degrees; `level` in (0, 1).
pub(super) fn student_t(level: f64, freedom: f64) -> f64 {
    let outside = 1.0 - level;
    // P(|T| > t) is the regularised incomplete beta function at ν / (ν + t²), which falls with t.
    let excess = |t: f64| incomplete_beta(0.5 * freedom, 0.5, freedom / (freedom + t * t)) - outside;
    let (mut low, mut high) = (0.0, 1.0);
    while excess(high) > 0.0 && high < 1e12 {
        high *= 2.0;
    }
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if excess(middle) > 0.0 { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// Regularised incomplete beta function `I_x(a, b)`, by its continued fraction (DLMF 8.17.22).
fn incomplete_beta(a: f64, b: f64, x: f64) -> f64 {
    if x <= 0.0 || x >= 1.0 {
        return if x <= 0.0 { 0.0 } else { 1.0 };
    }
    // The fraction converges fast below the mean; above it the mirrored one does.
    if x > (a + 1.0) / (a + b + 2.0) {
        return 1.0 - incomplete_beta(b, a, 1.0 - x);
    }
    let front = log_gamma(a + b) - log_gamma(a) - log_gamma(b) + a * logarithm(x) + b * logarithm(1.0 - x);
    exponential(front) / (a * fraction(a, b, x))
}

/// `1 + d₁/(1 + d₂/(1 + …))`, from its far end: 300 terms are plenty below the mean for the degrees that occur.
fn fraction(a: f64, b: f64, x: f64) -> f64 {
    let mut value = 1.0;
    for n in (1..=300_u32).rev() {
        let m = f64::from(n / 2);
        let d = if n % 2 == 0 {
            m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m))
        } else {
            -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0))
        };
        value = 1.0 + d / value;
    }
    value
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(a: f64, b: f64, tolerance: f64) {
        assert!((a - b).abs() <= tolerance * b.abs().max(1e-300), "{a} is not {b}");
    }

    #[test]
    fn quantile_inverts_the_distribution() {
        for p in [1e-300, 1e-20, 1e-6, 0.025, 0.3, 0.5, 0.8, 0.975] {
            close(normal_cdf(normal_quantile(p)), p, 1e-13 * normal_quantile(p).abs().max(1.0).powi(2));
        }
        // Tables.
        close(normal_quantile(0.975), 1.959_963_984_540_054, 1e-14);
        close(normal_quantile(0.999), 3.090_232_306_167_813_5, 1e-14);
    }

    #[test]
    fn students_t_is_as_tabulated() {
        // With one degree of freedom T is a tangent, with two an algebraic function.
        close(student_t(0.5, 1.0), 1.0, 1e-12);
        close(student_t(0.95, 1.0), (0.475 * PI).tan(), 1e-10);
        close(student_t(0.9, 2.0), (2.0 * 0.81 / (1.0 - 0.81_f64)).sqrt(), 1e-10);
        close(student_t(0.95, 10.0), 2.228_138_852, 1e-9);
        close(student_t(0.99, 30.0), 2.749_995_654, 1e-9);
        close(student_t(0.95, 1e6), 1.959_966_357, 1e-8);
    }
}
