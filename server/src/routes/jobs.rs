//! Submitting jobs, looking at them, stopping and forgetting them.

use super::problems::{database, no_job};
use crate::api::jobs::{JobRequest, JobView, JobsQuery, JobsView, location};
use crate::api::{self, Name, Query};
use crate::error::Problem;
use crate::jobs::{Job, NewJob};
use crate::state::AppState;
use axum::Json;
use axum::extract::State;
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::{IntoResponse, Response};
use uuid::Uuid;

/// Whose jobs are meant.
const OWNER: &str = "local";

pub(super) async fn submit(
    State(state): State<AppState>,
    headers: HeaderMap,
    api::Json(request): api::Json<JobRequest>,
) -> Result<Response, Problem> {
    if state.is_draining() {
        return Err(Problem::status(StatusCode::SERVICE_UNAVAILABLE, "the server is shutting down"));
    }
    let (config, receivers) = (state.config.clone(), state.receivers.clone());
    let kind = request.kind;
    // Thousands of scenarios take a while.
    let checked = tokio::task::spawn_blocking(move || {
        let checked = request.check(&config.limits, &receivers)?;
        Ok::<_, Problem>((checked.study.into_new_scenarios(), checked.label, checked.priority, checked.webhook))
    });
    let (scenarios, label, priority, webhook) = checked.await.map_err(super::internal)??;
    let job = NewJob { owner: OWNER.to_owned(), kind, label, priority, webhook, idempotency: None, scenarios };
    let submitted = state.engine.submit(job).await.map_err(database)?;
    let location = [(header::LOCATION, location(submitted.job.id))];
    let _ = headers;
    Ok((StatusCode::ACCEPTED, location, Json(JobView::from(submitted.job))).into_response())
}

pub(super) async fn list(
    State(state): State<AppState>,
    Query(query): Query<JobsQuery>,
) -> Result<Json<JobsView>, Problem> {
    let jobs = state.store.jobs(OWNER, &query.filter(), 50).await.map_err(database)?;
    Ok(Json(JobsView { jobs: jobs.into_iter().map(JobView::from).collect(), next_cursor: None }))
}

pub(super) async fn show(State(state): State<AppState>, Name(id): Name) -> Result<Json<JobView>, Problem> {
    Ok(Json(find(&state, OWNER, &id).await?.into()))
}

/// Cancelling a job that has ended changes nothing and is no mistake: it may have ended a moment ago.
pub(super) async fn cancel(State(state): State<AppState>, Name(id): Name) -> Result<Json<JobView>, Problem> {
    let job = state.store.cancel(OWNER, parse(&id)?).await.map_err(database)?;
    Ok(Json(job.ok_or_else(|| no_job(&id))?.into()))
}

pub(super) async fn delete(State(state): State<AppState>, Name(id): Name) -> Result<StatusCode, Problem> {
    let deleted = state.store.delete(OWNER, parse(&id)?).await.map_err(database)?;
    if deleted { Ok(StatusCode::NO_CONTENT) } else { Err(no_job(&id)) }
}

fn parse(id: &str) -> Result<Uuid, Problem> {
    id.parse().map_err(|_| no_job(id))
}

/// A user's job.
pub(super) async fn find(state: &AppState, owner: &str, id: &str) -> Result<Job, Problem> {
    state.store.job(owner, parse(id)?).await.map_err(database)?.ok_or_else(|| no_job(id))
}
