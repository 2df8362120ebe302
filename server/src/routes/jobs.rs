//! Submitting jobs, looking at them, stopping them, reading their results.

use crate::api::jobs::{JobRequest, JobView, StudyResultView, location};
use crate::api::{self, Name};
use crate::error::Problem;
use crate::jobs::{Job, JobState, StoreError, StudyResult};
use crate::series::{SeriesQuery, SeriesRequest};
use crate::state::AppState;
use axum::Json;
use axum::extract::{Query, State, rejection::QueryRejection};
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::{IntoResponse, Response};
use std::sync::Arc;
use uuid::Uuid;

/// After how many seconds a client that found the queue full should come again.
const RETRY_AFTER_S: u32 = 5;

pub(super) async fn submit(
    State(state): State<AppState>,
    api::Json(request): api::Json<JobRequest>,
) -> Result<Response, Problem> {
    if state.is_draining() {
        return Err(Problem::status(StatusCode::SERVICE_UNAVAILABLE, "the server is shutting down"));
    }
    let (study, label) = request.check()?;
    let job = state.engine.submit(study, label).await?;
    let location = [(header::LOCATION, location(job.id))];
    Ok((StatusCode::ACCEPTED, location, Json(JobView::from(job))).into_response())
}

pub(super) async fn show(State(state): State<AppState>, Name(id): Name) -> Result<Json<JobView>, Problem> {
    Ok(Json(find(&state, &id).await?.into()))
}

/// Cancelling a job that has ended changes nothing and is no mistake: it may have ended a moment ago.
pub(super) async fn cancel(State(state): State<AppState>, Name(id): Name) -> Result<Json<JobView>, Problem> {
    let job = state.engine.store().cancel(parse(&id)?).await?;
    Ok(Json(job.ok_or_else(|| no_job(&id))?.into()))
}

pub(super) async fn result(State(state): State<AppState>, Name(id): Name) -> Result<Response, Problem> {
    let result = find_result(&state, &id).await?;
    Ok(Json(StudyResultView::from(&*result)).into_response())
}

pub(super) async fn series(
    State(state): State<AppState>,
    Name(id): Name,
    query: Result<Query<SeriesQuery>, QueryRejection>,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    let Query(query) = query.map_err(|error| Problem::status(StatusCode::BAD_REQUEST, error.body_text()))?;
    let scenario = query.scenario;
    let result = find_result(&state, &id).await?;
    let report = result.reports.get(scenario);
    let report = report.ok_or_else(|| Problem::not_found("scenario in this job called", &scenario.to_string()))?;
    let request = SeriesRequest::new(&query, report)?;
    if let Some(response) = request.not_modified(&headers) {
        return Ok(response);
    }
    if result.recordings.is_empty() {
        let detail = "samples are kept for the newest jobs only; the same scenario gives the same samples again";
        return Err(Problem::new(StatusCode::GONE, "/problems/gone", "No longer kept", detail));
    }
    request.respond(Arc::new(result.recordings[scenario].clone()), &headers).await
}

fn no_job(id: &str) -> Problem {
    Problem::not_found("job", id)
}

fn parse(id: &str) -> Result<Uuid, Problem> {
    id.parse().map_err(|_| no_job(id))
}

async fn find(state: &AppState, id: &str) -> Result<Job, Problem> {
    state.engine.store().job(parse(id)?).await?.ok_or_else(|| no_job(id))
}

async fn find_result(state: &AppState, id: &str) -> Result<Arc<StudyResult>, Problem> {
    let job = find(state, id).await?;
    // A job can be forgotten between two looks at it.
    match state.engine.store().result(job.id).await? {
        Some(result) => Ok(result),
        None if job.state == JobState::Succeeded => Err(no_job(id)),
        None => Err(not_ready(&job)),
    }
}

fn not_ready(job: &Job) -> Problem {
    let state = job.state.id();
    let detail = match job.state {
        JobState::Queued | JobState::Running => format!("the job is {state}: its result comes when it has succeeded"),
        JobState::Canceled => "the job was canceled and has no result".to_owned(),
        JobState::Failed | JobState::Succeeded => {
            format!("the job {state} and has no result: {}", job.reason.as_deref().unwrap_or("nobody noted why"))
        }
    };
    Problem::new(StatusCode::CONFLICT, "/problems/not-ready", "No result", detail).with("state", state)
}

impl From<StoreError> for Problem {
    fn from(error: StoreError) -> Self {
        match error {
            StoreError::Full(_) => {
                let detail = format!("{error}; try again in {RETRY_AFTER_S} s");
                let problem = Self::new(StatusCode::SERVICE_UNAVAILABLE, "/problems/queue-full", "Queue full", detail);
                Self { retry_after_s: Some(RETRY_AFTER_S), ..problem }
            }
        }
    }
}
