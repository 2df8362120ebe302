//! Giving exercises out: under which conditions, with which extensions, and a teacher's own decisions about marks.

use super::super::desk::Desk;
use super::super::marks::hundredths;
use super::super::model::{Assignment, Counts, Explanation, Extension, Late, Override, Settings};
use super::super::session::{Signed, Teacher};
use super::super::store::Change;
use super::super::work::Work;
use super::super::{model::Role, problems, texts, views};
use super::{attempts, change, change_as, own_assignment, own_class, own_pair, read};
use crate::api::{JsonBytes, Name};
use crate::error::Problem;
use crate::exercises::Library;
use crate::routes::problems::database;
use crate::state::AppState;
use adaptarm_core::scenario::{Problem as Wrong, ScenarioError};
use axum::Json;
use axum::extract::State;
use axum::http::StatusCode;
use axum::response::{IntoResponse, Response};
use jiff::Timestamp;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};
use uuid::Uuid;

/// Most assignments of a class.
const ASSIGNMENTS: i64 = 200;

/// An assignment as it is asked for.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Asked {
    exercise: String,
    #[serde(default)]
    title: Option<String>,
    #[serde(default)]
    opens_at: Option<Timestamp>,
    #[serde(default)]
    deadline: Option<Timestamp>,
    #[serde(default)]
    attempts: Option<u32>,
    #[serde(default = "best")]
    counts: Counts,
    #[serde(default = "hundred")]
    points: f64,
    #[serde(default)]
    late: Option<Late>,
    #[serde(default = "after_deadline")]
    explanation: Explanation,
    #[serde(default = "yes")]
    hints: bool,
    #[serde(default)]
    leaderboard: bool,
}

fn best() -> Counts {
    Counts::Best
}

fn hundred() -> f64 {
    100.0
}

fn after_deadline() -> Explanation {
    Explanation::AfterDeadline
}

fn yes() -> bool {
    true
}

impl Asked {
    fn of(assignment: &Assignment) -> Self {
        let Settings { title, opens_at, deadline, attempts, counts, points, late, explanation, hints, leaderboard } =
            assignment.settings.clone();
        let title = (!title.is_empty()).then_some(title);
        let exercise = assignment.exercise.clone();
        Self { exercise, title, opens_at, deadline, attempts, counts, points, late, explanation, hints, leaderboard }
    }

    /// Everything in it, checked.
    fn settings(self) -> Result<Settings, ScenarioError> {
        let title = self.title.map(|title| texts::cell("/title", &title, texts::TITLE_CHARS)).transpose()?;
        if let Some(attempts) = self.attempts {
            texts::number("/attempts", f64::from(attempts), [1.0, 1000.0], "attempts")?;
        }
        let points = hundredths(texts::number("/points", self.points, [1.0, 1000.0], "points")?);
        if points != self.points {
            return Err(texts::malformed("/points", &format!("{} is no whole number of hundredths", self.points)));
        }
        if let Some(late) = &self.late {
            texts::number("/late/percent_per_day", late.percent_per_day, [0.0, 100.0], "%")?;
            texts::number("/late/cap_percent", late.cap_percent, [0.0, 100.0], "%")?;
            texts::number("/late/days", f64::from(late.days), [1.0, 365.0], "days")?;
        }
        texts::moment("/opens_at", self.opens_at)?;
        texts::moment("/deadline", self.deadline)?;
        if let (Some(opens), Some(deadline)) = (self.opens_at, self.deadline)
            && deadline <= opens
        {
            let message = format!("{deadline} is not after opens_at, {opens}");
            return Err(ScenarioError::new("/deadline", Wrong::Conflict { message }));
        }
        let Self { opens_at, deadline, attempts, counts, late, explanation, hints, leaderboard, .. } = self;
        let title = title.unwrap_or_default();
        Ok(Settings { title, opens_at, deadline, attempts, counts, points, late, explanation, hints, leaderboard })
    }
}

/// Identifiers of all exercises, for whoever asked for another.
fn ids(library: &Library) -> String {
    library.iter().map(|exercise| exercise.document().id.as_str()).collect::<Vec<_>>().join(", ")
}

/// Gives an exercise to a class.
pub(super) async fn create(
    State(state): State<AppState>,
    teacher: Teacher,
    Name(class): Name,
    JsonBytes(bytes): JsonBytes,
) -> Result<Response, Problem> {
    let class = own_class(&state, &teacher.0, &class).await?;
    let assignment = add(&state.desk, class.id, teacher.0.id, read(&bytes)?).await?;
    Ok((StatusCode::CREATED, Json(views::assignment(&assignment, &[]))).into_response())
}

/// Gives an exercise to a class under the usual conditions, for a link in a learning platform.
pub async fn give_out(desk: &Desk, class: Uuid, teacher: Uuid, exercise: &str) -> Result<Assignment, Problem> {
    let asked = json!({ "exercise": exercise }).to_string();
    add(desk, class, teacher, read(asked.as_bytes())?).await
}

async fn add(desk: &Desk, class: Uuid, teacher: Uuid, asked: Asked) -> Result<Assignment, Problem> {
    let name = asked.exercise.clone();
    let unknown = || {
        let problem = Wrong::Unknown { value: crate::document::brief(&name), allowed: ids(&desk.library) };
        ScenarioError::new("/exercise", problem)
    };
    let document = desk.library.get(&name).ok_or_else(unknown)?.document();
    let settings = asked.settings()?;
    let now = Timestamp::now();
    if let Some(deadline) = settings.deadline.filter(|deadline| *deadline <= now) {
        // Nobody could hand in, and the explanation would be out at once.
        return Err(conflict("past", format!("{deadline} is over already; it is {now}")));
    }
    if desk.store.assignments(class).await.map_err(database)?.len() as i64 >= ASSIGNMENTS {
        return Err(problems::full("assignments", ASSIGNMENTS));
    }
    let document = serde_json::to_string(document).map_err(crate::routes::internal)?;
    let (id, created_at) = (Uuid::now_v7(), now);
    let assignment = Assignment { id, class, exercise: name, document, settings, created_at };
    let data = json!({ "assignment": id, "settings": assignment.settings });
    change_as(desk, teacher, class, Change::AddAssignment(assignment.clone()), "assignment.create", data).await?;
    Ok(assignment)
}

/// An assignment, to its teacher and to the students of its class.
pub(super) async fn show(
    State(state): State<AppState>,
    signed: Signed,
    Name(id): Name,
) -> Result<Json<Value>, Problem> {
    if signed.person.role == Role::Student {
        return attempts::assignment(&state, &signed.person, &id).await;
    }
    let (_, assignment) = own_assignment(&state, &signed.person, &id).await?;
    view(&state, &assignment).await
}

async fn view(state: &AppState, assignment: &Assignment) -> Result<Json<Value>, Problem> {
    let extensions = state.desk.store.extensions(assignment.id).await.map_err(database)?;
    Ok(Json(views::assignment(assignment, &extensions)))
}

/// Other conditions; what is not named stays.
pub(super) async fn update(
    State(state): State<AppState>,
    teacher: Teacher,
    Name(id): Name,
    JsonBytes(bytes): JsonBytes,
) -> Result<Json<Value>, Problem> {
    let (class, mut assignment) = own_assignment(&state, &teacher.0, &id).await?;
    let asked: Map<String, Value> = read(&bytes)?;
    if asked.contains_key("exercise") {
        let message = "an assignment keeps its exercise; make another assignment".to_owned();
        return Err(ScenarioError::new("/exercise", Wrong::Conflict { message }).into());
    }
    // What stands already, and over it what is asked for: the whole is read like a new assignment.
    let mut whole = json!(Asked::of(&assignment));
    views::merge(&mut whole, Value::Object(asked));
    let whole: Asked = read(whole.to_string().as_bytes())?;
    assignment.settings = whole.settings()?;
    let data = json!({ "assignment": assignment.id, "settings": assignment.settings });
    let changed = Change::SetAssignment(assignment.id, assignment.settings.clone());
    change(&state, &teacher, class.id, changed, "assignment.change", data).await?;
    view(&state, &assignment).await
}

/// Takes an assignment back, with everything handed in.
pub(super) async fn delete(
    State(state): State<AppState>,
    teacher: Teacher,
    Name(id): Name,
) -> Result<StatusCode, Problem> {
    let (class, assignment) = own_assignment(&state, &teacher.0, &id).await?;
    let data = json!({ "assignment": assignment.id });
    change(&state, &teacher, class.id, Change::RemoveAssignment(assignment.id), "assignment.delete", data).await?;
    Ok(StatusCode::NO_CONTENT)
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct AskedExtension {
    #[serde(default)]
    deadline: Option<Timestamp>,
    #[serde(default)]
    attempts: u32,
    #[serde(default)]
    comment: String,
}

/// More time, or more attempts, for one student.
pub(super) async fn extend(
    State(state): State<AppState>,
    teacher: Teacher,
    Name((id, student)): Name<(String, String)>,
    JsonBytes(bytes): JsonBytes,
) -> Result<Json<Value>, Problem> {
    let (class, assignment, student) = own_pair(&state, &teacher.0, &id, &student).await?;
    let AskedExtension { deadline, attempts, comment } = read(&bytes)?;
    let before = state.desk.store.extensions(assignment.id).await.map_err(database)?;
    let before = before.iter().find(|own| own.student == student.id).and_then(|own| own.deadline);
    // What stands already may stay, though the class's deadline has come up with it.
    if deadline != before {
        later(deadline, assignment.settings.deadline)?;
    }
    texts::number("/attempts", f64::from(attempts), [0.0, 1000.0], "attempts")?;
    let [_, most] = texts::COMMENT_CHARS;
    let comment = texts::line("/comment", &comment, [0, most])?;
    let extension = Extension { assignment: assignment.id, student: student.id, deadline, attempts, comment };
    // The comment goes with the student, and the note stays.
    let data = json!({
        "assignment": assignment.id, "student": student.id, "deadline": deadline, "attempts": attempts,
    });
    change(&state, &teacher, class.id, Change::SetExtension(extension.clone()), "extension.set", data).await?;
    Ok(Json(views::extension(&extension)))
}

/// Whether a student's deadline gives more time than the class's does.
fn later(deadline: Option<Timestamp>, of_class: Option<Timestamp>) -> Result<(), Problem> {
    texts::moment("/deadline", deadline)?;
    let Some(deadline) = deadline else { return Ok(()) };
    match of_class {
        Some(of_class) if deadline > of_class => Ok(()),
        Some(of_class) => Err(conflict("class-deadline", format!("{deadline} is not after the class's, {of_class}"))),
        None => Err(conflict("no-deadline", "the class has no deadline that could be extended".to_owned())),
    }
}

/// A deadline that cannot be, with the reason by name for whoever says it in another language.
fn conflict(reason: &str, message: String) -> Problem {
    Problem::from(ScenarioError::new("/deadline", Wrong::Conflict { message })).with("reason", reason)
}

/// Takes an extension back.
pub(super) async fn end_extension(
    State(state): State<AppState>,
    teacher: Teacher,
    Name((id, student)): Name<(String, String)>,
) -> Result<StatusCode, Problem> {
    let (class, assignment, student) = own_pair(&state, &teacher.0, &id, &student).await?;
    let data = json!({ "assignment": assignment.id, "student": student.id });
    let removed = Change::RemoveExtension { assignment: assignment.id, student: student.id };
    change(&state, &teacher, class.id, removed, "extension.remove", data).await?;
    Ok(StatusCode::NO_CONTENT)
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct AskedOverride {
    points: Option<f64>,
    comment: String,
}

/// Decides about a mark, or lets the attempts decide again.
pub(super) async fn decide(
    State(state): State<AppState>,
    teacher: Teacher,
    Name((id, student)): Name<(String, String)>,
    JsonBytes(bytes): JsonBytes,
) -> Result<Json<Value>, Problem> {
    let (class, assignment, student) = own_pair(&state, &teacher.0, &id, &student).await?;
    let AskedOverride { points, comment } = read(&bytes)?;
    let most = assignment.settings.points;
    // Beyond full credit lies what a teacher may want to reward.
    let points = points.map(|points| texts::number("/points", points, [0.0, 2.0 * most], "points")).transpose()?;
    let comment = texts::cell("/comment", &comment, texts::COMMENT_CHARS)?;
    let decided = Override {
        id: Uuid::now_v7(),
        assignment: assignment.id,
        student: student.id,
        teacher: teacher.0.id,
        points: points.map(hundredths),
        of: Some(most),
        comment,
        at: Timestamp::now(),
    };
    // The comment is the student's, and goes with the student; the note stays.
    let data = json!({ "assignment": assignment.id, "student": student.id, "points": decided.points });
    change(&state, &teacher, class.id, Change::Decide(decided), "mark.override", data).await?;
    let work = Work::load(&*state.desk.store, assignment, Some(student.id)).await.map_err(database)?;
    let mark = work.of(student.id).mark().map(|mark| views::mark(&mark, &work.assignment));
    Ok(Json(json!(mark)))
}
