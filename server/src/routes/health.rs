//! Whether this process lives, and whether it takes work.

use super::problems::{database, stored};
use crate::error::Problem;
use crate::state::AppState;
use axum::Json;
use axum::extract::State;
use axum::http::StatusCode;
use serde_json::{Value, json};

pub(super) async fn alive() -> Json<Value> {
    Json(json!({ "status": "alive", "version": env!("CARGO_PKG_VERSION") }))
}

pub(super) async fn ready(State(state): State<AppState>) -> Result<Json<Value>, Problem> {
    if state.is_draining() {
        return Err(Problem::status(StatusCode::SERVICE_UNAVAILABLE, "the server is shutting down"));
    }
    let [queued, running] = state.store.unfinished().await.map_err(database)?;
    state.results.check().await.map_err(|error| stored(&error))?;
    Ok(Json(json!({ "status": "ready", "unfinished_jobs": queued + running })))
}
