//! Latin hypercube: on every axis, each of N equal parts holds exactly one of N points.

use super::stream::{Purpose, Stream};

/// A design of a fixed number of points.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct LatinHypercube {
    seed: u64,
    /// Per axis: the part in which each point lies.
    cells: Vec<Vec<u32>>,
    points: u32,
}

impl LatinHypercube {
    /// Of `points` points on this many axes.
    pub fn new(seed: u64, dimensions: usize, points: u32) -> Self {
        let cells = |axis: usize| {
            let mut stream = Stream::new(seed, Purpose::Cells, axis as u64);
            let mut cells: Vec<_> = (0..points).collect();
            for n in (1..cells.len()).rev() {
                cells.swap(n, stream.below(n + 1));
            }
            cells
        };
        Self { seed, cells: (0..dimensions).map(cells).collect(), points }
    }

    /// Point `n`, below the number of points; each coordinate in (0, 1).
    pub fn point(&self, n: u32) -> Vec<f64> {
        let mut stream = Stream::new(self.seed, Purpose::Jitter, u64::from(n));
        let mut coordinate = |cells: &Vec<u32>| (f64::from(cells[n as usize]) + stream.unit()) / f64::from(self.points);
        self.cells.iter().map(&mut coordinate).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn every_part_of_every_axis_holds_one_point(seed: u64, dimensions in 1_usize..8, points in 1_u32..200) {
            let design = LatinHypercube::new(seed, dimensions, points);
            for axis in 0..dimensions {
                let part = |n| (design.point(n)[axis] * f64::from(points)) as u32;
                let mut parts: Vec<_> = (0..points).map(part).collect();
                parts.sort_unstable();
                prop_assert_eq!(parts, (0..points).collect::<Vec<_>>());
            }
        }
    }
}
