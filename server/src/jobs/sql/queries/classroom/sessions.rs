//! Sessions, by the hashes of their secrets.

use super::super::{Connection, Pool, begin, now};
use crate::classroom::model::{Person, Session};
use crate::classroom::rows::{PersonRow, person_columns};
use crate::jobs::{StoreError, stored_time};
use jiff::Timestamp;
use sqlx::{FromRow, Row};
use uuid::Uuid;

pub(super) async fn open(pool: &Pool, hash: &str, person: Uuid, ended: Option<&str>) -> Result<(), StoreError> {
    let mut transaction = begin(pool).await?;
    let at = now(&mut transaction).await?;
    sqlx::query("DELETE FROM session WHERE hash = $1").bind(ended).execute(&mut *transaction).await?;
    sqlx::query("INSERT INTO session (hash, person_id, created_at, used_at) VALUES ($1, $2, $3, $3)")
        .bind(hash)
        .bind(person.to_string())
        .bind(at)
        .execute(&mut *transaction)
        .await?;
    transaction.commit().await?;
    Ok(())
}

pub(super) async fn find(pool: &Pool, hash: &str) -> Result<Option<Session>, StoreError> {
    let row = sqlx::query(concat!(
        "SELECT s.begun_at, s.used_at, ",
        person_columns!(),
        " FROM person JOIN (SELECT person_id, created_at AS begun_at, used_at FROM session WHERE hash = $1) s \
         ON s.person_id = person.id"
    ))
    .bind(hash)
    .fetch_optional(pool)
    .await?;
    let Some(row) = row else { return Ok(None) };
    let (created_at, used_at) = (stored_time(row.try_get("begun_at")?)?, stored_time(row.try_get("used_at")?)?);
    Ok(Some(Session { person: Person::try_from(PersonRow::from_row(&row)?)?, created_at, used_at }))
}

pub(super) async fn touch(pool: &Pool, hash: &str) -> Result<(), StoreError> {
    sqlx::query("UPDATE session SET used_at = $2 WHERE hash = $1")
        .bind(hash)
        .bind(Timestamp::now().as_microsecond())
        .execute(pool)
        .await?;
    Ok(())
}

pub(super) async fn close(pool: &Pool, hash: &str) -> Result<(), StoreError> {
    sqlx::query("DELETE FROM session WHERE hash = $1").bind(hash).execute(pool).await?;
    Ok(())
}

pub(super) async fn close_all(connection: &mut Connection, person: Uuid, spared: &str) -> Result<(), StoreError> {
    sqlx::query("DELETE FROM session WHERE person_id = $1 AND hash <> $2")
        .bind(person.to_string())
        .bind(spared)
        .execute(connection)
        .await?;
    Ok(())
}

pub(super) async fn forget(pool: &Pool, used: Timestamp, begun: Timestamp) -> Result<u64, StoreError> {
    let done = sqlx::query("DELETE FROM session WHERE used_at < $1 OR created_at < $2")
        .bind(used.as_microsecond())
        .bind(begun.as_microsecond())
        .execute(pool)
        .await?;
    Ok(done.rows_affected())
}
