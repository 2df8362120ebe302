//! A paused run: everything that decides its future and all it has recorded.

use super::Outcome;
use thiserror::Error;

/// A paused simulation. Resuming gives the same bits as never having paused.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Snapshot {
    /// `adaptarm.snapshot/1`.
    pub format: String,
    /// Version of the core that made it: another one may compute other bits.
    pub core_version: String,
    /// What is simulated, by the caller's name for it (a scenario's hash).
    pub identity: String,
    /// Steps taken.
    pub step: u64,
    /// Time reached, s.
    pub time_s: f64,
    /// Step that an adaptive integrator would try next, s.
    pub next_step_s: f64,
    /// Evaluations of the right-hand side so far.
    pub evaluations: u64,
    /// State vector.
    pub state: Vec<f64>,
    /// Recorded rows.
    pub rows: Vec<f64>,
    /// How it ended, if it has.
    pub outcome: Option<Outcome>,
}

impl Snapshot {
    /// Identifier of the format.
    pub const FORMAT: &'static str = "adaptarm.snapshot/1";
}

/// Why a snapshot cannot be resumed.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum SnapshotError {
    /// It belongs to another scenario.
    #[error("the snapshot belongs to scenario {found}, not to {expected}")]
    OtherScenario {
        /// Identity of the scenario that should be resumed.
        expected: String,
        /// Identity in the snapshot.
        found: String,
    },
    /// Another version of the core made it.
    #[error("the snapshot is {found}; this is {} of core {}", Snapshot::FORMAT, crate::VERSION)]
    OtherVersion {
        /// Its format and version.
        found: String,
    },
    /// Its parts do not belong together.
    #[error("the snapshot is damaged: {0} do not belong to this run")]
    Inconsistent(&'static str),
    /// Its arrays do not have the scenario's shape.
    #[error("the snapshot's {what} has {found} numbers where {expected} are needed")]
    Shape {
        /// Which array.
        what: &'static str,
        /// Length needed (for rows: a multiple of it).
        expected: usize,
        /// Length found.
        found: usize,
    },
}
