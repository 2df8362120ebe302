//! A teacher's students: names, numbers, new links, what is kept about them.

use super::super::session::Teacher;
use super::super::store::Change;
use super::super::{export, secrets, texts, views};
use super::{change, own_student, read};
use crate::api::{JsonBytes, Name};
use crate::error::Problem;
use crate::routes::problems::database;
use crate::state::AppState;
use axum::Json;
use axum::extract::State;
use axum::http::{HeaderMap, StatusCode};
use serde::Deserialize;
use serde_json::{Value, json};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct StudentChange {
    name: Option<String>,
    number: Option<String>,
}

pub(super) async fn update(
    State(state): State<AppState>,
    teacher: Teacher,
    Name(id): Name,
    JsonBytes(bytes): JsonBytes,
) -> Result<Json<Value>, Problem> {
    let (class, mut student) = own_student(&state, &teacher.0, &id).await?;
    let StudentChange { name, number } = read(&bytes)?;
    if let Some(name) = name {
        student.name = texts::cell("/name", &name, texts::NAME_CHARS)?;
    }
    if let Some(number) = number {
        // An empty one takes it away.
        let kept = (!number.trim().is_empty()).then(|| texts::cell("/number", &number, texts::NUMBER_CHARS));
        student.number = kept.transpose()?;
    }
    let data = json!({ "student": student.id });
    change(&state, &teacher, class.id, Change::SetStudent(student.clone()), "student.change", data).await?;
    Ok(Json(views::student(&student)))
}

/// A new personal link for a student who lost theirs; the old one is void.
pub(super) async fn renew_key(
    State(state): State<AppState>,
    teacher: Teacher,
    Name(id): Name,
    headers: HeaderMap,
) -> Result<Json<Value>, Problem> {
    let (class, student) = own_student(&state, &teacher.0, &id).await?;
    let key = secrets::fresh().map_err(crate::routes::internal)?;
    // First the note: what follows cannot fail for the student's being unknown.
    let data = json!({ "student": student.id });
    change(&state, &teacher, class.id, Change::SetStudent(student.clone()), "student.key", data).await?;
    state.desk.store.set_key(student.id, &secrets::hash(&key), "").await.map_err(database)?;
    let link = secrets::link(&state.desk.base(&headers), &student, &key);
    Ok(Json(json!({ "key": key, "link": link })))
}

pub(super) async fn export(
    State(state): State<AppState>,
    Teacher(teacher): Teacher,
    Name(id): Name,
) -> Result<Json<Value>, Problem> {
    let (_, student) = own_student(&state, &teacher, &id).await?;
    Ok(Json(export::export(&*state.desk.store, &student).await.map_err(database)?))
}

pub(super) async fn delete(
    State(state): State<AppState>,
    teacher: Teacher,
    Name(id): Name,
) -> Result<StatusCode, Problem> {
    let (class, student) = own_student(&state, &teacher.0, &id).await?;
    let data = json!({ "student": student.id });
    change(&state, &teacher, class.id, Change::RemoveStudent(student.id), "student.erase", data).await?;
    Ok(StatusCode::NO_CONTENT)
}
