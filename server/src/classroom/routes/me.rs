//! What people do about themselves: passwords, keys, what is kept about them.

use super::super::session::{Signed, Student, set_cookie};
use super::super::{export, passwords, problems, secrets};
use super::read;
use crate::api::JsonBytes;
use crate::auth::peer;
use crate::error::Problem;
use crate::routes::problems::database;
use crate::state::AppState;
use axum::Json;
use axum::extract::State;
use axum::http::request::Parts;
use axum::http::{HeaderMap, StatusCode};
use axum::response::{IntoResponse, Response};
use serde::Deserialize;
use serde_json::{Value, json};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct NewPassword {
    password: String,
    current: Option<String>,
}

/// Sets a password; every other session ends.
pub(super) async fn set_password(
    State(state): State<AppState>,
    signed: Signed,
    parts: Parts,
    JsonBytes(bytes): JsonBytes,
) -> Result<StatusCode, Problem> {
    state.lti.refuse_course_account(signed.person.id).await?;
    let NewPassword { password, current } = read(&bytes)?;
    passwords::check("/password", &password)?;
    check_current(&state, &signed, &parts, current).await?;
    let hash = passwords::hash(password).await?;
    state.desk.store.set_password(signed.person.id, Some(&hash), &signed.hash()).await.map_err(database)?;
    Ok(StatusCode::NO_CONTENT)
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct CurrentPassword {
    current: String,
}

/// Takes the password away: the key is the way in again.
pub(super) async fn remove_password(
    State(state): State<AppState>,
    signed: Signed,
    parts: Parts,
    JsonBytes(bytes): JsonBytes,
) -> Result<StatusCode, Problem> {
    let CurrentPassword { current } = read(&bytes)?;
    check_current(&state, &signed, &parts, Some(current)).await?;
    state.desk.store.set_password(signed.person.id, None, &signed.hash()).await.map_err(database)?;
    Ok(StatusCode::NO_CONTENT)
}

/// Whoever finds an open session may not change its password.
async fn check_current(
    state: &AppState,
    signed: &Signed,
    parts: &Parts,
    current: Option<String>,
) -> Result<(), Problem> {
    let kept = signed.person.password.clone();
    if kept.is_none() {
        return Ok(());
    }
    state.desk.check_password(peer(parts), &signed.person.login)?;
    if passwords::verify(current.unwrap_or_default(), kept).await? {
        return Ok(());
    }
    state.desk.wrong_password(peer(parts));
    Err(problems::sign_in())
}

/// A new key; the old one is void, and every other session ends.
pub(super) async fn renew_key(
    State(state): State<AppState>,
    signed: Signed,
    headers: HeaderMap,
) -> Result<Json<Value>, Problem> {
    state.lti.refuse_course_account(signed.person.id).await?;
    let key = secrets::fresh().map_err(crate::routes::internal)?;
    let store = &state.desk.store;
    store.set_key(signed.person.id, &secrets::hash(&key), &signed.hash()).await.map_err(database)?;
    let link = secrets::link(&state.desk.base(&headers), &signed.person, &key);
    Ok(Json(json!({ "key": key, "link": link })))
}

/// Everything that is kept about the student.
pub(super) async fn export(
    State(state): State<AppState>,
    Student(student, _): Student,
) -> Result<Json<Value>, Problem> {
    Ok(Json(export::export(&*state.desk.store, &*state.lti.store, &student).await.map_err(database)?))
}

/// Forgets the student.
pub(super) async fn erase(
    State(state): State<AppState>,
    Student(student, _): Student,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    state.desk.store.erase(student.id).await.map_err(database)?;
    Ok((StatusCode::NO_CONTENT, [set_cookie(state.desk.is_https(&headers), None)]).into_response())
}
