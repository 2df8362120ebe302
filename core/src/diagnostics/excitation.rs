//! Persistent excitation: how well the motion tells parameters apart, and which combinations it does not tell at all.
//!
//! A regressor is persistently exciting where the smallest eigenvalue of its Gram matrix over every window stays above a positive number
//! (Narendra and Annaswamy 1987). Here the matrix has relative parameters as coordinates (`gram`).

use super::gram::{Blocks, Gram};
use crate::eigen::symmetric_eigen;
use crate::robots::RobotData;
use serde::Serialize;

/// Directions whose mean square torque is below this share of the strongest one's count as unexcited: a ten-thousandth of its torque.
pub(super) const UNEXCITED: f64 = 1e-8;

/// Parameters with a weight below this share of a combination's largest are not named.
const NAMED: f64 = 0.01;

/// How exciting a motion is.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Meter {
    /// Length of the window that moves over the run, s.
    pub window_s: f64,
    /// Smallest eigenvalue in the worst window, N²·m²: mean square torque of the relative parameter change that shows least.
    pub worst_window_n2m2: f64,
    /// The same in the best window, N²·m².
    pub best_window_n2m2: f64,
    /// Whether every window excites all directions, by the measure that also decides what is unidentifiable.
    pub is_persistent: bool,
    /// Eigenvalues over the whole run, ascending, N²·m².
    pub eigenvalues_n2m2: Vec<f64>,
    /// Directions that the whole run excites, out of the number of parameters.
    pub rank: usize,
    /// What the whole run does not tell: along each of these the parameters can change together.
    pub unidentifiable: Vec<Combination>,
}

/// Parameters that can change together, in these proportions, almost without changing a torque.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Combination {
    /// Root mean square torque of this change, N·m.
    pub torque_rms_nm: f64,
    /// Who takes part, the largest share first.
    pub terms: Vec<Term>,
}

/// A parameter's share in a combination.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Term {
    /// Its symbol.
    pub parameter: String,
    /// Its change, as a multiple of its nominal value; the largest is 1.
    pub relative_change: f64,
}

/// Eigenvalues of a Gram matrix, ascending, with their eigenvectors.
pub(super) fn directions(gram: &Gram, parameters: usize) -> Vec<(f64, Vec<f64>)> {
    let (values, vectors) = symmetric_eigen(&gram.matrix, parameters);
    let column = |k: usize| (0..parameters).map(|i| vectors[i * parameters + k]).collect();
    // Rounding alone makes them negative.
    let mut pairs: Vec<_> = values.iter().enumerate().map(|(k, value)| (value.max(0.0), column(k))).collect();
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
    pairs
}

/// Smallest eigenvalue, and whether it counts as excited.
fn weakest(pairs: &[(f64, Vec<f64>)]) -> (f64, bool) {
    let (least, most) = (pairs.first().map_or(0.0, |pair| pair.0), pairs.last().map_or(0.0, |pair| pair.0));
    (least, least > UNEXCITED * most)
}

/// Measures a run; `curve` gets the smallest eigenvalue of the window that ends with a row. `None` without two samples.
pub(super) fn measure(blocks: &Blocks, robot: &RobotData, curve: &mut dyn FnMut(usize, f64)) -> Option<Meter> {
    let whole = blocks.whole()?;
    let p = blocks.parameters;
    let (mut worst, mut best, mut is_persistent) = (f64::INFINITY, 0.0_f64, true);
    let mut drawn = None;
    for window in blocks.windows() {
        let (least, excited) = weakest(&directions(&window, p));
        (worst, best, is_persistent) = (worst.min(least), best.max(least), is_persistent && excited);
        for row in drawn.map_or(window.end, |last| last + 1)..=window.end {
            curve(row, least);
        }
        drawn = Some(window.end);
    }
    let pairs = directions(&whole, p);
    let most = pairs.last().map_or(0.0, |pair| pair.0);
    let unexcited: Vec<_> = pairs.iter().filter(|pair| pair.0 <= UNEXCITED * most).map(|pair| pair.1.clone()).collect();
    Some(Meter {
        window_s: blocks.window_s(),
        worst_window_n2m2: worst,
        best_window_n2m2: best,
        is_persistent,
        eigenvalues_n2m2: pairs.iter().map(|pair| pair.0).collect(),
        rank: p - unexcited.len(),
        unidentifiable: combinations(unexcited, &whole, robot),
    })
}

/// A basis of the unexcited directions in which each belongs to a parameter that no other contains, so that it reads as plainly as it can:
/// reduced by rows, the largest entry first. Weights are relative changes.
fn combinations(mut basis: Vec<Vec<f64>>, gram: &Gram, robot: &RobotData) -> Vec<Combination> {
    let p = robot.parameter_count();
    for n in 0..basis.len() {
        let pivots = (n..basis.len()).flat_map(|row| (0..p).map(move |column| (row, column)));
        let largest = |a: &(usize, usize), b: &(usize, usize)| basis[a.0][a.1].abs().total_cmp(&basis[b.0][b.1].abs());
        let Some((row, column)) = pivots.max_by(largest) else { break };
        basis.swap(n, row);
        let pivot = basis[n][column];
        basis[n].iter_mut().for_each(|weight| *weight /= pivot);
        let reduced = basis[n].clone();
        for (_, other) in basis.iter_mut().enumerate().filter(|(m, _)| *m != n) {
            let factor = other[column];
            other.iter_mut().zip(&reduced).for_each(|(weight, of_pivot)| *weight -= factor * of_pivot);
        }
    }
    basis.iter().map(|weights| combination(weights, gram, robot)).collect()
}

fn combination(weights: &[f64], gram: &Gram, robot: &RobotData) -> Combination {
    let p = weights.len();
    let largest = weights.iter().fold(0.0, |a: f64, b| if b.abs() > a.abs() { *b } else { a });
    let change: Vec<_> = weights.iter().map(|weight| weight / largest).collect();
    let square: f64 = (0..p).map(|i| change[i] * (0..p).map(|j| gram.matrix[i * p + j] * change[j]).sum::<f64>()).sum();
    let mut terms: Vec<_> = robot
        .parameters
        .iter()
        .zip(&change)
        .filter(|(_, change)| change.abs() >= NAMED)
        .map(|(parameter, change)| Term { parameter: parameter.symbol.to_owned(), relative_change: *change })
        .collect();
    terms.sort_by(|a, b| b.relative_change.abs().total_cmp(&a.relative_change.abs()));
    Combination { torque_rms_nm: square.max(0.0).sqrt(), terms }
}
