//! A student's work on an assignment, put together from what is stored: conditions, attempts, mark; and what is stored, read:
//! the exercise, gains.

use super::marks::{self, Mark, Window};
use super::model::{Assignment, Attempt, AttemptState, Extension, Override};
use super::problems;
use super::store::ClassroomStore;
use crate::error::Problem;
use crate::jobs::StoreError;
use crate::routes::problems::database;
use adaptarm_core::exercises::{Exercise, ExerciseDocument, Visibility};
use jiff::Timestamp;
use serde_json::Value;
use std::collections::BTreeMap;
use uuid::Uuid;

/// All work of a class on an assignment, or one student's share of it.
#[derive(Debug)]
pub struct Work {
    /// On what.
    pub assignment: Assignment,
    /// Of everyone.
    pub extensions: Vec<Extension>,
    /// Oldest first.
    pub overrides: Vec<Override>,
    /// By student, then by number.
    pub attempts: Vec<Attempt>,
}

/// One student's.
#[derive(Debug, Clone, Copy)]
pub struct Share<'a> {
    /// On what.
    pub assignment: &'a Assignment,
    /// Beyond the others.
    pub extension: Option<&'a Extension>,
    /// In the order of their numbers.
    pub attempts: &'a [Attempt],
    /// The latest.
    pub decided: Option<&'a Override>,
}

impl Work {
    /// Of this student, or of all.
    pub async fn load(
        store: &dyn ClassroomStore,
        assignment: Assignment,
        student: Option<Uuid>,
    ) -> Result<Self, StoreError> {
        let mut attempts = store.attempts(assignment.id, student).await?;
        // A database may order identifiers by the rules of a language.
        attempts.sort_by_key(|attempt| (attempt.student, attempt.number));
        let extensions = store.extensions(assignment.id).await?;
        let overrides = store.overrides(assignment.id).await?;
        Ok(Self { assignment, extensions, overrides, attempts })
    }

    /// One student's share.
    pub fn of(&self, student: Uuid) -> Share<'_> {
        let from = self.attempts.partition_point(|attempt| attempt.student < student);
        let count = self.attempts[from..].iter().take_while(|attempt| attempt.student == student).count();
        Share {
            assignment: &self.assignment,
            extension: self.extensions.iter().find(|extension| extension.student == student),
            attempts: &self.attempts[from..from + count],
            decided: self.overrides.iter().rev().find(|decided| decided.student == student),
        }
    }
}

impl Share<'_> {
    /// The mark, if there is one.
    pub fn mark(&self) -> Option<Mark> {
        marks::mark(&self.assignment.settings, self.extension, self.attempts, self.decided)
    }

    /// When attempts are taken.
    pub fn window(&self) -> Window {
        Window::of(&self.assignment.settings, self.extension)
    }

    /// How many attempts are allowed.
    pub fn allowed(&self) -> Option<u32> {
        marks::allowed(&self.assignment.settings, self.extension)
    }

    /// Attempts that count against the limit.
    pub fn used(&self) -> usize {
        self.attempts.iter().filter(|attempt| attempt.state != AttemptState::Returned).count()
    }

    /// Attempts with a grade.
    pub fn graded(&self) -> usize {
        self.attempts.iter().filter(|attempt| attempt.state == AttemptState::Graded).count()
    }

    /// Whether the student may see it at all.
    pub fn has_opened(&self, now: Timestamp) -> bool {
        self.window().has_opened(now)
    }
}

/// The exercise that an assignment holds.
pub fn exercise(assignment: &Assignment) -> Result<Exercise, String> {
    let document: ExerciseDocument =
        serde_json::from_str(&assignment.document).map_err(|error| format!("the stored exercise: {error}"))?;
    Exercise::new(document).map_err(|error| format!("the stored exercise: {error}"))
}

/// The variants that count: the hidden ones, or where an exercise has none, those that everyone sees.
pub fn graded_on(exercise: &Exercise) -> Visibility {
    if exercise.document().hidden.is_some() { Visibility::Hidden } else { Visibility::Visible }
}

/// Gains as the exercise takes them.
pub fn gains(value: &Value) -> Option<BTreeMap<String, f64>> {
    value.as_object()?.iter().map(|(name, value)| Some((name.clone(), value.as_f64()?))).collect()
}

/// The assignment of this identifier, if it is this class's.
pub async fn of_class(store: &dyn ClassroomStore, id: &str, class: Uuid) -> Result<Assignment, Problem> {
    let id = id.parse().map_err(|_| problems::nothing())?;
    let found = store.assignment(id).await.map_err(database)?;
    found.filter(|assignment| assignment.class == class).ok_or_else(problems::nothing)
}
