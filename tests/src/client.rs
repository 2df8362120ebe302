//! A client of the HTTP API that takes every status as an answer and waits for what it asked for.

use crate::events::Events;
use anyhow::{Context, Result, ensure};
use serde_json::{Value, json};
use std::time::{Duration, Instant};
use ureq::http::{HeaderMap, Request};

/// Longest that one answer may take, the whole body included.
const PATIENCE: Duration = Duration::from_mins(1);

/// Longest that a stream of events may stay open.
const LONGEST_STREAM: Duration = Duration::from_mins(30);

/// A client of one server, as one user.
#[derive(Debug, Clone)]
pub struct Client {
    agent: ureq::Agent,
    url: String,
    token: Option<String>,
}

/// A whole answer.
#[derive(Debug, Clone)]
pub struct Answer {
    /// HTTP status.
    pub status: u16,
    /// Headers.
    pub headers: HeaderMap,
    /// Body.
    pub body: Vec<u8>,
}

impl Answer {
    /// The body, which must be JSON.
    pub fn json(&self) -> Result<Value> {
        serde_json::from_slice(&self.body).with_context(|| format!("no JSON in {self}"))
    }

    /// The body, which must be JSON and come with this status.
    pub fn expect(&self, status: u16) -> Result<Value> {
        self.expect_status(status)?;
        self.json()
    }

    /// Checks the status of an answer whose body does not matter.
    pub fn expect_status(&self, status: u16) -> Result<()> {
        ensure!(self.status == status, "{self} instead of {status}");
        Ok(())
    }

    /// A header's value; empty if it is absent.
    pub fn header(&self, name: &str) -> &str {
        self.headers.get(name).and_then(|value| value.to_str().ok()).unwrap_or_default()
    }
}

impl std::fmt::Display for Answer {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let text = String::from_utf8_lossy(&self.body);
        write!(f, "{}: {}", self.status, text.chars().take(600).collect::<String>())
    }
}

impl Client {
    /// A client without credentials.
    pub fn new(url: &str) -> Self {
        let agent = ureq::Agent::config_builder()
            .http_status_as_error(false)
            .timeout_global(Some(PATIENCE))
            .max_idle_connections(4)
            .build()
            .into();
        Self { agent, url: url.to_owned(), token: None }
    }

    /// The same as the user of this token.
    pub fn with_token(&self, token: &str) -> Self {
        Self { token: Some(token.to_owned()), ..self.clone() }
    }

    /// Sends a request; `path` starts at the server's root.
    pub fn send(&self, method: &str, path: &str, headers: &[(&str, &str)], body: &[u8]) -> Result<Answer> {
        let mut response = self.agent.run(self.request(method, path, headers, body)?)?;
        let body = response.body_mut().with_config().limit(1 << 30).read_to_vec()?;
        Ok(Answer { status: response.status().as_u16(), headers: response.headers().clone(), body })
    }

    fn request(&self, method: &str, path: &str, headers: &[(&str, &str)], body: &[u8]) -> Result<Request<Vec<u8>>> {
        let mut request = Request::builder().method(method).uri(format!("{}{path}", self.url));
        if let Some(token) = &self.token {
            request = request.header("authorization", format!("Bearer {token}"));
        }
        for (name, value) in headers {
            request = request.header(*name, *value);
        }
        Ok(request.body(body.to_vec())?)
    }

    /// GET.
    pub fn get(&self, path: &str) -> Result<Answer> {
        self.send("GET", path, &[], &[])
    }

    /// POST of JSON.
    pub fn post(&self, path: &str, body: &Value) -> Result<Answer> {
        self.send("POST", path, &[("content-type", "application/json")], body.to_string().as_bytes())
    }

    /// DELETE.
    pub fn delete(&self, path: &str) -> Result<Answer> {
        self.send("DELETE", path, &[], &[])
    }

    /// Submits a job, which must be accepted; its identifier.
    pub fn submit(&self, job: &Value) -> Result<String> {
        identifier(&self.post("/api/v1/jobs", job)?)
    }

    /// Submits a job again and again under one key until an answer comes, as one does when servers die; its identifier.
    pub fn submit_surely(&self, job: &Value, key: &str, within: Duration) -> Result<String> {
        let headers = [("content-type", "application/json"), ("idempotency-key", key)];
        let body = job.to_string();
        let answer = surely(within, || Ok(answered(self.send("POST", "/api/v1/jobs", &headers, body.as_bytes()))))?;
        identifier(&answer)
    }

    /// The job as the server describes it.
    pub fn job(&self, id: &str) -> Result<Value> {
        self.get(&format!("/api/v1/jobs/{id}"))?.expect(200)
    }

    /// The job once it has ended, which must be within this time. A server that does not answer is asked again.
    pub fn wait(&self, id: &str, within: Duration) -> Result<Value> {
        surely(within, || {
            let Some(answer) = answered(self.get(&format!("/api/v1/jobs/{id}"))) else { return Ok(None) };
            let job = answer.expect(200)?;
            Ok(is_final(&job).then_some(job))
        })
        .with_context(|| match self.job(id) {
            Ok(job) => format!("waiting for the end of {job}"),
            Err(error) => format!("waiting for the end of job {id}, about which nobody answers ({error:#})"),
        })
    }

    /// Returns once every job has ended, which must be within this time.
    pub fn wait_for_all(&self, within: Duration) -> Result<()> {
        let done = || {
            let unfinished = self.jobs("state=queued")?.len() + self.jobs("state=running")?.len();
            Ok((unfinished == 0).then_some(()))
        };
        surely(within, done).context("waiting for the end of all jobs")
    }

    /// The result of a job that has ended.
    pub fn result(&self, id: &str) -> Result<Value> {
        self.get(&format!("/api/v1/jobs/{id}/result"))?.expect(200)
    }

    /// Cancels a job.
    pub fn cancel(&self, id: &str) -> Result<Answer> {
        self.post(&format!("/api/v1/jobs/{id}/cancel"), &json!({}))
    }

    /// Every job that a filter such as `state=failed` lets through, page by page.
    pub fn jobs(&self, filter: &str) -> Result<Vec<Value>> {
        let mut jobs = Vec::new();
        let mut cursor = String::new();
        loop {
            let page = self.get(&format!("/api/v1/jobs?limit=100&{filter}{cursor}"))?.expect(200)?;
            jobs.extend_from_slice(page["jobs"].as_array().context("a page without jobs")?);
            let Some(next) = page["next_cursor"].as_str() else { return Ok(jobs) };
            cursor = format!("&cursor={next}");
        }
    }

    /// The job's events after the one with this identifier; from the first on when there is none.
    pub fn events(&self, id: &str, after: Option<&str>) -> Result<Events> {
        let after: Vec<_> = after.map(|after| ("last-event-id", after)).into_iter().collect();
        self.stream(&format!("/api/v1/jobs/{id}/events"), &after)
    }

    /// The events that this path tells.
    pub fn stream(&self, path: &str, headers: &[(&str, &str)]) -> Result<Events> {
        let headers: Vec<_> = [("accept", "text/event-stream")].iter().chain(headers).copied().collect();
        let request = self.request("GET", path, &headers, &[])?;
        let request = self.agent.configure_request(request).timeout_global(Some(LONGEST_STREAM)).build();
        let response = self.agent.run(request)?;
        ensure!(response.status() == 200, "{} for {path}", response.status());
        Ok(Events::new(response.into_body().into_reader()))
    }
}

/// Whether a job will not change any more.
pub fn is_final(job: &Value) -> bool {
    matches!(job["state"].as_str(), Some("succeeded" | "failed" | "canceled"))
}

/// Tries until there is something, at most for this time; an error ends it at once.
pub fn surely<T>(within: Duration, attempt: impl Fn() -> Result<Option<T>>) -> Result<T> {
    let deadline = Instant::now() + within;
    loop {
        if let Some(found) = attempt()? {
            return Ok(found);
        }
        ensure!(Instant::now() < deadline, "nothing within {within:?}");
        std::thread::sleep(Duration::from_millis(20));
    }
}

/// An answer of a server that is well; none while it is dead, starting, or without its database.
fn answered(outcome: Result<Answer>) -> Option<Answer> {
    outcome.ok().filter(|answer| answer.status < 500)
}

fn identifier(answer: &Answer) -> Result<String> {
    let job = answer.json()?;
    ensure!(matches!(answer.status, 200 | 202), "not accepted: {answer}");
    Ok(job["id"].as_str().context("a job without an identifier")?.to_owned())
}
