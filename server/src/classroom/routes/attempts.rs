//! What students do: looking at assignments, handing gains in, following the grade.

use super::super::marks;
use super::super::model::{Attempt, AttemptState, Person};
use super::super::session::Student;
use super::super::store::{Handed, NewAttempt};
use super::super::work::{self, Work};
use super::super::{problems, secrets, views};
use super::{ROOT, exercise, read};
use crate::api::headers::{IDEMPOTENCY_REPLAYED, idempotency_key};
use crate::api::{JsonBytes, Name};
use crate::error::Problem;
use crate::events::Sight;
use crate::jobs::{JobKind, NewJob, NewScenario};
use crate::receipts::{Nonce, Reveal};
use crate::routes::problems::{database, draining};
use crate::state::AppState;
use adaptarm_core::exercises::Exercise;
use axum::Json;
use axum::extract::State;
use axum::http::{HeaderMap, HeaderName, HeaderValue, StatusCode, header};
use axum::response::sse::{Event, KeepAlive, Sse};
use axum::response::{IntoResponse, Response};
use futures_util::stream;
use jiff::Timestamp;
use serde::Deserialize;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::convert::Infallible;
use std::time::Duration;
use tokio::task::spawn_blocking;
use tokio::time::{sleep, timeout};
use uuid::Uuid;

/// Time between two signs of life where nothing happens, and between two looks at what has ended but has no grade yet.
const KEEP_ALIVE: Duration = Duration::from_secs(15);
const LOOK_INTERVAL: Duration = Duration::from_millis(100);

/// Tells nginx to pass every event on at once.
const NO_BUFFERING: (HeaderName, &str) = (HeaderName::from_static("x-accel-buffering"), "no");

/// Assignments of the student's class that have opened, soonest deadline first.
pub(super) async fn assignments(
    State(state): State<AppState>,
    Student(student, class): Student,
) -> Result<Json<Value>, Problem> {
    let (store, now) = (&*state.desk.store, Timestamp::now());
    let mut views = Vec::new();
    for assignment in store.assignments(class).await.map_err(database)? {
        let work = Work::load(store, assignment, Some(student.id)).await.map_err(database)?;
        let share = work.of(student.id);
        if share.has_opened(now) {
            let until = share.window().closes_at.unwrap_or(Timestamp::MAX);
            views.push((until, views::assignment_for_student(&share, now)));
        }
    }
    views.sort_by_key(|(until, _)| *until);
    let views: Vec<_> = views.into_iter().map(|(_, view)| view).collect();
    Ok(Json(json!({ "assignments": views })))
}

/// The student's work on an assignment of their class that has opened.
async fn find(state: &AppState, student: &Person, id: &str) -> Result<Work, Problem> {
    let store = &*state.desk.store;
    let class = student.class.ok_or_else(problems::nothing)?;
    let assignment = work::of_class(store, id, class).await?;
    let work = Work::load(store, assignment, Some(student.id)).await.map_err(database)?;
    if work.of(student.id).has_opened(Timestamp::now()) { Ok(work) } else { Err(problems::nothing()) }
}

/// An assignment with its exercise, as far as its student may see it.
pub(super) async fn assignment(state: &AppState, student: &Person, id: &str) -> Result<Json<Value>, Problem> {
    let (work, now) = (find(state, student, id).await?, Timestamp::now());
    let share = work.of(student.id);
    let mut view = views::assignment_for_student(&share, now);
    let released = marks::released(&work.assignment, &work.extensions, now);
    let more = views::exercise_for_student(&share, &state.desk.secret, student.id, released);
    views::merge(&mut view, more.map_err(crate::routes::internal)?);
    Ok(Json(view))
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Asked {
    gains: BTreeMap<String, f64>,
}

/// Takes gains; their hidden variants are computed when their turn comes, also if the server dies meanwhile.
pub(super) async fn hand_in(
    State(state): State<AppState>,
    Student(student, _): Student,
    Name(id): Name,
    headers: HeaderMap,
    JsonBytes(bytes): JsonBytes,
) -> Result<Response, Problem> {
    if state.is_draining() {
        return Err(draining());
    }
    let key = idempotency_key(&headers)?;
    let work = find(&state, &student, &id).await?;
    let Asked { gains } = read(&bytes)?;
    let exercise = exercise(&work.assignment)?;
    exercise.check(&gains)?;
    state.desk.count_attempt(student.id)?;
    let given = json!(gains);
    let (secret, owner) = (state.desk.secret.clone(), student.id);
    let assignment = work.assignment.id;
    let scenarios = spawn_blocking(move || hidden_runs(&exercise, &gains, &secret, assignment, owner));
    let job = NewJob {
        kind: JobKind::Grade,
        label: Some(format!("assignment {assignment}")),
        ..NewJob::study(&Person::job_owner(student.id), scenarios.await.map_err(crate::routes::internal)??)
    };
    let new = NewAttempt { assignment, student: student.id, gains: given, key, job };
    let handed = state.desk.store.hand_in(&new, &state.config.limits).await.map_err(database)?;
    let (attempt, replayed) = match handed {
        Handed::In(attempt) => (attempt, false),
        Handed::Before(attempt) => (attempt, true),
        Handed::Closed => return Err(closed(&work, student.id)),
        Handed::NoneLeft(allowed) => return Err(none_left(allowed)),
        Handed::Gone => return Err(problems::nothing()),
    };
    let location = format!("{ROOT}/attempts/{}", attempt.id);
    let view = views::attempt(&attempt, &work.of(student.id));
    let mut response = (StatusCode::ACCEPTED, [(header::LOCATION, location)], Json(view)).into_response();
    if replayed {
        response.headers_mut().insert(IDEMPOTENCY_REPLAYED, HeaderValue::from_static("true"));
    }
    Ok(response)
}

/// The runs that count. Only what is wrong with the gains themselves is told.
fn hidden_runs(
    exercise: &Exercise,
    gains: &BTreeMap<String, f64>,
    secret: &str,
    assignment: Uuid,
    student: Uuid,
) -> Result<Vec<NewScenario>, Problem> {
    let visibility = work::graded_on(exercise);
    let seed = secrets::seed(secret, assignment, student, visibility);
    let runs = exercise.runs(gains, seed, visibility).map_err(|error| {
        if error.pointer.starts_with("/gains") { error.into() } else { crate::routes::internal(error) }
    })?;
    Ok(runs.iter().map(NewScenario::of).collect())
}

fn closed(work: &Work, student: Uuid) -> Problem {
    let window = work.of(student).window();
    let detail = "the assignment does not take attempts at this time";
    Problem::new(StatusCode::CONFLICT, "/problems/closed", "Not open", detail)
        .with("opens_at", json!(window.opens_at))
        .with("closes_at", json!(window.closes_at))
}

fn none_left(allowed: u32) -> Problem {
    let detail = format!("all {allowed} attempts are used");
    Problem::new(StatusCode::CONFLICT, "/problems/attempts", "No attempts are left", detail).with("allowed", allowed)
}

/// The student's own attempts at an assignment.
pub(super) async fn list(
    State(state): State<AppState>,
    Student(student, _): Student,
    Name(id): Name,
) -> Result<Json<Value>, Problem> {
    let work = find(&state, &student, &id).await?;
    let share = work.of(student.id);
    let views: Vec<_> = share.attempts.iter().map(|attempt| views::attempt(attempt, &share)).collect();
    Ok(Json(json!({ "attempts": views })))
}

/// One of the student's own attempts.
async fn own(state: &AppState, student: &Person, id: &str) -> Result<Attempt, Problem> {
    let id = id.parse().map_err(|_| problems::nothing())?;
    let found = state.desk.store.attempt(id).await.map_err(database)?;
    found.filter(|attempt| attempt.student == student.id).ok_or_else(problems::nothing)
}

async fn view(state: &AppState, student: &Person, attempt: &Attempt) -> Result<Value, Problem> {
    let work = find(state, student, &attempt.assignment.to_string()).await?;
    Ok(views::attempt(attempt, &work.of(student.id)))
}

pub(super) async fn show(
    State(state): State<AppState>,
    Student(student, _): Student,
    Name(id): Name,
) -> Result<Json<Value>, Problem> {
    let attempt = own(&state, &student, &id).await?;
    Ok(Json(view(&state, &student, &attempt).await?))
}

/// The signed receipt.
pub(super) async fn receipt(
    State(state): State<AppState>,
    Student(student, _): Student,
    Name(id): Name,
) -> Result<Response, Problem> {
    let attempt = own(&state, &student, &id).await?;
    let papers = state.desk.store.papers(attempt.id).await.map_err(database)?;
    let receipt = papers.receipt.ok_or_else(|| not_ready(&attempt, "it has no receipt"))?;
    Ok(([(header::CONTENT_TYPE, "application/json")], receipt).into_response())
}

fn not_ready(attempt: &Attempt, why: &str) -> Problem {
    let state = attempt.state.id();
    let detail = format!("the attempt is {state}: {why}");
    Problem::new(StatusCode::CONFLICT, "/problems/not-ready", "Not there yet", detail).with("state", state)
}

/// What opens the receipt's commitments: the seed of the hidden variants, once nobody can hand in any more.
pub(super) async fn reveal(
    State(state): State<AppState>,
    Student(student, _): Student,
    Name(id): Name,
) -> Result<Json<Reveal>, Problem> {
    let attempt = own(&state, &student, &id).await?;
    let work = find(&state, &student, &attempt.assignment.to_string()).await?;
    if attempt.state != AttemptState::Graded || !marks::is_over(&work.assignment, &work.extensions, Timestamp::now()) {
        return Err(not_ready(&attempt, "its variants are shown when it is graded and nobody can hand in any more"));
    }
    let (exercise, secret) = (exercise(&work.assignment)?, &state.desk.secret);
    let seed = secrets::seed(secret, attempt.assignment, student.id, work::graded_on(&exercise));
    let nonce = Nonce::try_from(secrets::nonce(secret, attempt.id)).map_err(crate::routes::internal)?;
    let mut reveal = Reveal::new(seed, nonce, Some(&exercise));
    if let Some(document) = &mut reveal.exercise {
        // Texts are no part of what was graded, and the teacher may keep the explanation.
        document.explanation = None;
        document.hints.clear();
    }
    Ok(Json(reveal))
}

/// What a follower is at.
enum Following {
    Running(Option<f64>),
    Ended,
}

/// Follows one's own attempt to its grade. Of its job, progress is all that is told.
pub(super) async fn events(
    State(state): State<AppState>,
    Student(student, _): Student,
    Name(id): Name,
) -> Result<Response, Problem> {
    if state.is_draining() {
        return Err(draining());
    }
    let attempt = own(&state, &student, &id).await?;
    let sight = state.hub.watch(attempt.job);
    let begin = (state, student, attempt, sight, Following::Running(None));
    let told = stream::unfold(begin, |(state, student, attempt, mut sight, following)| async move {
        let Following::Running(mut before) = following else { return None };
        loop {
            let now = state.desk.store.attempt(attempt.id).await.ok().flatten()?;
            if now.state != AttemptState::Grading {
                let event =
                    Event::default().event("attempt").data(view(&state, &student, &now).await.ok()?.to_string());
                return Some((Ok::<_, Infallible>(event), (state, student, attempt, sight, Following::Ended)));
            }
            if state.is_draining() {
                return None;
            }
            let progress = match &*sight.borrow_and_update() {
                Sight::Seen { pulse, .. } => Some(pulse.progress),
                Sight::Unseen | Sight::Gone => None,
            };
            if progress.is_some() && progress != before {
                before = progress;
                let event = Event::default().event("progress").data(json!({ "progress": progress }).to_string());
                return Some((Ok(event), (state, student, attempt, sight, Following::Running(before))));
            }
            // A job that has ended changes no more; its grade is a moment away.
            let _ = timeout(5 * LOOK_INTERVAL, sight.changed()).await;
            sleep(LOOK_INTERVAL).await;
        }
    });
    let stream = Sse::new(told).keep_alive(KeepAlive::new().interval(KEEP_ALIVE));
    Ok(([NO_BUFFERING], stream).into_response())
}
