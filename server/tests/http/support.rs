//! An application with tables and results of its own, and the requests that most tests make.

use adaptarm::auth::{Owner, Token};
use adaptarm::config::Config;
use adaptarm::guard::Hosts;
use adaptarm::jobs::StoredToken;
use adaptarm::laboratory::Laboratory;
use adaptarm::router::build_app;
use adaptarm::state::AppState;
use adaptarm::webhooks;
use axum::Router;
use axum::body::Body;
use axum::http::{HeaderMap, Request, StatusCode};
use http_body_util::BodyExt;
use jiff::Timestamp;
use serde_json::{Value, json};
use std::time::Duration;
use tempfile::TempDir;
use tokio::sync::watch;
use tokio::time::{sleep, timeout};
use tower::ServiceExt;

pub const JOBS: &str = "/api/v1/jobs";

/// Longer than anything here takes, on a slow machine too.
const PATIENCE: Duration = Duration::from_mins(1);

/// An application and what it answers.
pub struct App {
    router: Router,
    pub state: AppState,
    _end: watch::Sender<bool>,
    _data: TempDir,
}

/// One answer.
#[derive(Debug)]
pub struct Answer {
    pub status: StatusCode,
    pub headers: HeaderMap,
    pub body: Vec<u8>,
}

impl Answer {
    pub fn json(&self) -> Value {
        serde_json::from_slice(&self.body).unwrap_or_else(|error| panic!("{error}: {self:?}"))
    }

    pub fn header(&self, name: &str) -> &str {
        self.headers.get(name).map_or("", |value| value.to_str().unwrap())
    }

    /// The problem document, after checking that it is one.
    pub fn problem(&self, status: u16, kind: &str) -> Value {
        let problem = self.json();
        assert_eq!(self.status.as_u16(), status, "{problem}");
        assert_eq!(self.header("content-type"), "application/problem+json");
        assert_eq!(problem["type"], kind, "{problem}");
        assert_eq!(problem["status"], status);
        assert!(!problem["title"].as_str().unwrap().is_empty());
        assert!(!problem["detail"].as_str().unwrap().is_empty());
        let id = self.header("x-request-id");
        assert_eq!(problem["instance"], format!("urn:uuid:{id}"));
        problem
    }
}

impl App {
    pub async fn new() -> Self {
        Self::with(|_| ()).await
    }

    /// With other settings than the usual ones.
    pub async fn with(change: impl FnOnce(&mut Config)) -> Self {
        Self::start(change, Hosts::Loopback).await
    }

    /// As if other machines could reach it.
    pub async fn public(change: impl FnOnce(&mut Config)) -> Self {
        Self::start(change, Hosts::Any).await
    }

    async fn start(change: impl FnOnce(&mut Config), hosts: Hosts) -> Self {
        adaptarm::metrics::start();
        let data = tempfile::tempdir().unwrap();
        let mut config = Config { data: Some(data.path().to_owned()), threads: Some(2), ..Config::default() };
        config.queue.heartbeat_ms = 20;
        change(&mut config);
        let laboratory = Laboratory::open(&config).await.unwrap();
        let desk = laboratory.desk(&config).await.unwrap();
        let lti = laboratory.tool(&desk, &config).unwrap();
        let state = AppState::new(&laboratory, desk, lti, &config, hosts);
        let (end, ending) = watch::channel(false);
        tokio::spawn(webhooks::worker::run(laboratory.queue.clone(), laboratory.sender(&config), ending));
        let engine = laboratory.engine.clone();
        tokio::spawn(async move {
            // Holds the folder for as long as it works.
            let _laboratory = laboratory;
            engine.run().await;
        });
        Self { router: build_app(state.clone()), state, _end: end, _data: data }
    }

    pub async fn call(&self, request: Request<Body>) -> Answer {
        let response = self.router.clone().oneshot(request).await.unwrap();
        let (parts, body) = response.into_parts();
        let body = timeout(PATIENCE, body.collect()).await.expect("the answer ends").unwrap().to_bytes().to_vec();
        Answer { status: parts.status, headers: parts.headers, body }
    }

    /// A request without a body.
    pub async fn ask(&self, method: &str, path: &str, headers: &[(&str, &str)]) -> Answer {
        let request =
            headers.iter().fold(request(method, path), |request, (name, value)| request.header(*name, *value));
        self.call(request.body(Body::empty()).unwrap()).await
    }

    pub async fn get(&self, path: &str) -> Answer {
        self.ask("GET", path, &[]).await
    }

    pub async fn post(&self, path: &str, body: impl Into<Body>) -> Answer {
        self.post_with(path, body, &[]).await
    }

    pub async fn post_with(&self, path: &str, body: impl Into<Body>, headers: &[(&str, &str)]) -> Answer {
        let request = request("POST", path).header("content-type", "application/json");
        let request = headers.iter().fold(request, |request, (name, value)| request.header(*name, *value));
        self.call(request.body(body.into()).unwrap()).await
    }

    /// Submits a study and returns its address.
    pub async fn submit(&self, scenarios: &[Value]) -> String {
        let answer = self.post(JOBS, study(scenarios).to_string()).await;
        assert_eq!(answer.status, StatusCode::ACCEPTED, "{answer:?}");
        answer.header("location").to_owned()
    }

    /// The job once it has reached one of these states.
    pub async fn wait(&self, job: &str, states: &[&str]) -> Value {
        let reached = async {
            loop {
                let view = self.get(job).await.json();
                if states.iter().any(|state| view["state"] == *state) {
                    return view;
                }
                sleep(Duration::from_millis(5)).await;
            }
        };
        timeout(PATIENCE, reached).await.unwrap_or_else(|_| panic!("{job} never reached {states:?}"))
    }

    /// Value of the header `Authorization` for a new token.
    pub async fn token(&self, owner: &str, scopes: &str) -> String {
        let (owner, scopes) = (Owner::new(owner).unwrap(), scopes.parse().unwrap());
        let (token, text) = Token::issue(owner, "test", scopes, None, Timestamp::now()).unwrap();
        self.state.store.add_token(&StoredToken::from(&token)).await.unwrap();
        format!("Bearer {}", text.reveal())
    }
}

impl Drop for App {
    fn drop(&mut self) {
        // Or a simulation would keep its thread to the end of all tests.
        self.state.engine.stop();
    }
}

pub fn request(method: &str, path: &str) -> axum::http::request::Builder {
    Request::builder().method(method).uri(path).header("host", "127.0.0.1:8080")
}

pub fn study(scenarios: &[Value]) -> Value {
    json!({ "kind": "study", "spec": { "scenarios": scenarios } })
}

/// A scenario of half a second.
pub fn short(scheme: &str) -> Value {
    json!({
        "format": "adaptarm.scenario/1",
        "scheme": { "kind": scheme },
        "integration": { "duration_s": 0.5 },
        "recording": { "samples": 100 },
    })
}

/// A scenario of minutes of computing.
pub fn long() -> Value {
    let mut scenario = short("slotine_li");
    scenario["integration"]["duration_s"] = json!(90_000.0);
    scenario
}
