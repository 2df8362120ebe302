//! A trajectory that remembers instants: integrators ask for each stage time several times, and for a step's two together.

use super::{Desired, Trajectory};
use crate::scalar::Scalar;
use std::cell::Cell;

/// A trajectory with the motion at three instants: start, middle and end of the step that was foreseen last. An instant that was
/// not foreseen takes the place of the start; adaptive steps and imperfect loops foresee none.
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
        let remembered = self.times_s.iter().position(|at| at.get().to_bits() == time_s.to_bits());
        // One place to read from, whether it was remembered or not: the compiler then reads each number when it is needed and keeps no
        // copy of all, which would have to be written before it is read.
        self.motions[remembered.unwrap_or_else(|| self.remember(time_s))].get()
    }

    /// Computes an instant in the place of the start; gives that place.
    #[inline(always)]
    fn remember(&self, time_s: f64) -> usize {
        self.times_s[0].set(time_s);
        self.motions[0].set(self.trajectory.at(time_s));
        0
    }

    /// Computes a step's middle and end together; the end of the step before stays, where this one starts.
    #[inline(always)]
    pub fn foresee(&self, times_s: [f64; 2]) {
        self.times_s[0].set(self.times_s[2].get());
        self.motions[0].set(self.motions[2].get());
        let desired = self.trajectory.at_two(times_s);
        for n in 0..2 {
            self.times_s[n + 1].set(times_s[n]);
            self.motions[n + 1].set(desired[n]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trajectories::Fourier;

    #[test]
    fn gives_the_bits_of_the_trajectory_whatever_was_foreseen() {
        let trajectory: Trajectory<f64, 3> = Trajectory::Fourier(Fourier::paper());
        let remembered = Remembered::new(trajectory.clone());
        let bits = |desired: Desired<f64, 3>| {
            [desired.position, desired.velocity, desired.acceleration].map(|v| v.map(f64::to_bits))
        };
        let examine = |t: f64| assert_eq!(bits(remembered.at(t)), bits(trajectory.at(t)), "at {t} s");
        for n in 0..50_u32 {
            let (start, end) = (f64::from(n) * 1e-3, f64::from(n + 1) * 1e-3);
            if n % 3 != 1 {
                remembered.foresee([start + 0.5e-3, end]);
            }
            [start, start + 0.5e-3, start + 0.5e-3, end, 7.0, end].into_iter().for_each(examine);
        }
        // Beyond what the argument's reduction keeps accurate, too.
        let times_s = [2e5, 0.3];
        for (desired, time_s) in trajectory.at_two(times_s).into_iter().zip(times_s) {
            assert_eq!(bits(desired), bits(trajectory.at(time_s)));
        }
    }
}
