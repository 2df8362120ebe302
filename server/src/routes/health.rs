//! Whether this process lives, and whether it takes work.

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
    match state.engine.store().unfinished().await {
        Ok(unfinished) => Ok(Json(json!({ "status": "ready", "unfinished_jobs": unfinished }))),
        Err(error) => Err(Problem::status(StatusCode::SERVICE_UNAVAILABLE, error.to_string())),
    }
}
