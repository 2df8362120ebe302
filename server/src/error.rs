//! Errors over HTTP: RFC 9457 `application/problem+json`, for every response from 400 up.
//!
//! `type` is stable and relative to the server. docs/api.md has the table of all of them, and a test compares. What is wrong in
//! a document has its place as a `pointer`, what is wrong in a query its `parameter`.

use crate::auth::Challenge;
use crate::document::DocumentError;
use crate::jobs::StudyError;
use adaptarm_core::scenario::ScenarioError;
use axum::http::StatusCode;
use axum::http::header::{CONTENT_ENCODING, CONTENT_LENGTH, CONTENT_TYPE, HeaderValue, RETRY_AFTER, WWW_AUTHENTICATE};
use axum::response::{IntoResponse, Response};
use serde::Serialize;
use serde_json::{Map, Value};

/// The media type of every error.
pub const MEDIA_TYPE: &str = "application/problem+json";

/// One error, as a client sees it. Rendered by [`render`], which knows the request it answers.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Problem {
    /// Which kind; see the table in docs/api.md.
    #[serde(rename = "type")]
    pub kind: &'static str,
    /// The kind in words.
    pub title: &'static str,
    /// HTTP status.
    pub status: u16,
    /// What is wrong this time.
    pub detail: String,
    /// The request that this answers, as logs name it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub instance: Option<String>,
    /// Fields of the kind.
    #[serde(flatten)]
    pub fields: Map<String, Value>,
    /// After how many seconds it may be worth trying again.
    #[serde(skip)]
    pub retry_after_s: Option<u32>,
    /// How to log in, where that is what is missing.
    #[serde(skip)]
    pub challenge: Option<Challenge>,
}

impl Problem {
    /// A problem without further fields.
    pub fn new(status: StatusCode, kind: &'static str, title: &'static str, detail: impl Into<String>) -> Self {
        let (status, detail, fields) = (status.as_u16(), detail.into(), Map::new());
        Self { kind, title, status, detail, instance: None, fields, retry_after_s: None, challenge: None }
    }

    /// A problem about which the status says all.
    pub fn status(status: StatusCode, detail: impl Into<String>) -> Self {
        Self::new(status, "/problems/http", status.canonical_reason().unwrap_or("Error"), detail)
    }

    /// 404 for `what` of this name.
    pub fn not_found(what: &str, name: &str) -> Self {
        let name: String = name.chars().take(60).collect();
        Self::status(StatusCode::NOT_FOUND, format!("there is no {what} {name:?}"))
    }

    /// The same with one more field.
    #[must_use]
    pub fn with(mut self, name: &str, value: impl Into<Value>) -> Self {
        self.fields.insert(name.to_owned(), value.into());
        self
    }
}

impl IntoResponse for Problem {
    fn into_response(self) -> Response {
        let status = StatusCode::from_u16(self.status).unwrap_or(StatusCode::INTERNAL_SERVER_ERROR);
        let mut response = status.into_response();
        response.extensions_mut().insert(self);
        response
    }
}

impl From<DocumentError> for Problem {
    fn from(error: DocumentError) -> Self {
        let detail = error.to_string();
        match error {
            DocumentError::Invalid(error) => error.into(),
            DocumentError::Syntax { pointer, line, column, .. } => {
                Self::new(StatusCode::BAD_REQUEST, "/problems/malformed-json", "Not JSON", detail)
                    .with("pointer", pointer)
                    .with("line", line)
                    .with("column", column)
            }
        }
    }
}

impl From<ScenarioError> for Problem {
    fn from(error: ScenarioError) -> Self {
        use adaptarm_core::scenario::Problem as Wrong;
        // The core calls a whole document a scenario; here it may be a request that holds some.
        let detail = if error.pointer.is_empty() { error.problem.to_string() } else { error.to_string() };
        let (kind, title) = match &error.problem {
            Wrong::OutOfRange { .. } => ("/problems/out-of-range", "A number is outside its allowed range"),
            Wrong::WrongLength { .. } => ("/problems/wrong-length", "A list has the wrong length"),
            Wrong::TooMany { .. } => ("/problems/too-long", "Longer than allowed"),
            Wrong::Unknown { .. } => ("/problems/unknown", "A name is not known"),
            Wrong::Conflict { .. } => ("/problems/conflict", "Fields contradict each other"),
            Wrong::Malformed { .. } => ("/problems/malformed", "Not the document that is needed"),
        };
        let mut problem = Self::new(StatusCode::UNPROCESSABLE_ENTITY, kind, title, detail);
        // A struct of strings and numbers always becomes an object.
        if let Ok(Value::Object(fields)) = serde_json::to_value(&error) {
            problem.fields = fields;
        }
        problem.fields.remove("problem");
        problem
    }
}

impl From<StudyError> for Problem {
    fn from(error: StudyError) -> Self {
        let detail = error.to_string();
        match error {
            StudyError::Document(error) => error.into(),
            StudyError::TooMuch { pointer, what, total, most } => {
                Self::new(StatusCode::UNPROCESSABLE_ENTITY, "/problems/too-much", "Too much for one job", detail)
                    .with("pointer", pointer)
                    .with("what", what)
                    .with("total", total)
                    .with("most", most)
            }
        }
    }
}

/// Gives every error its final form, whoever made it: ours, the framework's, or a middleware's.
pub fn render(response: Response, request_id: Option<&str>) -> Response {
    if !response.status().is_client_error() && !response.status().is_server_error() {
        return response;
    }
    let (mut parts, _) = response.into_parts();
    let mut problem = parts
        .extensions
        .remove::<Problem>()
        .unwrap_or_else(|| Problem::status(parts.status, explanation(parts.status)));
    problem.instance = request_id.map(|id| format!("urn:uuid:{id}"));
    parts.headers.remove(CONTENT_LENGTH);
    // What is written here is not compressed, whatever the answer was before.
    parts.headers.remove(CONTENT_ENCODING);
    parts.headers.insert(CONTENT_TYPE, HeaderValue::from_static(MEDIA_TYPE));
    if let Some(seconds) = problem.retry_after_s {
        parts.headers.insert(RETRY_AFTER, HeaderValue::from(seconds));
    }
    // Made here, of plain characters only.
    if let Some(Ok(challenge)) = problem.challenge.map(|challenge| HeaderValue::from_str(&challenge.to_string())) {
        parts.headers.insert(WWW_AUTHENTICATE, challenge);
    }
    // Strings and numbers always serialise.
    let body = serde_json::to_vec(&problem).unwrap_or_default();
    Response::from_parts(parts, body.into())
}

/// What to tell about a status that came without words.
fn explanation(status: StatusCode) -> &'static str {
    match status {
        StatusCode::NOT_FOUND => "nothing is served at this path; the API starts at /api/v1",
        StatusCode::METHOD_NOT_ALLOWED => "this path does not take this method; the header Allow names those it takes",
        StatusCode::REQUEST_TIMEOUT => "the request did not arrive or was not answered in time",
        StatusCode::INTERNAL_SERVER_ERROR => "the server failed; its log names this request",
        _ => status.canonical_reason().unwrap_or("the request failed"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn carries_what_the_core_says_about_a_field() {
        let wrong = adaptarm_core::scenario::Problem::OutOfRange { value: -1.0, min: 1e-6, max: 0.1, unit: "s" };
        let problem = Problem::from(ScenarioError::new("/integration/step_s", wrong).within("/spec/scenarios/3"));
        let json = serde_json::to_value(&problem).unwrap();
        assert_eq!(json["type"], "/problems/out-of-range");
        assert_eq!(json["status"], 422);
        assert_eq!(json["pointer"], "/spec/scenarios/3/integration/step_s");
        assert_eq!((&json["value"], &json["unit"]), (&Value::from(-1.0), &Value::from("s")));
        assert!(json.get("problem").is_none());
    }
}
