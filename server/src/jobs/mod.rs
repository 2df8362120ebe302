//! Jobs: work that outlives the request that asked for it, and the process that began it.
//!
//! [`JobStore`] is the one seam: tables in SQLite or PostgreSQL that hold the truth about every job. [`Engine`] takes
//! shards from it, computes them on a bounded pool and hands back what they gave; between the two stands nothing but
//! the store's fences, so any process may die at any moment.

mod claim;
mod compute;
mod engine;
mod experiment;
mod new_job;
mod plan;
mod queue;
mod shard;
mod shared;
mod sql;
mod store;
mod study;
#[cfg(test)]
mod tests;
mod upkeep;

pub use claim::{Claim, Delivered, Folded, MadeRuns, NextStep, Order, Part, PartWork, StoredResult, Task, Tick};
pub use engine::Engine;
pub use experiment::{ExperimentJob, read_experiment, read_rows, read_search};
pub use new_job::{NewExperiment, NewJob, NewScenario, NewWork};
pub use queue::{Handler, Queue, WEBHOOKS};
pub use shared::EngineSettings;
pub use sql::connect;
pub use store::{
    Event, EventKind, ExperimentRow, Filter, JobStore, Pulse, ScenarioRow, StoreError, StoredToken, Submitted,
};
pub use study::{Study, StudyError};
pub use upkeep::{Forgotten, collect_garbage};

use jiff::Timestamp;
use serde::{Deserialize, Serialize};
use uuid::Uuid;

/// What a job computes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, utoipa::ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum JobKind {
    /// One or more scenarios, each simulated to its end.
    Study,
    /// An experiment in which fields are tried systematically.
    Sweep,
    /// An experiment in which fields are random.
    MonteCarlo,
    /// An experiment in which schemes meet conditions.
    Compare,
    /// An experiment that searches the best values.
    Tuning,
}

impl JobKind {
    /// Every kind.
    pub const ALL: [Self; 5] = [Self::Study, Self::Sweep, Self::MonteCarlo, Self::Compare, Self::Tuning];

    /// Its name over HTTP and in the database.
    pub fn id(self) -> &'static str {
        match self {
            Self::Study => "study",
            Self::Sweep => "sweep",
            Self::MonteCarlo => "monte_carlo",
            Self::Compare => "compare",
            Self::Tuning => "tuning",
        }
    }

    /// Whether it is an experiment.
    pub fn is_experiment(self) -> bool {
        self != Self::Study
    }

    /// The kind of this name.
    pub fn from_id(id: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.id() == id)
    }
}

/// Where a job stands. The last three are final.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, utoipa::ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum JobState {
    /// Waits for a free thread.
    Queued,
    /// Is being computed, or was and waits for its next turn.
    Running,
    /// Its whole result can be read.
    Succeeded,
    /// Ended early; what had been computed by then can be read.
    Failed,
    /// Stopped because someone asked; what had been computed by then can be read.
    Canceled,
}

impl JobState {
    /// Every state.
    pub const ALL: [Self; 5] = [Self::Queued, Self::Running, Self::Succeeded, Self::Failed, Self::Canceled];

    /// Whether it will never change again.
    pub fn is_final(self) -> bool {
        !matches!(self, Self::Queued | Self::Running)
    }

    /// Its name over HTTP and in the database.
    pub fn id(self) -> &'static str {
        match self {
            Self::Queued => "queued",
            Self::Running => "running",
            Self::Succeeded => "succeeded",
            Self::Failed => "failed",
            Self::Canceled => "canceled",
        }
    }

    /// The state of this name.
    pub fn from_id(id: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|state| state.id() == id)
    }
}

/// A job as its owner sees it.
#[derive(Debug, Clone, PartialEq)]
pub struct Job {
    /// Identifier; later jobs have larger ones.
    pub id: Uuid,
    /// Whose it is.
    pub owner: String,
    /// What it computes.
    pub kind: JobKind,
    /// Its owner's name for it.
    pub label: Option<String>,
    /// Among its owner's jobs, larger ones go first.
    pub priority: i64,
    /// Where it stands.
    pub state: JobState,
    /// Why it failed or was canceled.
    pub reason: Option<String>,
    /// Whether every scenario had been computed before it was submitted.
    pub cached: bool,
    /// Most often that any part of it was taken up.
    pub attempts: i64,
    /// When it was accepted.
    pub created_at: Timestamp,
    /// When work on it began.
    pub started_at: Option<Timestamp>,
    /// When it reached a final state.
    pub finished_at: Option<Timestamp>,
    /// How many scenarios it has: of an experiment its runs, of a tuning the candidates that it may try.
    pub scenarios: i64,
    /// How many of them have a result.
    pub scenarios_done: i64,
    /// Integration steps of all scenarios.
    pub steps_total: i64,
    /// Integration steps done and kept.
    pub steps_done: i64,
}

impl Job {
    /// Share done, 0 to 1; 1 only when it has succeeded.
    pub fn progress(&self) -> f64 {
        if self.state == JobState::Succeeded {
            return 1.0;
        }
        // How many steps a tuning will take, nobody knows; an adaptive method may take more than were planned.
        let (done, total) = match self.kind {
            JobKind::Tuning => (self.scenarios_done, self.scenarios),
            _ => (self.steps_done, self.steps_total),
        };
        (done as f64 / total.max(1) as f64).clamp(0.0, 0.999)
    }
}
