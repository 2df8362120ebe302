//! Handlers: they translate between HTTP and the rest, and nothing more.

mod catalog;
mod events;
mod health;
mod jobs;
pub(crate) mod problems;
mod results;

use crate::compression;
use crate::error::Problem;
use crate::state::AppState;
use axum::Router;
use axum::http::{HeaderValue, StatusCode, header};
use axum::routing::{get, post};

/// The API, whose index is found with and without a slash at the end.
pub fn api() -> Router<AppState> {
    let version_1 = Router::new()
        .route("/", get(catalog::index))
        .route("/presets", get(catalog::presets))
        .route("/presets/{id}", get(catalog::preset))
        .route("/robots", get(catalog::robots))
        .route("/schemes", get(catalog::schemes))
        .route("/schema/scenario", get(catalog::scenario_schema))
        .route("/limits", get(catalog::limits))
        .route("/jobs", post(jobs::submit).get(jobs::list))
        .route("/jobs/{id}", get(jobs::show).delete(jobs::delete))
        .route("/jobs/{id}/events", get(events::events))
        .route("/jobs/{id}/cancel", post(jobs::cancel))
        .route("/jobs/{id}/result", get(results::result))
        .route("/jobs/{id}/result/series", get(results::series))
        .route("/jobs/{id}/result/figures/{name}", get(results::figure));
    Router::new()
        .nest("/api/v1", version_1)
        .route("/api/v1/", get(catalog::index))
        .layer(axum::middleware::map_response(|mut response: axum::response::Response| async {
            // A job's state changes between two looks at it.
            response.headers_mut().entry(header::CACHE_CONTROL).or_insert(HeaderValue::from_static("no-store"));
            response
        }))
        .layer(compression::layer())
        .layer(axum::middleware::map_response(compression::weaken_tag))
}

/// What watches over servers asks at the top level.
pub fn health() -> Router<AppState> {
    Router::new()
        .route("/healthz", get(health::alive))
        .route("/readyz", get(health::ready))
        .route("/metrics", get(health::metrics))
}

/// Our own constants cannot be wrong; if one is, that is our failure.
fn internal(error: impl std::fmt::Display) -> Problem {
    tracing::error!("{error}");
    Problem::status(StatusCode::INTERNAL_SERVER_ERROR, "the server failed; its log names this request")
}
