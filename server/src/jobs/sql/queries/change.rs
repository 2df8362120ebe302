//! A job changes its state: the row, the event, whom to tell; always together.

use super::{Connection, push};
use crate::jobs::queue::{TICKETS, WEBHOOKS};
use crate::jobs::store::EventKind;
use crate::jobs::{JobState, StoreError};
use crate::webhooks::{Delivery, Webhook};
use apalis::prelude::TaskBuilder;
use jiff::Timestamp;
use serde_json::json;
use sqlx::Row;
use uuid::Uuid;

/// Tickets pushed at a time: enough to wake every thread of a good many machines.
const MOST_TICKETS: usize = 64;

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

/// Brings a job that has not ended into a state, and tells everyone; whether it had not ended. A job that ends has no
/// shards any more: whoever computes one finds its fence gone.
pub(super) async fn tell(
    connection: &mut Connection,
    id: Uuid,
    State { state, reason }: State<'_>,
    at: i64,
) -> Result<bool, StoreError> {
    let row = sqlx::query(
        "UPDATE job SET state = $2, reason = $3, \
         started_at = CASE WHEN $4 = 1 THEN COALESCE(started_at, $6) ELSE started_at END, \
         finished_at = CASE WHEN $5 = 1 THEN $6 ELSE finished_at END \
         WHERE id = $1 AND state IN ('queued', 'running') RETURNING webhook, kind, label",
    )
    .bind(id.to_string())
    .bind(state.id())
    .bind(reason)
    .bind(i64::from(state == JobState::Running))
    .bind(i64::from(state.is_final()))
    .bind(at)
    .fetch_optional(&mut *connection)
    .await?;
    let Some(row) = row else { return Ok(false) };
    let when = Timestamp::from_microsecond(at).map_err(|_| StoreError::Damaged(format!("the time {at}")))?;
    let mut told = json!({ "id": id, "state": state, "at": when });
    if let Some(reason) = reason {
        told["reason"] = reason.into();
    }
    let seq = record(connection, id, EventKind::State, &told.to_string()).await?;
    if state.is_final() {
        sqlx::query("DELETE FROM shard WHERE job_id = $1").bind(id.to_string()).execute(&mut *connection).await?;
    }
    if let Some(webhook) = row.try_get::<Option<String>, _>("webhook")? {
        let webhook: Webhook = serde_json::from_str(&webhook)
            .map_err(|error| StoreError::Damaged(format!("a webhook that cannot be read: {error}")))?;
        told["kind"] = row.try_get::<String, _>("kind")?.into();
        told["label"] = row.try_get::<Option<String>, _>("label")?.into();
        let kind = format!("job.{}", state.id());
        let event = format!("{id}.{seq}");
        let body = json!({ "id": event, "type": kind, "created_at": when, "data": told }).to_string();
        let delivery = Delivery { event_id: event, event_type: kind, job: id, url: webhook.url, secret: webhook.secret, body, attempt: 1 };
        // A struct of strings and numbers always becomes JSON.
        let payload = serde_json::to_vec(&delivery).unwrap_or_default();
        push(connection, WEBHOOKS, vec![TaskBuilder::new(payload).max_attempts(1).build()]).await?;
    }
    Ok(true)
}

/// Adds an event to a job; its number.
pub(super) async fn record(
    connection: &mut Connection,
    id: Uuid,
    kind: EventKind,
    data: &str,
) -> Result<i64, StoreError> {
    let seq: i64 = sqlx::query_scalar("UPDATE job SET event_seq = event_seq + 1 WHERE id = $1 RETURNING event_seq")
        .bind(id.to_string())
        .fetch_one(&mut *connection)
        .await?;
    sqlx::query("INSERT INTO event (job_id, seq, kind, data) VALUES ($1, $2, $3, $4)")
        .bind(id.to_string())
        .bind(seq)
        .bind(kind.id())
        .bind(data)
        .execute(connection)
        .await?;
    Ok(seq)
}

/// Wakes as many workers as there are shards, in reason. What a ticket brings them to is decided by the tables.
pub(super) async fn wake(connection: &mut Connection, shards: usize) -> Result<(), StoreError> {
    let ticket = || TaskBuilder::new(b"null".to_vec()).max_attempts(1).build();
    push(connection, TICKETS, std::iter::repeat_with(ticket).take(shards.min(MOST_TICKETS)).collect()).await
}
