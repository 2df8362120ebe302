//! What a worker and the store say to each other about a shard.

use super::JobState;
use super::plan::Shard;
use adaptarm_core::scenario::Report;
use std::ops::Range;
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
    /// Steps of what is to be done that the store counts as done.
    pub steps_done: i64,
    /// What is to be done.
    pub task: Task,
}

/// What is to be done of a shard.
#[derive(Debug, Clone, PartialEq)]
pub enum Task {
    /// Scenarios that have no result yet, in order: numbers and documents.
    Scenarios(Vec<(i64, String)>),
    /// A part of an experiment.
    Part(Part),
}

/// A part of an experiment.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    /// The experiment's hash.
    pub hash: String,
    /// Its document.
    pub document: String,
    /// Version of the core that began it.
    pub core_version: String,
    /// Step of a tuning; 0 of anything else.
    pub step: i64,
    /// The search of a tuning before this step; none before the first.
    pub state: Option<Vec<u8>>,
    /// What is to be done.
    pub work: PartWork,
}

/// What is to be done of an experiment's part.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum PartWork {
    /// Making runs.
    Runs(Range<i64>),
    /// Summing up the rows of the step; of a tuning also saying what comes next.
    Fold,
}

/// Runs that have been made.
#[derive(Debug, Clone, PartialEq)]
pub struct MadeRuns {
    /// Step of the experiment.
    pub step: i64,
    /// Number of the first.
    pub first: i64,
    /// How many.
    pub count: i64,
    /// Their rows, packed.
    pub packed: Vec<u8>,
    /// Steps that they took.
    pub steps: i64,
}

/// What the rows of a step came to.
#[derive(Debug, Clone, PartialEq)]
pub struct Folded {
    /// Step of the experiment.
    pub step: i64,
    /// Rows that were summed up.
    pub rows: i64,
    /// The summary, as JSON.
    pub summary: String,
    /// The same in short, for those who follow.
    pub digest: String,
    /// The search of a tuning after this step.
    pub state: Option<Vec<u8>>,
    /// Candidates of a tuning so far.
    pub candidates: Option<i64>,
    /// What comes next.
    pub next: NextStep,
}

/// What comes after the rows were summed up.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum NextStep {
    /// The rest of this step.
    Rest,
    /// Another step with so many runs, cut into these shards.
    Step(i64, Vec<Shard>),
    /// Nothing.
    End,
}

/// What a worker reports now and then.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Tick {
    /// Steps done in the scenarios under way, or in the experiment's part.
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
    /// Whether it is the shard's last.
    pub last: bool,
}

/// What became of a delivered result.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Delivered {
    /// Whether to go on.
    pub order: Order,
    /// The job's state afterwards, where this changed it.
    pub ended: Option<JobState>,
}
