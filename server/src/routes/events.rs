//! What happens to a job, as it happens: server-sent events.

use super::jobs::find;
use super::problems::{database, draining};
use crate::api::{Name, Query};
use crate::auth::Reader;
use crate::document::brief;
use crate::error::Problem;
use crate::events::{Follower, Told};
use crate::openapi::ServerSentEvent;
use crate::state::AppState;
use axum::extract::State;
use axum::http::{HeaderMap, HeaderName, StatusCode};
use axum::response::sse::{Event, KeepAlive, Sse};
use axum::response::{IntoResponse, Response};
use futures_util::stream;
use jiff::Timestamp;
use serde::Deserialize;
use serde_json::json;
use std::convert::Infallible;
use std::time::Duration;
use uuid::Uuid;

/// Where a client that lost its connection goes on.
const LAST_EVENT_ID: HeaderName = HeaderName::from_static("last-event-id");

/// Tells nginx to pass every event on at once.
const NO_BUFFERING: (HeaderName, &str) = (HeaderName::from_static("x-accel-buffering"), "no");

/// Time between two signs of life where nothing happens.
const KEEP_ALIVE: Duration = Duration::from_secs(15);

/// Where to begin.
#[derive(Debug, Clone, Default, Deserialize, utoipa::IntoParams)]
#[serde(deny_unknown_fields, default)]
#[into_params(parameter_in = Query)]
pub(super) struct EventsQuery {
    /// The same as the header `Last-Event-ID`, which counts if both are there.
    #[param(value_type = Option<i64>, minimum = 0)]
    last_event_id: Option<String>,
}

/// Follows a job to its end, by server-sent events.
///
/// `state` events tell `{id, state, reason?, at}`, `summary` events `{scenario, report}` for each scenario that has its
/// result, `partial` events what an experiment's rows say so far; these have ids and come again to whoever resumes. `progress` events, without ids, tell
/// `{progress, scenarios_done}` a few times a second while it changes. The stream ends after the final state. Needs the
/// scope `jobs:read`.
#[utoipa::path(
    get, path = "/api/v1/jobs/{id}/events", operation_id = "follow_job", tag = "jobs",
    params(
        ("id" = uuid::Uuid, Path, description = "The job's identifier."),
        EventsQuery,
        (
            "Last-Event-ID" = Option<i64>, Header, minimum = 0,
            description = "Id of the last event that you have: the stream goes on after it.",
        ),
    ),
    responses(
        (status = 200, description = "The events.", body = ServerSentEvent, content_type = "text/event-stream"),
        (status = 204, description = "The job has ended, and you know all of it: do not come again."),
    ),
)]
pub(super) async fn events(
    State(state): State<AppState>,
    Reader(owner): Reader,
    Name(id): Name,
    Query(query): Query<EventsQuery>,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    if state.is_draining() {
        return Err(draining());
    }
    let job = find(&state, owner.as_str(), &id).await?;
    let after = last_event_id(&headers, query)?;
    let last = state.store.pulses(&[job.id]).await.map_err(database)?.first().map_or(0, |pulse| pulse.seq);
    if after > last {
        return Err(Problem::not_found("event of this job yet with the id", &after.to_string()));
    }
    if after == last && job.state.is_final() {
        // To browsers this means: all has been told, do not come again.
        return Ok(StatusCode::NO_CONTENT.into_response());
    }
    let follower = Follower::new(&state.hub, job.id, after);
    let told = stream::unfold(follower, move |mut follower| async move {
        let told = follower.next().await?;
        Some((Ok::<_, Infallible>(write(job.id, &told)), follower))
    });
    let stream = Sse::new(told).keep_alive(KeepAlive::new().interval(KEEP_ALIVE));
    Ok(([NO_BUFFERING], stream).into_response())
}

fn write(job: Uuid, told: &Told) -> Event {
    match told {
        Told::Event(event) => Event::default().id(event.seq.to_string()).event(event.kind.id()).data(&event.data),
        // Two numbers always become JSON.
        Told::Progress(progress) => Event::default().event("progress").data(json!(progress).to_string()),
        Told::Deleted => {
            let data =
                json!({ "id": job, "state": "canceled", "reason": "the job was deleted", "at": Timestamp::now() });
            Event::default().event("state").data(data.to_string())
        }
    }
}

fn last_event_id(headers: &HeaderMap, query: EventsQuery) -> Result<i64, Problem> {
    let header = headers.get(LAST_EVENT_ID).map(|value| String::from_utf8_lossy(value.as_bytes()).into_owned());
    let [header, query] = [header, query.last_event_id].map(|text| text.map(|text| read_id(&text)).transpose());
    Ok(header?.or(query?).unwrap_or(0))
}

fn read_id(text: &str) -> Result<i64, Problem> {
    let number =
        text.parse().ok().filter(|number: &i64| *number >= 0 && text.bytes().all(|byte| byte.is_ascii_digit()));
    number.ok_or_else(|| wrong_id(text, "not the id of an event: a whole number from 0 up"))
}

fn wrong_id(value: &str, message: &str) -> Problem {
    let detail = format!("Last-Event-ID {:?}: {message}", brief(value));
    Problem::new(StatusCode::BAD_REQUEST, "/problems/malformed-header", "A header is wrong", detail)
        .with("header", "Last-Event-ID")
        .with("value", brief(value))
        .with("message", message)
}
