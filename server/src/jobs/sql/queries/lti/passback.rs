//! Grades on their way to platforms: what they should have, what they have, and when it is tried again.
//!
//! Marks follow from graded attempts and from what teachers decide. Both only ever add rows, so their numbers tell whether marks
//! may have changed; that is looked at again and again, and no change can be missed for the death of a process.

use super::super::{Pool, begin, now, while_submitting};
use crate::jobs::{StoreError, stored_id};
use crate::lti::rows::{DueItemRow, DueScoreRow, platform_columns};
use crate::lti::{DueItem, DueScore, Link, Score, StaleLink, Standing};
use std::time::Duration;
use uuid::Uuid;

/// Scores of a student have times at least this far apart, µs: platforms may read them to a millisecond.
const APART_US: i64 = 1000;

/// Numbers from which it follows whether an assignment's marks may have changed: graded attempts, teachers' deeds, students.
const PROBE: &str = "SELECT l.id, l.assignment_id, l.context_id, l.probe, \
     (SELECT COUNT(*) FROM attempt a WHERE a.assignment_id = l.assignment_id AND a.state = 'graded') AS graded, \
     (SELECT COUNT(*) FROM audit d WHERE d.class_id = c.class_id) AS deeds, \
     (SELECT COUNT(*) FROM lti_member m WHERE m.context_id = l.context_id) AS members \
     FROM lti_link l JOIN lti_context c ON c.id = l.context_id";

pub(super) async fn stale(pool: &Pool) -> Result<Vec<StaleLink>, StoreError> {
    let rows: Vec<(String, String, String, String, i64, i64, i64)> = sqlx::query_as(PROBE).fetch_all(pool).await?;
    let mut stale = Vec::new();
    for (id, assignment, context, before, graded, deeds, members) in rows {
        let probe = format!("{graded} {deeds} {members}");
        if probe == before {
            continue;
        }
        let students: Vec<String> = sqlx::query_scalar("SELECT person_id FROM lti_member WHERE context_id = $1")
            .bind(context)
            .fetch_all(pool)
            .await?;
        stale.push(StaleLink {
            link: Link { id: stored_id(&id)?, assignment: stored_id(&assignment)? },
            probe,
            students: students.iter().map(|id| stored_id(id)).collect::<Result<_, _>>()?,
        });
    }
    Ok(stale)
}

/// Notes the scores of a link, and the probe that they follow from.
pub(super) async fn plan(pool: &Pool, stale: &StaleLink, scores: &[Score]) -> Result<(), StoreError> {
    let mut transaction = begin(pool).await?;
    let connection = &mut *transaction;
    // Two servers must not each think that the other's older marks are newer.
    while_submitting(connection, &format!("lti scores {}", stale.link.id)).await?;
    let at = now(connection).await?;
    for Score { student, points, most } in scores {
        // Where there never was a score, none is taken back.
        let query = if points.is_some() {
            "INSERT INTO lti_score (id, link_id, person_id, points, most, at, tries, due_at) \
             SELECT $1, $2, id, CAST($4 AS DOUBLE PRECISION), CAST($5 AS DOUBLE PRECISION), CAST($6 AS BIGINT), 0, 0 FROM person WHERE id = $3 \
             ON CONFLICT (link_id, person_id) DO UPDATE SET points = excluded.points, most = excluded.most, \
             at = CASE WHEN excluded.at > lti_score.at + $7 THEN excluded.at ELSE lti_score.at + $7 END, \
             sent_at = NULL, tries = 0, due_at = 0, error = NULL \
             WHERE lti_score.points IS DISTINCT FROM excluded.points OR lti_score.most <> excluded.most"
        } else {
            "UPDATE lti_score SET id = $1, points = $4, most = $5, \
             at = CASE WHEN $6 > at + $7 THEN $6 ELSE at + $7 END, sent_at = NULL, tries = 0, due_at = 0, error = NULL \
             WHERE link_id = $2 AND person_id = $3 AND points IS NOT NULL"
        };
        sqlx::query(query)
            .bind(Uuid::now_v7().to_string())
            .bind(stale.link.id.to_string())
            .bind(student.to_string())
            .bind(*points)
            .bind(*most)
            .bind(at)
            .bind(APART_US)
            .execute(&mut *connection)
            .await?;
    }
    sqlx::query("UPDATE lti_link SET probe = $2 WHERE id = $1")
        .bind(stale.link.id.to_string())
        .bind(&stale.probe)
        .execute(connection)
        .await?;
    transaction.commit().await?;
    Ok(())
}

/// Takes rows of a table that are due: `(found, taken)` are the statements that look for some and that take them.
async fn take(
    write: &Pool,
    read: &Pool,
    found: &'static str,
    taken: &'static str,
    limit: i64,
    lease: Duration,
) -> Result<Vec<String>, StoreError> {
    let at = now(&mut *read.acquire().await?).await?;
    // Mostly nothing is due, and then nothing is written.
    let due: Vec<String> = sqlx::query_scalar(found).bind(at).bind(limit).fetch_all(read).await?;
    let mut mine = Vec::new();
    let until = at.saturating_add(i64::try_from(lease.as_micros()).unwrap_or(i64::MAX));
    for id in due {
        let done = sqlx::query(taken).bind(at).bind(until).bind(&id).execute(write).await?;
        if done.rows_affected() > 0 {
            mine.push(id);
        }
    }
    Ok(mine)
}

pub(super) async fn due_items(
    write: &Pool,
    read: &Pool,
    limit: i64,
    lease: Duration,
) -> Result<Vec<DueItem>, StoreError> {
    let found = "SELECT l.id FROM lti_link l JOIN lti_context c ON c.id = l.context_id \
         WHERE l.line_item IS NULL AND c.line_items_url IS NOT NULL AND l.due_at <= $1 ORDER BY l.due_at LIMIT $2";
    let taken = "UPDATE lti_link SET due_at = $2 WHERE id = $3 AND line_item IS NULL AND due_at <= $1";
    let mut items = Vec::new();
    for id in take(write, read, found, taken, limit, lease).await? {
        let row: Option<DueItemRow> = sqlx::query_as(concat!(
            "SELECT l.id, l.link, l.assignment_id, c.line_items_url, l.tries, ",
            platform_columns!(),
            " FROM lti_link l JOIN lti_context c ON c.id = l.context_id JOIN lti_platform p ON p.id = c.platform_id \
             WHERE l.id = $1 AND c.line_items_url IS NOT NULL"
        ))
        .bind(id)
        .fetch_optional(read)
        .await?;
        items.extend(row.map(DueItem::try_from).transpose()?);
    }
    Ok(items)
}

pub(super) async fn item_found(pool: &Pool, id: Uuid, line_item: &str) -> Result<(), StoreError> {
    sqlx::query("UPDATE lti_link SET line_item = COALESCE(line_item, $2), error = NULL WHERE id = $1")
        .bind(id.to_string())
        .bind(line_item)
        .execute(pool)
        .await?;
    Ok(())
}

pub(super) async fn item_failed(pool: &Pool, id: Uuid, pause: Duration, error: &str) -> Result<(), StoreError> {
    let until = after(pool, pause).await?;
    sqlx::query("UPDATE lti_link SET tries = tries + 1, due_at = $2, error = $3 WHERE id = $1")
        .bind(id.to_string())
        .bind(until)
        .bind(error)
        .execute(pool)
        .await?;
    Ok(())
}

pub(super) async fn retry_all(pool: &Pool) -> Result<(), StoreError> {
    let mut transaction = begin(pool).await?;
    sqlx::query("UPDATE lti_link SET due_at = 0 WHERE line_item IS NULL").execute(&mut *transaction).await?;
    sqlx::query("UPDATE lti_score SET due_at = 0 WHERE sent_at IS NULL").execute(&mut *transaction).await?;
    transaction.commit().await?;
    Ok(())
}

pub(super) async fn due_scores(
    write: &Pool,
    read: &Pool,
    limit: i64,
    lease: Duration,
) -> Result<Vec<DueScore>, StoreError> {
    let found = "SELECT s.id FROM lti_score s JOIN lti_link l ON l.id = s.link_id \
         WHERE s.sent_at IS NULL AND s.due_at <= $1 AND l.line_item IS NOT NULL ORDER BY s.due_at, s.id LIMIT $2";
    let taken = "UPDATE lti_score SET due_at = $2 WHERE id = $3 AND sent_at IS NULL AND due_at <= $1";
    let mut scores = Vec::new();
    for id in take(write, read, found, taken, limit, lease).await? {
        let row: Option<DueScoreRow> = sqlx::query_as(concat!(
            "SELECT s.id, m.subject, l.line_item, s.points, s.most, s.at, s.tries, ",
            platform_columns!(),
            " FROM lti_score s JOIN lti_link l ON l.id = s.link_id JOIN lti_context c ON c.id = l.context_id \
             JOIN lti_platform p ON p.id = c.platform_id \
             JOIN lti_member m ON m.context_id = c.id AND m.person_id = s.person_id \
             WHERE s.id = $1 AND l.line_item IS NOT NULL"
        ))
        .bind(id)
        .fetch_optional(read)
        .await?;
        scores.extend(row.map(DueScore::try_from).transpose()?);
    }
    Ok(scores)
}

pub(super) async fn score_sent(pool: &Pool, score: &DueScore) -> Result<(), StoreError> {
    let at = now(&mut *pool.acquire().await?).await?;
    sqlx::query("UPDATE lti_score SET sent_at = $3, error = NULL WHERE id = $1 AND at = $2")
        .bind(score.id.to_string())
        .bind(score.at.as_microsecond())
        .bind(at)
        .execute(pool)
        .await?;
    Ok(())
}

pub(super) async fn score_failed(
    pool: &Pool,
    score: &DueScore,
    pause: Duration,
    error: &str,
) -> Result<(), StoreError> {
    let until = after(pool, pause).await?;
    sqlx::query("UPDATE lti_score SET tries = tries + 1, due_at = $3, error = $4 WHERE id = $1 AND at = $2")
        .bind(score.id.to_string())
        .bind(score.at.as_microsecond())
        .bind(until)
        .bind(error)
        .execute(pool)
        .await?;
    Ok(())
}

async fn after(pool: &Pool, pause: Duration) -> Result<i64, StoreError> {
    let at = now(&mut *pool.acquire().await?).await?;
    Ok(at.saturating_add(i64::try_from(pause.as_micros()).unwrap_or(i64::MAX)))
}

pub(super) async fn standing(pool: &Pool, assignment: Uuid) -> Result<Standing, StoreError> {
    let (links, columns): (i64, i64) =
        sqlx::query_as("SELECT COUNT(*), COUNT(line_item) FROM lti_link WHERE assignment_id = $1")
            .bind(assignment.to_string())
            .fetch_one(pool)
            .await?;
    let (sent, all): (i64, i64) = sqlx::query_as(
        "SELECT COUNT(s.sent_at), COUNT(*) FROM lti_score s JOIN lti_link l ON l.id = s.link_id WHERE l.assignment_id = $1",
    )
    .bind(assignment.to_string())
    .fetch_one(pool)
    .await?;
    let error: Option<String> = sqlx::query_scalar(
        "SELECT COALESCE(s.error, l.error) FROM lti_link l LEFT JOIN lti_score s ON s.link_id = l.id AND s.sent_at IS NULL \
         WHERE l.assignment_id = $1 AND COALESCE(s.error, l.error) IS NOT NULL LIMIT 1",
    )
    .bind(assignment.to_string())
    .fetch_optional(pool)
    .await?;
    Ok(Standing { links, columns, sent, waiting: all - sent, error })
}
