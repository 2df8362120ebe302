//! An application to call, and the requests that most tests make.

use adaptarm::config::Capacity;
use adaptarm::guard::Hosts;
use adaptarm::jobs::{Engine, MemoryStore};
use adaptarm::router::build_app;
use adaptarm::state::AppState;
use axum::Router;
use axum::body::Body;
use axum::http::{HeaderMap, Request, StatusCode};
use http_body_util::BodyExt;
use serde_json::{Value, json};
use std::sync::Arc;
use std::time::Duration;
use tower::ServiceExt;

/// An application and what it answers.
pub struct App(Router);

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
    pub fn new() -> Self {
        Self::with(Capacity::default())
    }

    pub fn with(capacity: Capacity) -> Self {
        Self(build_app(AppState::in_memory(capacity, Hosts::Loopback).unwrap()))
    }

    /// With this in place of the simulation, and one thread.
    pub fn simulating(capacity: Capacity, simulate: adaptarm::jobs::Simulate) -> Self {
        let engine = Engine::with(Arc::new(MemoryStore::new(capacity)), simulate, 1).unwrap();
        Self(build_app(AppState::new(engine, Hosts::Loopback)))
    }

    pub async fn call(&self, request: Request<Body>) -> Answer {
        let response = self.0.clone().oneshot(request).await.unwrap();
        let (parts, body) = response.into_parts();
        let body = body.collect().await.unwrap().to_bytes().to_vec();
        Answer { status: parts.status, headers: parts.headers, body }
    }

    pub async fn get(&self, path: &str) -> Answer {
        self.call(request("GET", path).body(Body::empty()).unwrap()).await
    }

    pub async fn post(&self, path: &str, body: impl Into<Body>) -> Answer {
        let request = request("POST", path).header("content-type", "application/json");
        self.call(request.body(body.into()).unwrap()).await
    }

    /// Submits a study and returns its address.
    pub async fn submit(&self, scenarios: &[Value]) -> String {
        let answer = self.post("/api/v1/jobs", study(scenarios).to_string()).await;
        assert_eq!(answer.status, StatusCode::ACCEPTED, "{answer:?}");
        answer.header("location").to_owned()
    }

    /// The job once it has reached one of these states.
    pub async fn wait(&self, job: &str, states: &[&str]) -> Value {
        for _ in 0..2000 {
            let view = self.get(job).await.json();
            if states.iter().any(|state| view["state"] == *state) {
                return view;
            }
            tokio::time::sleep(Duration::from_millis(5)).await;
        }
        panic!("{job} never reached {states:?}");
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
