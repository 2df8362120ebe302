//! What a platform's administrator needs to know about this tool, and what platforms fetch by themselves.

use super::super::claims::{LINE_ITEM_SCOPE, SCORE_SCOPE};
use super::super::deep_link::target;
use super::super::roster;
use crate::classroom::session::Teacher;
use crate::error::Problem;
use crate::state::AppState;
use axum::Json;
use axum::extract::State;
use axum::http::{HeaderMap, HeaderValue, header};
use axum::response::IntoResponse;
use serde_json::{Value, json};

/// The public half of this server's key.
pub(super) async fn keys(State(state): State<AppState>) -> Result<Json<Value>, Problem> {
    Ok(Json(state.lti.key().await?.public().clone()))
}

/// The addresses that a platform asks for.
pub(super) async fn tool(State(state): State<AppState>, _: Teacher, headers: HeaderMap) -> Json<Value> {
    let base = state.desk.base(&headers);
    Json(json!({
        "login_url": format!("{base}/lti/login"),
        "launch_url": target(&base),
        "keys_url": format!("{base}/lti/keys"),
        "canvas_url": format!("{base}/lti/canvas.json"),
    }))
}

/// The same as Canvas reads it: a developer key's configuration.
pub(super) async fn canvas(State(state): State<AppState>, headers: HeaderMap) -> Json<Value> {
    let base = state.desk.base(&headers);
    let choosing = |placement: &str| {
        json!({
            "placement": placement, "message_type": "LtiDeepLinkingRequest", "target_link_uri": target(&base),
            "text": "adaptarm", "enabled": true,
        })
    };
    let placements = ["assignment_selection", "link_selection"].map(choosing);
    Json(json!({
        "title": "adaptarm",
        "description": "Exercises in the adaptive control of robot arms.",
        "oidc_initiation_url": format!("{base}/lti/login"),
        "target_link_uri": target(&base),
        "public_jwk_url": format!("{base}/lti/keys"),
        "scopes": [LINE_ITEM_SCOPE, SCORE_SCOPE, roster::SCOPE],
        "extensions": [{
            "platform": "canvas.instructure.com",
            "privacy_level": "name_only",
            "settings": { "placements": placements },
        }],
        "custom_fields": {},
    }))
}

/// The script of the page that carries an answer.
pub(super) async fn script() -> impl IntoResponse {
    let kind = HeaderValue::from_static("text/javascript; charset=utf-8");
    ([(header::CONTENT_TYPE, kind)], include_str!("../submit.js"))
}

/// How the pages look.
pub(super) async fn style() -> impl IntoResponse {
    let kind = HeaderValue::from_static("text/css; charset=utf-8");
    ([(header::CONTENT_TYPE, kind)], include_str!("../page.css"))
}
