//! What a column of numbers says: mean with its interval, spread, quantiles; shares; correlation of ranks.

use super::normal::{normal_quantile, student_t};
use serde::{Deserialize, Serialize};

/// Statistics of the numbers that there are.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Statistics {
    /// Numbers.
    pub count: usize,
    /// Mean.
    pub mean: f64,
    /// Confidence interval of the mean, by Student's distribution; absent for one number.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mean_interval: Option<[f64; 2]>,
    /// Standard deviation of the sample; absent for one number.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sd: Option<f64>,
    /// Smallest.
    pub min: f64,
    /// Quantile 5 %.
    pub p05: f64,
    /// Lower quartile.
    pub p25: f64,
    /// Median.
    pub p50: f64,
    /// Upper quartile.
    pub p75: f64,
    /// Quantile 95 %.
    pub p95: f64,
    /// Largest.
    pub max: f64,
}

/// A share with its interval.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Share {
    /// Of how many it is true.
    pub count: usize,
    /// Of how many it could be.
    pub of: usize,
    /// Their quotient.
    pub share: f64,
    /// Confidence interval. Source: Wilson (1927).
    pub interval: [f64; 2],
}

impl Statistics {
    /// Of these numbers, in this order; nothing of none.
    pub fn of(values: &[f64], confidence: f64) -> Option<Self> {
        let count = values.len();
        let mut sorted = values.to_vec();
        sorted.sort_by(f64::total_cmp);
        let (min, max) = (*sorted.first()?, *sorted.last()?);
        let n = count as f64;
        let mean = values.iter().sum::<f64>() / n;
        let sd = (count > 1).then(|| (values.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / (n - 1.0)).sqrt());
        let mean_interval = sd.map(|sd| {
            let half = student_t(confidence, n - 1.0) * sd / n.sqrt();
            [mean - half, mean + half]
        });
        let [p05, p25, p50, p75, p95] = [0.05, 0.25, 0.5, 0.75, 0.95].map(|share| quantile(&sorted, share));
        Some(Self { count, mean, mean_interval, sd, min, p05, p25, p50, p75, p95, max })
    }
}

/// The value below which a share of sorted numbers lies, linear between them (Hyndman and Fan's type 7). There is one number.
pub(crate) fn quantile(sorted: &[f64], share: f64) -> f64 {
    let place = share * (sorted.len() - 1) as f64;
    let below = place.floor() as usize;
    let above = (below + 1).min(sorted.len() - 1);
    sorted[below] + (place - below as f64) * (sorted[above] - sorted[below])
}

impl Share {
    /// `count` of `of`, which is positive.
    pub fn new(count: usize, of: usize, confidence: f64) -> Self {
        let (n, share) = (of as f64, count as f64 / of as f64);
        let z = normal_quantile(0.5 + 0.5 * confidence);
        let center = (share + z * z / (2.0 * n)) / (1.0 + z * z / n);
        let half = z / (1.0 + z * z / n) * (share * (1.0 - share) / n + z * z / (4.0 * n * n)).sqrt();
        // Exact where rounding would leave a trace of nothing.
        let low = if count == 0 { 0.0 } else { center - half };
        let high = if count == of { 1.0 } else { center + half };
        let interval = [low, high];
        Self { count, of, share, interval }
    }
}

/// Ranks from 1, the smallest first; equal numbers share the mean of theirs. Infinity is worst, however often.
pub(super) fn ranks(values: &[f64]) -> Vec<f64> {
    let mut order: Vec<_> = (0..values.len()).collect();
    order.sort_by(|a, b| values[*a].total_cmp(&values[*b]));
    let mut ranks = vec![0.0; values.len()];
    let mut start = 0;
    while start < order.len() {
        let same = order[start..].iter().take_while(|n| values[**n] == values[order[start]]).count();
        for n in &order[start..start + same] {
            ranks[*n] = start as f64 + 0.5 * (same as f64 + 1.0);
        }
        start += same;
    }
    ranks
}

/// Spearman's correlation of ranks; nothing where one side is constant.
pub(super) fn rank_correlation(x: &[f64], y: &[f64]) -> Option<f64> {
    let (x, y) = (ranks(x), ranks(y));
    let middle = 0.5 * (x.len() as f64 + 1.0);
    let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - middle) * (b - middle)).sum::<f64>();
    let scale = (product(&x, &x) * product(&y, &y)).sqrt();
    (scale > 0.0).then(|| product(&x, &y) / scale)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn statistics_of_known_numbers() {
        let statistics = Statistics::of(&[4.0, 1.0, 3.0, 2.0, 5.0], 0.95).unwrap();
        assert_eq!((statistics.mean, statistics.min, statistics.max), (3.0, 1.0, 5.0));
        assert_eq!((statistics.p25, statistics.p50, statistics.p95), (2.0, 3.0, 4.8));
        let (sd, half) = (2.5_f64.sqrt(), 2.776_445_105 * 2.5_f64.sqrt() / 5.0_f64.sqrt());
        assert!((statistics.sd.unwrap() - sd).abs() < 1e-12);
        assert!((statistics.mean_interval.unwrap()[1] - 3.0 - half).abs() < 1e-8);
        assert_eq!(Statistics::of(&[], 0.95), None);
        assert_eq!(Statistics::of(&[7.0], 0.95).unwrap().mean_interval, None);
    }

    #[test]
    fn wilsons_interval_is_as_published() {
        assert_eq!(Share::new(0, 10_000, 0.95).interval[0], 0.0);
        let none = Share::new(0, 10, 0.95);
        assert!(none.interval[0] == 0.0 && (none.interval[1] - 0.277_5).abs() < 1e-4, "{none:?}");
        let half = Share::new(5, 10, 0.95);
        assert!((half.interval[0] - 0.2366).abs() < 1e-4 && (half.interval[1] - 0.7634).abs() < 1e-4, "{half:?}");
    }

    #[test]
    fn ranks_share_ties_and_correlate() {
        assert_eq!(ranks(&[3.0, 1.0, 3.0, f64::INFINITY]), [2.5, 1.0, 2.5, 4.0]);
        assert_eq!(rank_correlation(&[1.0, 2.0, 9.0], &[-1.0, -2.0, -3.0]), Some(-1.0));
        assert_eq!(rank_correlation(&[1.0, 1.0], &[0.0, 1.0]), None);
    }
}
