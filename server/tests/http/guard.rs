//! Who is answered, and what every answer carries.

use crate::support::{App, request};
use axum::body::Body;
use axum::http::Request;

#[tokio::test]
async fn only_names_of_this_machine_are_answered() {
    let app = App::new().await;
    for host in ["localhost:8080", "127.0.0.1", "[::1]:8080"] {
        let request = Request::get("/healthz").header("host", host).body(Body::empty()).unwrap();
        assert_eq!(app.call(request).await.status, 200, "{host}");
    }
    for host in ["evil.example", "localhost.evil.example", "127.0.0.1@evil.example", "10.0.0.1"] {
        let request = Request::get("/healthz").header("host", host).body(Body::empty()).unwrap();
        app.call(request).await.problem(421, "/problems/wrong-host");
    }
    let nobody = Request::get("/healthz").body(Body::empty()).unwrap();
    app.call(nobody).await.problem(421, "/problems/wrong-host");
    let both = Request::get("http://evil.example/healthz").header("host", "localhost").body(Body::empty()).unwrap();
    app.call(both).await.problem(421, "/problems/wrong-host");
}

#[tokio::test]
async fn pages_of_other_sites_cannot_change_anything() {
    let app = App::new().await;
    for (name, value) in [("sec-fetch-site", "cross-site"), ("origin", "https://evil.example"), ("origin", "null")] {
        let request = request("POST", "/api/v1/jobs/x/cancel").header(name, value).body(Body::empty()).unwrap();
        app.call(request).await.problem(403, "/problems/cross-site");
    }
    let own = request("POST", "/api/v1/jobs/x/cancel").header("origin", "http://127.0.0.1:8080");
    app.call(own.body(Body::empty()).unwrap()).await.problem(404, "/problems/http");
}

#[tokio::test]
async fn every_answer_carries_the_protecting_headers() {
    let app = App::new().await;
    for path in ["/healthz", "/api/v1/limits", "/api/v1/nothing", "/nothing"] {
        let answer = app.get(path).await;
        let policy = answer.header("content-security-policy");
        assert!(policy.starts_with("default-src 'none'; script-src 'self' 'wasm-unsafe-eval';"), "{path}: {policy}");
        assert!(!policy.contains("unsafe-inline") && !policy.contains("  "), "{policy}");
        assert_eq!(answer.header("x-content-type-options"), "nosniff");
        assert_eq!(answer.header("referrer-policy"), "no-referrer");
        assert_eq!(answer.header("cross-origin-resource-policy"), "same-origin");
        assert_eq!(answer.header("permissions-policy"), "", "{path} is no page");
    }
    for page in ["/index.html", "/learn.html", "/api/docs"] {
        let answer = app.get(page).await;
        assert!(answer.header("permissions-policy").contains("camera=()"), "{page}: {}", answer.status);
    }
}

#[tokio::test]
async fn requests_are_named_by_the_server() {
    let asked = request("GET", "/healthz").header("x-request-id", "mine").body(Body::empty()).unwrap();
    let answer = App::new().await.call(asked).await;
    assert_eq!(answer.header("x-request-id").parse::<uuid::Uuid>().unwrap().get_version_num(), 7);
}
