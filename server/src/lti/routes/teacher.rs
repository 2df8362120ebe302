//! What teachers do about platforms: registering them, fetching a course's members, seeing whether grades arrive.

use super::super::model::{Context, Platform};
use super::super::refusal::LtiError;
use super::super::registration::NewPlatform;
use super::super::roster;
use crate::api::{JsonBytes, Name};
use crate::classroom::model::Person;
use crate::classroom::session::Teacher;
use crate::classroom::{own_assignment, own_class, problems};
use crate::document;
use crate::error::Problem;
use crate::state::AppState;
use axum::Json;
use axum::extract::State;
use axum::http::StatusCode;
use axum::response::{IntoResponse, Response};
use serde_json::{Value, json};

/// Most platforms of a teacher.
const PLATFORMS: usize = 50;

/// The teacher's platforms.
pub(super) async fn platforms(
    State(state): State<AppState>,
    Teacher(teacher): Teacher,
) -> Result<Json<Value>, Problem> {
    let mut platforms = state.lti.store.platforms().await.map_err(LtiError::from)?;
    platforms.retain(|platform| platform.teacher == teacher.id);
    Ok(Json(json!({ "platforms": platforms })))
}

/// Registers a platform.
pub(super) async fn register(
    State(state): State<AppState>,
    Teacher(teacher): Teacher,
    JsonBytes(bytes): JsonBytes,
) -> Result<Response, Problem> {
    state.lti.refuse_course_account(teacher.id).await?;
    let new: NewPlatform = document::parse(&bytes)?;
    let platform = new.check(teacher.id, &state.lti.caller)?;
    let store = &state.lti.store;
    let all = store.platforms().await.map_err(LtiError::from)?;
    if all.iter().filter(|platform| platform.teacher == teacher.id).count() >= PLATFORMS {
        return Err(problems::full("platforms", PLATFORMS as i64));
    }
    if !store.add_platform(&platform).await.map_err(LtiError::from)? {
        let detail = "this issuer and client_id are registered already; remove that registration first";
        return Err(Problem::new(StatusCode::CONFLICT, "/problems/taken", "Registered already", detail));
    }
    Ok((StatusCode::CREATED, Json(json!(platform))).into_response())
}

/// Forgets a platform. Classes and marks stay, but nobody comes from there any more, and no grades go there.
pub(super) async fn remove(
    State(state): State<AppState>,
    Teacher(teacher): Teacher,
    Name(id): Name,
) -> Result<StatusCode, Problem> {
    let id = id.parse().map_err(|_| problems::nothing())?;
    let removed = state.lti.store.remove_platform(id, Some(teacher.id)).await.map_err(LtiError::from)?;
    state.lti.platform_keys.forget(id).await;
    if removed { Ok(StatusCode::NO_CONTENT) } else { Err(problems::nothing()) }
}

/// Which platform's course a class is, and whether it tells its members.
pub(super) async fn course(
    State(state): State<AppState>,
    Teacher(teacher): Teacher,
    Name(class): Name,
) -> Result<Json<Value>, Problem> {
    Ok(Json(match course_of(&state, &teacher, &class).await? {
        Some((platform, context)) => json!({ "platform": platform.issuer, "members": context.members_url.is_some() }),
        None => json!({ "platform": null, "members": false }),
    }))
}

/// The course that a teacher's class belongs to.
async fn course_of(state: &AppState, teacher: &Person, class: &str) -> Result<Option<(Platform, Context)>, Problem> {
    let class = own_class(state, teacher, class).await?;
    let store = &state.lti.store;
    let Some(context) = store.context_of(class.id).await.map_err(LtiError::from)? else { return Ok(None) };
    let platform = store.platform(context.platform).await.map_err(LtiError::from)?.ok_or_else(problems::nothing)?;
    Ok(Some((platform, context)))
}

/// Makes students of those who attend the class's course.
pub(super) async fn fetch_members(
    State(state): State<AppState>,
    Teacher(teacher): Teacher,
    Name(class): Name,
) -> Result<Json<Value>, Problem> {
    let (platform, context) = course_of(&state, &teacher, &class).await?.ok_or_else(problems::nothing)?;
    Ok(Json(json!(roster::fetch(&state.lti, &platform, &context).await?)))
}

/// Whether an assignment's grades have arrived.
pub(super) async fn standing(
    State(state): State<AppState>,
    Teacher(teacher): Teacher,
    Name(id): Name,
) -> Result<Json<Value>, Problem> {
    let (_, assignment) = own_assignment(&state, &teacher, &id).await?;
    Ok(Json(json!(state.lti.store.standing(assignment.id).await.map_err(LtiError::from)?)))
}
