//! A trajectory that remembers its last instant: integrators ask for each stage time several times in a row.

use super::{Desired, Trajectory};
use crate::scalar::Scalar;
use std::cell::Cell;

/// A trajectory with the motion at the last instant asked for.
#[derive(Debug, Clone)]
pub struct Remembered<T: Scalar, const N: usize> {
    trajectory: Trajectory<T, N>,
    last: Cell<(f64, Desired<T, N>)>,
}

impl<T: Scalar, const N: usize> Remembered<T, N> {
    /// Remembers the start.
    pub fn new(trajectory: Trajectory<T, N>) -> Self {
        let start = trajectory.at(0.0);
        Self { trajectory, last: Cell::new((0.0, start)) }
    }

    /// Desired motion at `time_s`: the same bits as the trajectory itself gives.
    #[inline(always)]
    pub fn at(&self, time_s: f64) -> Desired<T, N> {
        let (last_s, desired) = self.last.get();
        if last_s.to_bits() == time_s.to_bits() {
            return desired;
        }
        let desired = self.trajectory.at(time_s);
        self.last.set((time_s, desired));
        desired
    }
}
