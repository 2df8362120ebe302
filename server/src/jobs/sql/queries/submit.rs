//! Accepting a job: idempotency, the user's limits, what is known already, the plan; all in one transaction.

use super::change::{State, Teller, announce, record, tell, wake};
use super::rows::{JobRow, job_columns};
use super::{Connection, Db, Pool, begin, experiment, now, while_submitting};
use crate::config::Limits;
use crate::jobs::plan::{Shard, plan};
use crate::jobs::store::{EventKind, summary};
use crate::jobs::{Job, JobState, NewJob, NewScenario, NewWork, StoreError, Submitted};
use adaptarm_core::scenario::Report;
use sqlx::{FromRow, QueryBuilder, Row};
use std::collections::BTreeMap;
use tokio::sync::{mpsc, oneshot};
use uuid::Uuid;

/// Rows written or hashes asked for in one statement; databases bound the number of parameters.
const BATCH: usize = 500;

/// Most jobs accepted in one transaction.
pub(super) const TOGETHER: usize = 64;

/// A job that waits to be accepted together with others.
pub(super) struct Waiting {
    /// The job.
    pub(super) job: NewJob,
    /// What it must keep to.
    pub(super) limits: Limits,
    /// Where its sender waits.
    pub(super) answer: oneshot::Sender<Result<Submitted, StoreError>>,
}

/// Accepts whatever waits, many jobs in one transaction: with one writer, beginning and committing is most of the work.
pub(super) async fn accept_together(pool: Pool, mut waiting: mpsc::Receiver<Waiting>) {
    let mut batch = Vec::new();
    while waiting.recv_many(&mut batch, TOGETHER).await > 0 {
        let accepted = together(&pool, &batch).await;
        let answers = accepted.unwrap_or_else(|error| {
            // All of them or none: each is told the same.
            let why = error.to_string();
            batch.iter().map(|_| Err(StoreError::Queue(why.clone()))).collect()
        });
        for (Waiting { answer, .. }, accepted) in batch.drain(..).zip(answers) {
            // Whoever went away meanwhile finds the job by its key.
            let _ = answer.send(accepted);
        }
    }
}

/// Accepts these jobs in one transaction. What refuses one of them leaves no trace of it, and the others go on.
async fn together(pool: &Pool, batch: &[Waiting]) -> Result<Vec<Result<Submitted, StoreError>>, StoreError> {
    let mut transaction = begin(pool).await?;
    let (mut accepted, mut shards) = (Vec::with_capacity(batch.len()), 0);
    for Waiting { job, limits, .. } in batch {
        match attempt(&mut transaction, job, limits).await {
            Ok((submitted, planned)) => {
                accepted.push(Ok(submitted));
                shards += planned;
            }
            Err(refusal @ (StoreError::Quota { .. } | StoreError::KeyReused { .. })) => accepted.push(Err(refusal)),
            Err(error) => return Err(error),
        }
    }
    wake(&mut transaction, shards).await?;
    transaction.commit().await?;
    Ok(accepted)
}

/// Accepts a job in a transaction of its own.
pub(super) async fn submit(pool: &Pool, job: &NewJob, limits: &Limits) -> Result<Submitted, StoreError> {
    match alone(pool, job, limits).await {
        // Another request with the same key came first, a moment ago: now its job can be seen.
        Err(StoreError::Database(error)) if is_doubled(&error) => alone(pool, job, limits).await,
        done => done,
    }
}

fn is_doubled(error: &sqlx::Error) -> bool {
    error.as_database_error().is_some_and(sqlx::error::DatabaseError::is_unique_violation)
}

async fn alone(pool: &Pool, job: &NewJob, limits: &Limits) -> Result<Submitted, StoreError> {
    let mut transaction = begin(pool).await?;
    let (submitted, shards) = attempt(&mut transaction, job, limits).await?;
    wake(&mut transaction, shards).await?;
    transaction.commit().await?;
    Ok(submitted)
}

/// Accepts a job as part of a transaction, and says for how many shards to wake someone. Every refusal comes before the
/// first thing written.
async fn attempt(connection: &mut Connection, job: &NewJob, limits: &Limits) -> Result<(Submitted, usize), StoreError> {
    while_submitting(connection, &job.owner).await?;
    if let Some(job) = repeated(connection, job).await? {
        return Ok((Submitted { job, repeated: true }, 0));
    }
    check_quotas(connection, &job.owner, job.work.steps(), limits).await?;
    let known = known_reports(connection, job).await?;
    let shards = match &job.work {
        NewWork::Study(scenarios) => plan(
            scenarios.iter().map(|scenario| (!known.contains_key(scenario.hash.as_str())).then_some(scenario.cost_us)),
        ),
        NewWork::Experiment(experiment) => experiment.shards.clone(),
    };
    let id = Uuid::now_v7();
    let at = now(connection).await?;
    let (accepted, teller) = insert_job(connection, id, job, &known, at).await?;
    match &job.work {
        NewWork::Study(scenarios) => insert_scenarios(connection, id, scenarios, &known).await?,
        NewWork::Experiment(experiment) => experiment::insert(connection, id, experiment).await?,
    }
    insert_shards(connection, id, (job.owner.as_str(), job.priority), 0, &shards).await?;
    announce(connection, id, teller, State::new(JobState::Queued), at).await?;
    if !known.is_empty() {
        insert_summaries(connection, id, job, &known).await?;
    }
    if !shards.is_empty() {
        return Ok((Submitted { job: accepted, repeated: false }, shards.len()));
    }
    tell(connection, id, State::new(JobState::Succeeded), at).await?;
    let row: JobRow = sqlx::query_as(concat!("SELECT ", job_columns!(), " FROM job WHERE id = $1"))
        .bind(id.to_string())
        .fetch_one(connection)
        .await?;
    Ok((Submitted { job: Job::try_from(row)?, repeated: false }, 0))
}

/// The job that the same request made before.
async fn repeated(connection: &mut Connection, job: &NewJob) -> Result<Option<Job>, StoreError> {
    let Some((key, hash)) = &job.idempotency else { return Ok(None) };
    let row = sqlx::query(concat!(
        "SELECT request_hash, ",
        job_columns!(),
        " FROM job WHERE owner = $1 AND idempotency_key = $2"
    ))
    .bind(&job.owner)
    .bind(key)
    .fetch_optional(connection)
    .await?;
    let Some(row) = row else { return Ok(None) };
    if row.try_get::<Option<String>, _>("request_hash")?.as_ref() != Some(hash) {
        return Err(StoreError::KeyReused { key: key.clone() });
    }
    Job::try_from(JobRow::from_row(&row)?).map(Some)
}

async fn check_quotas(connection: &mut Connection, owner: &str, steps: u64, limits: &Limits) -> Result<(), StoreError> {
    let (jobs, waiting, bytes): (i64, i64, i64) = sqlx::query_as(
        "SELECT COUNT(*), \
         CAST(COALESCE(SUM(CASE WHEN steps_total > steps_done THEN steps_total - steps_done ELSE 0 END), 0) AS BIGINT), \
         (SELECT CAST(COALESCE(SUM(bytes), 0) AS BIGINT) FROM job WHERE owner = $1) \
         FROM job WHERE owner = $1 AND state IN ('queued', 'running')",
    )
    .bind(owner)
    .fetch_one(connection)
    .await?;
    let quotas = [
        ("unfinished jobs", jobs, 1, limits.unfinished_jobs_per_user),
        ("integration steps waiting or under way", waiting, steps, limits.queued_steps_per_user),
        ("bytes of stored results", bytes, 0, limits.stored_bytes_per_user),
    ];
    for (what, found, more, most) in quotas {
        // An adaptive method may have taken more steps than were planned.
        let found = found.max(0) as u64;
        if found.saturating_add(more) > most {
            return Err(StoreError::Quota { what, found, more, most });
        }
    }
    Ok(())
}

/// Reports that are stored already, by scenario hash.
async fn known_reports<'a>(
    connection: &mut Connection,
    job: &'a NewJob,
) -> Result<BTreeMap<&'a str, Report>, StoreError> {
    let mut known = BTreeMap::new();
    for scenarios in job.work.scenarios().chunks(BATCH) {
        let mut query: QueryBuilder<Db> = QueryBuilder::new("SELECT hash, report FROM result WHERE core_version = ");
        query.push_bind(adaptarm_core::VERSION).push(" AND hash IN (");
        let mut list = query.separated(", ");
        for scenario in scenarios {
            list.push_bind(&scenario.hash);
        }
        query.push(")");
        for row in query.build().fetch_all(&mut *connection).await? {
            let (hash, report): (String, String) = (row.try_get("hash")?, row.try_get("report")?);
            let report: Report = match serde_json::from_str(&report) {
                Ok(report) => report,
                Err(error) => {
                    tracing::warn!(
                        "the stored report of scenario {hash} cannot be read and is computed again: {error}"
                    );
                    continue;
                }
            };
            if let Some(scenario) = scenarios.iter().find(|scenario| scenario.hash == hash) {
                known.insert(scenario.hash.as_str(), report);
            }
        }
    }
    Ok(known)
}

async fn insert_job(
    connection: &mut Connection,
    id: Uuid,
    job: &NewJob,
    known: &BTreeMap<&str, Report>,
    at: i64,
) -> Result<(Job, Teller), StoreError> {
    let done = |scenario: &&NewScenario| known.contains_key(scenario.hash.as_str());
    let scenarios = job.work.scenarios().iter();
    let (count_done, steps_done) =
        scenarios.filter(done).fold((0, 0), |(count, sum), scenario| (count + 1, sum + scenario.steps));
    // A webhook is two strings.
    let webhook = job.webhook.as_ref().map(|webhook| serde_json::to_string(webhook).unwrap_or_default());
    let (key, hash) = job.idempotency.clone().unzip();
    let row = sqlx::query(concat!(
        "INSERT INTO job (id, owner, kind, label, priority, state, cached, created_at, scenarios, scenarios_done, \
         steps_total, steps_done, bytes, webhook, idempotency_key, request_hash, event_seq) \
         VALUES ($1, $2, $3, $4, $5, 'queued', $6, $7, $8, $9, $10, $11, 0, $12, $13, $14, 1) \
         RETURNING event_seq, webhook, ",
        job_columns!()
    ))
    .bind(id.to_string())
    .bind(&job.owner)
    .bind(job.kind.id())
    .bind(&job.label)
    .bind(job.priority)
    .bind(i64::from(count_done == job.work.count()))
    .bind(at)
    .bind(job.work.count() as i64)
    .bind(count_done as i64)
    .bind(job.work.steps() as i64)
    .bind(steps_done as i64)
    .bind(webhook)
    .bind(key)
    .bind(hash)
    .fetch_one(connection)
    .await?;
    Ok((Job::try_from(JobRow::from_row(&row)?)?, Teller::from_row(&row)?))
}

/// Tells of what was known already, behind the event that the job was accepted.
async fn insert_summaries(
    connection: &mut Connection,
    id: Uuid,
    job: &NewJob,
    known: &BTreeMap<&str, Report>,
) -> Result<(), StoreError> {
    let mut seq = 1;
    for (n, scenario) in job.work.scenarios().iter().enumerate() {
        if let Some(report) = known.get(scenario.hash.as_str()) {
            seq += 1;
            record(connection, id, seq, EventKind::Summary, &summary(n as i64, report)).await?;
        }
    }
    sqlx::query("UPDATE job SET event_seq = $2 WHERE id = $1")
        .bind(id.to_string())
        .bind(seq)
        .execute(connection)
        .await?;
    Ok(())
}

async fn insert_scenarios(
    connection: &mut Connection,
    id: Uuid,
    scenarios: &[NewScenario],
    known: &BTreeMap<&str, Report>,
) -> Result<(), StoreError> {
    let numbered: Vec<_> = scenarios.iter().enumerate().collect();
    for scenarios in numbered.chunks(BATCH) {
        let mut query: QueryBuilder<Db> =
            QueryBuilder::new("INSERT INTO job_scenario (job_id, n, hash, document, core_version) ");
        query.push_values(scenarios, |mut row, (n, scenario)| {
            let version = known.contains_key(scenario.hash.as_str()).then_some(adaptarm_core::VERSION);
            row.push_bind(id.to_string())
                .push_bind(*n as i64)
                .push_bind(&scenario.hash)
                .push_bind(&scenario.document)
                .push_bind(version);
        });
        query.build().execute(&mut *connection).await?;
    }
    Ok(())
}

/// Adds shards to a job of this owner and priority, numbered from `number` on.
pub(super) async fn insert_shards(
    connection: &mut Connection,
    id: Uuid,
    (owner, priority): (&str, i64),
    number: i64,
    shards: &[Shard],
) -> Result<(), StoreError> {
    let numbered: Vec<_> = (number..).zip(shards).collect();
    for shards in numbered.chunks(BATCH) {
        let mut query: QueryBuilder<Db> =
            QueryBuilder::new("INSERT INTO shard (job_id, number, owner, priority, first, count, state) ");
        query.push_values(shards, |mut row, (number, shard)| {
            row.push_bind(id.to_string())
                .push_bind(*number)
                .push_bind(owner)
                .push_bind(priority)
                .push_bind(shard.first as i64)
                .push_bind(shard.count as i64)
                .push_bind("queued");
        });
        query.build().execute(&mut *connection).await?;
    }
    Ok(())
}
