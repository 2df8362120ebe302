//! Rows as the tables hold them, and what they mean.

use crate::jobs::{Event, EventKind, Job, JobKind, JobState, Pulse, ScenarioRow, StoreError, StoredToken};
use jiff::Timestamp;
use uuid::Uuid;

/// Columns of a [`JobRow`].
macro_rules! job_columns {
    () => {
        "id, owner, kind, label, priority, state, reason, cached, attempts, created_at, started_at, finished_at, \
         scenarios, scenarios_done, steps_total, steps_done"
    };
}
pub(super) use job_columns;

#[derive(Debug, sqlx::FromRow)]
pub(super) struct JobRow {
    pub(super) id: String,
    owner: String,
    kind: String,
    label: Option<String>,
    priority: i64,
    state: String,
    reason: Option<String>,
    cached: i64,
    attempts: i64,
    created_at: i64,
    started_at: Option<i64>,
    finished_at: Option<i64>,
    scenarios: i64,
    scenarios_done: i64,
    steps_total: i64,
    steps_done: i64,
}

impl TryFrom<JobRow> for Job {
    type Error = StoreError;

    fn try_from(row: JobRow) -> Result<Self, StoreError> {
        Ok(Self {
            id: id(&row.id)?,
            owner: row.owner,
            kind: JobKind::from_id(&row.kind).ok_or_else(|| damaged("a job of the kind", &row.kind))?,
            label: row.label,
            priority: row.priority,
            state: state(&row.state)?,
            reason: row.reason,
            cached: row.cached != 0,
            attempts: row.attempts,
            created_at: time(row.created_at)?,
            started_at: row.started_at.map(time).transpose()?,
            finished_at: row.finished_at.map(time).transpose()?,
            scenarios: row.scenarios,
            scenarios_done: row.scenarios_done,
            steps_total: row.steps_total,
            steps_done: row.steps_done,
        })
    }
}

impl TryFrom<JobRow> for Pulse {
    type Error = StoreError;

    fn try_from(row: JobRow) -> Result<Self, StoreError> {
        let job = Job::try_from(row)?;
        let (id, state, scenarios_done) = (job.id, job.state, job.scenarios_done);
        Ok(Self { id, seq: 0, progress: job.progress(), scenarios_done, state })
    }
}

#[derive(Debug, sqlx::FromRow)]
pub(super) struct ShardRow {
    pub(super) number: i64,
    pub(super) owner: String,
    pub(super) first: i64,
    pub(super) count: i64,
    pub(super) attempt: i64,
    pub(super) kills: i64,
    pub(super) steps_done: i64,
    pub(super) folds: i64,
}

#[derive(Debug, sqlx::FromRow)]
pub(super) struct EventRow {
    seq: i64,
    kind: String,
    data: String,
}

impl TryFrom<EventRow> for Event {
    type Error = StoreError;

    fn try_from(EventRow { seq, kind, data }: EventRow) -> Result<Self, StoreError> {
        let kind = EventKind::from_id(&kind).ok_or_else(|| damaged("an event of the kind", &kind))?;
        Ok(Self { seq, kind, data })
    }
}

#[derive(Debug, sqlx::FromRow)]
pub(super) struct ScenarioColumns {
    n: i64,
    hash: String,
    core_version: Option<String>,
    report: Option<String>,
    checksum: Option<String>,
}

impl From<ScenarioColumns> for ScenarioRow {
    fn from(ScenarioColumns { n, hash, core_version, report, checksum }: ScenarioColumns) -> Self {
        Self { n, hash, core_version, report, checksum }
    }
}

#[derive(Debug, sqlx::FromRow)]
pub(super) struct TokenRow {
    id: String,
    owner: String,
    name: String,
    scopes: String,
    secret_hash: String,
    created_at: i64,
    expires_at: Option<i64>,
    revoked_at: Option<i64>,
    last_used_at: Option<i64>,
}

impl TryFrom<TokenRow> for StoredToken {
    type Error = StoreError;

    fn try_from(row: TokenRow) -> Result<Self, StoreError> {
        Ok(Self {
            id: row.id,
            owner: row.owner,
            name: row.name,
            scopes: row.scopes,
            secret_hash: row.secret_hash,
            created_at: time(row.created_at)?,
            expires_at: row.expires_at.map(time).transpose()?,
            revoked_at: row.revoked_at.map(time).transpose()?,
            last_used_at: row.last_used_at.map(time).transpose()?,
        })
    }
}

/// A state by its name in the tables.
pub(super) fn state(name: &str) -> Result<JobState, StoreError> {
    JobState::from_id(name).ok_or_else(|| damaged("a job in the state", name))
}

/// An identifier as the tables hold it.
pub(super) fn id(text: &str) -> Result<Uuid, StoreError> {
    text.parse().map_err(|_| damaged("the identifier", text))
}

fn time(microseconds: i64) -> Result<Timestamp, StoreError> {
    Timestamp::from_microsecond(microseconds).map_err(|_| damaged("the time", &microseconds.to_string()))
}

fn damaged(what: &str, value: &str) -> StoreError {
    StoreError::Damaged(format!("{what} {value:?}"))
}
