//! What teachers change, each change together with the note that tells who made it; and erasing.

use super::super::{Connection, Pool, begin};
use crate::classroom::model::{Assignment, Class, Extension, Note, Override, Person};
use crate::classroom::secrets;
use crate::classroom::store::Change;
use crate::jobs::StoreError;
use jiff::Timestamp;
use uuid::Uuid;

/// Makes a change, and notes it; whether there was something to change.
pub(super) async fn change(pool: &Pool, change: &Change, note: &Note) -> Result<bool, StoreError> {
    let mut transaction = begin(pool).await?;
    let connection = &mut *transaction;
    let done = apply(connection, change).await?;
    // Nothing is left to keep a note on where its class is gone.
    if done && !matches!(change, Change::RemoveClass(_)) {
        sqlx::query("INSERT INTO audit (id, class_id, teacher_id, at, what, data) VALUES ($1, $2, $3, $4, $5, $6)")
            .bind(note.id.to_string())
            .bind(note.class.to_string())
            .bind(note.teacher.to_string())
            .bind(note.at.as_microsecond())
            .bind(&note.what)
            .bind(note.data.to_string())
            .execute(connection)
            .await?;
    }
    transaction.commit().await?;
    Ok(done)
}

async fn apply(connection: &mut Connection, change: &Change) -> Result<bool, StoreError> {
    match change {
        Change::AddClass(class) => add_class(connection, class).await,
        Change::SetClass(class) => set_class(connection, class).await,
        Change::RemoveClass(class) => remove_class(connection, *class).await,
        Change::SetStudent(student) => set_student(connection, student).await,
        Change::RemoveStudent(student) => remove_student(connection, *student).await,
        Change::AddAssignment(assignment) => add_assignment(connection, assignment).await,
        Change::SetAssignment(id, settings) => {
            // Strings, numbers and times always become JSON.
            let settings = serde_json::to_string(settings).unwrap_or_default();
            let query = sqlx::query("UPDATE assignment SET settings = $2 WHERE id = $1");
            let done = query.bind(id.to_string()).bind(settings).execute(connection).await?;
            Ok(done.rows_affected() > 0)
        }
        Change::RemoveAssignment(id) => {
            sqlx::query("DELETE FROM job WHERE id IN (SELECT job_id FROM attempt WHERE assignment_id = $1)")
                .bind(id.to_string())
                .execute(&mut *connection)
                .await?;
            let query = sqlx::query("DELETE FROM assignment WHERE id = $1").bind(id.to_string());
            Ok(query.execute(connection).await?.rows_affected() > 0)
        }
        Change::SetExtension(extension) => set_extension(connection, extension).await,
        Change::RemoveExtension { assignment, student } => {
            let query = sqlx::query("DELETE FROM extension WHERE assignment_id = $1 AND person_id = $2");
            let done = query.bind(assignment.to_string()).bind(student.to_string()).execute(connection).await?;
            Ok(done.rows_affected() > 0)
        }
        Change::Decide(decided) => decide(connection, decided).await,
    }
}

pub(in super::super) async fn add_class(connection: &mut Connection, class: &Class) -> Result<bool, StoreError> {
    sqlx::query(
        "INSERT INTO class (id, teacher_id, name, code, code_hash, joining, created_at) VALUES ($1, $2, $3, $4, $5, $6, $7)",
    )
    .bind(class.id.to_string())
    .bind(class.teacher.to_string())
    .bind(&class.name)
    .bind(&class.code)
    .bind(secrets::hash(&class.code))
    .bind(i64::from(class.joining))
    .bind(class.created_at.as_microsecond())
    .execute(connection)
    .await?;
    Ok(true)
}

async fn set_class(connection: &mut Connection, class: &Class) -> Result<bool, StoreError> {
    let done = sqlx::query("UPDATE class SET name = $2, code = $3, code_hash = $4, joining = $5 WHERE id = $1")
        .bind(class.id.to_string())
        .bind(&class.name)
        .bind(&class.code)
        .bind(secrets::hash(&class.code))
        .bind(i64::from(class.joining))
        .execute(connection)
        .await?;
    Ok(done.rows_affected() > 0)
}

async fn remove_class(connection: &mut Connection, class: Uuid) -> Result<bool, StoreError> {
    let students: Vec<String> = sqlx::query_scalar("SELECT id FROM person WHERE class_id = $1")
        .bind(class.to_string())
        .fetch_all(&mut *connection)
        .await?;
    for student in students {
        remove_jobs(connection, &student).await?;
    }
    let query = sqlx::query("DELETE FROM class WHERE id = $1").bind(class.to_string());
    Ok(query.execute(connection).await?.rows_affected() > 0)
}

async fn set_student(connection: &mut Connection, student: &Person) -> Result<bool, StoreError> {
    let done = sqlx::query("UPDATE person SET name = $2, number = $3 WHERE id = $1")
        .bind(student.id.to_string())
        .bind(&student.name)
        .bind(&student.number)
        .execute(connection)
        .await?;
    Ok(done.rows_affected() > 0)
}

/// Forgets a student, of their own will.
pub(super) async fn erase(pool: &Pool, student: Uuid) -> Result<(), StoreError> {
    let mut transaction = begin(pool).await?;
    remove_student(&mut transaction, student).await?;
    transaction.commit().await?;
    Ok(())
}

async fn remove_student(connection: &mut Connection, student: Uuid) -> Result<bool, StoreError> {
    remove_jobs(connection, &student.to_string()).await?;
    let query = sqlx::query("DELETE FROM person WHERE id = $1").bind(student.to_string());
    Ok(query.execute(connection).await?.rows_affected() > 0)
}

/// Jobs hold what a student handed in, too. Whoever computes one finds its fence gone.
async fn remove_jobs(connection: &mut Connection, student: &str) -> Result<(), StoreError> {
    let student = crate::jobs::stored_id(student)?;
    sqlx::query("DELETE FROM job WHERE owner = $1").bind(Person::job_owner(student)).execute(connection).await?;
    Ok(())
}

async fn add_assignment(connection: &mut Connection, assignment: &Assignment) -> Result<bool, StoreError> {
    // Strings, numbers and times always become JSON.
    let settings = serde_json::to_string(&assignment.settings).unwrap_or_default();
    sqlx::query(
        "INSERT INTO assignment (id, class_id, exercise, document, settings, created_at) VALUES ($1, $2, $3, $4, $5, $6)",
    )
    .bind(assignment.id.to_string())
    .bind(assignment.class.to_string())
    .bind(&assignment.exercise)
    .bind(&assignment.document)
    .bind(settings)
    .bind(assignment.created_at.as_microsecond())
    .execute(connection)
    .await?;
    Ok(true)
}

async fn set_extension(connection: &mut Connection, extension: &Extension) -> Result<bool, StoreError> {
    sqlx::query(
        "INSERT INTO extension (assignment_id, person_id, deadline, attempts, comment) VALUES ($1, $2, $3, $4, $5) \
         ON CONFLICT (assignment_id, person_id) DO UPDATE SET deadline = excluded.deadline, \
         attempts = excluded.attempts, comment = excluded.comment",
    )
    .bind(extension.assignment.to_string())
    .bind(extension.student.to_string())
    .bind(extension.deadline.map(Timestamp::as_microsecond))
    .bind(i64::from(extension.attempts))
    .bind(&extension.comment)
    .execute(connection)
    .await?;
    Ok(true)
}

async fn decide(connection: &mut Connection, decided: &Override) -> Result<bool, StoreError> {
    sqlx::query(
        "INSERT INTO mark_override (id, assignment_id, person_id, teacher_id, points, points_of, comment, at) \
         VALUES ($1, $2, $3, $4, $5, $6, $7, $8)",
    )
    .bind(decided.id.to_string())
    .bind(decided.assignment.to_string())
    .bind(decided.student.to_string())
    .bind(decided.teacher.to_string())
    .bind(decided.points)
    .bind(decided.of)
    .bind(&decided.comment)
    .bind(decided.at.as_microsecond())
    .execute(connection)
    .await?;
    Ok(true)
}
