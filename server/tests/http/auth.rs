//! Whose request it is: with tokens, without, with wrong ones, and too often.

use crate::support::{Answer, App, JOBS, short, study};
use serde_json::json;

const ALL: &str = "jobs:read,jobs:write";

async fn ask(app: &App, method: &str, path: &str, token: &str) -> Answer {
    app.ask(method, path, &[("authorization", token)]).await
}

#[tokio::test]
async fn away_from_loopback_jobs_and_metrics_need_a_token_and_the_rest_does_not() {
    let app = App::public(|_| ()).await;
    for path in [JOBS, "/api/v1/jobs/01a1faef-47aa-739c-8da0-8ec25cc71ac6/events", "/metrics"] {
        let refused = app.get(path).await;
        refused.problem(401, "/problems/token");
        assert_eq!(refused.header("www-authenticate"), "Bearer realm=\"adaptarm\"");
        for wrong in ["Bearer", "Bearer x", "Basic YTpi", "Bearer adaptarm_000000000000_00"] {
            ask(&app, "GET", path, wrong).await.problem(401, "/problems/token");
        }
    }
    app.post(JOBS, "not even JSON").await.problem(401, "/problems/token");
    for path in ["/", "/healthz", "/readyz", "/api/v1", "/api/v1/presets", "/api/v1/openapi.json", "/api/docs"] {
        assert_eq!(app.get(path).await.status, 200, "{path}");
    }
}

#[tokio::test]
async fn what_is_another_user_s_does_not_exist() {
    let app = App::public(|_| ()).await;
    let (ana, bob) = (app.token("ana", ALL).await, app.token("bob", ALL).await);
    let submit = [("authorization", ana.as_str()), ("prefer", "wait=30"), ("idempotency-key", "k")];
    let submitted = app.post_with(JOBS, study(&[short("proposed")]).to_string(), &submit).await;
    assert_eq!(submitted.status, 200);
    let job = submitted.header("location");
    for (method, rest) in [
        ("GET", ""),
        ("GET", "/result"),
        ("GET", "/result/series"),
        ("GET", "/result/figures/torques.svg"),
        ("GET", "/result/diagnostics"),
        ("GET", "/events"),
        ("POST", "/cancel"),
        ("DELETE", ""),
    ] {
        ask(&app, method, &format!("{job}{rest}"), &bob).await.problem(404, "/problems/http");
    }
    let submit = [("authorization", bob.as_str()), ("idempotency-key", "k")];
    let own = app.post_with(JOBS, study(&[short("proposed")]).to_string(), &submit).await;
    assert_ne!(own.header("location"), job);
    let submit = [("authorization", ana.as_str())];
    app.post_with(JOBS, study(&[short("slotine_li")]).to_string(), &submit).await;
    let page = ask(&app, "GET", "/api/v1/jobs?limit=1", &ana).await.json();
    let next = format!("{JOBS}?cursor={}", page["next_cursor"].as_str().unwrap());
    assert_eq!(ask(&app, "GET", &next, &ana).await.json()["jobs"].as_array().unwrap().len(), 1);
    ask(&app, "GET", &next, &bob).await.problem(404, "/problems/http");
    assert_eq!(ask(&app, "GET", JOBS, &bob).await.json()["jobs"].as_array().unwrap().len(), 1);
}

#[tokio::test]
async fn a_token_allows_what_it_names_for_as_long_as_it_holds() {
    let app = App::public(|_| ()).await;
    let reader = app.token("ana", "jobs:read").await;
    assert_eq!(ask(&app, "GET", JOBS, &reader).await.status, 200);
    let refused = app.post_with(JOBS, study(&[short("proposed")]).to_string(), &[("authorization", &reader)]).await;
    assert_eq!(refused.problem(403, "/problems/scope")["scope"], "jobs:write");
    assert!(refused.header("www-authenticate").contains("error=\"insufficient_scope\", scope=\"jobs:write\""));
    assert_eq!(ask(&app, "GET", "/metrics", &reader).await.problem(403, "/problems/scope")["scope"], "metrics:read");
    let observer = app.token("grafana", "metrics:read").await;
    let metrics = ask(&app, "GET", "/metrics", &observer).await;
    assert!(String::from_utf8(metrics.body).unwrap().contains("adaptarm_queue_depth{state=\"queued\"}"));
    ask(&app, "GET", JOBS, &observer).await.problem(403, "/problems/scope");

    let id = &reader["Bearer adaptarm_".len()..][..12];
    // It is noted beside the answer.
    while app.state.store.token(id).await.unwrap().unwrap().last_used_at.is_none() {
        tokio::time::sleep(std::time::Duration::from_millis(5)).await;
    }
    assert!(app.state.store.revoke_token(id).await.unwrap());
    let revoked = ask(&app, "GET", JOBS, &reader).await;
    assert_eq!(revoked.problem(401, "/problems/token")["detail"], "the token was revoked");
    assert!(revoked.header("www-authenticate").contains("error=\"invalid_token\""));
}

#[tokio::test]
async fn who_asks_too_often_waits_and_nobody_else() {
    let app = App::public(|config| config.auth.requests_per_minute = 5).await;
    let (ana, bob) = (app.token("ana", ALL).await, app.token("bob", ALL).await);
    for _ in 0..5 {
        assert_eq!(ask(&app, "GET", JOBS, &ana).await.status, 200);
    }
    let refused = ask(&app, "GET", JOBS, &ana).await;
    assert_eq!(refused.problem(429, "/problems/rate-limit")["per_minute"], 5);
    assert!((1..=12).contains(&refused.header("retry-after").parse().unwrap()));
    assert_eq!(ask(&app, "GET", JOBS, &bob).await.status, 200);
}

#[tokio::test]
async fn who_guesses_is_sent_away() {
    let app = App::public(|_| ()).await;
    let guess = format!("Bearer adaptarm_0123456789ab_{}", "0".repeat(64));
    let mut statuses = Vec::new();
    for _ in 0..40 {
        statuses.push(ask(&app, "GET", JOBS, &guess).await.status.as_u16());
    }
    assert_eq!((statuses[0], statuses[39]), (401, 429));
    let refused = ask(&app, "GET", JOBS, &guess).await;
    refused.problem(429, "/problems/rate-limit");
    assert!(!refused.header("retry-after").is_empty());
    // Who shares the address, behind a proxy, does not suffer.
    assert_eq!(ask(&app, "GET", JOBS, &app.token("ana", ALL).await).await.status, 200);
}

#[tokio::test]
async fn on_loopback_a_token_is_not_needed_but_counts() {
    let app = App::new().await;
    let mine = app.submit(&[short("proposed")]).await;
    let ana = app.token("ana", "jobs:read").await;
    ask(&app, "GET", &mine, &ana).await.problem(404, "/problems/http");
    assert_eq!(ask(&app, "GET", JOBS, &ana).await.json(), json!({ "jobs": [] }));
    ask(&app, "GET", JOBS, "Bearer adaptarm_x").await.problem(401, "/problems/token");
    // A proxy in front may have asked for a password.
    assert_eq!(ask(&app, "GET", &mine, "Basic YTpi").await.status, 200);
}
