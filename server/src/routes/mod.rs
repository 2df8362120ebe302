//! Handlers: they translate between HTTP and the rest, and nothing more.

mod catalog;
mod docs;
mod events;
mod experiments;
mod health;
mod jobs;
pub(crate) mod problems;
mod results;

use crate::compression;
use crate::error::Problem;
use crate::state::AppState;
use axum::Router;
use axum::http::{HeaderValue, StatusCode, header};
use axum::routing::get;
use utoipa_axum::router::OpenApiRouter;
use utoipa_axum::routes;

/// The API, whose index and documentation are found with and without a slash at the end.
pub fn api() -> Router<AppState> {
    Router::from(operations())
        .route("/api/v1/", get(catalog::index))
        .route("/api/docs", get(docs::page))
        .route("/api/docs/", get(docs::page))
        .route("/api/docs/{name}", get(docs::file))
        .layer(axum::middleware::map_response(|mut response: axum::response::Response| async {
            // A job's state changes between two looks at it.
            response.headers_mut().entry(header::CACHE_CONTROL).or_insert(HeaderValue::from_static("no-store"));
            response
        }))
        .layer(compression::layer())
        .layer(axum::middleware::map_response(compression::weaken_tag))
}

/// What the handlers say of themselves.
pub fn described() -> utoipa::openapi::OpenApi {
    operations().into_openapi()
}

/// Every operation that is part of the described API.
fn operations() -> OpenApiRouter<AppState> {
    OpenApiRouter::new()
        .routes(routes!(catalog::index))
        .routes(routes!(catalog::presets))
        .routes(routes!(catalog::preset))
        .routes(routes!(catalog::robots))
        .routes(routes!(catalog::schemes))
        .routes(routes!(catalog::scenario_schema))
        .routes(routes!(catalog::experiment_schema))
        .routes(routes!(catalog::experiments))
        .routes(routes!(catalog::limits))
        .routes(routes!(docs::document))
        .routes(routes!(jobs::submit, jobs::list))
        .routes(routes!(jobs::show, jobs::delete))
        .routes(routes!(jobs::cancel))
        .routes(routes!(events::events))
        .routes(routes!(results::result))
        .routes(routes!(results::scenario))
        .routes(routes!(results::series))
        .routes(routes!(results::file))
        .routes(routes!(results::figure))
        .routes(routes!(results::diagnostics))
        // What watches over servers asks at the top level.
        .routes(routes!(health::alive))
        .routes(routes!(health::ready))
        .routes(routes!(health::metrics))
}

/// Our own constants cannot be wrong; if one is, that is our failure.
fn internal(error: impl std::fmt::Display) -> Problem {
    tracing::error!("{error}");
    Problem::status(StatusCode::INTERNAL_SERVER_ERROR, "the server failed; its log names this request")
}
