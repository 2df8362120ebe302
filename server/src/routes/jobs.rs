//! Submitting jobs, looking at them, stopping and forgetting them.

use super::problems::{database, draining, no_job};
use crate::api::headers::{IDEMPOTENCY_REPLAYED, PREFERENCE_APPLIED, idempotency_key, preferred_wait};
use crate::api::jobs::{JobRequest, JobRequestForm, JobView, JobsView, location};
use crate::api::page::{JobsQuery, cursor};
use crate::api::{JsonBytes, Name, Query};
use crate::auth::{Reader, Writer};
use crate::config::Config;
use crate::error::Problem;
use crate::jobs::{Job, NewJob};
use crate::state::AppState;
use crate::webhooks::Policy;
use axum::Json;
use axum::extract::State;
use axum::http::{HeaderMap, HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Response};
use std::time::Duration;
use tokio::task::spawn_blocking;
use uuid::Uuid;

/// Submits a job.
///
/// It is durable when this answers: it runs when its turn comes, also if the server is stopped or dies meanwhile. Scenarios
/// that were computed before are answered from stored results.
///
/// Needs the scope `jobs:write`.
#[utoipa::path(
    post, path = "/api/v1/jobs", operation_id = "submit_job", tag = "jobs",
    params(
        (
            "Idempotency-Key" = Option<String>, Header, min_length = 1, max_length = 200, pattern = "^[!-~]+$",
            description = "The request's own name. Sent again with the same key, the request makes no second job; with the \
                           same key and other contents it is refused.",
        ),
        (
            "Prefer" = Option<String>, Header, example = "wait=10",
            description = "`wait=N` holds the answer back until the job has ended, but not longer than N seconds. What is \
                           longer than `wait_s` of the limits is lowered; anything else is ignored (RFC 7240).",
        ),
    ),
    request_body(content = JobRequestForm, content_type = "application/json"),
    responses(
        (
            status = 200, description = "The job has ended within the time that `Prefer: wait` allowed.", body = JobView,
            headers(
                ("Location" = String, description = "The job's address."),
                ("Preference-Applied" = String, description = "How long the answer was allowed to wait."),
                ("Idempotency-Replayed" = String, description = "`true` if an earlier request made the job."),
            ),
        ),
        (
            status = 202, description = "The job is accepted.", body = JobView,
            headers(
                ("Location" = String, description = "The job's address."),
                ("Preference-Applied" = String, description = "How long the answer was allowed to wait."),
                ("Idempotency-Replayed" = String, description = "`true` if an earlier request made the job."),
            ),
        ),
    ),
)]
pub(super) async fn submit(
    State(state): State<AppState>,
    Writer(owner): Writer,
    headers: HeaderMap,
    JsonBytes(bytes): JsonBytes,
) -> Result<Response, Problem> {
    if state.is_draining() {
        return Err(draining());
    }
    let key = idempotency_key(&headers)?;
    let (config, receivers, name) = (state.config.clone(), state.receivers.clone(), owner.to_string());
    // Thousands of scenarios take a while.
    let job = spawn_blocking(move || new_job(&bytes, name, key, &config, &receivers));
    let submitted = state.engine.submit(job.await.map_err(super::internal)??).await.map_err(database)?;
    let (mut job, mut more) = (submitted.job, HeaderMap::new());
    if submitted.repeated {
        more.insert(IDEMPOTENCY_REPLAYED, HeaderValue::from_static("true"));
    }
    let mut status = StatusCode::ACCEPTED;
    if let Some(wait) = preferred_wait(&headers) {
        let wait = wait.min(Duration::from_secs(state.config.limits.wait_s));
        if !job.state.is_final() {
            state.hub.wait(job.id, wait).await;
            // It may have been deleted meanwhile; then this is the last that was known of it.
            job = state.store.job(owner.as_str(), job.id).await.map_err(database)?.unwrap_or(job);
        }
        if job.state.is_final() {
            status = StatusCode::OK;
        }
        let applied = HeaderValue::from_str(&format!("wait={}", wait.as_secs())).map_err(super::internal)?;
        more.insert(PREFERENCE_APPLIED, applied);
    }
    let location = [(header::LOCATION, location(job.id))];
    Ok((status, location, more, Json(JobView::from(job))).into_response())
}

/// What a body asks for, everything checked.
fn new_job(
    bytes: &[u8],
    owner: String,
    key: Option<String>,
    config: &Config,
    receivers: &Policy,
) -> Result<NewJob, Problem> {
    let request = JobRequest::read(bytes)?.check(&config.limits, receivers)?;
    Ok(NewJob {
        owner,
        kind: request.kind,
        idempotency: key.map(|key| (key, request.hash())),
        label: request.label,
        priority: request.priority,
        webhook: request.webhook,
        work: request.work.into_new_work(),
    })
}

/// Lists your jobs, newest first.
///
/// Needs the scope `jobs:read`.
#[utoipa::path(
    get, path = "/api/v1/jobs", operation_id = "list_jobs", tag = "jobs", params(JobsQuery),
    responses((status = 200, description = "A page of jobs.", body = JobsView)),
)]
pub(super) async fn list(
    State(state): State<AppState>,
    Reader(owner): Reader,
    Query(query): Query<JobsQuery>,
) -> Result<Json<JobsView>, Problem> {
    let page = query.check(owner.as_str())?;
    // One more tells whether there is another page.
    let mut jobs = state.store.jobs(owner.as_str(), &page.filter, page.limit + 1).await.map_err(database)?;
    let more = jobs.len() as i64 > page.limit;
    jobs.truncate(page.limit as usize);
    let next_cursor = jobs.last().filter(|_| more).map(|last| cursor(owner.as_str(), last.id));
    Ok(Json(JobsView { jobs: jobs.into_iter().map(JobView::from).collect(), next_cursor }))
}

/// Shows a job.
///
/// Needs the scope `jobs:read`.
#[utoipa::path(
    get, path = "/api/v1/jobs/{id}", operation_id = "show_job", tag = "jobs", params(("id" = uuid::Uuid, Path, description = "The job's identifier.")),
    responses((status = 200, description = "The job.", body = JobView)),
)]
pub(super) async fn show(
    State(state): State<AppState>,
    Reader(owner): Reader,
    Name(id): Name,
) -> Result<Json<JobView>, Problem> {
    Ok(Json(find(&state, owner.as_str(), &id).await?.into()))
}

/// Stops a job. What it has computed can be read.
///
/// Cancelling a job that has ended changes nothing and is no mistake: it may have ended a moment ago. Needs the scope
/// `jobs:write`.
#[utoipa::path(
    post, path = "/api/v1/jobs/{id}/cancel", operation_id = "cancel_job", tag = "jobs", params(("id" = uuid::Uuid, Path, description = "The job's identifier.")),
    responses((status = 200, description = "The job as it is now.", body = JobView)),
)]
pub(super) async fn cancel(
    State(state): State<AppState>,
    Writer(owner): Writer,
    Name(id): Name,
) -> Result<Json<JobView>, Problem> {
    let job = state.store.cancel(owner.as_str(), parse(&id)?).await.map_err(database)?;
    Ok(Json(job.ok_or_else(|| no_job(&id))?.into()))
}

/// Forgets a job; one that has not ended is stopped.
///
/// Needs the scope `jobs:write`.
#[utoipa::path(
    delete, path = "/api/v1/jobs/{id}", operation_id = "delete_job", tag = "jobs", params(("id" = uuid::Uuid, Path, description = "The job's identifier.")),
    responses((status = 204, description = "It is forgotten.")),
)]
pub(super) async fn delete(
    State(state): State<AppState>,
    Writer(owner): Writer,
    Name(id): Name,
) -> Result<StatusCode, Problem> {
    let deleted = state.store.delete(owner.as_str(), parse(&id)?).await.map_err(database)?;
    if deleted { Ok(StatusCode::NO_CONTENT) } else { Err(no_job(&id)) }
}

fn parse(id: &str) -> Result<Uuid, Problem> {
    id.parse().map_err(|_| no_job(id))
}

/// A user's job.
pub(super) async fn find(state: &AppState, owner: &str, id: &str) -> Result<Job, Problem> {
    state.store.job(owner, parse(id)?).await.map_err(database)?.ok_or_else(|| no_job(id))
}
