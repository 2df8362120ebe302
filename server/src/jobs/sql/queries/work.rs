//! What workers write, each behind the fence of its claim, and what users stop.

use super::change::{State, record, tell, wake};
use super::claim::TURNS;
use super::{Connection, Pool, begin, now};
use crate::config::Limits;
use crate::jobs::store::{EventKind, summary};
use crate::jobs::{Claim, Delivered, JobState, Order, StoreError, StoredResult, Tick};
use crate::metrics::{self, FailureReason};
use std::time::Duration;
use uuid::Uuid;

/// Notes how far a shard is.
pub(super) async fn tick(
    pool: &Pool,
    claim: &Claim,
    tick: Tick,
    lease: Duration,
    limits: &Limits,
) -> Result<Order, StoreError> {
    let mut transaction = begin(pool).await?;
    let connection = &mut *transaction;
    let at = now(connection).await?;
    let Some(compute_us) = count_steps(connection, claim, tick).await? else { return Ok(Order::Stop) };
    if !fenced(connection, claim, tick, Some(at + lease.as_micros() as i64)).await? {
        return Ok(Order::Stop);
    }
    if compute_us > limits.compute_s_per_job.saturating_mul(1_000_000) as i64 {
        let reason = format!(
            "the job has computed for {} s, the longest that a job may; split it, or ask for fewer steps",
            limits.compute_s_per_job
        );
        tell(connection, claim.job, State::failed(&reason), at).await?;
        transaction.commit().await?;
        metrics::job_failed(FailureReason::OutOfTime);
        return Ok(Order::Stop);
    }
    let order =
        if tick.turn_over && others_wait(connection, claim, at).await? { Order::Yield } else { Order::Continue };
    transaction.commit().await?;
    Ok(order)
}

/// Adds what a shard has done to its job, which must be running; the job's computing time, µs.
async fn count_steps(connection: &mut Connection, claim: &Claim, tick: Tick) -> Result<Option<i64>, StoreError> {
    let compute_us = sqlx::query_scalar(
        "UPDATE job SET steps_done = steps_done + $2, compute_us = compute_us + $3 \
         WHERE id = $1 AND state = 'running' RETURNING compute_us",
    )
    .bind(claim.job.to_string())
    .bind(tick.steps_done - tick.steps_before)
    .bind(tick.computed.as_micros() as i64)
    .fetch_optional(connection)
    .await?;
    Ok(compute_us)
}

/// Notes how far a shard is, if the claim still holds; whether it does.
pub(super) async fn fenced(
    connection: &mut Connection,
    claim: &Claim,
    tick: Tick,
    lease: Option<i64>,
) -> Result<bool, StoreError> {
    let done = sqlx::query(
        "UPDATE shard SET steps_done = $4, lease_until = COALESCE($5, lease_until), \
         kills = CASE WHEN $6 = 1 THEN 0 ELSE kills END \
         WHERE job_id = $1 AND number = $2 AND attempt = $3 AND state = 'running'",
    )
    .bind(claim.job.to_string())
    .bind(claim.shard)
    .bind(claim.attempt)
    .bind(tick.steps_done)
    .bind(lease)
    .bind(i64::from(tick.saved))
    .execute(connection)
    .await?;
    Ok(done.rows_affected() == 1)
}

/// Whether someone's turn comes before this claim's next one.
async fn others_wait(connection: &mut Connection, claim: &Claim, at: i64) -> Result<bool, StoreError> {
    let own: i64 = sqlx::query_scalar("SELECT COUNT(*) FROM shard WHERE state = 'running' AND owner = $1")
        .bind(&claim.owner)
        .fetch_one(&mut *connection)
        .await?;
    let turns: Vec<(String, i64, i64)> = sqlx::query_as(TURNS).fetch_all(&mut *connection).await?;
    for (owner, running, _) in turns {
        let own_job = owner == claim.owner;
        if !own_job && running >= own {
            continue;
        }
        let next: Option<i64> = sqlx::query_scalar(
            "SELECT priority FROM shard WHERE state = 'queued' AND owner = $1 AND not_before <= $2 \
             ORDER BY priority DESC, job_id, number LIMIT 1",
        )
        .bind(&owner)
        .bind(at)
        .fetch_optional(&mut *connection)
        .await?;
        if next.is_some_and(|priority| !own_job || priority > claim.priority) {
            return Ok(true);
        }
    }
    Ok(false)
}

/// Notes a scenario's result; the last one ends the job.
pub(super) async fn deliver(
    pool: &Pool,
    claim: &Claim,
    result: &StoredResult,
    counted: i64,
    computed: Duration,
) -> Result<Delivered, StoreError> {
    let stop = Delivered { order: Order::Stop, ended: None };
    let mut transaction = begin(pool).await?;
    let connection = &mut *transaction;
    let at = now(connection).await?;
    let counts: Option<(i64, i64, i64)> = sqlx::query_as(
        "UPDATE job SET steps_done = steps_done + $2, compute_us = compute_us + $3, bytes = bytes + $4, \
         scenarios_done = scenarios_done + 1, event_seq = event_seq + 1 \
         WHERE id = $1 AND state = 'running' RETURNING scenarios_done, scenarios, event_seq",
    )
    .bind(claim.job.to_string())
    .bind(result.report.steps as i64 - counted)
    .bind(computed.as_micros() as i64)
    .bind(result.bytes as i64)
    .fetch_optional(&mut *connection)
    .await?;
    let Some((scenarios_done, scenarios, seq)) = counts else { return Ok(stop) };
    // From now on the shard's count is that of its next scenario.
    let forward = Tick { steps_done: 0, steps_before: 0, computed, saved: true, turn_over: false };
    if !fenced(connection, claim, forward, None).await? {
        return Ok(stop);
    }
    // A struct of strings and numbers always becomes JSON.
    let report = serde_json::to_string(&result.report).unwrap_or_default();
    sqlx::query(
        "INSERT INTO result (hash, core_version, report, bytes, checksum, stored_at) VALUES ($1, $2, $3, $4, $5, $6) \
         ON CONFLICT (hash, core_version) DO UPDATE SET report = excluded.report, bytes = excluded.bytes, \
         checksum = excluded.checksum, stored_at = excluded.stored_at",
    )
    .bind(&result.report.scenario_hash)
    .bind(&result.report.core_version)
    .bind(report)
    .bind(result.bytes as i64)
    .bind(&result.checksum)
    .bind(at)
    .execute(&mut *connection)
    .await?;
    let done =
        sqlx::query("UPDATE job_scenario SET core_version = $3 WHERE job_id = $1 AND n = $2 AND core_version IS NULL")
            .bind(claim.job.to_string())
            .bind(result.n)
            .bind(&result.report.core_version)
            .execute(&mut *connection)
            .await?;
    if done.rows_affected() != 1 {
        return Ok(stop);
    }
    record(connection, claim.job, seq, EventKind::Summary, &summary(result.n, &result.report)).await?;
    let mut delivered = Delivered { order: Order::Continue, ended: None };
    if scenarios_done == scenarios {
        tell(connection, claim.job, State::new(JobState::Succeeded), at).await?;
        delivered = Delivered { order: Order::Stop, ended: Some(JobState::Succeeded) };
    } else if result.last {
        sqlx::query("DELETE FROM shard WHERE job_id = $1 AND number = $2")
            .bind(claim.job.to_string())
            .bind(claim.shard)
            .execute(&mut *connection)
            .await?;
    }
    transaction.commit().await?;
    Ok(delivered)
}

/// Gives a shard back for its next turn.
pub(super) async fn release(pool: &Pool, claim: &Claim) -> Result<(), StoreError> {
    let mut transaction = begin(pool).await?;
    let released = sqlx::query(
        "UPDATE shard SET state = 'queued', worker = NULL, not_before = 0 \
         WHERE job_id = $1 AND number = $2 AND attempt = $3 AND state = 'running'",
    )
    .bind(claim.job.to_string())
    .bind(claim.shard)
    .bind(claim.attempt)
    .execute(&mut *transaction)
    .await?;
    if released.rows_affected() == 1 {
        wake(&mut transaction, 1).await?;
    }
    transaction.commit().await?;
    Ok(())
}

/// Fails the job of a claim that still holds.
pub(super) async fn fail(pool: &Pool, claim: &Claim, reason: &str) -> Result<(), StoreError> {
    let mut transaction = begin(pool).await?;
    let connection = &mut *transaction;
    let at = now(connection).await?;
    // First the job's row, as everywhere.
    sqlx::query("UPDATE job SET attempts = attempts WHERE id = $1")
        .bind(claim.job.to_string())
        .execute(&mut *connection)
        .await?;
    let holds: Option<i64> = sqlx::query_scalar(
        "SELECT attempt FROM shard WHERE job_id = $1 AND number = $2 AND attempt = $3 AND state = 'running'",
    )
    .bind(claim.job.to_string())
    .bind(claim.shard)
    .bind(claim.attempt)
    .fetch_optional(&mut *connection)
    .await?;
    if holds.is_some() {
        tell(connection, claim.job, State::failed(reason), at).await?;
    }
    transaction.commit().await?;
    Ok(())
}

/// Cancels a user's job, if there is one that has not ended.
pub(super) async fn cancel(pool: &Pool, owner: &str, id: Uuid) -> Result<(), StoreError> {
    let mut transaction = begin(pool).await?;
    let connection = &mut *transaction;
    let found: Option<String> = sqlx::query_scalar("SELECT id FROM job WHERE id = $1 AND owner = $2")
        .bind(id.to_string())
        .bind(owner)
        .fetch_optional(&mut *connection)
        .await?;
    if found.is_some() {
        let at = now(connection).await?;
        tell(connection, id, State::canceled("canceled on request"), at).await?;
        transaction.commit().await?;
    }
    Ok(())
}
