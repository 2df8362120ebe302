//! What a random field may be: uniform, log-uniform, normal and lognormal, the last two truncated if wished.
//!
//! A draw is the quantile of a number of (0, 1), so that one random number makes one value, whatever the distribution.

use super::limits::check_range;
use super::normal::{normal_cdf, normal_quantile};
use crate::scalar::{exponential, logarithm};
use crate::scenario::{Problem, ScenarioError};
use serde::{Deserialize, Serialize};

/// A distribution as written. One struct for all kinds, so that a mistake in it is found at its place.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct DistributionDocument {
    /// Which.
    pub kind: DistributionKind,
    /// Mean of a normal distribution.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mean: Option<f64>,
    /// Standard deviation of a normal distribution (before it is truncated).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sd: Option<f64>,
    /// Median of a lognormal distribution.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub median: Option<f64>,
    /// Standard deviation of the logarithm of a lognormal one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub log_sd: Option<f64>,
    /// Least value; normal and lognormal ones are cut there.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub min: Option<f64>,
    /// Greatest value.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max: Option<f64>,
}

/// Kind of a distribution.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum DistributionKind {
    /// Evenly between `min` and `max`.
    Uniform,
    /// Evenly in the logarithm between `min` and `max`.
    LogUniform,
    /// `mean` and `sd`; `min` and `max` truncate it.
    Normal,
    /// `median` and `log_sd`; `min` and `max` truncate it.
    Lognormal,
}

/// A distribution that has been checked.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Distribution {
    shape: Shape,
    /// Of the value, or of its logarithm.
    low: f64,
    high: f64,
    logarithmic: bool,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Shape {
    Even,
    Normal { mean: f64, sd: f64 },
}

/// Magnitudes that a distribution may speak of.
const LARGEST: f64 = 1e12;
const SMALLEST: f64 = 1e-12;
/// The part that truncation leaves must be at least this probable.
const LEAST_LEFT: f64 = 1e-9;

impl Distribution {
    /// Checks a document that stands at `pointer`.
    pub fn new(document: &DistributionDocument, pointer: &str) -> Result<Self, ScenarioError> {
        let DistributionDocument { kind, mean, sd, median, log_sd, min, max } = document;
        let given = [("mean", mean), ("sd", sd), ("median", median), ("log_sd", log_sd), ("min", min), ("max", max)];
        let (needed, allowed, logarithmic): (&[&str], &[&str], bool) = match kind {
            DistributionKind::Uniform => (&["min", "max"], &[], false),
            DistributionKind::LogUniform => (&["min", "max"], &[], true),
            DistributionKind::Normal => (&["mean", "sd"], &["min", "max"], false),
            DistributionKind::Lognormal => (&["median", "log_sd"], &["min", "max"], true),
        };
        for (name, value) in given {
            let at = format!("{pointer}/{name}");
            let conflict = |message: String| Err(ScenarioError::new(at.clone(), Problem::Conflict { message }));
            match value {
                None if needed.contains(&name) => {
                    return conflict(format!("missing; this distribution needs {}", needed.join(" and ")));
                }
                Some(_) if !needed.contains(&name) && !allowed.contains(&name) => {
                    let all = [needed, allowed].concat().join(", ");
                    return conflict(format!("has no meaning for this distribution, whose numbers are {all}"));
                }
                Some(value) => {
                    let positive = name.ends_with("sd") || logarithmic;
                    let least = if positive { SMALLEST } else { -LARGEST };
                    check_range(&at, *value, [least, if name == "log_sd" { 10.0 } else { LARGEST }], "")?;
                }
                None => {}
            }
        }
        let inner = |x: f64| if logarithmic { logarithm(x) } else { x };
        let low = min.map_or(f64::NEG_INFINITY, inner);
        let high = max.map_or(f64::INFINITY, inner);
        if low >= high {
            let message = "must be above min".to_owned();
            return Err(ScenarioError::new(format!("{pointer}/max"), Problem::Conflict { message }));
        }
        let shape = match (mean.or(median.map(inner)), sd.or(*log_sd)) {
            (Some(mean), Some(sd)) => Shape::Normal { mean, sd },
            _ => Shape::Even,
        };
        let distribution = Self { shape, low, high, logarithmic };
        if let Shape::Normal { mean, sd } = shape {
            let left = distribution.mirrored(mean, sd).map_or(0.0, |(a, b, _)| normal_cdf(b) - normal_cdf(a));
            if left < LEAST_LEFT {
                let message = "leaves nothing of the distribution between min and max".to_owned();
                return Err(ScenarioError::new(pointer, Problem::Conflict { message }));
            }
        }
        Ok(distribution)
    }

    /// The limits in standard deviations, mirrored to the left side where the distribution function is exact; and the sign.
    fn mirrored(&self, mean: f64, sd: f64) -> Option<(f64, f64, f64)> {
        let (a, b) = ((self.low - mean) / sd, (self.high - mean) / sd);
        // So narrow a range that it is a point next to the standard deviation is none.
        (a < b).then_some(if a > 0.0 { (-b, -a, -1.0) } else { (a, b, 1.0) })
    }

    /// The value below which a share `u` in (0, 1) of all values lies.
    pub fn quantile(&self, u: f64) -> f64 {
        let x = match self.shape {
            Shape::Even => self.low + u * (self.high - self.low),
            Shape::Normal { mean, sd } => {
                let (a, b, sign) = self.mirrored(mean, sd).unwrap_or((0.0, 0.0, 1.0));
                let u = if sign < 0.0 { 1.0 - u } else { u };
                let (from, to) = (normal_cdf(a), normal_cdf(b));
                // The rounding of a share next to 1 must not make infinity of it.
                let share = (from + u * (to - from)).clamp(f64::MIN_POSITIVE, 1.0 - f64::EPSILON / 2.0);
                mean + sign * sd * normal_quantile(share)
            }
        };
        let x = x.clamp(self.low, self.high);
        if self.logarithmic { exponential(x) } else { x }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiments::stream::{Purpose, Stream};

    fn draws(document: &DistributionDocument) -> Vec<f64> {
        let distribution = Distribution::new(document, "").unwrap();
        (0..40_000).map(|n| distribution.quantile(Stream::new(9, Purpose::Draw, n).unit())).collect()
    }

    fn none(kind: DistributionKind) -> DistributionDocument {
        DistributionDocument { kind, mean: None, sd: None, median: None, log_sd: None, min: None, max: None }
    }

    /// Mean and variance within five standard errors, both of which are asked for.
    fn moments(values: &[f64], mean: f64, variance: f64) {
        let n = values.len() as f64;
        let found = values.iter().sum::<f64>() / n;
        let squares: Vec<_> = values.iter().map(|x| (x - found).powi(2)).collect();
        let spread = squares.iter().sum::<f64>() / n;
        let fourth = squares.iter().map(|s| (s - spread).powi(2)).sum::<f64>() / n;
        assert!((found - mean).abs() < 5.0 * (variance / n).sqrt(), "mean {found}, not {mean}");
        assert!((spread - variance).abs() < 5.0 * (fourth / n).sqrt(), "variance {spread}, not {variance}");
    }

    #[test]
    fn draws_have_the_moments_of_their_distribution() {
        let uniform = DistributionDocument { min: Some(-1.0), max: Some(3.0), ..none(DistributionKind::Uniform) };
        moments(&draws(&uniform), 1.0, 16.0 / 12.0);
        let log_uniform =
            DistributionDocument { min: Some(0.1), max: Some(10.0), ..none(DistributionKind::LogUniform) };
        let width = 100_f64.ln();
        let mean = 9.9 / width;
        moments(&draws(&log_uniform), mean, (100.0 - 0.01) / (2.0 * width) - mean * mean);
        let normal = DistributionDocument { mean: Some(2.0), sd: Some(0.5), ..none(DistributionKind::Normal) };
        moments(&draws(&normal), 2.0, 0.25);
        let lognormal =
            DistributionDocument { median: Some(2.0), log_sd: Some(0.3), ..none(DistributionKind::Lognormal) };
        let square = 0.09_f64.exp();
        moments(&draws(&lognormal), 2.0 * square.sqrt(), 4.0 * square * (square - 1.0));
        // A half normal distribution, from either side.
        let half = DistributionDocument { mean: Some(0.0), sd: Some(1.0), ..none(DistributionKind::Normal) };
        let mean = (2.0 / std::f64::consts::PI).sqrt();
        moments(&draws(&DistributionDocument { min: Some(0.0), ..half.clone() }), mean, 1.0 - mean * mean);
        moments(&draws(&DistributionDocument { max: Some(0.0), ..half }), -mean, 1.0 - mean * mean);
    }

    #[test]
    fn truncation_far_in_a_tail_stays_exact() {
        let tail =
            DistributionDocument { mean: Some(0.0), sd: Some(1.0), min: Some(5.0), ..none(DistributionKind::Normal) };
        let draws = draws(&tail);
        assert!(draws.iter().all(|x| (5.0..9.0).contains(x)));
        // Mills' ratio: the mean of the tail is the density over the tail's probability.
        let density = (-12.5_f64).exp() / (2.0 * std::f64::consts::PI).sqrt();
        let mean = density / normal_cdf(-5.0);
        let found = draws.iter().sum::<f64>() / draws.len() as f64;
        assert!((found - mean).abs() < 0.005, "{found}, not {mean}");
    }

    #[test]
    fn mistakes_are_named() {
        let error = |document: &DistributionDocument| Distribution::new(document, "/d").unwrap_err().to_string();
        assert_eq!(error(&none(DistributionKind::Normal)), "d.mean: missing; this distribution needs mean and sd");
        let stray =
            DistributionDocument { min: Some(1.0), max: Some(2.0), sd: Some(1.0), ..none(DistributionKind::Uniform) };
        assert!(error(&stray).starts_with("d.sd: has no meaning"));
        let empty = DistributionDocument { min: Some(2.0), max: Some(2.0), ..none(DistributionKind::Uniform) };
        assert_eq!(error(&empty), "d.max: must be above min");
        let negative = DistributionDocument { min: Some(-2.0), max: Some(2.0), ..none(DistributionKind::LogUniform) };
        assert!(error(&negative).contains("-2 is outside the allowed range"));
        let nothing =
            DistributionDocument { mean: Some(0.0), sd: Some(1.0), min: Some(9.0), ..none(DistributionKind::Normal) };
        assert!(error(&nothing).contains("leaves nothing"));
    }
}
