//! Makes a receipt's runs again: the seed must be the one that was committed to, the exercise the one that graded, and every
//! trajectory and point must come out the same.

use super::receipt::Receipt;
use super::reveal::{REVEAL_FORMAT, Reveal};
use crate::exercises::reports;
use adaptarm_core::exercises::{Exercise, GradeError};
use thiserror::Error;

/// What came out the same.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Rerun {
    /// Trajectories that were made again, bit by bit.
    pub trajectories: usize,
}

/// Why a receipt's runs do not come out the same, or cannot be made.
#[derive(Debug, Error)]
pub enum RerunError {
    /// Of another format.
    #[error("the reveal's format is {0:?}; this program knows {REVEAL_FORMAT}")]
    Format(String),
    /// Another seed or nonce.
    #[error("the revealed seed is not the one that the receipt committed to")]
    Seed,
    /// Another exercise.
    #[error("the exercise has fingerprint {found}; the receipt was graded by {expected}")]
    Exercise {
        /// Of the exercise given.
        found: String,
        /// The receipt's.
        expected: String,
    },
    /// Another program.
    #[error("it was computed by core {expected}, this is {found}: other bits prove nothing; use that version")]
    Version {
        /// This program's.
        found: String,
        /// The receipt's.
        expected: String,
    },
    /// The runs cannot be made.
    #[error(transparent)]
    Grade(#[from] GradeError),
    /// Other bits.
    #[error("variant {variant} has another trajectory than the one that was graded")]
    Trajectory {
        /// Which, from 0.
        variant: usize,
    },
    /// Another number of runs.
    #[error("the receipt has {found} trajectories where the exercise has {expected} hidden variants")]
    Count {
        /// The receipt's.
        found: usize,
        /// The exercise's.
        expected: usize,
    },
    /// Same bits, other points.
    #[error("the runs are worth {found} points, the receipt says {expected}")]
    Points {
        /// What comes out.
        found: f64,
        /// The receipt's.
        expected: f64,
    },
}

/// Makes the runs again. The signature is another matter.
pub fn rerun(receipt: &Receipt, reveal: &Reveal, exercise: &Exercise) -> Result<Rerun, RerunError> {
    let statement = &receipt.statement;
    let grade = &statement.grade;
    if reveal.format != REVEAL_FORMAT {
        return Err(RerunError::Format(reveal.format.clone()));
    }
    if reveal.nonce.commit_seed(reveal.seed) != statement.seed_commitment {
        return Err(RerunError::Seed);
    }
    let (found, expected) = (exercise.fingerprint(), grade.fingerprint.clone());
    if found != expected {
        return Err(RerunError::Exercise { found, expected });
    }
    let (found, expected) = (adaptarm_core::VERSION.to_owned(), grade.core_version.clone());
    if found != expected {
        return Err(RerunError::Version { found, expected });
    }
    let reports = reports(exercise, &statement.gains, reveal.seed, grade.visibility)?;
    let again = exercise.grade(&statement.gains, reveal.seed, grade.visibility, &reports)?;
    let (found, expected) = (statement.trajectory_commitments.len(), again.variants.len());
    if found != expected {
        return Err(RerunError::Count { found, expected });
    }
    for (variant, (own, committed)) in again.variants.iter().zip(&statement.trajectory_commitments).enumerate() {
        if &reveal.nonce.commit_trajectory(variant, &own.trajectory_hash) != committed {
            return Err(RerunError::Trajectory { variant });
        }
    }
    if again.public() != *grade {
        return Err(RerunError::Points { found: again.points, expected: grade.points });
    }
    Ok(Rerun { trajectories: again.variants.len() })
}
