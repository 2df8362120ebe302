//! A job changes its state: the row, the event, whom to tell; always together.
//!
//! Events are numbered by the job's row, so their numbers follow the order in which changes were committed.

use super::{Connection, push};
use crate::jobs::queue::{TICKETS, WEBHOOKS};
use crate::jobs::store::EventKind;
use crate::jobs::{JobKind, JobState, StoreError};
use crate::metrics;
use crate::webhooks::{Delivery, Webhook};
use apalis::prelude::TaskBuilder;
use jiff::Timestamp;
use serde_json::json;
use uuid::Uuid;

/// Tickets pushed at a time: each wakes one thread somewhere, which wakes its neighbours as long as there is work.
const MOST_TICKETS: usize = 4;

/// A state to change to.
#[derive(Debug, Clone, Copy)]
pub(super) struct State<'a> {
    state: JobState,
    reason: Option<&'a str>,
}

impl<'a> State<'a> {
    /// This state, about which there is nothing more to say.
    pub(super) fn new(state: JobState) -> Self {
        Self { state, reason: None }
    }

    /// The job failed.
    pub(super) fn failed(reason: &'a str) -> Self {
        Self { state: JobState::Failed, reason: Some(reason) }
    }

    /// The job was canceled.
    pub(super) fn canceled(reason: &'a str) -> Self {
        Self { state: JobState::Canceled, reason: Some(reason) }
    }
}

/// What telling of a job's new state takes.
#[derive(Debug, sqlx::FromRow)]
pub(super) struct Teller {
    event_seq: i64,
    webhook: Option<String>,
    kind: String,
    label: Option<String>,
}

/// Brings a job that has not ended into a state, and tells everyone; whether it had not ended. A job that ends has no
/// shards any more: whoever computes one finds its fence gone.
pub(super) async fn tell(connection: &mut Connection, id: Uuid, to: State<'_>, at: i64) -> Result<bool, StoreError> {
    let State { state, reason } = to;
    let teller: Option<Teller> = sqlx::query_as(
        "UPDATE job SET state = $2, reason = $3, event_seq = event_seq + 1, \
         started_at = CASE WHEN $4 = 1 THEN COALESCE(started_at, $6) ELSE started_at END, \
         finished_at = CASE WHEN $5 = 1 THEN $6 ELSE finished_at END \
         WHERE id = $1 AND state IN ('queued', 'running') RETURNING event_seq, webhook, kind, label",
    )
    .bind(id.to_string())
    .bind(state.id())
    .bind(reason)
    .bind(i64::from(state == JobState::Running))
    .bind(i64::from(state.is_final()))
    .bind(at)
    .fetch_optional(&mut *connection)
    .await?;
    let Some(teller) = teller else { return Ok(false) };
    if state.is_final() {
        sqlx::query("DELETE FROM shard WHERE job_id = $1").bind(id.to_string()).execute(&mut *connection).await?;
        metrics::job_ended(JobKind::from_id(&teller.kind).map_or("unknown", JobKind::id), state);
    }
    announce(connection, id, teller, to, at).await?;
    Ok(true)
}

/// Tells of a state that the job's row has already.
pub(super) async fn announce(
    connection: &mut Connection,
    id: Uuid,
    Teller { event_seq, webhook, kind, label }: Teller,
    State { state, reason }: State<'_>,
    at: i64,
) -> Result<(), StoreError> {
    let when = Timestamp::from_microsecond(at).map_err(|_| StoreError::Damaged(format!("the time {at}")))?;
    let mut told = json!({ "id": id, "state": state, "at": when });
    if let Some(reason) = reason {
        told["reason"] = reason.into();
    }
    record(connection, id, event_seq, EventKind::State, &told.to_string()).await?;
    let Some(webhook) = webhook else { return Ok(()) };
    let Webhook { url, secret } = serde_json::from_str(&webhook)
        .map_err(|error| StoreError::Damaged(format!("a webhook that cannot be read: {error}")))?;
    told["kind"] = kind.into();
    told["label"] = label.into();
    let (event_id, event_type) = (format!("{id}.{event_seq}"), format!("job.{}", state.id()));
    let body = json!({ "id": event_id, "type": event_type, "created_at": when, "data": told }).to_string();
    let delivery = Delivery { event_id, event_type, job: id, url, secret, body, attempt: 1 };
    // A struct of strings and numbers always becomes JSON.
    let payload = serde_json::to_vec(&delivery).unwrap_or_default();
    push(connection, WEBHOOKS, vec![TaskBuilder::new(payload).max_attempts(1).build()]).await
}

/// Writes an event down, under a number that its job has counted already.
pub(super) async fn record(
    connection: &mut Connection,
    id: Uuid,
    seq: i64,
    kind: EventKind,
    data: &str,
) -> Result<(), StoreError> {
    sqlx::query("INSERT INTO event (job_id, seq, kind, data) VALUES ($1, $2, $3, $4)")
        .bind(id.to_string())
        .bind(seq)
        .bind(kind.id())
        .bind(data)
        .execute(connection)
        .await?;
    Ok(())
}

/// Wakes as many workers as there are shards, in reason. What a ticket brings them to is decided by the tables.
pub(super) async fn wake(connection: &mut Connection, shards: usize) -> Result<(), StoreError> {
    if shards == 0 {
        return Ok(());
    }
    let ticket = || TaskBuilder::new(b"null".to_vec()).max_attempts(1).build();
    push(connection, TICKETS, std::iter::repeat_with(ticket).take(shards.min(MOST_TICKETS)).collect()).await
}
