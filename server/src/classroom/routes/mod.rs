//! Handlers of the classroom: they read what came, ask, and write the answer. `docs/classroom.md` is their contract.

mod assignments;
mod attempts;
mod classes;
mod entry;
mod look;
mod me;
mod students;

pub use assignments::give_out;
pub use entry::{STUDENTS, new_person};

use super::desk::Desk;
use super::model::{Assignment, Class, Note, Person};
use super::session::Teacher;
use super::store::Change;
use super::{problems, work};
use crate::document;
use crate::error::Problem;
use crate::routes::problems::database;
use crate::state::AppState;
use axum::Router;
use axum::routing::{delete, get, patch, post, put};
use jiff::Timestamp;
use serde_json::Value;
use uuid::Uuid;

/// Where all of it is.
pub const ROOT: &str = "/api/v1/classroom";

/// The routes, by their paths below [`ROOT`].
pub fn routes() -> Router<AppState> {
    let below = Router::new()
        .route("/session", get(entry::show).post(entry::sign_in).delete(entry::sign_out))
        .route("/sessions", delete(entry::sign_out_everywhere))
        .route("/teachers", post(entry::redeem))
        .route("/students", post(entry::join))
        .route("/me", delete(me::erase))
        .route("/me/export", get(me::export))
        .route("/me/password", put(me::set_password).delete(me::remove_password))
        .route("/me/key", post(me::renew_key))
        .route("/invitations", post(entry::invite))
        .route("/exercises", get(look::exercises))
        .route("/classes", get(classes::list).post(classes::create))
        .route("/classes/{class}", get(classes::show).patch(classes::update).delete(classes::delete))
        .route("/classes/{class}/code", post(classes::renew_code))
        .route("/classes/{class}/assignments", post(assignments::create))
        .route("/classes/{class}/gradebook.csv", get(look::gradebook))
        .route("/classes/{class}/audit", get(look::audit))
        .route("/students/{student}", patch(students::update).delete(students::delete))
        .route("/students/{student}/key", post(students::renew_key))
        .route("/students/{student}/export", get(students::export))
        .route("/assignments", get(attempts::assignments))
        .route("/assignments/{id}", get(assignments::show).patch(assignments::update).delete(assignments::delete))
        .route("/assignments/{id}/attempts", get(attempts::list).post(attempts::hand_in))
        .route("/assignments/{id}/leaderboard", get(look::leaderboard))
        .route("/assignments/{id}/board", get(look::board))
        .route("/assignments/{id}/extensions/{student}", put(assignments::extend).delete(assignments::end_extension))
        .route("/assignments/{id}/students/{student}", get(look::work))
        .route("/assignments/{id}/students/{student}/override", put(assignments::decide))
        .route("/attempts/{id}", get(attempts::show))
        .route("/attempts/{id}/events", get(attempts::events))
        .route("/attempts/{id}/receipt", get(attempts::receipt))
        .route("/attempts/{id}/reveal", get(attempts::reveal))
        .merge(crate::lti::api());
    Router::new().nest(ROOT, below)
}

/// A teacher's class.
pub async fn own_class(state: &AppState, teacher: &Person, id: &str) -> Result<Class, Problem> {
    let id = id.parse().map_err(|_| problems::nothing())?;
    let found = state.desk.store.class(id).await.map_err(database)?;
    found.filter(|class| class.teacher == teacher.id).ok_or_else(problems::nothing)
}

/// An assignment in a teacher's class.
pub async fn own_assignment(state: &AppState, teacher: &Person, id: &str) -> Result<(Class, Assignment), Problem> {
    let id: Uuid = id.parse().map_err(|_| problems::nothing())?;
    let found = state.desk.store.assignment(id).await.map_err(database)?;
    let assignment = found.ok_or_else(problems::nothing)?;
    Ok((own_class(state, teacher, &assignment.class.to_string()).await?, assignment))
}

/// A student in a teacher's class.
async fn own_student(state: &AppState, teacher: &Person, id: &str) -> Result<(Class, Person), Problem> {
    let id: Uuid = id.parse().map_err(|_| problems::nothing())?;
    let found = state.desk.store.person(id).await.map_err(database)?;
    // Only students have a class.
    let (class, student) = found.and_then(|student| Some((student.class?, student))).ok_or_else(problems::nothing)?;
    Ok((own_class(state, teacher, &class.to_string()).await?, student))
}

/// An assignment and a student of the same class of a teacher.
async fn own_pair(
    state: &AppState,
    teacher: &Person,
    assignment: &str,
    student: &str,
) -> Result<(Class, Assignment, Person), Problem> {
    let (class, assignment) = own_assignment(state, teacher, assignment).await?;
    let (of, student) = own_student(state, teacher, student).await?;
    if of.id == class.id { Ok((class, assignment, student)) } else { Err(problems::nothing()) }
}

/// Makes a change and writes down who made it.
async fn change(
    state: &AppState,
    Teacher(teacher): &Teacher,
    class: Uuid,
    change: Change,
    what: &str,
    data: Value,
) -> Result<(), Problem> {
    change_as(&state.desk, teacher.id, class, change, what, data).await
}

/// The same for a teacher who is known by other means than a session.
async fn change_as(
    desk: &Desk,
    teacher: Uuid,
    class: Uuid,
    change: Change,
    what: &str,
    data: Value,
) -> Result<(), Problem> {
    let (id, at) = (Uuid::now_v7(), Timestamp::now());
    let note = Note { id, class, teacher, at, what: what.to_owned(), data };
    let done = desk.store.change(&change, &note).await.map_err(database)?;
    if done { Ok(()) } else { Err(problems::nothing()) }
}

/// The exercise that an assignment holds; it was good when it was given out.
fn exercise(assignment: &Assignment) -> Result<adaptarm_core::exercises::Exercise, Problem> {
    work::exercise(assignment).map_err(crate::routes::internal)
}

/// Reads a body.
fn read<T: serde::de::DeserializeOwned>(bytes: &[u8]) -> Result<T, Problem> {
    Ok(document::parse(bytes)?)
}
