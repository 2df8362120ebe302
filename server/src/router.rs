//! The application: routes, and around them what every request passes through, outermost first.

use crate::error::{Problem, render};
use crate::routes;
use crate::state::AppState;
use crate::{assets, guard, lti, metrics, unread};
use axum::Router;
use axum::extract::{Request, State};
use axum::http::StatusCode;
use axum::middleware::{self, Next};
use axum::response::{IntoResponse, Response};
use std::any::Any;
use tower::ServiceBuilder;
use tower_http::catch_panic::CatchPanicLayer;
use tower_http::csrf::CsrfLayer;
use tower_http::request_id::{MakeRequestId, PropagateRequestIdLayer, RequestId, SetRequestIdLayer};
use tower_http::timeout::TimeoutLayer;
use tower_http::trace::{DefaultOnResponse, TraceLayer};
use tracing::Level;
use uuid::Uuid;

/// The whole application, ready to be served or called in process.
pub fn build_app(state: AppState) -> Router {
    let around = ServiceBuilder::new()
        .map_request(without_request_id)
        .layer(SetRequestIdLayer::x_request_id(NewRequestId))
        .layer(
            TraceLayer::new_for_http()
                .make_span_with(span)
                .on_request(())
                .on_response(DefaultOnResponse::new().level(Level::INFO)),
        )
        .layer(PropagateRequestIdLayer::x_request_id())
        .layer(middleware::from_fn(metrics::observe))
        .layer(middleware::from_fn(finish))
        .layer(TimeoutLayer::with_status_code(StatusCode::REQUEST_TIMEOUT, state.config.server.request_timeout()))
        .layer(middleware::from_fn(unread::discard))
        .layer(CatchPanicLayer::custom(panicked))
        .layer(middleware::from_fn_with_state(state.clone(), check_host))
        .layer(
            CsrfLayer::new()
                .with_insecure_bypass(|_, uri| lti::takes_posts_from_elsewhere(uri.path()))
                .with_rejection_response(|_| cross_site()),
        );
    Router::new()
        .merge(assets::router())
        .merge(routes::api())
        .fallback(|| async { StatusCode::NOT_FOUND })
        .layer(around)
        .with_state(state)
}

/// Names of requests, in order of arrival.
#[derive(Debug, Clone, Copy)]
struct NewRequestId;

impl MakeRequestId for NewRequestId {
    fn make_request_id<B>(&mut self, _: &Request<B>) -> Option<RequestId> {
        Uuid::now_v7().to_string().parse().ok().map(RequestId::new)
    }
}

/// Clients do not choose the names under which the log knows them.
fn without_request_id<B>(mut request: Request<B>) -> Request<B> {
    request.headers_mut().remove("x-request-id");
    request
}

fn span<B>(request: &Request<B>) -> tracing::Span {
    let id = request.extensions().get::<RequestId>().and_then(|id| id.header_value().to_str().ok()).unwrap_or_default();
    // So that a failure names its request even where only failures are logged.
    tracing::error_span!("request", id, method = %request.method(), path = request.uri().path())
}

/// Gives errors their form and every response its headers.
async fn finish(request: Request, next: Next) -> Response {
    let id = request.extensions().get::<RequestId>().and_then(|id| id.header_value().to_str().ok().map(str::to_owned));
    let mut response = render(next.run(request).await, id.as_deref());
    guard::protect(response.headers_mut());
    response
}

async fn check_host(State(state): State<AppState>, request: Request, next: Next) -> Response {
    match state.hosts.check(&request) {
        Ok(()) => next.run(request).await,
        Err(problem) => problem.into_response(),
    }
}

fn cross_site() -> Response {
    let detail = "a page of another site sent this request; only pages of this server may change anything";
    Problem::new(StatusCode::FORBIDDEN, "/problems/cross-site", "From another site", detail).into_response()
}

fn panicked(_: Box<dyn Any + Send + 'static>) -> Response {
    // The panic itself is in the log already, under this request's name.
    StatusCode::INTERNAL_SERVER_ERROR.into_response()
}
