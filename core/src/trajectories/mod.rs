//! Desired trajectories: where the joints should be, how fast, and with what acceleration.

mod chirp;
mod fourier;
mod motion;
mod point_to_point;
mod random_fourier;
mod remembered;
mod samples;
mod tip_path;

pub use chirp::{Chirp, chirp_phase};
pub use fourier::Fourier;
pub use motion::{Motion, Trajectory};
pub use point_to_point::{PointToPoint, minimum_jerk};
pub use random_fourier::random_fourier;
pub use remembered::{MOST_FORESEEN, Remembered};
pub use samples::Samples;
pub use tip_path::{Path, TipPath};

use nalgebra::SVector;

/// Desired motion at one instant: `q_d` (rad), `q̇_d` (rad/s), `q̈_d` (rad/s²).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Desired<T, const N: usize> {
    /// `q_d`, rad.
    pub position: SVector<T, N>,
    /// `q̇_d`, rad/s.
    pub velocity: SVector<T, N>,
    /// `q̈_d`, rad/s².
    pub acceleration: SVector<T, N>,
}
