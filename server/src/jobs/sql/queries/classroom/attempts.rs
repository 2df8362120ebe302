//! Attempts. One transaction looks whether the student may, counts, and writes the attempt with its job; a grade is written
//! only where there is none.

use super::super::change::wake;
use super::super::{Connection, Db, Pool, begin, now, submit, while_submitting};
use crate::classroom::marks;
use crate::classroom::model::{Assignment, Attempt, AttemptState, Extension};
use crate::classroom::rows::{AssignmentRow, AttemptRow, ExtensionRow, attempt_columns};
use crate::classroom::store::{Handed, NewAttempt, Outcome, Papers, Ripe};
use crate::config::Limits;
use crate::jobs::{StoreError, stored_state, stored_time};
use sqlx::{FromRow, Row};
use uuid::Uuid;

/// Takes an attempt, if its student may make one.
pub(super) async fn hand_in(pool: &Pool, new: &NewAttempt, limits: &Limits) -> Result<Handed, StoreError> {
    let mut transaction = begin(pool).await?;
    let connection = &mut *transaction;
    // One student's attempts are counted one after another, however many come at once.
    while_submitting(connection, &new.job.owner).await?;
    if let Some(attempt) = repeated(connection, new).await? {
        return Ok(Handed::Before(attempt));
    }
    let Some((assignment, extension)) = conditions(connection, new).await? else { return Ok(Handed::Gone) };
    let at = now(connection).await?;
    let window = marks::Window::of(&assignment.settings, extension.as_ref());
    if !window.takes(stored_time(at)?) {
        return Ok(Handed::Closed);
    }
    let (used, last): (i64, i64) = sqlx::query_as(
        "SELECT COUNT(CASE WHEN state <> 'returned' THEN 1 END), COALESCE(MAX(number), 0) FROM attempt \
         WHERE assignment_id = $1 AND person_id = $2",
    )
    .bind(new.assignment.to_string())
    .bind(new.student.to_string())
    .fetch_one(&mut *connection)
    .await?;
    let allowed = marks::allowed(&assignment.settings, extension.as_ref()).unwrap_or(marks::MOST_ATTEMPTS);
    if used >= i64::from(allowed) {
        return Ok(Handed::NoneLeft(allowed));
    }
    let (submitted, shards) = submit::attempt(connection, &new.job, limits).await?;
    let row: AttemptRow = sqlx::query_as(concat!(
        "INSERT INTO attempt (id, assignment_id, person_id, number, gains, idempotency_key, job_id, state, submitted_at) \
         VALUES ($1, $2, $3, $4, $5, $6, $7, 'grading', $8) RETURNING ",
        attempt_columns!()
    ))
    .bind(Uuid::now_v7().to_string())
    .bind(new.assignment.to_string())
    .bind(new.student.to_string())
    .bind(last + 1)
    .bind(new.gains.to_string())
    .bind(&new.key)
    .bind(submitted.job.id.to_string())
    .bind(at)
    .fetch_one(&mut *connection)
    .await?;
    wake(connection, shards).await?;
    transaction.commit().await?;
    Ok(Handed::In(row.try_into()?))
}

/// The attempt that the same request made before.
async fn repeated(connection: &mut Connection, new: &NewAttempt) -> Result<Option<Attempt>, StoreError> {
    let Some(key) = &new.key else { return Ok(None) };
    let row: Option<AttemptRow> = sqlx::query_as(concat!(
        "SELECT ",
        attempt_columns!(),
        " FROM attempt WHERE assignment_id = $1 AND person_id = $2 AND idempotency_key = $3"
    ))
    .bind(new.assignment.to_string())
    .bind(new.student.to_string())
    .bind(key)
    .fetch_optional(connection)
    .await?;
    let Some(attempt) = row.map(Attempt::try_from).transpose()? else { return Ok(None) };
    if attempt.gains == new.gains { Ok(Some(attempt)) } else { Err(StoreError::KeyReused { key: key.clone() }) }
}

/// What the student's attempt must keep to, as it stands now.
async fn conditions(
    connection: &mut Connection,
    new: &NewAttempt,
) -> Result<Option<(Assignment, Option<Extension>)>, StoreError> {
    let assignment: Option<AssignmentRow> = sqlx::query_as("SELECT * FROM assignment WHERE id = $1")
        .bind(new.assignment.to_string())
        .fetch_optional(&mut *connection)
        .await?;
    let Some(assignment) = assignment else { return Ok(None) };
    let extension: Option<ExtensionRow> =
        sqlx::query_as("SELECT * FROM extension WHERE assignment_id = $1 AND person_id = $2")
            .bind(new.assignment.to_string())
            .bind(new.student.to_string())
            .fetch_optional(connection)
            .await?;
    Ok(Some((assignment.try_into()?, extension.map(Extension::try_from).transpose()?)))
}

pub(super) async fn attempt(pool: &Pool, id: Uuid) -> Result<Option<Attempt>, StoreError> {
    let query = sqlx::query_as(concat!("SELECT ", attempt_columns!(), " FROM attempt WHERE id = $1"));
    let row: Option<AttemptRow> = query.bind(id.to_string()).fetch_optional(pool).await?;
    row.map(Attempt::try_from).transpose()
}

pub(super) async fn attempts(pool: &Pool, assignment: Uuid, student: Option<Uuid>) -> Result<Vec<Attempt>, StoreError> {
    let rows: Vec<AttemptRow> = sqlx::query_as(concat!(
        "SELECT ",
        attempt_columns!(),
        " FROM attempt WHERE assignment_id = $1 AND ($2 = '' OR person_id = $2) ORDER BY person_id, number"
    ))
    .bind(assignment.to_string())
    .bind(student.map(|student| student.to_string()).unwrap_or_default())
    .fetch_all(pool)
    .await?;
    rows.into_iter().map(Attempt::try_from).collect()
}

pub(super) async fn papers(pool: &Pool, attempt: Uuid) -> Result<Papers, StoreError> {
    let row: Option<(Option<String>, Option<String>)> =
        sqlx::query_as("SELECT grade, receipt FROM attempt WHERE id = $1")
            .bind(attempt.to_string())
            .fetch_optional(pool)
            .await?;
    Ok(row.map_or_else(Papers::default, |(grade, receipt)| Papers { grade, receipt }))
}

/// Attempts without a grade whose jobs have ended, or are gone.
pub(super) async fn ripe(pool: &Pool, limit: i64) -> Result<Vec<Ripe>, StoreError> {
    let rows = sqlx::query(concat!(
        "SELECT j.job_state, j.job_reason, ",
        attempt_columns!(),
        " FROM attempt LEFT JOIN (SELECT id AS found, state AS job_state, reason AS job_reason FROM job) j \
         ON j.found = attempt.job_id \
         WHERE attempt.state = 'grading' \
         AND (j.job_state IS NULL OR j.job_state IN ('succeeded', 'failed', 'canceled')) ORDER BY attempt.id LIMIT $1"
    ))
    .bind(limit)
    .fetch_all(pool)
    .await?;
    let ripe = |row: &<Db as sqlx::Database>::Row| {
        let ended: Option<String> = row.try_get("job_state")?;
        let reason: Option<String> = row.try_get("job_reason")?;
        let job = ended.map(|ended| stored_state(&ended).map(|state| (state, reason))).transpose()?;
        Ok(Ripe { attempt: AttemptRow::from_row(row)?.try_into()?, job })
    };
    rows.iter().map(ripe).collect()
}

/// Ends an attempt that has not ended; whether this call did.
pub(super) async fn finish(pool: &Pool, attempt: Uuid, outcome: &Outcome) -> Result<bool, StoreError> {
    let mut transaction = begin(pool).await?;
    let at = now(&mut transaction).await?;
    let (state, reason, at, papers) = match outcome {
        Outcome::Graded { feedback, grade, receipt, graded_at } => {
            (AttemptState::Graded, None, graded_at.as_microsecond(), [feedback, grade, receipt].map(Some))
        }
        Outcome::Returned(reason) => (AttemptState::Returned, Some(reason), at, [None; 3]),
    };
    let [feedback, grade, receipt] = papers;
    let done = sqlx::query(
        "UPDATE attempt SET state = $2, reason = $3, feedback = $4, grade = $5, receipt = $6, graded_at = $7 \
         WHERE id = $1 AND state = 'grading'",
    )
    .bind(attempt.to_string())
    .bind(state.id())
    .bind(reason)
    .bind(feedback)
    .bind(grade)
    .bind(receipt)
    .bind(at)
    .execute(&mut *transaction)
    .await?;
    transaction.commit().await?;
    Ok(done.rows_affected() > 0)
}
