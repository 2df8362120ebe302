//! Desired trajectories: where the joints should be, how fast, and with what acceleration.

mod fourier;
mod remembered;

pub use fourier::Fourier;
pub use remembered::Remembered;

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
