//! Sobol's sequence: points that fill a cube evenly, each computable from its index.
//!
//! Point n is the exclusive or of the direction numbers named by the bits of n's Gray code; a random digital shift keeps the
//! evenness and makes the corner at zero as likely as any. Direction numbers: the first rows of Joe and Kuo (2008),
//! `new-joe-kuo-6`.

use super::stream::{Purpose, Stream};

/// Most axes.
pub(super) const DIMENSIONS: usize = 21;
/// Binary digits of a coordinate, hence the length of the sequence.
const BITS: usize = 32;

/// Degree of a primitive polynomial, its inner coefficients as bits, and the odd initial numbers.
type Row = (usize, u32, &'static [u32]);

/// Of every axis but the first, which is van der Corput's sequence.
const ROWS: [Row; DIMENSIONS - 1] = [
    (1, 0, &[1]),
    (2, 1, &[1, 3]),
    (3, 1, &[1, 3, 1]),
    (3, 2, &[1, 1, 1]),
    (4, 1, &[1, 1, 3, 3]),
    (4, 4, &[1, 3, 5, 13]),
    (5, 2, &[1, 1, 5, 5, 17]),
    (5, 4, &[1, 1, 5, 5, 5]),
    (5, 7, &[1, 1, 7, 11, 19]),
    (5, 11, &[1, 1, 5, 1, 1]),
    (5, 13, &[1, 1, 1, 3, 11]),
    (5, 14, &[1, 3, 5, 5, 31]),
    (6, 1, &[1, 3, 3, 9, 7, 49]),
    (6, 13, &[1, 1, 1, 15, 21, 21]),
    (6, 16, &[1, 3, 1, 13, 27, 49]),
    (6, 19, &[1, 1, 1, 15, 7, 5]),
    (6, 22, &[1, 3, 1, 15, 13, 25]),
    (6, 25, &[1, 1, 5, 5, 19, 61]),
    (7, 1, &[1, 3, 7, 11, 23, 15, 103]),
    (7, 4, &[1, 3, 7, 13, 13, 15, 69]),
];

/// A shifted Sobol sequence.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Sobol {
    /// Per axis: direction numbers, and the shift.
    axes: Vec<([u32; BITS], u32)>,
}

impl Sobol {
    /// With this many axes, at most [`DIMENSIONS`], shifted as the seed says.
    pub fn new(seed: u64, dimensions: usize) -> Self {
        let shift = |axis: usize| Stream::new(seed, Purpose::Shift, axis as u64).bits();
        Self { axes: (0..dimensions.min(DIMENSIONS)).map(|axis| (directions(axis), shift(axis))).collect() }
    }

    /// Point `n`, each coordinate in (0, 1).
    pub fn point(&self, n: u64) -> Vec<f64> {
        let gray = n ^ (n >> 1);
        let coordinate = |(directions, shift): &([u32; BITS], u32)| {
            let mut digits = *shift;
            for (bit, direction) in directions.iter().enumerate() {
                if gray >> bit & 1 == 1 {
                    digits ^= direction;
                }
            }
            (f64::from(digits) + 0.5) / 4_294_967_296.0
        };
        self.axes.iter().map(coordinate).collect()
    }
}

/// Direction numbers of an axis, the most significant bit first.
fn directions(axis: usize) -> [u32; BITS] {
    let mut v = [0; BITS];
    if axis == 0 {
        for (n, v) in v.iter_mut().enumerate() {
            *v = 1 << (BITS - 1 - n);
        }
        return v;
    }
    let (degree, coefficients, initial) = ROWS[axis - 1];
    for (n, m) in initial.iter().enumerate() {
        v[n] = m << (BITS - 1 - n);
    }
    for n in degree..BITS {
        v[n] = v[n - degree] ^ (v[n - degree] >> degree);
        for k in 1..degree {
            if coefficients >> (degree - 1 - k) & 1 == 1 {
                v[n] ^= v[n - k];
            }
        }
    }
    v
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_axis_has_one_point_in_each_part_of_a_power_of_two() {
        let sobol = Sobol::new(5, DIMENSIONS);
        for log in [1, 5, 10] {
            let count = 1_usize << log;
            let points: Vec<_> = (0..count as u64).map(|n| sobol.point(n)).collect();
            for axis in 0..DIMENSIONS {
                let mut seen = vec![false; count];
                for point in &points {
                    let part = (point[axis] * count as f64) as usize;
                    assert!(!std::mem::replace(&mut seen[part], true), "axis {axis}, {count} points");
                }
            }
        }
    }

    #[test]
    fn the_first_two_axes_are_a_net_in_every_shape_of_box() {
        let sobol = Sobol::new(1, 2);
        let points: Vec<_> = (0..64).map(|n| sobol.point(n)).collect();
        for log in 0..=6 {
            let (columns, rows) = (1_usize << log, 64_usize >> log);
            let mut seen = [false; 64];
            for point in &points {
                let place = (point[0] * columns as f64) as usize * rows + (point[1] * rows as f64) as usize;
                assert!(!std::mem::replace(&mut seen[place], true), "{columns} by {rows}");
            }
        }
    }

    #[test]
    fn integrates_better_than_chance() {
        // The integral of the product of 2x over a cube of six dimensions is 1.
        let sobol = Sobol::new(2, 6);
        let count = 4096;
        let sum: f64 = (0..count).map(|n| sobol.point(n).iter().map(|x| 2.0 * x).product::<f64>()).sum();
        let error = (sum / count as f64 - 1.0).abs();
        // Chance would give a standard error of sqrt((4/3)^6 − 1) / 64, which is 0.03.
        assert!(error < 0.005, "{error}");
    }
}
