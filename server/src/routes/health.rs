//! Whether this process lives, and whether it takes work.

use super::problems::{database, draining, stored};
use crate::auth::Observer;
use crate::error::Problem;
use crate::jobs::JobState;
use crate::metrics as record;
use crate::openapi::Health;
use crate::state::AppState;
use axum::Json;
use axum::extract::State;
use axum::http::header;
use axum::response::IntoResponse;
use serde_json::{Value, json};

/// Whether this process lives.
#[utoipa::path(
    get, path = "/healthz", operation_id = "alive", tag = "server",
    responses((status = 200, description = "It does.", body = Health)),
)]
pub(super) async fn alive() -> Json<Value> {
    Json(json!({ "status": "alive", "version": env!("CARGO_PKG_VERSION") }))
}

/// Whether this server takes work: its database and its stored results can be used, and it is not shutting down.
#[utoipa::path(
    get, path = "/readyz", operation_id = "ready", tag = "server",
    responses((status = 200, description = "It does.", body = Health)),
)]
pub(super) async fn ready(State(state): State<AppState>) -> Result<Json<Value>, Problem> {
    if state.is_draining() {
        return Err(draining());
    }
    let [queued, running] = state.store.unfinished().await.map_err(database)?;
    state.results.check().await.map_err(|error| stored(&error))?;
    Ok(Json(json!({ "status": "ready", "unfinished_jobs": queued + running })))
}

/// Counts and times for Prometheus.
///
/// Needs the scope `metrics:read`.
#[utoipa::path(
    get, path = "/metrics", operation_id = "metrics", tag = "server",
    responses((status = 200, description = "Prometheus' text format.", body = String, content_type = "text/plain")),
)]
pub(super) async fn metrics(State(state): State<AppState>, _: Observer) -> Result<impl IntoResponse, Problem> {
    let [queued, running] = state.store.unfinished().await.map_err(database)?;
    for (state, jobs) in [(JobState::Queued, queued), (JobState::Running, running)] {
        record::queue_depth(state, jobs.max(0) as u64);
    }
    Ok(([(header::CONTENT_TYPE, "text/plain; version=0.0.4; charset=utf-8")], record::render()))
}
