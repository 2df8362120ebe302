//! A trajectory that remembers instants: integrators ask for each stage time several times, and those of several steps are
//! computed together, one not waiting for the other.

use super::{Desired, Trajectory};
use crate::scalar::{Kernel, Scalar};
use std::cell::Cell;

/// Most instants that can be foreseen at once.
pub const MOST_FORESEEN: usize = 8;

/// A trajectory with the motion at the instants that were foreseen last and, in the first place, at the last of those foreseen before.
/// An instant that was not foreseen takes the first place; adaptive steps and imperfect loops foresee none.
#[derive(Debug, Clone)]
pub struct Remembered<T: Scalar, const N: usize> {
    trajectory: Trajectory<T, N>,
    times_s: [Cell<f64>; 1 + MOST_FORESEEN],
    motions: [Cell<Desired<T, N>>; 1 + MOST_FORESEEN],
    /// Where the last instant was found: the next is there or in the place after it.
    found: Cell<usize>,
    /// The place of the last instant that was foreseen.
    last: Cell<usize>,
}

impl<T: Scalar, const N: usize> Remembered<T, N> {
    /// Remembers the start.
    pub fn new(trajectory: Trajectory<T, N>) -> Self {
        let start = trajectory.at(0.0);
        Self {
            trajectory,
            times_s: Default::default(),
            motions: std::array::from_fn(|_| Cell::new(start)),
            found: Cell::new(0),
            last: Cell::new(0),
        }
    }

    /// Desired motion at `time_s`: the same bits as the trajectory itself gives.
    #[inline(always)]
    pub fn at(&self, time_s: f64) -> Desired<T, N> {
        let is_at = |n: usize| self.times_s[n].get().to_bits() == time_s.to_bits();
        let found = self.found.get().min(MOST_FORESEEN);
        // One place to read from, whether it was remembered or not: the compiler then reads each number when it is needed and keeps no
        // copy of all, which would have to be written before it is read.
        let place = if is_at(found) {
            found
        } else if is_at((found + 1).min(MOST_FORESEEN)) {
            (found + 1).min(MOST_FORESEEN)
        } else {
            self.search(time_s)
        };
        self.found.set(place);
        self.motions[place].get()
    }

    /// The place of an instant that may be anywhere; computed in the first place where it is nowhere.
    #[inline(never)]
    fn search(&self, time_s: f64) -> usize {
        let remembered = self.times_s.iter().position(|at| at.get().to_bits() == time_s.to_bits());
        remembered.unwrap_or_else(|| {
            self.times_s[0].set(time_s);
            self.motions[0].set(T::compiled(At { trajectory: &self.trajectory, time_s }));
            0
        })
    }

    /// Computes the next instants together, [`MOST_FORESEEN`] at most.
    #[inline(always)]
    pub fn foresee(&self, times_s: &[f64]) {
        let last = self.last.get();
        self.times_s[0].set(self.times_s[last].get());
        self.motions[0].set(self.motions[last].get());
        debug_assert!(times_s.len() <= MOST_FORESEEN);
        let count = times_s.len().min(MOST_FORESEEN);
        let (times, motions) = (&self.times_s[1..=count], &self.motions[1..=count]);
        for n in 0..count {
            times[n].set(times_s[n]);
        }
        self.trajectory.at_each(&times_s[..count], motions);
        self.found.set(0);
        self.last.set(count);
    }
}

/// [`Trajectory::at`], compiled for each kind of scalar.
struct At<'a, T: Scalar, const N: usize> {
    trajectory: &'a Trajectory<T, N>,
    time_s: f64,
}

impl<T: Scalar, const N: usize> Kernel for At<'_, T, N> {
    type Output = Desired<T, N>;

    #[inline(always)]
    fn run(self) -> Desired<T, N> {
        self.trajectory.at(self.time_s)
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
                let next = f64::from(n + 2) * 1e-3;
                remembered.foresee(&[start + 0.5e-3, end, end + 0.5e-3, next][..2 + 2 * (n as usize % 2)]);
            }
            [start, start + 0.5e-3, start + 0.5e-3, end, 7.0, end].into_iter().for_each(examine);
        }
        // Beyond what the argument's reduction keeps accurate, too.
        let times_s = [2e5, 0.3];
        remembered.foresee(&times_s);
        times_s.into_iter().for_each(examine);
    }
}
