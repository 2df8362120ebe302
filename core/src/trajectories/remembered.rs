//! A trajectory that remembers instants: integrators ask for each stage time several times, and for a step's two together.

use super::{Desired, Trajectory};
use crate::scalar::Scalar;
use std::cell::Cell;

/// A trajectory with the motion at the start, the middle and the end of the latest step.
#[derive(Debug, Clone)]
pub struct Remembered<T: Scalar, const N: usize> {
    trajectory: Trajectory<T, N>,
    times_s: [Cell<f64>; 3],
    motions: [Cell<Desired<T, N>>; 3],
}

impl<T: Scalar, const N: usize> Remembered<T, N> {
    /// Remembers the start.
    pub fn new(trajectory: Trajectory<T, N>) -> Self {
        let start = trajectory.at(0.0);
        Self { trajectory, times_s: Default::default(), motions: std::array::from_fn(|_| Cell::new(start)) }
    }

    /// Desired motion at `time_s`: the same bits as the trajectory itself gives.
    #[inline(always)]
    pub fn at(&self, time_s: f64) -> Desired<T, N> {
        for n in 0..self.times_s.len() {
            if self.times_s[n].get().to_bits() == time_s.to_bits() {
                return self.motions[n].get();
            }
        }
        let desired = self.trajectory.at(time_s);
        self.times_s[0].set(time_s);
        self.motions[0].set(desired);
        desired
    }

    /// Computes a step's middle and end together; the end of the step before stays, where this one starts.
    #[inline(always)]
    pub fn expect(&self, times_s: [f64; 2]) {
        self.times_s[0].set(self.times_s[2].get());
        self.motions[0].set(self.motions[2].get());
        let desired = self.trajectory.at_two(times_s);
        for n in 0..2 {
            self.times_s[n + 1].set(times_s[n]);
            self.motions[n + 1].set(desired[n]);
        }
    }
}
