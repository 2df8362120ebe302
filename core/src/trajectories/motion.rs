//! One trajectory of any kind, over which the closed loop is built.
//!
//! Fourier series are vectors of numbers and run in lanes as they are; every other kind is a [`Motion`] per lane, evaluated
//! number by number once per stage time. So a new kind is plain arithmetic on `f64`, and the Fourier path does not slow down.

use super::{Desired, Fourier};
use crate::scalar::Scalar;
use nalgebra::SVector;
use std::cell::Cell;
use std::fmt::Debug;
use std::sync::Arc;

/// Most lanes that a scalar has here.
pub(super) const MOST_LANES: usize = 16;

/// A desired motion in closed form.
pub trait Motion<const N: usize>: Debug + Send + Sync {
    /// Desired motion at `time_s`. Units: rad, rad/s, rad/s².
    fn at(&self, time_s: f64) -> Desired<f64, N>;
}

/// A desired trajectory of any kind.
#[derive(Debug, Clone)]
pub enum Trajectory<T: Scalar, const N: usize> {
    /// A Fourier series, its lanes side by side.
    Fourier(Fourier<T, N>),
    /// Any other motion, one per lane; lanes behind the last repeat it.
    Motions(Vec<Arc<dyn Motion<N>>>),
}

impl<const N: usize> Trajectory<f64, N> {
    /// Whether both can be lanes of one trajectory.
    pub fn runs_beside(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Fourier(a), Self::Fourier(b)) => a.runs_beside(b),
            (Self::Motions(_), Self::Motions(_)) => true,
            _ => false,
        }
    }
}

impl<T: Scalar, const N: usize> Trajectory<T, N> {
    /// The trajectories of `T`'s lanes as one; they run beside each other, and there is at least one.
    pub fn side_by_side(lanes: &[Trajectory<f64, N>]) -> Self {
        let of = |lane: usize| &lanes[lane.min(lanes.len() - 1)];
        match of(0) {
            Trajectory::Fourier(first) => Self::Fourier(Fourier::side_by_side(|lane| match of(lane) {
                Trajectory::Fourier(fourier) => fourier,
                Trajectory::Motions(_) => first,
            })),
            Trajectory::Motions(_) => Self::Motions(
                lanes
                    .iter()
                    .flat_map(|lane| match lane {
                        Trajectory::Motions(motions) => motions.clone(),
                        Trajectory::Fourier(_) => Vec::new(),
                    })
                    .collect(),
            ),
        }
    }

    /// Desired motion at `time_s`. Units: rad, rad/s, rad/s².
    #[inline(always)]
    pub fn at(&self, time_s: f64) -> Desired<T, N> {
        match self {
            Self::Fourier(fourier) => fourier.at(time_s),
            Self::Motions(motions) => number_by_number(motions, time_s),
        }
    }

    /// Desired motion (rad, rad/s, rad/s²) at each of several instants, with the bits of [`Self::at`]; `motions` is as long as `times_s`.
    #[inline(always)]
    pub fn at_each(&self, times_s: &[f64], motions: &[Cell<Desired<T, N>>]) {
        match self {
            Self::Fourier(fourier) => fourier.at_each(times_s, motions),
            Self::Motions(each) => {
                for n in 0..times_s.len() {
                    motions[n].set(number_by_number(each, times_s[n]));
                }
            }
        }
    }
}

/// Each lane's own motion, put side by side.
#[inline(never)]
fn number_by_number<T: Scalar, const N: usize>(motions: &[Arc<dyn Motion<N>>], time_s: f64) -> Desired<T, N> {
    let zero = SVector::<f64, N>::zeros();
    let mut each = [Desired { position: zero, velocity: zero, acceleration: zero }; MOST_LANES];
    for (lane, motion) in motions.iter().enumerate().take(MOST_LANES) {
        each[lane] = motion.at(time_s);
    }
    let last = motions.len().min(MOST_LANES) - 1;
    let vector = |of: fn(&Desired<f64, N>) -> &SVector<f64, N>| {
        SVector::<T, N>::from_fn(|joint, _| T::from_lanes(|lane| of(&each[lane.min(last)])[joint]))
    };
    Desired {
        position: vector(|desired| &desired.position),
        velocity: vector(|desired| &desired.velocity),
        acceleration: vector(|desired| &desired.acceleration),
    }
}
