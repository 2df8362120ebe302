//! What goes over the wire: requests and answers as types, and how a request's body becomes one.

pub mod catalog;
pub mod headers;
pub mod jobs;
pub mod page;

use crate::document;
use crate::error::Problem;
use crate::state::AppState;
use axum::body::{Body, Bytes};
use axum::extract::{FromRequest, FromRequestParts, Path, Request};
use axum::http::request::Parts;
use axum::http::{HeaderMap, StatusCode, header};
use http_body_util::{BodyExt, LengthLimitError, Limited};
use serde::de::DeserializeOwned;

/// The bytes of a body that is declared as JSON and is not too large. What they say is read beside the async threads.
#[derive(Debug, Clone)]
pub struct JsonBytes(pub Bytes);

impl FromRequest<AppState> for JsonBytes {
    type Rejection = Problem;

    async fn from_request(request: Request, state: &AppState) -> Result<Self, Problem> {
        let (parts, body) = request.into_parts();
        if !is_json(&parts.headers) {
            return Err(Problem::new(
                StatusCode::UNSUPPORTED_MEDIA_TYPE,
                "/problems/media-type",
                "Not declared as JSON",
                "send the header `Content-Type: application/json`",
            ));
        }
        read_body(&parts.headers, body, state.config.limits.request_bytes).await.map(Self)
    }
}

/// A request's query; what is wrong with it is told.
#[derive(Debug, Clone, Copy)]
pub struct Query<T>(pub T);

impl<T: DeserializeOwned, S: Send + Sync> FromRequestParts<S> for Query<T> {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, state: &S) -> Result<Self, Problem> {
        let query = axum::extract::Query::from_request_parts(parts, state).await;
        query
            .map(|axum::extract::Query(query)| Self(query))
            .map_err(|error| Problem::status(StatusCode::BAD_REQUEST, query_error(&error.body_text())))
    }
}

/// What the framework says of a query, in this house's words.
fn query_error(said: &str) -> String {
    let said = said.strip_prefix("Failed to deserialize query string: ").unwrap_or(said);
    document::brief(&format!("query: {}", said.replacen("field", "parameter", 1)))
}

/// The name in a request's path, or several as a tuple.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Name<T = String>(pub T);

impl<T: DeserializeOwned + Send, S: Send + Sync> FromRequestParts<S> for Name<T> {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, state: &S) -> Result<Self, Problem> {
        let name = Path::from_request_parts(parts, state).await;
        // All that strings can fail at.
        let detail = "the path, with its percent-encoding undone, is not UTF-8 text";
        name.map(|Path(name)| Self(name)).map_err(|error| Problem::status(error.status(), detail))
    }
}

/// Whether the body is declared as JSON, which no other site's page can do without asking first.
fn is_json(headers: &HeaderMap) -> bool {
    let value = headers.get(header::CONTENT_TYPE).and_then(|value| value.to_str().ok()).unwrap_or_default();
    let media_type = value.split(';').next().unwrap_or_default().trim().to_ascii_lowercase();
    media_type == "application/json" || (media_type.starts_with("application/") && media_type.ends_with("+json"))
}

/// The whole body, if it is not too large.
async fn read_body(headers: &HeaderMap, body: Body, most: usize) -> Result<Bytes, Problem> {
    let declared = headers.get(header::CONTENT_LENGTH).and_then(|value| value.to_str().ok()?.parse::<u64>().ok());
    if declared.is_none_or(|length| length <= most as u64) {
        match Limited::new(body, most).collect().await {
            Ok(collected) => return Ok(collected.to_bytes()),
            Err(error) if error.is::<LengthLimitError>() => {}
            Err(error) => return Err(Problem::status(StatusCode::BAD_REQUEST, format!("the body broke off: {error}"))),
        }
    }
    let size = declared.map_or_else(String::new, |length| format!("{length} bytes are too many: "));
    let detail = format!("{size}a body may have {most} bytes");
    Err(Problem::new(StatusCode::PAYLOAD_TOO_LARGE, "/problems/too-large", "Body too large", detail)
        .with("max_bytes", most))
}
