//! Jobs: work that outlives the request that asked for it.
//!
//! [`Engine`] runs them on a bounded pool; [`JobStore`] remembers them. The store is the seam where a durable queue takes
//! the place of memory: whoever works on a job learns what to do, and whether to go on, only through it.

mod engine;
mod memory;
mod store;
mod study;

pub use engine::{Engine, Simulate};
pub use memory::MemoryStore;
pub use store::{Ending, JobStore, Order, StoreError};
pub use study::{STUDY_LIMITS, Study, StudyError, StudyLimits, StudyResult};

use jiff::Timestamp;
use serde::{Deserialize, Serialize};
use uuid::Uuid;

/// What a job computes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum JobKind {
    /// One or more scenarios, each simulated to its end.
    Study,
}

/// Where a job stands. The last three are final.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum JobState {
    /// Waits for a free thread.
    Queued,
    /// Is being computed.
    Running,
    /// Its whole result can be read.
    Succeeded,
    /// Ended without a result.
    Failed,
    /// Stopped because someone asked.
    Canceled,
}

impl JobState {
    /// Whether it will never change again.
    pub fn is_final(self) -> bool {
        !matches!(self, Self::Queued | Self::Running)
    }

    /// Its name over HTTP.
    pub fn id(self) -> &'static str {
        match self {
            Self::Queued => "queued",
            Self::Running => "running",
            Self::Succeeded => "succeeded",
            Self::Failed => "failed",
            Self::Canceled => "canceled",
        }
    }
}

/// A job as its owner sees it.
#[derive(Debug, Clone, PartialEq)]
pub struct Job {
    /// Identifier; later jobs have larger ones.
    pub id: Uuid,
    /// What it computes.
    pub kind: JobKind,
    /// Its owner's name for it.
    pub label: Option<String>,
    /// Where it stands.
    pub state: JobState,
    /// Share done, 0 to 1.
    pub progress: f64,
    /// Why it failed.
    pub reason: Option<String>,
    /// When it was accepted.
    pub created_at: Timestamp,
    /// When its first scenario began.
    pub started_at: Option<Timestamp>,
    /// When it reached a final state.
    pub finished_at: Option<Timestamp>,
}

impl Job {
    /// A job that has just been accepted.
    pub fn new(kind: JobKind, label: Option<String>) -> Self {
        Self {
            id: Uuid::now_v7(),
            kind,
            label,
            state: JobState::Queued,
            progress: 0.0,
            reason: None,
            created_at: Timestamp::now(),
            started_at: None,
            finished_at: None,
        }
    }
}
