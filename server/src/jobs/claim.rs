//! What a worker and the store say to each other about a shard.

use super::JobState;
use adaptarm_core::scenario::Report;
use std::time::Duration;
use uuid::Uuid;

/// Whether to go on with a shard.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Order {
    /// Go on.
    Continue,
    /// Someone else's work has waited longer: keep the state and let go.
    Yield,
    /// Stop; what was computed is not wanted any more.
    Stop,
}

/// A shard that a worker may compute until its lease runs out.
#[derive(Debug, Clone, PartialEq)]
pub struct Claim {
    /// Job.
    pub job: Uuid,
    /// Whose it is.
    pub owner: String,
    /// Job's label.
    pub label: Option<String>,
    /// Among its owner's jobs, larger ones go first.
    pub priority: i64,
    /// Number of the shard in its job.
    pub shard: i64,
    /// The fence: no one else has this number.
    pub attempt: i64,
    /// Whether whoever worked on it before vanished: it may have killed them.
    pub suspect: bool,
    /// Steps of its first scenario that the store counts as done.
    pub steps_done: i64,
    /// What is left to compute, in order: numbers and documents.
    pub scenarios: Vec<(i64, String)>,
}

/// What a worker reports now and then.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Tick {
    /// Steps done in the scenario under way.
    pub steps_done: i64,
    /// Steps of it that were reported before.
    pub steps_before: i64,
    /// Computing time since the last report.
    pub computed: Duration,
    /// Whether the shard's state was saved: then it has come forward, and is not suspect any more.
    pub saved: bool,
    /// Whether it had its turn, and should let go if others wait.
    pub turn_over: bool,
}

impl Tick {
    /// A sign of life of someone who has not begun yet.
    pub fn waiting(claim: &Claim) -> Self {
        let steps = claim.steps_done;
        Self { steps_done: steps, steps_before: steps, computed: Duration::ZERO, saved: false, turn_over: false }
    }
}

/// A scenario's result that has just been put into the result store.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredResult {
    /// Number of the scenario in its job.
    pub n: i64,
    /// The report.
    pub report: Report,
    /// Size of the object that holds the samples.
    pub bytes: u64,
    /// Hash over the object's bytes.
    pub checksum: String,
}

/// What became of a delivered result.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Delivered {
    /// Whether to go on.
    pub order: Order,
    /// The job's state afterwards, where this changed it.
    pub ended: Option<JobState>,
}
