//! Everything that is kept about a student, as one JSON document.

use super::model::Person;
use super::store::ClassroomStore;
use super::views;
use super::work::Work;
use crate::jobs::StoreError;
use jiff::Timestamp;
use serde_json::{Value, json};

/// The document. Secrets are not in it, and neither are hidden variants.
pub async fn export(store: &dyn ClassroomStore, student: &Person) -> Result<Value, StoreError> {
    let class = match student.class {
        Some(class) => store.class(class).await?,
        None => None,
    };
    let assignments = match &class {
        Some(class) => store.assignments(class.id).await?,
        None => Vec::new(),
    };
    let mut works = Vec::new();
    for assignment in assignments {
        let work = Work::load(store, assignment, Some(student.id)).await?;
        let share = work.of(student.id);
        let overrides = work.overrides.iter().filter(|decided| decided.student == student.id);
        works.push(json!({
            "assignment": work.assignment.id, "title": views::title(&work.assignment), "exercise": work.assignment.exercise,
            "attempts": share.attempts.iter().map(|attempt| views::attempt(attempt, &share)).collect::<Vec<_>>(),
            "mark": share.mark().map(|mark| views::mark(&mark, &work.assignment)),
            "extension": share.extension.map(views::extension),
            "overrides": overrides.map(views::decided).collect::<Vec<_>>(),
        }));
    }
    Ok(json!({
        "format": "adaptarm.student/1", "exported_at": Timestamp::now(), "student": views::student(student),
        "class": class.map(|class| class.name), "assignments": works,
    }))
}
