//! Experiments in the tables: rows come in part by part, each step's last one has them folded, and what the fold says ends the
//! job or begins its next step. All in transactions behind the fence of a claim, so whoever dies leaves one state or the next.

use super::change::{State, record, tell, wake};
use super::rows::ShardRow;
use super::submit::insert_shards;
use super::work::fenced;
use super::{Connection, Pool, begin, now};
use crate::jobs::plan::Shard;
use crate::jobs::store::EventKind;
use crate::jobs::{
    Claim, Delivered, ExperimentRow, Folded, JobKind, JobState, MadeRuns, NewExperiment, NextStep, Order, Part,
    PartWork, StoreError, Tick,
};
use sqlx::Row;
use std::time::Duration;
use uuid::Uuid;

/// How often what is there is summed up on the way to the end.
const SUMS: i64 = 10;

/// What a claim that does not hold any more is told.
const STOP: Delivered = Delivered { order: Order::Stop, ended: None };

/// Keeps a new job's experiment.
pub(super) async fn insert(
    connection: &mut Connection,
    id: Uuid,
    experiment: &NewExperiment,
) -> Result<(), StoreError> {
    sqlx::query(
        "INSERT INTO experiment (job_id, hash, document, core_version, planned, next_shard) \
         VALUES ($1, $2, $3, $4, $5, $6)",
    )
    .bind(id.to_string())
    .bind(&experiment.hash)
    .bind(&experiment.document)
    .bind(adaptarm_core::VERSION)
    .bind(experiment.planned as i64)
    .bind(experiment.shards.len() as i64)
    .execute(connection)
    .await?;
    Ok(())
}

/// What is to be done of an experiment's shard.
pub(super) async fn part(connection: &mut Connection, job: &str, shard: &ShardRow) -> Result<Part, StoreError> {
    let row = sqlx::query("SELECT hash, document, core_version, step, state FROM experiment WHERE job_id = $1")
        .bind(job)
        .fetch_one(connection)
        .await?;
    let range = shard.first..shard.first + shard.count;
    Ok(Part {
        hash: row.try_get("hash")?,
        document: row.try_get("document")?,
        core_version: row.try_get("core_version")?,
        step: row.try_get("step")?,
        state: row.try_get("state")?,
        work: if shard.folds == 0 { PartWork::Runs(range) } else { PartWork::Fold },
    })
}

/// Keeps the rows of a part. The last ones of a step have it folded, and so has every tenth of them on the way.
pub(super) async fn deliver_runs(
    pool: &Pool,
    claim: &Claim,
    made: &MadeRuns,
    counted: i64,
    computed: Duration,
) -> Result<Delivered, StoreError> {
    let mut transaction = begin(pool).await?;
    let connection = &mut *transaction;
    let bytes = made.packed.len() as i64;
    let Some(kind) = count(connection, claim, [made.steps - counted, bytes], computed).await? else { return Ok(STOP) };
    if !done(connection, claim).await? {
        return Ok(STOP);
    }
    sqlx::query("INSERT INTO experiment_rows (job_id, step, first, count, packed) VALUES ($1, $2, $3, $4, $5)")
        .bind(claim.job.to_string())
        .bind(made.step)
        .bind(made.first)
        .bind(made.count)
        .bind(&made.packed)
        .execute(&mut *connection)
        .await?;
    let row = sqlx::query(
        "UPDATE experiment SET done = done + $2 WHERE job_id = $1 RETURNING planned, done, summed, next_shard",
    )
    .bind(claim.job.to_string())
    .bind(made.count)
    .fetch_one(&mut *connection)
    .await?;
    let [planned, done, summed, number] = ["planned", "done", "summed", "next_shard"].map(|name| row.try_get(name));
    let (planned, done, summed, number): (i64, i64, i64, i64) = (planned?, done?, summed?, number?);
    // A tuning learns from whole generations, and counts candidates.
    let in_parts = kind != JobKind::Tuning.id();
    let is_due = done == planned || in_parts && (SUMS * done) / planned > (SUMS * summed) / planned;
    if is_due {
        add_fold(connection, claim, number, done).await?;
    }
    if in_parts {
        sqlx::query("UPDATE job SET scenarios_done = scenarios_done + $2 WHERE id = $1")
            .bind(claim.job.to_string())
            .bind(made.count)
            .execute(&mut *connection)
            .await?;
    }
    transaction.commit().await?;
    Ok(Delivered { order: Order::Continue, ended: None })
}

/// Adds what a part has done to its job, which must be running; the job's kind.
async fn count(
    connection: &mut Connection,
    claim: &Claim,
    [steps, bytes]: [i64; 2],
    computed: Duration,
) -> Result<Option<String>, StoreError> {
    let kind = sqlx::query_scalar(
        "UPDATE job SET steps_done = steps_done + $2, compute_us = compute_us + $3, bytes = bytes + $4 \
         WHERE id = $1 AND state = 'running' RETURNING kind",
    )
    .bind(claim.job.to_string())
    .bind(steps)
    .bind(computed.as_micros() as i64)
    .bind(bytes)
    .fetch_optional(connection)
    .await?;
    Ok(kind)
}

/// Removes the shard of a claim that still holds; whether it does.
async fn done(connection: &mut Connection, claim: &Claim) -> Result<bool, StoreError> {
    let forward = Tick { steps_done: 0, steps_before: 0, computed: Duration::ZERO, saved: true, turn_over: false };
    if !fenced(connection, claim, forward, None).await? {
        return Ok(false);
    }
    sqlx::query("DELETE FROM shard WHERE job_id = $1 AND number = $2")
        .bind(claim.job.to_string())
        .bind(claim.shard)
        .execute(connection)
        .await?;
    Ok(true)
}

/// Adds a shard that folds. Its number is negative, so that it comes before the runs that are left.
async fn add_fold(connection: &mut Connection, claim: &Claim, number: i64, summed: i64) -> Result<(), StoreError> {
    sqlx::query(
        "INSERT INTO shard (job_id, number, owner, priority, first, count, state, folds) \
         VALUES ($1, $2, $3, $4, 0, 0, 'queued', 1)",
    )
    .bind(claim.job.to_string())
    .bind(-number - 1)
    .bind(&claim.owner)
    .bind(claim.priority)
    .execute(&mut *connection)
    .await?;
    sqlx::query("UPDATE experiment SET next_shard = next_shard + 1, summed = $2 WHERE job_id = $1")
        .bind(claim.job.to_string())
        .bind(summed)
        .execute(&mut *connection)
        .await?;
    wake(connection, 1).await
}

/// Keeps what the rows of a step came to, and begins what comes next or ends the job.
pub(super) async fn deliver_fold(
    pool: &Pool,
    claim: &Claim,
    folded: &Folded,
    computed: Duration,
) -> Result<Delivered, StoreError> {
    let mut transaction = begin(pool).await?;
    let connection = &mut *transaction;
    let at = now(connection).await?;
    if count(connection, claim, [0, 0], computed).await?.is_none() || !done(connection, claim).await? {
        return Ok(STOP);
    }
    let id = claim.job.to_string();
    let kept = sqlx::query(
        "UPDATE experiment SET summary = $3, state = COALESCE($4, state) WHERE job_id = $1 AND step = $2 RETURNING next_shard",
    )
    .bind(&id)
    .bind(folded.step)
    .bind(&folded.summary)
    .bind(&folded.state)
    .fetch_optional(&mut *connection)
    .await?;
    let Some(kept) = kept else { return Ok(STOP) };
    if let Some(candidates) = folded.candidates {
        // The last generation may go beyond what was asked for.
        sqlx::query("UPDATE job SET scenarios_done = $2, scenarios = CASE WHEN $3 = 1 OR scenarios < $2 THEN $2 ELSE scenarios END WHERE id = $1")
            .bind(&id)
            .bind(candidates)
            .bind(i64::from(folded.next == NextStep::End))
            .execute(&mut *connection)
            .await?;
    }
    tell_partial(connection, claim.job, &folded.digest).await?;
    match &folded.next {
        NextStep::Rest => {}
        NextStep::Step(planned, shards) => {
            begin_step(connection, claim, kept.try_get("next_shard")?, *planned, shards).await?;
        }
        NextStep::End => {
            tell(connection, claim.job, State::new(JobState::Succeeded), at).await?;
        }
    }
    transaction.commit().await?;
    let ended = (folded.next == NextStep::End).then_some(JobState::Succeeded);
    Ok(Delivered { order: Order::Continue, ended })
}

/// Tells how the experiment stands; what was told before is of no use any more.
async fn tell_partial(connection: &mut Connection, id: Uuid, digest: &str) -> Result<(), StoreError> {
    let seq: i64 = sqlx::query_scalar("UPDATE job SET event_seq = event_seq + 1 WHERE id = $1 RETURNING event_seq")
        .bind(id.to_string())
        .fetch_one(&mut *connection)
        .await?;
    sqlx::query("DELETE FROM event WHERE job_id = $1 AND kind = $2")
        .bind(id.to_string())
        .bind(EventKind::Partial.id())
        .execute(&mut *connection)
        .await?;
    record(connection, id, seq, EventKind::Partial, digest).await
}

/// Begins the next step of a tuning; the rows of the one before have been learnt from.
async fn begin_step(
    connection: &mut Connection,
    claim: &Claim,
    number: i64,
    planned: i64,
    shards: &[Shard],
) -> Result<(), StoreError> {
    let id = claim.job.to_string();
    sqlx::query("DELETE FROM experiment_rows WHERE job_id = $1").bind(&id).execute(&mut *connection).await?;
    sqlx::query(
        "UPDATE experiment SET step = step + 1, planned = $2, done = 0, summed = 0, next_shard = $3 WHERE job_id = $1",
    )
    .bind(&id)
    .bind(planned)
    .bind(number + shards.len() as i64)
    .execute(&mut *connection)
    .await?;
    insert_shards(connection, claim.job, (claim.owner.as_str(), claim.priority), number, shards).await?;
    wake(connection, shards.len()).await
}

/// The experiment of a job.
pub(super) async fn find(pool: &Pool, id: Uuid) -> Result<Option<ExperimentRow>, StoreError> {
    let row = sqlx::query(
        "SELECT hash, document, core_version, step, done, state, summary FROM experiment WHERE job_id = $1",
    )
    .bind(id.to_string())
    .fetch_optional(pool)
    .await?;
    let Some(row) = row else { return Ok(None) };
    Ok(Some(ExperimentRow {
        hash: row.try_get("hash")?,
        document: row.try_get("document")?,
        core_version: row.try_get("core_version")?,
        step: row.try_get("step")?,
        done: row.try_get("done")?,
        state: row.try_get("state")?,
        summary: row.try_get("summary")?,
    }))
}

/// Packed rows of a step, in order.
pub(super) async fn packed_rows(
    pool: &Pool,
    id: Uuid,
    step: i64,
    from: i64,
    limit: i64,
) -> Result<Vec<(i64, Vec<u8>)>, StoreError> {
    let rows = sqlx::query_as(
        "SELECT first, packed FROM experiment_rows WHERE job_id = $1 AND step = $2 AND first >= $3 ORDER BY first LIMIT $4",
    )
    .bind(id.to_string())
    .bind(step)
    .bind(from)
    .bind(limit)
    .fetch_all(pool)
    .await?;
    Ok(rows)
}
