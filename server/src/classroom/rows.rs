//! The classroom's rows as the tables hold them, and what they mean.

use super::model::{Assignment, Attempt, AttemptState, Class, Extension, Note, Override, Person, Role};
use crate::jobs::{StoreError, damaged, stored_id, stored_time};
use serde::de::DeserializeOwned;

/// Columns of a [`PersonRow`].
macro_rules! person_columns {
    () => {
        "id, role, class_id, name, number, login, password, created_at"
    };
}
pub(crate) use person_columns;

/// Columns of an [`AttemptRow`].
macro_rules! attempt_columns {
    () => {
        "id, assignment_id, person_id, number, gains, job_id, state, reason, submitted_at, graded_at, feedback"
    };
}
pub(crate) use attempt_columns;

#[derive(Debug, sqlx::FromRow)]
pub(crate) struct PersonRow {
    id: String,
    role: String,
    class_id: Option<String>,
    name: String,
    number: Option<String>,
    login: String,
    password: Option<String>,
    created_at: i64,
}

impl TryFrom<PersonRow> for Person {
    type Error = StoreError;

    fn try_from(row: PersonRow) -> Result<Self, StoreError> {
        Ok(Self {
            id: stored_id(&row.id)?,
            role: Role::from_id(&row.role).ok_or_else(|| damaged("a person with the role", &row.role))?,
            class: row.class_id.as_deref().map(stored_id).transpose()?,
            name: row.name,
            number: row.number,
            login: row.login,
            password: row.password,
            created_at: stored_time(row.created_at)?,
        })
    }
}

#[derive(Debug, sqlx::FromRow)]
pub(crate) struct ClassRow {
    id: String,
    teacher_id: String,
    name: String,
    code: String,
    joining: i64,
    created_at: i64,
}

impl TryFrom<ClassRow> for Class {
    type Error = StoreError;

    fn try_from(row: ClassRow) -> Result<Self, StoreError> {
        Ok(Self {
            id: stored_id(&row.id)?,
            teacher: stored_id(&row.teacher_id)?,
            name: row.name,
            code: row.code,
            joining: row.joining != 0,
            created_at: stored_time(row.created_at)?,
        })
    }
}

#[derive(Debug, sqlx::FromRow)]
pub(crate) struct AssignmentRow {
    id: String,
    class_id: String,
    exercise: String,
    document: String,
    settings: String,
    created_at: i64,
}

impl TryFrom<AssignmentRow> for Assignment {
    type Error = StoreError;

    fn try_from(row: AssignmentRow) -> Result<Self, StoreError> {
        Ok(Self {
            id: stored_id(&row.id)?,
            class: stored_id(&row.class_id)?,
            exercise: row.exercise,
            document: row.document,
            settings: json(&row.settings)?,
            created_at: stored_time(row.created_at)?,
        })
    }
}

#[derive(Debug, sqlx::FromRow)]
pub(crate) struct ExtensionRow {
    assignment_id: String,
    person_id: String,
    deadline: Option<i64>,
    attempts: i64,
    comment: String,
}

impl TryFrom<ExtensionRow> for Extension {
    type Error = StoreError;

    fn try_from(row: ExtensionRow) -> Result<Self, StoreError> {
        Ok(Self {
            assignment: stored_id(&row.assignment_id)?,
            student: stored_id(&row.person_id)?,
            deadline: row.deadline.map(stored_time).transpose()?,
            attempts: u32::try_from(row.attempts)
                .map_err(|_| damaged("an extension by attempts", &row.attempts.to_string()))?,
            comment: row.comment,
        })
    }
}

#[derive(Debug, sqlx::FromRow)]
pub(crate) struct AttemptRow {
    id: String,
    assignment_id: String,
    person_id: String,
    number: i64,
    gains: String,
    job_id: String,
    state: String,
    reason: Option<String>,
    submitted_at: i64,
    graded_at: Option<i64>,
    feedback: Option<String>,
}

impl TryFrom<AttemptRow> for Attempt {
    type Error = StoreError;

    fn try_from(row: AttemptRow) -> Result<Self, StoreError> {
        Ok(Self {
            id: stored_id(&row.id)?,
            assignment: stored_id(&row.assignment_id)?,
            student: stored_id(&row.person_id)?,
            number: row.number,
            gains: json(&row.gains)?,
            job: stored_id(&row.job_id)?,
            state: AttemptState::from_id(&row.state).ok_or_else(|| damaged("an attempt in the state", &row.state))?,
            reason: row.reason,
            submitted_at: stored_time(row.submitted_at)?,
            graded_at: row.graded_at.map(stored_time).transpose()?,
            feedback: row.feedback.as_deref().map(json).transpose()?,
        })
    }
}

#[derive(Debug, sqlx::FromRow)]
pub(crate) struct OverrideRow {
    id: String,
    assignment_id: String,
    person_id: String,
    teacher_id: String,
    points: Option<f64>,
    points_of: Option<f64>,
    comment: String,
    at: i64,
}

impl TryFrom<OverrideRow> for Override {
    type Error = StoreError;

    fn try_from(row: OverrideRow) -> Result<Self, StoreError> {
        Ok(Self {
            id: stored_id(&row.id)?,
            assignment: stored_id(&row.assignment_id)?,
            student: stored_id(&row.person_id)?,
            teacher: stored_id(&row.teacher_id)?,
            points: row.points,
            of: row.points_of,
            comment: row.comment,
            at: stored_time(row.at)?,
        })
    }
}

#[derive(Debug, sqlx::FromRow)]
pub(crate) struct NoteRow {
    id: String,
    class_id: String,
    teacher_id: String,
    at: i64,
    what: String,
    data: String,
}

impl TryFrom<NoteRow> for Note {
    type Error = StoreError;

    fn try_from(row: NoteRow) -> Result<Self, StoreError> {
        Ok(Self {
            id: stored_id(&row.id)?,
            class: stored_id(&row.class_id)?,
            teacher: stored_id(&row.teacher_id)?,
            at: stored_time(row.at)?,
            what: row.what,
            data: json(&row.data)?,
        })
    }
}

fn json<T: DeserializeOwned>(text: &str) -> Result<T, StoreError> {
    serde_json::from_str(text)
        .map_err(|error| damaged("a document of the classroom that cannot be read:", &error.to_string()))
}
