//! Looking at classes and what was given to them.

use super::super::{Db, Pool};
use crate::classroom::model::{Assignment, Class, Extension, Note, Override};
use crate::classroom::rows::{AssignmentRow, ClassRow, ExtensionRow, NoteRow, OverrideRow};
use crate::jobs::StoreError;
use sqlx::{FromRow, Row};
use uuid::Uuid;

pub(super) async fn class(pool: &Pool, id: Uuid) -> Result<Option<Class>, StoreError> {
    let query = sqlx::query_as("SELECT * FROM class WHERE id = $1").bind(id.to_string());
    let row: Option<ClassRow> = query.fetch_optional(pool).await?;
    row.map(Class::try_from).transpose()
}

pub(super) async fn classes(pool: &Pool, teacher: Uuid) -> Result<Vec<(Class, i64)>, StoreError> {
    let rows = sqlx::query(
        "SELECT class.*, (SELECT COUNT(*) FROM person WHERE person.class_id = class.id) AS students FROM class \
         WHERE teacher_id = $1 ORDER BY id",
    )
    .bind(teacher.to_string())
    .fetch_all(pool)
    .await?;
    let class =
        |row: &<Db as sqlx::Database>::Row| Ok((ClassRow::from_row(row)?.try_into()?, row.try_get("students")?));
    rows.iter().map(class).collect()
}

pub(super) async fn notes(pool: &Pool, class: Uuid, limit: i64) -> Result<Vec<Note>, StoreError> {
    let query = sqlx::query_as("SELECT * FROM audit WHERE class_id = $1 ORDER BY id DESC LIMIT $2");
    let rows: Vec<NoteRow> = query.bind(class.to_string()).bind(limit).fetch_all(pool).await?;
    rows.into_iter().map(Note::try_from).collect()
}

pub(super) async fn assignment(pool: &Pool, id: Uuid) -> Result<Option<Assignment>, StoreError> {
    let query = sqlx::query_as("SELECT * FROM assignment WHERE id = $1").bind(id.to_string());
    let row: Option<AssignmentRow> = query.fetch_optional(pool).await?;
    row.map(Assignment::try_from).transpose()
}

pub(super) async fn assignments(pool: &Pool, class: Uuid) -> Result<Vec<Assignment>, StoreError> {
    let query = sqlx::query_as("SELECT * FROM assignment WHERE class_id = $1 ORDER BY id").bind(class.to_string());
    let rows: Vec<AssignmentRow> = query.fetch_all(pool).await?;
    rows.into_iter().map(Assignment::try_from).collect()
}

pub(super) async fn extensions(pool: &Pool, assignment: Uuid) -> Result<Vec<Extension>, StoreError> {
    let query = sqlx::query_as("SELECT * FROM extension WHERE assignment_id = $1 ORDER BY person_id");
    let rows: Vec<ExtensionRow> = query.bind(assignment.to_string()).fetch_all(pool).await?;
    rows.into_iter().map(Extension::try_from).collect()
}

pub(super) async fn overrides(pool: &Pool, assignment: Uuid) -> Result<Vec<Override>, StoreError> {
    let query = sqlx::query_as("SELECT * FROM mark_override WHERE assignment_id = $1 ORDER BY id");
    let rows: Vec<OverrideRow> = query.bind(assignment.to_string()).fetch_all(pool).await?;
    rows.into_iter().map(Override::try_from).collect()
}
