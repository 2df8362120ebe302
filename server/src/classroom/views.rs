//! What people and their work look like over HTTP: `docs/classroom.md` has the table of all of it.

use super::marks::{self, Mark};
use super::model::{Assignment, Attempt, Class, Extension, Note, Override, Person, Settings};
use super::session::Signed;
use super::work::Share;
use super::{secrets, work};
use jiff::Timestamp;
use serde_json::{Map, Value, json};

/// A session; `entry` has the person's new key and link, which are shown once.
pub fn session(signed: &Signed, class: Option<&Class>, entry: Option<(&str, &str)>) -> Value {
    let Person { id, role, name, login, password, .. } = &signed.person;
    let mut view = json!({
        "role": role, "id": id, "name": name, "login": login, "has_password": password.is_some(),
        "csrf": secrets::csrf(&signed.secret), "expires_at": signed.ends_at,
    });
    if let Some(class) = class {
        view["class"] = json!({ "id": class.id, "name": class.name });
    }
    if let Some((key, link)) = entry {
        (view["key"], view["link"]) = (key.into(), link.into());
    }
    view
}

/// A class as its teacher sees it.
pub fn class(class: &Class, base: &str, student_count: usize) -> Value {
    let Class { id, name, code, joining, created_at, .. } = class;
    json!({
        "id": id, "name": name, "code": code, "joining": joining, "link": format!("{base}/learn.html#code={code}"),
        "created_at": created_at, "student_count": student_count,
    })
}

/// A student as the teacher sees them.
pub fn student(person: &Person) -> Value {
    let Person { id, name, login, number, password, created_at, .. } = person;
    json!({
        "id": id, "name": name, "login": login, "number": number, "has_password": password.is_some(),
        "joined_at": created_at,
    })
}

/// An assignment's title in both languages: the teacher's own, or the exercise's.
pub fn title(assignment: &Assignment) -> Value {
    let own = &assignment.settings.title;
    if !own.is_empty() {
        return json!({ "en": own, "es": own });
    }
    exercise_field(assignment, "title")
}

/// A field of the exercise as it is stored.
fn exercise_field(assignment: &Assignment, name: &str) -> Value {
    let document: Map<String, Value> = serde_json::from_str(&assignment.document).unwrap_or_default();
    document.get(name).cloned().unwrap_or_default()
}

/// What teacher and student see alike.
fn conditions(assignment: &Assignment) -> Value {
    let Settings { counts, points, late, leaderboard, .. } = &assignment.settings;
    json!({
        "id": assignment.id, "title": title(assignment), "points": points, "counts": counts, "late": late,
        "leaderboard": leaderboard,
    })
}

/// An assignment as its teacher sees it.
pub fn assignment(assignment: &Assignment, extensions: &[Extension]) -> Value {
    let Settings { opens_at, deadline, attempts, explanation, hints, .. } = &assignment.settings;
    let mut view = conditions(assignment);
    let more = json!({
        "class": assignment.class, "exercise": assignment.exercise, "opens_at": opens_at, "deadline": deadline,
        "attempts": attempts, "explanation": explanation, "hints": hints, "created_at": assignment.created_at,
        "released": marks::released(assignment, extensions, Timestamp::now()),
        "extensions": extensions.iter().map(extension).collect::<Vec<_>>(),
    });
    merge(&mut view, more);
    view
}

/// An extension.
pub fn extension(extension: &Extension) -> Value {
    let Extension { student, deadline, attempts, comment, .. } = extension;
    json!({ "student": student, "deadline": deadline, "attempts": attempts, "comment": comment })
}

/// An assignment as a student sees it.
pub fn assignment_for_student(share: &Share, now: Timestamp) -> Value {
    let (window, allowed, used) = (share.window(), share.allowed(), share.used());
    let state = match (window.takes(now), window.deadline.is_some_and(|deadline| now > deadline)) {
        (true, false) => "open",
        (true, true) => "late",
        (false, _) => "closed",
    };
    let mut view = conditions(share.assignment);
    let more = json!({
        "exercise_id": share.assignment.exercise, "opens_at": window.opens_at, "deadline": window.deadline,
        "closes_at": window.closes_at, "extended": share.extension.is_some(), "attempts_allowed": allowed,
        "attempts_used": used, "attempts_left": allowed.map(|allowed| i64::from(allowed) - used as i64).map(|left| left.max(0)),
        "state": state, "mark": share.mark().map(|own| mark(&own, share.assignment)),
        "hints_total": if share.assignment.settings.hints {
            exercise_field(share.assignment, "hints").as_array().map_or(0, Vec::len)
        } else {
            0
        },
    });
    merge(&mut view, more);
    view
}

/// A mark.
pub fn mark(mark: &Mark, assignment: &Assignment) -> Value {
    json!({
        "points": mark.points, "of": assignment.settings.points, "attempt": mark.attempt, "late_percent": mark.late_percent,
        "overridden": mark.overridden.is_some(), "comment": mark.overridden,
    })
}

/// An attempt. The job that grades it is nobody's business.
pub fn attempt(attempt: &Attempt, share: &Share) -> Value {
    let marks::Worth { late_percent, points } = marks::worth(&share.assignment.settings, share.extension, attempt);
    let feedback = attempt.feedback.as_ref();
    json!({
        "id": attempt.id, "assignment": attempt.assignment, "number": attempt.number, "gains": attempt.gains,
        "submitted_at": attempt.submitted_at, "graded_at": attempt.graded_at, "state": attempt.state,
        "reason": attempt.reason, "late_percent": late_percent, "score": feedback.map(|feedback| feedback.score),
        "points": points, "criteria": feedback.map_or(&[][..], |feedback| &feedback.criteria),
        "counts": share.mark().is_some_and(|mark| mark.attempt == Some(attempt.id)),
    })
}

/// A decision about a mark.
pub fn decided(decided: &Override) -> Value {
    let Override { teacher, points, of, comment, at, .. } = decided;
    json!({ "at": at, "teacher": teacher, "points": points, "of": of, "comment": comment })
}

/// What a teacher did.
pub fn note(note: &Note) -> Value {
    json!({ "at": note.at, "teacher": note.teacher, "what": note.what, "data": note.data })
}

/// Points of a whole class, best first, without names.
pub fn leaderboard(shares: &[(uuid::Uuid, Share)], you: Option<uuid::Uuid>) -> Value {
    let marks = shares.iter().filter_map(|(student, share)| Some((*student, share.mark()?.points)));
    let mut marks: Vec<_> = marks.collect();
    // Among equals the order must not tell who they are.
    marks.sort_by(|(_, one), (_, other)| other.total_cmp(one));
    let rank = |points: f64| 1 + marks.iter().filter(|(_, other)| *other > points).count();
    let entries = marks
        .iter()
        .map(|(student, points)| json!({ "rank": rank(*points), "points": points, "you": you == Some(*student) }));
    json!({ "entries": entries.collect::<Vec<_>>() })
}

/// The exercise as a student may see it by now, with their own visible variants.
pub fn exercise_for_student(share: &Share, secret: &str, student: uuid::Uuid, released: bool) -> Result<Value, String> {
    use adaptarm_core::exercises::{Released, Visibility};
    let exercise = work::exercise(share.assignment)?;
    let attempts = u32::try_from(share.graded()).unwrap_or(u32::MAX);
    let mut document = exercise.public(Released { attempts, explanation: released });
    if !share.assignment.settings.hints {
        document.hints.clear();
    }
    let seed = secrets::seed(secret, share.assignment.id, student, Visibility::Visible);
    let runs = exercise.runs(&exercise.start(), seed, Visibility::Visible).map_err(|error| error.to_string())?;
    let visible: Vec<_> = runs.iter().map(|run| json!(run.document())).collect();
    let html = super::reading::html(&document).map_err(|error| error.to_string())?;
    Ok(json!({ "exercise": document, "html": html, "seed": seed, "visible": visible }))
}

/// Adds one object's fields to another's.
pub fn merge(view: &mut Value, more: Value) {
    if let (Value::Object(view), Value::Object(more)) = (view, more) {
        view.extend(more);
    }
}
