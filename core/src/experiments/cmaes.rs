//! CMA-ES: search by a normal distribution that learns the shape of what it searches. Source: Hansen (2016), "The CMA
//! Evolution Strategy: A Tutorial", weights of the better half only.
//!
//! The state is a value: candidates follow from it and a stream of random numbers, so it can be stored and taken up anywhere.

use crate::eigen::symmetric_eigen;
use super::normal::normal_quantile;
use super::statistics::ranks;
use super::stream::Stream;
use crate::scalar::{exponential, logarithm};
use serde::{Deserialize, Serialize};

/// A search under way.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Cma {
    /// Center of the distribution.
    pub mean: Vec<f64>,
    /// Its size.
    pub sigma: f64,
    /// Its shape, n×n by rows.
    covariance: Vec<f64>,
    path_c: Vec<f64>,
    path_s: Vec<f64>,
    /// Candidates per generation.
    pub population: usize,
    /// Generations done.
    pub generation: u32,
    /// Best objective of each of the last generations, the newest last.
    recent: Vec<f64>,
}

/// Constants that follow from dimension and population. Source: the tutorial's Table 1.
struct Rates {
    weights: Vec<f64>,
    mu_eff: f64,
    c_s: f64,
    d_s: f64,
    c_c: f64,
    c_1: f64,
    c_mu: f64,
    /// Expected length of a standard normal vector.
    chi: f64,
}

impl Rates {
    fn new(dimension: usize, population: usize) -> Self {
        let n = dimension as f64;
        let parents = (population / 2).max(1);
        let raw: Vec<_> =
            (1..=parents).map(|i| logarithm(0.5 * (population as f64 + 1.0)) - logarithm(i as f64)).collect();
        let sum: f64 = raw.iter().sum();
        let weights: Vec<_> = raw.iter().map(|weight| weight / sum).collect();
        let mu_eff = 1.0 / weights.iter().map(|weight| weight * weight).sum::<f64>();
        let c_s = (mu_eff + 2.0) / (n + mu_eff + 5.0);
        let c_1 = 2.0 / ((n + 1.3) * (n + 1.3) + mu_eff);
        let c_mu = 2.0 * (mu_eff - 2.0 + 1.0 / mu_eff) / ((n + 2.0) * (n + 2.0) + mu_eff);
        Self {
            d_s: 1.0 + 2.0 * (((mu_eff - 1.0) / (n + 1.0)).sqrt() - 1.0).max(0.0) + c_s,
            c_c: (4.0 + mu_eff / n) / (n + 4.0 + 2.0 * mu_eff / n),
            c_mu: c_mu.min(1.0 - c_1),
            chi: n.sqrt() * (1.0 - 1.0 / (4.0 * n) + 1.0 / (21.0 * n * n)),
            weights,
            mu_eff,
            c_s,
            c_1,
        }
    }
}

/// Where a search has settled: relative change of the objective, size in every direction, squared ratio of axes.
const SETTLED_OBJECTIVE: f64 = 1e-9;
const SETTLED_SIZE: f64 = 1e-8;
const WORST_CONDITION: f64 = 1e14;

impl Cma {
    /// About `mean` with standard deviation `sigma`.
    pub fn new(mean: Vec<f64>, sigma: f64, population: usize) -> Self {
        let n = mean.len();
        let mut covariance = vec![0.0; n * n];
        for i in 0..n {
            covariance[i * n + i] = 1.0;
        }
        let (path_c, path_s) = (vec![0.0; n], vec![0.0; n]);
        Self { mean, sigma, covariance, path_c, path_s, population, generation: 0, recent: Vec::new() }
    }

    /// Candidates per generation that the tutorial advises.
    pub fn default_population(dimension: usize) -> usize {
        4 + (3.0 * logarithm(dimension as f64)) as usize
    }

    /// Whether the parts fit each other; a stored state may have been damaged.
    pub fn is_sound(&self, dimension: usize) -> bool {
        let n = dimension;
        let lengths = [self.mean.len(), self.path_c.len(), self.path_s.len()];
        let numbers = [&self.mean, &self.path_c, &self.path_s, &self.covariance];
        lengths == [n; 3]
            && self.covariance.len() == n * n
            && self.population >= 2
            && self.sigma.is_finite()
            && numbers.into_iter().flatten().all(|x| x.is_finite())
    }

    /// Axes of the distribution: lengths and, in the columns of a matrix, directions.
    fn axes(&self) -> (Vec<f64>, Vec<f64>) {
        let (squares, directions) = symmetric_eigen(&self.covariance, self.mean.len());
        (squares.into_iter().map(|square| square.max(1e-300).sqrt()).collect(), directions)
    }

    /// The candidates of this generation.
    pub fn ask(&self, stream: &mut Stream) -> Vec<Vec<f64>> {
        let n = self.mean.len();
        let (lengths, directions) = self.axes();
        let mut candidate = || {
            let z: Vec<_> = lengths.iter().map(|length| length * normal_quantile(stream.unit())).collect();
            let along = |i: usize| (0..n).map(|k| directions[i * n + k] * z[k]).sum::<f64>();
            (0..n).map(|i| self.mean[i] + self.sigma * along(i)).collect()
        };
        (0..self.population).map(|_| candidate()).collect()
    }

    /// Learns from the candidates that [`Cma::ask`] gave and their objectives, in the same order. Smaller is better.
    pub fn tell(&mut self, candidates: &[Vec<f64>], objectives: &[f64]) {
        let n = self.mean.len();
        let rates = Rates::new(n, self.population);
        let ranks = ranks(objectives);
        let mut order: Vec<_> = (0..candidates.len()).collect();
        order.sort_by(|a, b| ranks[*a].total_cmp(&ranks[*b]));
        let steps: Vec<Vec<f64>> = order
            .iter()
            .take(rates.weights.len())
            .map(|&k| (0..n).map(|i| (candidates[k][i] - self.mean[i]) / self.sigma).collect())
            .collect();
        let weighted = |i: usize| rates.weights.iter().zip(&steps).map(|(weight, step)| weight * step[i]).sum::<f64>();
        let step: Vec<_> = (0..n).map(weighted).collect();

        let (lengths, directions) = self.axes();
        // C^(−1/2) times the step.
        let across: Vec<f64> =
            (0..n).map(|k| (0..n).map(|i| directions[i * n + k] * step[i]).sum::<f64>() / lengths[k]).collect();
        let whitened = |i: usize| (0..n).map(|k| directions[i * n + k] * across[k]).sum::<f64>();
        let push_s = (rates.c_s * (2.0 - rates.c_s) * rates.mu_eff).sqrt();
        for i in 0..n {
            self.path_s[i] = (1.0 - rates.c_s) * self.path_s[i] + push_s * whitened(i);
        }
        let length = self.path_s.iter().map(|x| x * x).sum::<f64>().sqrt();
        self.generation += 1;
        let fading = logarithm(1.0 - rates.c_s) * 2.0 * f64::from(self.generation);
        let stalled = length / (1.0 - exponential(fading)).sqrt() >= (1.4 + 2.0 / (n as f64 + 1.0)) * rates.chi;
        let on = if stalled { 0.0 } else { 1.0 };
        let push_c = on * (rates.c_c * (2.0 - rates.c_c) * rates.mu_eff).sqrt();
        for i in 0..n {
            self.path_c[i] = (1.0 - rates.c_c) * self.path_c[i] + push_c * step[i];
        }
        let keep = 1.0 - rates.c_1 - rates.c_mu + (1.0 - on) * rates.c_1 * rates.c_c * (2.0 - rates.c_c);
        for i in 0..n {
            for j in 0..n {
                let spread: f64 =
                    rates.weights.iter().zip(&steps).map(|(weight, step)| weight * step[i] * step[j]).sum();
                self.covariance[i * n + j] = keep * self.covariance[i * n + j]
                    + rates.c_1 * self.path_c[i] * self.path_c[j]
                    + rates.c_mu * spread;
            }
        }
        for i in 0..n {
            self.mean[i] += self.sigma * step[i];
        }
        self.sigma *= exponential((rates.c_s / rates.d_s * (length / rates.chi - 1.0)).min(1.0));
        self.remember(objectives);
    }

    fn remember(&mut self, objectives: &[f64]) {
        let memory = 10 + 30 * self.mean.len() / self.population;
        self.recent.push(objectives.iter().copied().fold(f64::INFINITY, f64::min));
        if self.recent.len() > memory {
            self.recent.remove(0);
        }
    }

    /// Whether nothing new is to be expected of it.
    pub fn has_settled(&self) -> bool {
        let memory = 10 + 30 * self.mean.len() / self.population;
        let (lengths, _) = self.axes();
        let longest = lengths.iter().copied().fold(0.0, f64::max);
        let shortest = lengths.iter().copied().fold(f64::INFINITY, f64::min);
        let most = self.recent.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let least = self.recent.iter().copied().fold(f64::INFINITY, f64::min);
        let flat = self.recent.len() >= memory && most - least <= SETTLED_OBJECTIVE * least.abs();
        flat || self.sigma * longest < SETTLED_SIZE || longest * longest > WORST_CONDITION * shortest * shortest
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiments::stream::Purpose;

    /// Best objective after so many generations, and the state.
    fn search(objective: impl Fn(&[f64]) -> f64, start: Cma, seed: u64, generations: u64) -> (f64, Cma) {
        let (mut cma, mut best) = (start, f64::INFINITY);
        for generation in 0..generations {
            let candidates = cma.ask(&mut Stream::new(seed, Purpose::Generation, generation));
            let objectives: Vec<_> = candidates.iter().map(|x| objective(x)).collect();
            best = objectives.iter().copied().fold(best, f64::min);
            cma.tell(&candidates, &objectives);
        }
        (best, cma)
    }

    #[test]
    fn the_sphere_in_ten_dimensions() {
        let sphere = |x: &[f64]| x.iter().map(|x| x * x).sum();
        let (best, cma) = search(sphere, Cma::new(vec![1.0; 10], 0.5, 10), 1, 250);
        assert!(best < 1e-12, "{best}");
        assert!(cma.is_sound(10) && !cma.is_sound(9));
    }

    #[test]
    fn rosenbrocks_valley() {
        let valley =
            |x: &[f64]| x.windows(2).map(|x| 100.0 * (x[1] - x[0] * x[0]).powi(2) + (1.0 - x[0]).powi(2)).sum::<f64>();
        let (best, cma) = search(valley, Cma::new(vec![-0.5; 5], 0.3, 8), 2, 500);
        assert!(best < 1e-10, "{best}");
        assert!(cma.mean.iter().all(|x| (x - 1.0).abs() < 1e-4), "{:?}", cma.mean);
    }

    #[test]
    fn an_ellipsoid_a_million_times_longer_than_wide_turned_in_space() {
        let ellipsoid = |x: &[f64]| {
            let turned = [x[0] + x[1] + x[2], x[0] - x[1], x[0] + x[1] - 2.0 * x[2]];
            turned.iter().zip([1.0, 1e3, 1e6]).map(|(x, scale)| scale * x * x).sum::<f64>()
        };
        let (best, _) = search(ellipsoid, Cma::new(vec![2.0, -1.0, 3.0], 1.0, 7), 3, 400);
        assert!(best < 1e-12, "{best}");
    }

    #[test]
    fn rastrigins_egg_box_with_many_candidates() {
        let box_of_eggs =
            |x: &[f64]| x.iter().map(|x| x * x - 10.0 * (2.0 * std::f64::consts::PI * x).cos() + 10.0).sum::<f64>();
        // A neighbouring pit is one more; with enough candidates most searches end in the deepest.
        let deepest = |seed| search(box_of_eggs, Cma::new(vec![2.7; 5], 2.0, 200), seed, 120).0 < 1e-9;
        let count = (0..10).filter(|seed| deepest(*seed)).count();
        assert!(count >= 7, "{count} of 10");
    }

    #[test]
    fn it_settles_where_nothing_changes() {
        let (_, cma) = search(|_| 1.0, Cma::new(vec![0.0; 2], 0.3, 6), 5, 40);
        assert!(cma.has_settled());
        assert!(!Cma::new(vec![0.0; 2], 0.3, 6).has_settled());
    }
}
