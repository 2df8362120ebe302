//! A receiver on this machine is called, with a signature that it can check.

use crate::support::{App, JOBS, short, study};
use adaptarm::webhooks::{Secret, verify};
use axum::Router;
use axum::extract::State;
use axum::http::{HeaderMap, StatusCode};
use axum::routing::post;
use serde_json::{Value, json};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};
use std::time::Duration;

const SECRET: &str = "0123456789abcdef";

#[derive(Clone, Default)]
struct Receiver {
    calls: Arc<Mutex<Vec<(HeaderMap, String)>>>,
    failures: Arc<AtomicUsize>,
}

async fn receive(State(receiver): State<Receiver>, headers: HeaderMap, body: String) -> StatusCode {
    receiver.calls.lock().unwrap().push((headers, body));
    let failing =
        receiver.failures.fetch_update(Ordering::SeqCst, Ordering::SeqCst, |left| left.checked_sub(1)).is_ok();
    if failing { StatusCode::SERVICE_UNAVAILABLE } else { StatusCode::NO_CONTENT }
}

#[tokio::test]
async fn every_change_of_state_is_told_until_the_receiver_has_it() {
    let receiver = Receiver::default();
    receiver.failures.store(1, Ordering::SeqCst);
    let listener = tokio::net::TcpListener::bind("127.0.0.1:0").await.unwrap();
    let url = format!("http://{}/hook", listener.local_addr().unwrap());
    let app = Router::new().route("/hook", post(receive)).with_state(receiver.clone());
    tokio::spawn(axum::serve(listener, app).into_future());

    let app = App::with(|config| {
        config.webhooks.allow = vec!["127.0.0.1".to_owned()];
        config.webhooks.first_retry_s = 0.05;
    })
    .await;
    let mut body = study(&[short("proposed")]);
    body["webhook"] = json!({ "url": url, "secret": SECRET });
    let submitted = app.post(JOBS, body.to_string()).await;
    assert_eq!(submitted.status, 202);
    assert!(!String::from_utf8_lossy(&submitted.body).contains(SECRET), "the secret is told to nobody");
    let told = |kind: &str| {
        let calls = receiver.calls.lock().unwrap();
        let events: Vec<(String, String)> = calls
            .iter()
            .map(|(headers, _)| {
                let text = |name: &str| headers[name].to_str().unwrap().to_owned();
                (text("adaptarm-event-type"), text("adaptarm-event-id"))
            })
            .collect();
        events.into_iter().filter(|(found, _)| found == kind).map(|(_, id)| id).collect::<Vec<_>>()
    };
    for _ in 0..600 {
        if ["job.queued", "job.running", "job.succeeded"].iter().all(|kind| !told(kind).is_empty())
            && receiver.calls.lock().unwrap().len() == 4
        {
            break;
        }
        tokio::time::sleep(Duration::from_millis(50)).await;
    }
    let calls = receiver.calls.lock().unwrap().clone();
    assert_eq!(calls.len(), 4, "three changes, one of them told twice: {calls:?}");
    for (headers, body) in &calls {
        let signature = headers["adaptarm-signature"].to_str().unwrap();
        let now = jiff::Timestamp::now().as_second();
        verify(&Secret::new(SECRET), signature, body, now, Duration::from_mins(5)).unwrap();
        let event: Value = serde_json::from_str(body).unwrap();
        assert_eq!(event["id"], headers["adaptarm-event-id"].to_str().unwrap());
        assert!(submitted.header("location").ends_with(event["data"]["id"].as_str().unwrap()));
    }
}

#[tokio::test]
async fn addresses_that_only_the_server_can_reach_are_refused() {
    let app = App::new().await;
    let mut body = study(&[short("proposed")]);
    body["webhook"] = json!({ "url": "http://127.0.0.1:9/", "secret": SECRET });
    let problem = app.post(JOBS, body.to_string()).await.problem(422, "/problems/malformed");
    assert_eq!(problem["pointer"], "/webhook/url");
    body["webhook"] = json!({ "url": "https://example.org/", "secret": "short" });
    let problem = app.post(JOBS, body.to_string()).await.problem(422, "/problems/out-of-range");
    assert_eq!(problem["pointer"], "/webhook/secret");
}

/// The signature that docs/api.md shows to people who write receivers.
#[test]
fn the_manual_s_signature_is_ours() {
    let signature = "t=1700000000,v1=d5f5834972cbc6cf5590800c46ccaa0cd6c16f19c0c73dbdf9b4c56390cbc2a3";
    let manual = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/api.md");
    assert!(std::fs::read_to_string(manual).unwrap().contains(signature));
    let tolerance = Duration::from_mins(5);
    assert_eq!(verify(&Secret::new(SECRET), signature, r#"{"id":"1"}"#, 1_700_000_001, tolerance), Ok(()));
}
