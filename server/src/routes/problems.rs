//! How what the store says becomes a problem.

use crate::error::Problem;
use crate::jobs::{Job, JobState, StoreError};
use crate::results::ResultError;
use axum::http::StatusCode;

/// After how many seconds a client that found the database failing should come again.
const RETRY_AFTER_S: u32 = 5;

/// There is no such job, for this user.
pub(super) fn no_job(id: &str) -> Problem {
    Problem::not_found("job", id)
}

/// Nothing begins here any more.
pub(crate) fn draining() -> Problem {
    let problem = Problem::status(StatusCode::SERVICE_UNAVAILABLE, "the server is shutting down");
    Problem { retry_after_s: Some(RETRY_AFTER_S), ..problem }
}

/// What the tables say.
pub(crate) fn database(error: StoreError) -> Problem {
    let detail = error.to_string();
    match error {
        StoreError::Quota { what, found, more, most } => {
            Problem::new(StatusCode::TOO_MANY_REQUESTS, "/problems/quota", "More than one user may have", detail)
                .with("what", what)
                .with("found", found)
                .with("more", more)
                .with("most", most)
        }
        StoreError::KeyReused { key } => {
            let title = "The key belongs to another request";
            Problem::new(StatusCode::UNPROCESSABLE_ENTITY, "/problems/idempotency-key", title, detail)
                .with("value", key)
        }
        StoreError::Database(_) | StoreError::Queue(_) | StoreError::Migration(_) | StoreError::Damaged(_) => {
            tracing::error!("{error}");
            let detail = "the database cannot be used at the moment; try again in a while";
            let problem =
                Problem::new(StatusCode::SERVICE_UNAVAILABLE, "/problems/unavailable", "Not available", detail);
            Problem { retry_after_s: Some(RETRY_AFTER_S), ..problem }
        }
    }
}

/// What the result store says.
pub(super) fn stored(error: &ResultError) -> Problem {
    match error {
        ResultError::Missing(_) | ResultError::Damaged(_) => {
            tracing::error!("{error}");
            let detail = "the samples are not kept any more; the same scenario gives the same samples again";
            Problem::new(StatusCode::GONE, "/problems/gone", "No longer kept", detail)
        }
        ResultError::NoSpace(_) | ResultError::Unavailable(_) => {
            tracing::error!("{error}");
            let detail = "the stored results cannot be read at the moment; try again in a while";
            let problem =
                Problem::new(StatusCode::SERVICE_UNAVAILABLE, "/problems/unavailable", "Not available", detail);
            Problem { retry_after_s: Some(RETRY_AFTER_S), ..problem }
        }
    }
}

/// There is nothing to read yet.
pub(super) fn not_ready(job: &Job, what: &str) -> Problem {
    let state = job.state.id();
    let detail = match job.state {
        JobState::Queued | JobState::Running => format!("the job is {state}: {what} can be read when it has ended"),
        JobState::Succeeded | JobState::Failed | JobState::Canceled => {
            format!(
                "the job ended ({state}) before it had {what}: {}",
                job.reason.as_deref().unwrap_or("nobody noted why")
            )
        }
    };
    Problem::new(StatusCode::CONFLICT, "/problems/not-ready", "No result", detail).with("state", state)
}
