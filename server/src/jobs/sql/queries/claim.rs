//! Whose turn it is, and what becomes of shards whose worker vanished.

use super::change::{State, tell};
use super::rows::{self, ShardRow};
use super::{Connection, Pool, begin, experiment, now, one_at_a_time};
use crate::jobs::{Claim, JobKind, JobState, StoreError, Task};
use crate::metrics::{self, FailureReason};
use sqlx::Row;
use std::time::Duration;
use uuid::Uuid;

/// So often a shard may lose its worker without having come forward.
const MOST_KILLS: i64 = 3;

/// How long a shard that has lost its worker waits for its next try, µs; twice as long after the second time.
const BACK_OFF_US: i64 = 2_000_000;

/// Vanished workers' shards given back in one transaction.
const EXPIRED: i64 = 100;

/// Users with waiting shards, those with the fewest running ones first, then who waited longest.
///
/// The recursion leaps from user to user along the index instead of reading every waiting shard.
pub(super) const TURNS: &str = "WITH RECURSIVE waiting(owner) AS ( \
     SELECT MIN(owner) FROM shard WHERE state = 'queued' \
     UNION ALL \
     SELECT (SELECT MIN(owner) FROM shard WHERE state = 'queued' AND owner > waiting.owner) \
     FROM waiting WHERE waiting.owner IS NOT NULL) \
     SELECT owner, (SELECT COUNT(*) FROM shard s WHERE s.state = 'running' AND s.owner = waiting.owner) AS running, \
     COALESCE((SELECT served_at FROM turn t WHERE t.owner = waiting.owner), 0) AS served \
     FROM waiting WHERE owner IS NOT NULL ORDER BY running, served";

/// Takes the shard whose turn it is.
pub(super) async fn claim(pool: &Pool, worker: &str, lease: Duration) -> Result<Option<Claim>, StoreError> {
    let mut transaction = begin(pool).await?;
    let connection = &mut *transaction;
    one_at_a_time(connection).await?;
    let at = now(connection).await?;
    give_back_expired(connection, at).await?;
    let turns: Vec<(String, i64, i64)> = sqlx::query_as(TURNS).fetch_all(&mut *connection).await?;
    let mut claimed = None;
    for (owner, _, _) in turns {
        claimed = claim_of(connection, &owner, worker, at, lease).await?;
        if claimed.is_some() {
            break;
        }
    }
    transaction.commit().await?;
    Ok(claimed)
}

/// Takes a user's next shard.
async fn claim_of(
    connection: &mut Connection,
    owner: &str,
    worker: &str,
    at: i64,
    lease: Duration,
) -> Result<Option<Claim>, StoreError> {
    let next: Option<(String, i64)> = sqlx::query_as(
        "SELECT job_id, number FROM shard WHERE state = 'queued' AND owner = $1 AND not_before <= $2 \
         ORDER BY priority DESC, job_id, number LIMIT 1",
    )
    .bind(owner)
    .bind(at)
    .fetch_optional(&mut *connection)
    .await?;
    let Some((job, number)) = next else { return Ok(None) };
    let id = rows::id(&job)?;
    // First the job's row: whoever cancels it at this moment is waited for.
    let row = sqlx::query(
        "UPDATE job SET attempts = attempts WHERE id = $1 AND state IN ('queued', 'running') RETURNING state, label, priority, attempts, kind",
    )
    .bind(&job)
    .fetch_optional(&mut *connection)
    .await?;
    let Some(row) = row else { return Ok(None) };
    let shard: Option<ShardRow> = sqlx::query_as(
        "UPDATE shard SET state = 'running', attempt = attempt + 1, worker = $3, lease_until = $4 \
         WHERE job_id = $1 AND number = $2 AND state = 'queued' \
         RETURNING number, owner, first, count, attempt, kills, steps_done, folds",
    )
    .bind(&job)
    .bind(number)
    .bind(worker)
    .bind(at + lease.as_micros() as i64)
    .fetch_optional(&mut *connection)
    .await?;
    let Some(shard) = shard else { return Ok(None) };
    if shard.attempt > row.try_get::<i64, _>("attempts")? {
        sqlx::query("UPDATE job SET attempts = $2 WHERE id = $1")
            .bind(&job)
            .bind(shard.attempt)
            .execute(&mut *connection)
            .await?;
    }
    sqlx::query(
        "INSERT INTO turn (owner, served_at) VALUES ($1, $2) \
         ON CONFLICT (owner) DO UPDATE SET served_at = excluded.served_at",
    )
    .bind(owner)
    .bind(at)
    .execute(&mut *connection)
    .await?;
    if row.try_get::<String, _>("state")? == JobState::Queued.id() {
        tell(connection, id, State::new(JobState::Running), at).await?;
    }
    let task = if row.try_get::<String, _>("kind")? == JobKind::Study.id() {
        Task::Scenarios(scenarios(connection, &job, &shard).await?)
    } else {
        Task::Part(experiment::part(connection, &job, &shard).await?)
    };
    Ok(Some(Claim {
        job: id,
        owner: shard.owner,
        label: row.try_get("label")?,
        priority: row.try_get("priority")?,
        shard: shard.number,
        attempt: shard.attempt,
        suspect: shard.kills > 0,
        steps_done: shard.steps_done,
        task,
    }))
}

/// What is left to compute of a study's shard.
async fn scenarios(connection: &mut Connection, job: &str, shard: &ShardRow) -> Result<Vec<(i64, String)>, StoreError> {
    let scenarios = sqlx::query_as(
        "SELECT n, document FROM job_scenario \
         WHERE job_id = $1 AND n >= $2 AND n < $3 AND core_version IS NULL ORDER BY n",
    )
    .bind(job)
    .bind(shard.first)
    .bind(shard.first + shard.count)
    .fetch_all(connection)
    .await?;
    Ok(scenarios)
}

/// Gives back what was claimed by workers that did not come back in time.
async fn give_back_expired(connection: &mut Connection, at: i64) -> Result<u64, StoreError> {
    let expired: Vec<(String, i64)> = sqlx::query_as(
        "SELECT job_id, number FROM shard WHERE state = 'running' AND lease_until < $1 ORDER BY job_id, number LIMIT $2",
    )
    .bind(at)
    .bind(EXPIRED)
    .fetch_all(&mut *connection)
    .await?;
    for (job, number) in &expired {
        give_back(connection, rows::id(job)?, *number, at).await?;
    }
    Ok(expired.len() as u64)
}

/// Gives back one shard whose worker vanished, unless it has vanished too often with it.
async fn give_back(connection: &mut Connection, job: Uuid, number: i64, at: i64) -> Result<(), StoreError> {
    sqlx::query("UPDATE job SET attempts = attempts WHERE id = $1")
        .bind(job.to_string())
        .execute(&mut *connection)
        .await?;
    let kills: Option<i64> = sqlx::query_scalar(
        "UPDATE shard SET state = 'queued', worker = NULL, kills = kills + 1, not_before = $3 + $4 * (kills + 1) \
         WHERE job_id = $1 AND number = $2 AND state = 'running' AND lease_until < $3 RETURNING kills",
    )
    .bind(job.to_string())
    .bind(number)
    .bind(at)
    .bind(BACK_OFF_US)
    .fetch_optional(&mut *connection)
    .await?;
    if kills.is_some_and(|kills| kills >= MOST_KILLS) {
        let reason = format!(
            "part {number} of the job lost its worker {MOST_KILLS} times without coming forward: most likely it makes \
             the process fail"
        );
        tracing::error!(%job, "{reason}");
        metrics::job_failed(FailureReason::OutOfAttempts);
        tell(connection, job, State::failed(&reason), at).await?;
    }
    Ok(())
}

/// Gives back every running shard, how many: whoever had them is known to be dead.
pub(super) async fn bury_all(pool: &Pool) -> Result<u64, StoreError> {
    let mut buried = 0;
    loop {
        let mut transaction = begin(pool).await?;
        sqlx::query("UPDATE shard SET lease_until = 0 WHERE state = 'running'").execute(&mut *transaction).await?;
        let at = now(&mut transaction).await?;
        let count = give_back_expired(&mut transaction, at).await?;
        transaction.commit().await?;
        buried += count;
        if count < EXPIRED as u64 {
            return Ok(buried);
        }
    }
}
