//! What teachers look at: the library, the board, a student's work, the gradebook, what was done; and the leaderboard.

use super::super::gradebook::{Shape, table};
use super::super::model::{Assignment, Attempt, Person, Role};
use super::super::session::{Signed, Teacher};
use super::super::work::{self, Work};
use super::super::{board, problems, reading, secrets, views};
use super::{exercise, own_assignment, own_class, own_pair};
use crate::api::{Name, Query};
use crate::document::brief;
use crate::error::Problem;
use crate::routes::problems::database;
use crate::state::AppState;
use adaptarm_core::exercises::{Exercise, Visibility};
use axum::Json;
use axum::extract::State;
use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};
use jiff::Timestamp;
use serde::Deserialize;
use serde_json::{Value, json};
use std::collections::BTreeMap;

/// Most entries of the audit shown.
const ENTRIES: i64 = 1000;

/// The library, with what only teachers see.
pub(super) async fn exercises(State(state): State<AppState>, _: Teacher) -> Result<Json<Value>, Problem> {
    let view = |exercise: &Exercise| {
        let document = exercise.document();
        let mut view = json!(document);
        views::merge(&mut view, json!({ "html": reading::html(document).map_err(crate::routes::internal)? }));
        Ok::<_, Problem>(view)
    };
    let documents = state.desk.library.iter().map(view).collect::<Result<Vec<_>, _>>()?;
    Ok(Json(json!({ "exercises": documents })))
}

/// A class's work on an assignment.
async fn of_class(state: &AppState, assignment: Assignment) -> Result<(Work, Vec<Person>), Problem> {
    let store = &*state.desk.store;
    let students = store.students(assignment.class).await.map_err(database)?;
    Ok((Work::load(store, assignment, None).await.map_err(database)?, students))
}

pub(super) async fn board(
    State(state): State<AppState>,
    Teacher(teacher): Teacher,
    Name(id): Name,
) -> Result<Json<Value>, Problem> {
    let (_, assignment) = own_assignment(&state, &teacher, &id).await?;
    let (work, students) = of_class(&state, assignment).await?;
    Ok(Json(board::board(&work, &students)))
}

/// Points of the class without names: to its teacher, and to its students where the teacher switched it on.
pub(super) async fn leaderboard(
    State(state): State<AppState>,
    signed: Signed,
    Name(id): Name,
) -> Result<Json<Value>, Problem> {
    let Person { id: own, role, class, .. } = signed.person;
    let (assignment, you) = match (role, class) {
        (Role::Student, Some(class)) => {
            let assignment = work::of_class(&*state.desk.store, &id, class).await?;
            let open = assignment.settings.opens_at.is_none_or(|opens| Timestamp::now() >= opens);
            if !assignment.settings.leaderboard || !open {
                return Err(problems::nothing());
            }
            (assignment, Some(own))
        }
        _ => (own_assignment(&state, &signed.person, &id).await?.1, None),
    };
    let (work, students) = of_class(&state, assignment).await?;
    let shares: Vec<_> = students.iter().map(|student| (student.id, work.of(student.id))).collect();
    Ok(Json(views::leaderboard(&shares, you)))
}

/// A student's attempts with everything that was computed, as documents that the playground opens.
pub(super) async fn work(
    State(state): State<AppState>,
    Teacher(teacher): Teacher,
    Name((id, student)): Name<(String, String)>,
) -> Result<Json<Value>, Problem> {
    let (_, assignment, student) = own_pair(&state, &teacher, &id, &student).await?;
    let store = &*state.desk.store;
    let exercise = exercise(&assignment)?;
    let work = Work::load(store, assignment, Some(student.id)).await.map_err(database)?;
    let share = work.of(student.id);
    let mut attempts = Vec::new();
    for attempt in share.attempts {
        let papers = store.papers(attempt.id).await.map_err(database)?;
        let grade: Option<Value> = papers.grade.as_deref().and_then(|grade| serde_json::from_str(grade).ok());
        let mut view = views::attempt(attempt, &share);
        view["grade"] = json!(grade);
        view["runs"] = runs(&exercise, &state.desk.secret, attempt).into();
        attempts.push(view);
    }
    // In which unit a variant's value is, its metric's name tells; what a gain is called and its unit, the move.
    let document = exercise.document();
    let metrics: Vec<_> = document.criteria.iter().map(|criterion| &criterion.metric).collect();
    let overrides = work.overrides.iter().filter(|decided| decided.student == student.id);
    Ok(Json(json!({
        "student": views::student(&student), "mark": share.mark().map(|mark| views::mark(&mark, &work.assignment)),
        "extension": share.extension.map(views::extension), "attempts": attempts, "metrics": metrics,
        "moves": document.moves,
        "overrides": overrides.map(views::decided).collect::<Vec<_>>(),
    })))
}

/// Scenarios of an attempt: hidden ones, then visible ones.
fn runs(exercise: &Exercise, secret: &str, attempt: &Attempt) -> Vec<Value> {
    let gains: BTreeMap<_, _> = work::gains(&attempt.gains).unwrap_or_default();
    let of = |visibility| {
        let seed = secrets::seed(secret, attempt.assignment, attempt.student, visibility);
        let runs = exercise.runs(&gains, seed, visibility).unwrap_or_default();
        let hidden = visibility == Visibility::Hidden;
        runs.iter().map(|run| json!({ "hidden": hidden, "scenario": run.document() })).collect::<Vec<_>>()
    };
    [of(Visibility::Hidden), of(Visibility::Visible)].concat()
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct GradebookQuery {
    shape: Option<String>,
}

pub(super) async fn gradebook(
    State(state): State<AppState>,
    Teacher(teacher): Teacher,
    Name(class): Name,
    Query(query): Query<GradebookQuery>,
) -> Result<Response, Problem> {
    let class = own_class(&state, &teacher, &class).await?;
    let name = query.shape.as_deref().unwrap_or("plain");
    let shape = Shape::from_id(name).ok_or_else(|| {
        let detail = format!("shape: {:?} is not known; allowed: {}", brief(name), Shape::NAMES);
        Problem::new(StatusCode::UNPROCESSABLE_ENTITY, "/problems/unknown", "A name is not known", detail)
            .with("parameter", "shape")
            .with("value", brief(name))
            .with("allowed", Shape::NAMES)
    })?;
    let store = &*state.desk.store;
    let students = store.students(class.id).await.map_err(database)?;
    let mut works = Vec::new();
    for assignment in store.assignments(class.id).await.map_err(database)? {
        works.push(Work::load(store, assignment, None).await.map_err(database)?);
    }
    let table = table(shape, &class.name, &students, &works);
    let headers = [
        (header::CONTENT_TYPE, "text/csv; charset=utf-8; header=present"),
        (header::CONTENT_DISPOSITION, "attachment; filename=\"gradebook.csv\""),
    ];
    Ok((headers, table).into_response())
}

pub(super) async fn audit(
    State(state): State<AppState>,
    Teacher(teacher): Teacher,
    Name(class): Name,
) -> Result<Json<Value>, Problem> {
    let class = own_class(&state, &teacher, &class).await?;
    let notes = state.desk.store.notes(class.id, ENTRIES).await.map_err(database)?;
    Ok(Json(json!({ "entries": notes.iter().map(views::note).collect::<Vec<_>>() })))
}
