//! The seam between jobs and where they are kept: everything that a request or a worker may ask of the tables.
//!
//! Every write of a worker is fenced: it names its claim, and a claim that was overtaken (its lease ran out, the job was
//! canceled) changes nothing and is told to stop.

use super::claim::{Claim, Delivered, Folded, MadeRuns, Order, StoredResult, Tick};
use super::{Job, JobKind, JobState, NewJob};
use crate::config::Limits;
use adaptarm_core::scenario::Report;
use async_trait::async_trait;
use jiff::Timestamp;
use std::time::Duration;
use thiserror::Error;
use uuid::Uuid;

/// Why a store did not do what it was asked.
#[derive(Debug, Error)]
pub enum StoreError {
    /// The database failed or cannot be reached; it may work again later.
    #[error("the database failed: {0}")]
    Database(#[from] sqlx::Error),
    /// The database could not be prepared.
    #[error("the database cannot be brought to this version: {0}")]
    Migration(#[from] sqlx::migrate::MigrateError),
    /// The queue in it failed.
    #[error("the queue failed: {0}")]
    Queue(String),
    /// What the database holds makes no sense: another program wrote it, or it is damaged.
    #[error("the database holds {0}")]
    Damaged(String),
    /// The user would have more of something than one user may.
    #[error("{what}: you have {found}, and this job would bring {more} more; one user may have {most}")]
    Quota {
        /// Of what.
        what: &'static str,
        /// How much there is.
        found: u64,
        /// How much the job would add.
        more: u64,
        /// How much there may be.
        most: u64,
    },
    /// The key was used before, with another request.
    #[error("the Idempotency-Key {key:?} was used for another request already; use a new key for a new request")]
    KeyReused {
        /// The key.
        key: String,
    },
}

/// What became of a request for a job.
#[derive(Debug, Clone, PartialEq)]
pub struct Submitted {
    /// The job.
    pub job: Job,
    /// Whether it existed already under the request's key.
    pub repeated: bool,
}

/// Which jobs to list.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Filter {
    /// In this state.
    pub state: Option<JobState>,
    /// Of this kind.
    pub kind: Option<JobKind>,
    /// With exactly this label.
    pub label: Option<String>,
    /// Older than this one.
    pub before: Option<Uuid>,
}

/// A scenario of a job, with its report once there is one.
#[derive(Debug, Clone, PartialEq)]
pub struct ScenarioRow {
    /// Number in the job.
    pub n: i64,
    /// Hash of its canonical form.
    pub hash: String,
    /// Version of the core that computed it.
    pub core_version: Option<String>,
    /// Report as JSON; absent with a version present where it is no longer kept.
    pub report: Option<String>,
    /// Hash over the stored samples.
    pub checksum: Option<String>,
}

/// An experiment as the tables hold it.
#[derive(Debug, Clone, PartialEq)]
pub struct ExperimentRow {
    /// Its hash.
    pub hash: String,
    /// Its document.
    pub document: String,
    /// Version of the core that began it.
    pub core_version: String,
    /// Step that it is in.
    pub step: i64,
    /// Rows of this step.
    pub done: i64,
    /// The search of a tuning.
    pub state: Option<Vec<u8>>,
    /// The newest summary, as JSON.
    pub summary: Option<String>,
}

/// What an event tells.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EventKind {
    /// The job changed its state: the data are the state and the reason.
    State,
    /// A scenario has its result: the data are its number and a digest of the report.
    Summary,
    /// An experiment was summed up: the data are the numbers that matter most. A later one takes its place.
    Partial,
}

impl EventKind {
    /// Its name over HTTP and in the database.
    pub fn id(self) -> &'static str {
        match self {
            Self::State => "state",
            Self::Summary => "summary",
            Self::Partial => "partial",
        }
    }

    /// The kind of this name.
    pub fn from_id(id: &str) -> Option<Self> {
        [Self::State, Self::Summary, Self::Partial].into_iter().find(|kind| kind.id() == id)
    }
}

/// Something that happened to a job, in the order in which it happened.
#[derive(Debug, Clone, PartialEq)]
pub struct Event {
    /// Number within the job, from 1.
    pub seq: i64,
    /// What it tells.
    pub kind: EventKind,
    /// JSON.
    pub data: String,
}

/// The little of a job that watching it needs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pulse {
    /// The job.
    pub id: Uuid,
    /// Number of its last event.
    pub seq: i64,
    /// Share done, 0 to 1.
    pub progress: f64,
    /// Scenarios with a result.
    pub scenarios_done: i64,
    /// Where it stands.
    pub state: JobState,
}

/// A token as the database knows it.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredToken {
    /// Its public part.
    pub id: String,
    /// Who it stands for.
    pub owner: String,
    /// What people call it.
    pub name: String,
    /// What it allows, comma-separated.
    pub scopes: String,
    /// Hash of its secret part, hexadecimal.
    pub secret_hash: String,
    /// When it was made.
    pub created_at: Timestamp,
    /// When it stops being valid.
    pub expires_at: Option<Timestamp>,
    /// When it was revoked.
    pub revoked_at: Option<Timestamp>,
    /// When it was last used, to a minute.
    pub last_used_at: Option<Timestamp>,
}

/// What a summary event tells: the number of the scenario, and its report without the long lists.
pub fn summary(n: i64, report: &Report) -> String {
    // Strings, numbers and lists always become a value.
    let mut report = serde_json::to_value(report).unwrap_or_default();
    if let Some(fields) = report.as_object_mut() {
        for long in ["theta_true", "theta_hat_end"] {
            fields.remove(long);
        }
    }
    serde_json::json!({ "scenario": n, "report": report }).to_string()
}

/// Where jobs are kept.
#[async_trait]
pub trait JobStore: Send + Sync + 'static {
    /// Accepts a job and plans its shards; what has a stored result is done at once. All of it is on disk when this
    /// returns, or nothing.
    async fn submit(&self, job: NewJob, limits: &Limits) -> Result<Submitted, StoreError>;

    /// A user's job.
    async fn job(&self, owner: &str, id: Uuid) -> Result<Option<Job>, StoreError>;

    /// A user's jobs, newest first.
    async fn jobs(&self, owner: &str, filter: &Filter, limit: i64) -> Result<Vec<Job>, StoreError>;

    /// Cancels a user's job, if it has not ended, and gives it as it is then.
    async fn cancel(&self, owner: &str, id: Uuid) -> Result<Option<Job>, StoreError>;

    /// Forgets a user's job, whatever its state; whether there was one.
    async fn delete(&self, owner: &str, id: Uuid) -> Result<bool, StoreError>;

    /// Scenarios of a job from number `from` on, in order.
    async fn scenarios(&self, id: Uuid, from: i64, limit: i64) -> Result<Vec<ScenarioRow>, StoreError>;

    /// One scenario of a job, with its document.
    async fn scenario(&self, id: Uuid, n: i64) -> Result<Option<(ScenarioRow, String)>, StoreError>;

    /// Events of a job after number `after`, in order.
    async fn events(&self, id: Uuid, after: i64, limit: i64) -> Result<Vec<Event>, StoreError>;

    /// How these jobs stand; a job that does not exist is left out.
    async fn pulses(&self, ids: &[Uuid]) -> Result<Vec<Pulse>, StoreError>;

    /// Jobs that wait and jobs that run, of all users.
    async fn unfinished(&self) -> Result<[i64; 2], StoreError>;

    /// Takes the shard whose turn it is: of the user with the fewest running shards, then of the one who waited longest;
    /// among one user's jobs by priority, then by age. Also gives back what vanished workers had.
    async fn claim(&self, worker: &str, lease: Duration) -> Result<Option<Claim>, StoreError>;

    /// Prolongs the lease, notes how far the shard is, and asks whether to go on.
    async fn tick(&self, claim: &Claim, tick: Tick, lease: Duration, limits: &Limits) -> Result<Order, StoreError>;

    /// Notes a scenario's result; the last one ends the job. So many of its steps were counted by ticks, and so much
    /// computing time has passed since the last one.
    async fn deliver(
        &self,
        claim: &Claim,
        result: &StoredResult,
        counted: i64,
        computed: Duration,
    ) -> Result<Delivered, StoreError>;

    /// Keeps the rows of an experiment's part; the last ones of a step have it folded.
    async fn deliver_runs(
        &self,
        claim: &Claim,
        made: &MadeRuns,
        counted: i64,
        computed: Duration,
    ) -> Result<Delivered, StoreError>;

    /// Keeps what the rows of a step came to, and begins what comes next or ends the job.
    async fn deliver_fold(&self, claim: &Claim, folded: &Folded, computed: Duration) -> Result<Delivered, StoreError>;

    /// The experiment of a job.
    async fn experiment(&self, id: Uuid) -> Result<Option<ExperimentRow>, StoreError>;

    /// Packed rows of a step of an experiment from the run `from` on, in order, each with the number of its first run.
    async fn packed_rows(&self, id: Uuid, step: i64, from: i64, limit: i64) -> Result<Vec<(i64, Vec<u8>)>, StoreError>;

    /// Gives a shard back for its next turn: its worker yields or stops, with its state saved.
    async fn release(&self, claim: &Claim) -> Result<(), StoreError>;

    /// Fails the job of a claim.
    async fn fail(&self, claim: &Claim, reason: &str) -> Result<(), StoreError>;

    /// Gives back every running shard, how many: whoever had them is known to be dead.
    async fn bury_all(&self) -> Result<u64, StoreError>;

    /// Forgets jobs that ended before this moment; how many.
    async fn forget_jobs(&self, before: Timestamp) -> Result<u64, StoreError>;

    /// Results that no job refers to and that were stored before this moment: hashes and core versions.
    async fn unused_results(&self, before: Timestamp, limit: i64) -> Result<Vec<(String, String)>, StoreError>;

    /// Forgets a result that no job refers to; whether it did. Its object is the caller's to remove.
    async fn forget_unused_result(&self, hash: &str, core_version: &str) -> Result<bool, StoreError>;

    /// Forgets a result whose samples are lost: whoever asks for the scenario again gets it computed again.
    async fn forget_lost_result(&self, hash: &str, core_version: &str) -> Result<(), StoreError>;

    /// Whether this shard still exists: its checkpoint is of use.
    async fn has_shard(&self, job: Uuid, shard: i64) -> Result<bool, StoreError>;

    /// Keeps a new token.
    async fn add_token(&self, token: &StoredToken) -> Result<(), StoreError>;

    /// The token with this public part.
    async fn token(&self, id: &str) -> Result<Option<StoredToken>, StoreError>;

    /// All tokens, oldest first.
    async fn tokens(&self) -> Result<Vec<StoredToken>, StoreError>;

    /// Revokes a token; whether there was one.
    async fn revoke_token(&self, id: &str) -> Result<bool, StoreError>;

    /// Notes that a token was used.
    async fn touch_token(&self, id: &str) -> Result<(), StoreError>;
}
