//! Counts requests and their time by route. Routes are those of the router, so clients cannot make up new ones.

use ::metrics::{counter, histogram};
use axum::extract::{MatchedPath, Request};
use axum::http::Method;
use axum::middleware::Next;
use axum::response::Response;
use std::time::{Duration, Instant};

/// Middleware around all routes: counts each request when its answer begins.
pub async fn observe(request: Request, next: Next) -> Response {
    let method = method_label(request.method());
    let matched = request.extensions().get::<MatchedPath>().cloned();
    let started = Instant::now();
    let response = next.run(request).await;
    record(
        method,
        route_label(matched.as_ref().map(MatchedPath::as_str)),
        response.status().as_u16(),
        started.elapsed(),
    );
    response
}

pub(super) fn record(method: &'static str, route: &str, status: u16, took: Duration) {
    let labels = [("method", method.to_owned()), ("route", route.to_owned()), ("status", status.to_string())];
    counter!("adaptarm_http_requests_total", &labels).increment(1);
    histogram!("adaptarm_http_request_seconds", "route" => route.to_owned()).record(took);
}

/// Methods outside the standard can be called anything.
fn method_label(method: &Method) -> &'static str {
    match *method {
        Method::GET => "GET",
        Method::HEAD => "HEAD",
        Method::POST => "POST",
        Method::PUT => "PUT",
        Method::PATCH => "PATCH",
        Method::DELETE => "DELETE",
        Method::OPTIONS => "OPTIONS",
        _ => "other",
    }
}

/// The API's routes one by one; the page's many files are one.
fn route_label(matched: Option<&str>) -> &str {
    match matched {
        Some(path) if path.starts_with("/api/") || matches!(path, "/healthz" | "/readyz" | "/metrics") => path,
        Some(_) => "page",
        None => "none",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metrics::{recorder, tests};
    use axum::Router;
    use axum::body::Body;
    use axum::http::StatusCode;
    use axum::routing::get;
    use tower::ServiceExt;

    async fn ask(app: &Router, method: &str, path: &str) -> StatusCode {
        let request = Request::builder().method(method).uri(path).body(Body::empty()).unwrap();
        app.clone().oneshot(request).await.unwrap().status()
    }

    #[tokio::test]
    async fn requests_are_counted_by_route_and_never_by_what_clients_make_up() {
        let recorder = recorder();
        let (recorded, _guard) = tests::record(&recorder);
        let app = Router::new()
            .nest("/api/test", Router::new().route("/things/{id}", get(|| async { "thing" })))
            .route("/file.js", get(|| async { "script" }))
            .fallback(|| async { StatusCode::NOT_FOUND })
            .layer(axum::middleware::from_fn(observe));
        assert_eq!(ask(&app, "GET", "/api/test/things/1").await, StatusCode::OK);
        assert_eq!(ask(&app, "GET", "/api/test/things/2").await, StatusCode::OK);
        assert_eq!(ask(&app, "BREW", "/api/test/things/2").await, StatusCode::METHOD_NOT_ALLOWED);
        assert_eq!(ask(&app, "GET", "/file.js").await, StatusCode::OK);
        assert_eq!(ask(&app, "GET", "/made/up").await, StatusCode::NOT_FOUND);
        let count = |method: &str, route: &str, status: &str| {
            let labels = format!(r#"method="{method}",route="{route}",status="{status}""#);
            recorded.value(&format!("adaptarm_http_requests_total{{{labels}}}"))
        };
        assert_eq!(count("GET", "/api/test/things/{id}", "200"), Some(2.0));
        assert_eq!(count("other", "/api/test/things/{id}", "405"), Some(1.0));
        assert_eq!(count("GET", "page", "200"), Some(1.0));
        assert_eq!(count("GET", "none", "404"), Some(1.0));
        let timed = recorded.value(r#"adaptarm_http_request_seconds_count{route="/api/test/things/{id}"}"#);
        assert_eq!(timed, Some(3.0));
    }
}
