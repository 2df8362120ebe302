//! What the platform answers over HTTP: keys, access tokens, members, gradebook, and the place for choices.

use super::{CLIENT, Shared, forge, lock};
use crate::client::Client;
use axum::extract::{Form, Path, Query, State};
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::{IntoResponse, Response};
use axum::routing::{get, post};
use axum::{Json, Router};
use serde_json::{Value, json};
use std::collections::HashMap;
use std::sync::Arc;
use std::sync::atomic::Ordering;

const SCOPES: [&str; 3] = [
    "https://purl.imsglobal.org/spec/lti-ags/scope/lineitem",
    "https://purl.imsglobal.org/spec/lti-ags/scope/score",
    "https://purl.imsglobal.org/spec/lti-nrps/scope/contextmembership.readonly",
];

/// Members on a page.
const PAGE: usize = 2;

type Fields = HashMap<String, String>;

pub(super) fn router(shared: Arc<Shared>) -> Router {
    Router::new()
        .route("/keys", get(keys))
        .route("/token", post(token))
        .route("/members", get(members))
        .route("/columns", get(columns).post(add_column))
        .route("/columns/{number}/lineitem/scores", post(score))
        .with_state(shared)
}

async fn keys(State(shared): State<Arc<Shared>>) -> Json<Value> {
    Json(json!({ "keys": [{ "kty": "EC", "kid": "another kind" }, shared.key.jwk()] }))
}

/// An answer that is none.
struct Refused(StatusCode, String);

impl IntoResponse for Refused {
    fn into_response(self) -> Response {
        (self.0, Json(json!({ "error": self.1 }))).into_response()
    }
}

fn refuse(status: StatusCode, why: impl Into<String>) -> Refused {
    Refused(status, why.into())
}

/// Gives out a token for whoever shows that they are the tool.
async fn token(State(shared): State<Arc<Shared>>, Form(fields): Form<Fields>) -> Result<Response, Refused> {
    if shared.down.load(Ordering::SeqCst) {
        return Err(refuse(StatusCode::SERVICE_UNAVAILABLE, "down"));
    }
    let field = |name: &str| fields.get(name).cloned().unwrap_or_default();
    let (tool, assertion, scope) = (lock(&shared.tool).clone(), field("client_assertion"), field("scope"));
    let claims = tokio::task::spawn_blocking(move || {
        let keys = Client::new(&tool).get("/lti/keys")?.expect(200)?;
        forge::verify(&assertion, &keys)
    });
    let claims = match claims.await {
        Ok(Ok(claims)) => claims,
        Ok(Err(error)) => return Err(refuse(StatusCode::UNAUTHORIZED, format!("{error:#}"))),
        Err(error) => return Err(refuse(StatusCode::INTERNAL_SERVER_ERROR, error.to_string())),
    };
    let now = jiff::Timestamp::now().as_second();
    let fits = claims["iss"] == CLIENT
        && claims["sub"] == CLIENT
        && claims["aud"] == format!("{}/token", shared.url)
        && claims["exp"].as_i64().is_some_and(|ends| ends > now && ends < now + 3600)
        && claims["jti"].is_string();
    let asked = field("grant_type") == "client_credentials"
        && field("client_assertion_type") == "urn:ietf:params:oauth:client-assertion-type:jwt-bearer";
    if !fits || !asked || !SCOPES.contains(&scope.as_str()) {
        return Err(refuse(StatusCode::BAD_REQUEST, format!("{claims}")));
    }
    let mut tokens = lock(&shared.tokens);
    let token = format!("token-{}", tokens.len());
    tokens.push((token.clone(), scope.clone()));
    Ok(Json(json!({ "access_token": token, "token_type": "Bearer", "expires_in": 3600, "scope": scope }))
        .into_response())
}

/// Whether a request may use a service.
fn check(shared: &Shared, headers: &HeaderMap, scope: &str) -> Result<(), Refused> {
    if shared.down.load(Ordering::SeqCst) {
        return Err(refuse(StatusCode::SERVICE_UNAVAILABLE, "down"));
    }
    let shown = headers.get(header::AUTHORIZATION).and_then(|shown| shown.to_str().ok()?.strip_prefix("Bearer "));
    let good = lock(&shared.tokens).iter().any(|(token, of)| Some(token.as_str()) == shown && of == scope);
    if good { Ok(()) } else { Err(refuse(StatusCode::UNAUTHORIZED, "no such token, or of another scope")) }
}

async fn members(
    State(shared): State<Arc<Shared>>,
    headers: HeaderMap,
    Query(fields): Query<Fields>,
) -> Result<Response, Refused> {
    check(&shared, &headers, SCOPES[2])?;
    let page: usize = fields.get("page").and_then(|page| page.parse().ok()).unwrap_or(0);
    let all = lock(&shared.members).clone();
    let own: Vec<_> = all.iter().skip(page * PAGE).take(PAGE).cloned().collect();
    let next = format!("<{}/members?page={}>; rel=\"next\"", shared.url, page + 1);
    let answer = Json(json!({ "id": "members", "context": { "id": "robotics" }, "members": own }));
    Ok(if (page + 1) * PAGE < all.len() { ([("link", next)], answer).into_response() } else { answer.into_response() })
}

async fn columns(
    State(shared): State<Arc<Shared>>,
    headers: HeaderMap,
    Query(fields): Query<Fields>,
) -> Result<Response, Refused> {
    check(&shared, &headers, SCOPES[0])?;
    let wanted = fields.get("resource_link_id").map(String::as_str);
    let mut columns = lock(&shared.gradebook).columns.clone();
    columns.retain(|column| wanted.is_none() || column["resourceLinkId"].as_str() == wanted);
    Ok(Json(columns).into_response())
}

async fn add_column(State(shared): State<Arc<Shared>>, headers: HeaderMap, body: String) -> Result<Response, Refused> {
    check(&shared, &headers, SCOPES[0])?;
    let column = read(&headers, "application/vnd.ims.lis.v2.lineitem+json", &body)?;
    let added = lock(&shared.gradebook).add(&shared.url, &column);
    Ok((StatusCode::CREATED, Json(added)).into_response())
}

async fn score(
    State(shared): State<Arc<Shared>>,
    headers: HeaderMap,
    Path(number): Path<usize>,
    Query(fields): Query<Fields>,
    body: String,
) -> Result<Response, Refused> {
    check(&shared, &headers, SCOPES[1])?;
    if fields.get("type_id").map(String::as_str) != Some("3") {
        return Err(refuse(StatusCode::NOT_FOUND, "the column's address had a query"));
    }
    let score = read(&headers, "application/vnd.ims.lis.v1.score+json", &body)?;
    let posted = lock(&shared.gradebook).post(number, score);
    if shared.mute.load(Ordering::SeqCst) {
        std::future::pending::<()>().await;
    }
    match posted {
        Ok(()) => Ok(StatusCode::OK.into_response()),
        Err(why) if why.contains("is there") => Err(refuse(StatusCode::CONFLICT, why)),
        Err(why) => Err(refuse(StatusCode::BAD_REQUEST, why)),
    }
}

/// A body of this media type.
fn read(headers: &HeaderMap, media_type: &str, body: &str) -> Result<Value, Refused> {
    let declared = headers.get(header::CONTENT_TYPE).and_then(|declared| declared.to_str().ok());
    if declared != Some(media_type) {
        return Err(refuse(StatusCode::UNSUPPORTED_MEDIA_TYPE, media_type));
    }
    serde_json::from_str(body).map_err(|error| refuse(StatusCode::BAD_REQUEST, error.to_string()))
}
