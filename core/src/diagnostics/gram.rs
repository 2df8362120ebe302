//! Gram matrices of a regressor along a motion: `G = 1/T ∫ (Y S)ᵀ (Y S) dt`, over windows and over the whole run.
//!
//! S is the diagonal of the parameters' nominal sizes. Every entry then has the unit N²·m², and `xᵀ G x` is the mean square of the torque
//! that a relative change x of the parameters makes, so eigenvalues can be compared, which those of `YᵀY` with its mixed units cannot.
//! The integral is kept in blocks, of which windows are sums: nothing is subtracted, so no window loses digits.

/// Blocks of a run; a window moves by one of them.
const BLOCKS: usize = 120;
/// Blocks of a window: a quarter of the run.
const WINDOW: usize = 30;

/// The integrals, block by block.
#[derive(Debug, Clone)]
pub(super) struct Blocks {
    pub parameters: usize,
    /// Intervals between samples.
    intervals: usize,
    /// `∫ (Y S)ᵀ (Y S) dt` of each block, full matrices by rows.
    sums: Vec<Vec<f64>>,
    /// Time in each block, s.
    times_s: Vec<f64>,
    /// First row after each block.
    ends: Vec<usize>,
}

/// Mean square torques over a stretch of the run.
pub(super) struct Gram {
    /// By rows.
    pub matrix: Vec<f64>,
    /// Row of the recording with which the stretch ends.
    pub end: usize,
}

impl Blocks {
    /// Of a recording with this many rows.
    pub fn new(parameters: usize, rows: usize) -> Self {
        let intervals = rows.saturating_sub(1);
        let blocks = intervals.min(BLOCKS);
        let nothing = vec![0.0; parameters * parameters];
        Self {
            parameters,
            intervals,
            sums: vec![nothing; blocks],
            times_s: vec![0.0; blocks],
            ends: (1..=blocks).map(|block| block * intervals / blocks).collect(),
        }
    }

    /// Adds interval `interval`, `span_s` long: half of it for the regressor at either end, whose columns are scaled (row-wise, joints by
    /// parameters).
    pub fn add(&mut self, interval: usize, span_s: f64, from: &[f64], to: &[f64]) {
        let block = self.ends.partition_point(|end| *end <= interval);
        self.times_s[block] += span_s;
        let (sum, p) = (&mut self.sums[block], self.parameters);
        for y in from.chunks_exact(p).chain(to.chunks_exact(p)) {
            for i in (0..p).filter(|i| y[*i] != 0.0) {
                for j in 0..=i {
                    sum[i * p + j] += 0.5 * span_s * y[i] * y[j];
                }
            }
        }
    }

    /// Mean over blocks `from` up to `to`; both exist, and the first is before the second.
    fn mean(&self, from: usize, to: usize) -> Gram {
        let p = self.parameters;
        let time_s: f64 = self.times_s[from..to].iter().sum();
        let mut matrix = vec![0.0; p * p];
        for sum in &self.sums[from..to] {
            for i in 0..p {
                for j in 0..=i {
                    matrix[i * p + j] += sum[i * p + j] / time_s;
                }
            }
        }
        for i in 0..p {
            for j in 0..i {
                matrix[j * p + i] = matrix[i * p + j];
            }
        }
        Gram { matrix, end: self.ends[to - 1] }
    }

    /// Blocks of a window.
    fn window(&self) -> usize {
        // A quarter also of what is shorter than all blocks.
        (self.sums.len() * WINDOW / BLOCKS).max(1)
    }

    /// Length of a window, s.
    pub fn window_s(&self) -> f64 {
        self.times_s.iter().sum::<f64>() * self.window() as f64 / self.sums.len().max(1) as f64
    }

    /// Every window, one after another.
    pub fn windows(&self) -> impl Iterator<Item = Gram> + '_ {
        let window = self.window();
        (window..=self.sums.len()).map(move |to| self.mean(to - window, to))
    }

    /// Over the whole run; `None` without two samples.
    pub fn whole(&self) -> Option<Gram> {
        (self.intervals > 0).then(|| self.mean(0, self.sums.len()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::eigen::symmetric_eigen;
    use std::f64::consts::TAU;

    /// `y = [sin t, cos t, sin t]` over whole periods: `G = [[½, 0, ½], [0, ½, 0], [½, 0, ½]]`, eigenvalues 0, ½, 1.
    #[test]
    fn the_gram_matrix_of_sines_is_known() {
        let rows = 4001;
        let at = |n: usize| TAU * 4.0 * n as f64 / (rows - 1) as f64;
        let y = |n: usize| [at(n).sin(), at(n).cos(), at(n).sin()];
        let mut blocks = Blocks::new(3, rows);
        for n in 0..rows - 1 {
            blocks.add(n, at(n + 1) - at(n), &y(n), &y(n + 1));
        }
        assert!((blocks.window_s() - TAU).abs() < 1e-9);
        let expected = [0.5, 0.0, 0.5, 0.0, 0.5, 0.0, 0.5, 0.0, 0.5];
        // A window is one period, wherever it begins.
        let mut windows = 0;
        for gram in blocks.windows().chain(blocks.whole()) {
            windows += 1;
            assert!(gram.matrix.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-3), "{:?}", gram.matrix);
        }
        assert_eq!((windows, blocks.whole().map(|gram| gram.end)), (BLOCKS - WINDOW + 2, Some(rows - 1)));
        let (mut values, _) = symmetric_eigen(&blocks.whole().unwrap().matrix, 3);
        values.sort_by(f64::total_cmp);
        assert!(values.iter().zip([0.0, 0.5, 1.0]).all(|(a, b)| (a - b).abs() < 1e-6), "{values:?}");
    }

    #[test]
    fn short_recordings_have_fewer_blocks_or_none() {
        for rows in [0, 1] {
            assert!(Blocks::new(2, rows).whole().is_none());
            assert_eq!(Blocks::new(2, rows).windows().count(), 0);
        }
        let mut blocks = Blocks::new(1, 3);
        blocks.add(0, 1.0, &[2.0], &[2.0]);
        blocks.add(1, 1.0, &[2.0], &[2.0]);
        assert_eq!(blocks.whole().unwrap().matrix, [4.0]);
        assert_eq!(blocks.windows().map(|gram| gram.end).collect::<Vec<_>>(), [1, 2]);
    }
}
