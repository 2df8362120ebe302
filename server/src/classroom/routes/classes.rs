//! A teacher's classes.

use super::super::model::Class;
use super::super::session::Teacher;
use super::super::store::Change;
use super::super::{problems, secrets, texts, views};
use super::{change, own_class, read};
use crate::api::{JsonBytes, Name};
use crate::error::Problem;
use crate::routes::problems::database;
use crate::state::AppState;
use axum::Json;
use axum::extract::State;
use axum::http::{HeaderMap, StatusCode};
use axum::response::{IntoResponse, Response};
use jiff::Timestamp;
use serde::Deserialize;
use serde_json::{Value, json};
use uuid::Uuid;

/// Most classes of a teacher.
const CLASSES: i64 = 200;

pub(super) async fn list(
    State(state): State<AppState>,
    Teacher(teacher): Teacher,
    headers: HeaderMap,
) -> Result<Json<Value>, Problem> {
    let (classes, base) = (state.desk.store.classes(teacher.id).await.map_err(database)?, state.desk.base(&headers));
    let views: Vec<_> = classes.iter().map(|(class, count)| views::class(class, &base, *count as usize)).collect();
    Ok(Json(json!({ "classes": views })))
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct NewClass {
    name: String,
}

pub(super) async fn create(
    State(state): State<AppState>,
    teacher: Teacher,
    headers: HeaderMap,
    JsonBytes(bytes): JsonBytes,
) -> Result<Response, Problem> {
    let NewClass { name } = read(&bytes)?;
    let name = texts::cell("/name", &name, texts::NAME_CHARS)?;
    if state.desk.store.classes(teacher.0.id).await.map_err(database)?.len() as i64 >= CLASSES {
        return Err(problems::full("classes", CLASSES));
    }
    let (id, code) = (Uuid::now_v7(), secrets::code().map_err(crate::routes::internal)?);
    let class = Class { id, teacher: teacher.0.id, name, code, joining: true, created_at: Timestamp::now() };
    change(&state, &teacher, id, Change::AddClass(class.clone()), "class.create", json!({})).await?;
    Ok((StatusCode::CREATED, Json(views::class(&class, &state.desk.base(&headers), 0))).into_response())
}

/// A class with its students and assignments.
pub(super) async fn show(
    State(state): State<AppState>,
    Teacher(teacher): Teacher,
    Name(id): Name,
    headers: HeaderMap,
) -> Result<Json<Value>, Problem> {
    let class = own_class(&state, &teacher, &id).await?;
    view(&state, &class, &headers).await
}

async fn view(state: &AppState, class: &Class, headers: &HeaderMap) -> Result<Json<Value>, Problem> {
    let store = &state.desk.store;
    let students = store.students(class.id).await.map_err(database)?;
    let mut assignments = Vec::new();
    for assignment in store.assignments(class.id).await.map_err(database)? {
        let extensions = store.extensions(assignment.id).await.map_err(database)?;
        assignments.push(views::assignment(&assignment, &extensions));
    }
    let mut view = views::class(class, &state.desk.base(headers), students.len());
    view["students"] = students.iter().map(views::student).collect();
    view["assignments"] = assignments.into();
    Ok(Json(view))
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ClassChange {
    name: Option<String>,
    joining: Option<bool>,
}

pub(super) async fn update(
    State(state): State<AppState>,
    teacher: Teacher,
    Name(id): Name,
    headers: HeaderMap,
    JsonBytes(bytes): JsonBytes,
) -> Result<Json<Value>, Problem> {
    let mut class = own_class(&state, &teacher.0, &id).await?;
    let ClassChange { name, joining } = read(&bytes)?;
    if let Some(name) = name {
        class.name = texts::cell("/name", &name, texts::NAME_CHARS)?;
    }
    class.joining = joining.unwrap_or(class.joining);
    let data = json!({ "joining": class.joining });
    change(&state, &teacher, class.id, Change::SetClass(class.clone()), "class.change", data).await?;
    view(&state, &class, &headers).await
}

/// A new code; the old one is void.
pub(super) async fn renew_code(
    State(state): State<AppState>,
    teacher: Teacher,
    Name(id): Name,
    headers: HeaderMap,
) -> Result<Json<Value>, Problem> {
    let mut class = own_class(&state, &teacher.0, &id).await?;
    class.code = secrets::code().map_err(crate::routes::internal)?;
    change(&state, &teacher, class.id, Change::SetClass(class.clone()), "class.code", json!({})).await?;
    view(&state, &class, &headers).await
}

/// Forgets a class with its students and all their data.
pub(super) async fn delete(
    State(state): State<AppState>,
    teacher: Teacher,
    Name(id): Name,
) -> Result<StatusCode, Problem> {
    let class = own_class(&state, &teacher.0, &id).await?;
    change(&state, &teacher, class.id, Change::RemoveClass(class.id), "class.delete", json!({})).await?;
    Ok(StatusCode::NO_CONTENT)
}
