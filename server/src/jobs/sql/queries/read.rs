//! Looking at jobs.

use super::rows::{EventRow, JobRow, ScenarioColumns, job_columns};
use super::{Db, Pool};
use crate::jobs::{Event, Filter, Job, JobKind, JobState, Pulse, ScenarioRow, StoreError};
use sqlx::{FromRow, QueryBuilder, Row};
use uuid::Uuid;

/// A user's job.
pub(super) async fn job(pool: &Pool, owner: &str, id: Uuid) -> Result<Option<Job>, StoreError> {
    let row: Option<JobRow> =
        sqlx::query_as(concat!("SELECT ", job_columns!(), " FROM job WHERE id = $1 AND owner = $2"))
            .bind(id.to_string())
            .bind(owner)
            .fetch_optional(pool)
            .await?;
    row.map(Job::try_from).transpose()
}

/// A user's jobs, newest first.
pub(super) async fn jobs(pool: &Pool, owner: &str, filter: &Filter, limit: i64) -> Result<Vec<Job>, StoreError> {
    let mut query: QueryBuilder<Db> = QueryBuilder::new(concat!("SELECT ", job_columns!(), " FROM job WHERE owner = "));
    query.push_bind(owner);
    if let Some(state) = filter.state {
        query.push(" AND state = ").push_bind(JobState::id(state));
    }
    if let Some(kind) = filter.kind {
        query.push(" AND kind = ").push_bind(JobKind::id(kind));
    }
    if let Some(label) = &filter.label {
        query.push(" AND label = ").push_bind(label);
    }
    if let Some(before) = filter.before {
        query.push(" AND id < ").push_bind(before.to_string());
    }
    query.push(" ORDER BY id DESC LIMIT ").push_bind(limit);
    let rows: Vec<JobRow> = query.build_query_as().fetch_all(pool).await?;
    rows.into_iter().map(Job::try_from).collect()
}

/// Scenarios of a job, in order.
pub(super) async fn scenarios(pool: &Pool, id: Uuid, from: i64, limit: i64) -> Result<Vec<ScenarioRow>, StoreError> {
    let rows: Vec<ScenarioColumns> = sqlx::query_as(
        "SELECT s.n, s.hash, s.core_version, r.report, r.checksum FROM job_scenario s \
         LEFT JOIN result r ON r.hash = s.hash AND r.core_version = s.core_version \
         WHERE s.job_id = $1 AND s.n >= $2 ORDER BY s.n LIMIT $3",
    )
    .bind(id.to_string())
    .bind(from)
    .bind(limit)
    .fetch_all(pool)
    .await?;
    Ok(rows.into_iter().map(ScenarioRow::from).collect())
}

/// One scenario of a job, with its document.
pub(super) async fn scenario(pool: &Pool, id: Uuid, n: i64) -> Result<Option<(ScenarioRow, String)>, StoreError> {
    let row = sqlx::query(
        "SELECT s.n, s.hash, s.core_version, r.report, r.checksum, s.document FROM job_scenario s \
         LEFT JOIN result r ON r.hash = s.hash AND r.core_version = s.core_version \
         WHERE s.job_id = $1 AND s.n = $2",
    )
    .bind(id.to_string())
    .bind(n)
    .fetch_optional(pool)
    .await?;
    let Some(row) = row else { return Ok(None) };
    Ok(Some((ScenarioColumns::from_row(&row)?.into(), row.try_get("document")?)))
}

/// Events of a job, in order.
pub(super) async fn events(pool: &Pool, id: Uuid, after: i64, limit: i64) -> Result<Vec<Event>, StoreError> {
    let rows: Vec<EventRow> =
        sqlx::query_as("SELECT seq, kind, data FROM event WHERE job_id = $1 AND seq > $2 ORDER BY seq LIMIT $3")
            .bind(id.to_string())
            .bind(after)
            .bind(limit)
            .fetch_all(pool)
            .await?;
    rows.into_iter().map(Event::try_from).collect()
}

/// Jobs asked for in one statement; databases bound the number of parameters.
const PULSES: usize = 500;

/// How these jobs stand.
pub(super) async fn pulses(pool: &Pool, ids: &[Uuid]) -> Result<Vec<Pulse>, StoreError> {
    let mut pulses = Vec::with_capacity(ids.len());
    for ids in ids.chunks(PULSES) {
        let mut query: QueryBuilder<Db> =
            QueryBuilder::new(concat!("SELECT event_seq, ", job_columns!(), " FROM job WHERE id IN ("));
        let mut list = query.separated(", ");
        for id in ids {
            list.push_bind(id.to_string());
        }
        query.push(")");
        for row in query.build().fetch_all(pool).await? {
            pulses.push(Pulse { seq: row.try_get("event_seq")?, ..Pulse::try_from(JobRow::from_row(&row)?)? });
        }
    }
    Ok(pulses)
}

/// Jobs that wait and jobs that run.
pub(super) async fn unfinished(pool: &Pool) -> Result<[i64; 2], StoreError> {
    let rows: Vec<(String, i64)> =
        sqlx::query_as("SELECT state, COUNT(*) FROM job WHERE state IN ('queued', 'running') GROUP BY state")
            .fetch_all(pool)
            .await?;
    let count = |state: JobState| rows.iter().find(|(name, _)| name == state.id()).map_or(0, |(_, count)| *count);
    Ok([count(JobState::Queued), count(JobState::Running)])
}
