//! Random numbers: every draw has a stream of its own, named by what it is for and its index.
//!
//! So a draw does not depend on which others were made, where, or in which order.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{RngCore, SeedableRng};

/// What random numbers are for: no two purposes share a stream.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Purpose {
    /// Values of a Monte Carlo draw.
    Draw = 1,
    /// Order of the cells of a Latin hypercube, per axis.
    Cells = 2,
    /// Place within the cell of a Latin hypercube, per point.
    Jitter = 3,
    /// Digital shift of a Sobol sequence, per axis.
    Shift = 4,
    /// Resampling for confidence.
    Bootstrap = 5,
    /// Candidates of a generation of the tuning.
    Generation = 6,
    /// Where a restart of the tuning begins.
    Restart = 7,
    /// Plants that the tuning works on.
    Plant = 8,
    /// Plants that the tuning never saw.
    Validation = 9,
    /// Seed of a run's own noise.
    Noise = 10,
    /// A variant of an exercise that its student sees.
    VisibleVariant = 11,
    /// One that he does not.
    HiddenVariant = 12,
}

/// A stream of random numbers.
pub(crate) struct Stream(ChaCha8Rng);

impl Stream {
    /// The stream of `purpose` with this index; indices are below 2⁵⁶.
    pub fn new(seed: u64, purpose: Purpose, index: u64) -> Self {
        let mut generator = ChaCha8Rng::seed_from_u64(seed);
        generator.set_stream(((purpose as u64) << 56) | (index & ((1 << 56) - 1)));
        Self(generator)
    }

    /// A number of the open interval (0, 1): the middle of one of 2⁵² equal parts.
    pub fn unit(&mut self) -> f64 {
        ((self.0.next_u64() >> 12) as f64 + 0.5) / 4_503_599_627_370_496.0
    }

    /// A whole number below `bound`, which is positive; its bias is below `bound / 2⁶⁴`.
    pub fn below(&mut self, bound: usize) -> usize {
        ((u128::from(self.0.next_u64()) * bound as u128) >> 64) as usize
    }

    /// 32 random bits.
    pub fn bits(&mut self) -> u32 {
        self.0.next_u32()
    }

    /// A whole number that every reader of JSON keeps exact.
    pub fn seed(&mut self) -> u64 {
        self.0.next_u64() >> 11
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn streams_differ_and_repeat() {
        let first = |seed, purpose, index| Stream::new(seed, purpose, index).unit();
        let one = first(1, Purpose::Draw, 0);
        assert_eq!(one, first(1, Purpose::Draw, 0));
        for other in [first(2, Purpose::Draw, 0), first(1, Purpose::Noise, 0), first(1, Purpose::Draw, 1)] {
            assert_ne!(one, other);
        }
    }

    #[test]
    fn numbers_are_uniform() {
        let mut stream = Stream::new(3, Purpose::Draw, 7);
        let mut counts = [0_u32; 10];
        for _ in 0..20_000 {
            let x = stream.unit();
            assert!(x > 0.0 && x < 1.0);
            counts[(x * 10.0) as usize] += 1;
            assert!(stream.below(3) < 3);
        }
        // Six standard deviations about 2000.
        assert!(counts.iter().all(|count| count.abs_diff(2000) < 260), "{counts:?}");
    }
}
