//! Teachers and students: how they come to be, and how they are found again. Secrets are here as hashes only.

use super::super::{Connection, Pool, begin, now, while_submitting};
use super::sessions;
use crate::classroom::model::{NewPerson, Person, Role};
use crate::classroom::rows::{PersonRow, person_columns};
use crate::classroom::store::Entered;
use crate::jobs::{StoreError, stored_id};
use jiff::Timestamp;
use uuid::Uuid;

/// The secret of this name, which this makes if nobody did before.
pub(super) async fn secret(pool: &Pool, name: &str, fresh: &str) -> Result<String, StoreError> {
    sqlx::query("INSERT INTO classroom_secret (name, value) VALUES ($1, $2) ON CONFLICT (name) DO NOTHING")
        .bind(name)
        .bind(fresh)
        .execute(pool)
        .await?;
    let value = sqlx::query_scalar("SELECT value FROM classroom_secret WHERE name = $1").bind(name);
    Ok(value.fetch_one(pool).await?)
}

pub(super) async fn teachers(pool: &Pool) -> Result<i64, StoreError> {
    let count = sqlx::query_scalar("SELECT COUNT(*) FROM person WHERE role = $1").bind(Role::Teacher.id());
    Ok(count.fetch_one(pool).await?)
}

/// Keeps an invitation; those that nobody used in time are forgotten.
pub(super) async fn invite(pool: &Pool, hash: &str, printed: bool, expires_at: Timestamp) -> Result<(), StoreError> {
    let mut transaction = begin(pool).await?;
    let at = now(&mut transaction).await?;
    sqlx::query("DELETE FROM invitation WHERE expires_at <= $1").bind(at).execute(&mut *transaction).await?;
    sqlx::query("INSERT INTO invitation (hash, printed, expires_at) VALUES ($1, $2, $3)")
        .bind(hash)
        .bind(i64::from(printed))
        .bind(expires_at.as_microsecond())
        .execute(&mut *transaction)
        .await?;
    transaction.commit().await?;
    Ok(())
}

/// Makes a teacher, and the invitation worthless. Whoever comes second finds its row gone.
pub(super) async fn redeem(pool: &Pool, invitation: &str, teacher: &NewPerson) -> Result<Entered, StoreError> {
    let mut transaction = begin(pool).await?;
    let connection = &mut *transaction;
    let at = now(connection).await?;
    let printed: Option<i64> =
        sqlx::query_scalar("DELETE FROM invitation WHERE hash = $1 AND expires_at > $2 RETURNING printed")
            .bind(invitation)
            .bind(at)
            .fetch_optional(&mut *connection)
            .await?;
    let Some(printed) = printed else { return Ok(Entered::Refused) };
    if printed == 1 {
        // Servers that started at the same time printed one each.
        sqlx::query("DELETE FROM invitation WHERE printed = 1").execute(&mut *connection).await?;
    }
    match insert(connection, teacher, None, at).await {
        Ok(()) => {}
        // Nothing of this is kept: the invitation is still good, for another login.
        Err(StoreError::Database(error)) if is_taken(&error) => return Ok(Entered::Taken),
        Err(error) => return Err(error),
    }
    transaction.commit().await?;
    Ok(Entered::Done)
}

fn is_taken(error: &sqlx::Error) -> bool {
    error.as_database_error().is_some_and(sqlx::error::DatabaseError::is_unique_violation)
}

/// Makes a student of the class whose code has this hash.
pub(super) async fn join(
    pool: &Pool,
    code: &str,
    student: &NewPerson,
    most: i64,
) -> Result<(Entered, Option<Uuid>), StoreError> {
    let mut transaction = begin(pool).await?;
    let connection = &mut *transaction;
    let class: Option<String> = sqlx::query_scalar("SELECT id FROM class WHERE code_hash = $1 AND joining = 1")
        .bind(code)
        .fetch_optional(&mut *connection)
        .await?;
    let Some(class) = class else { return Ok((Entered::Refused, None)) };
    // Two who come at once must not both be the last one for whom there is room.
    while_submitting(connection, &class).await?;
    let count: i64 = sqlx::query_scalar("SELECT COUNT(*) FROM person WHERE class_id = $1")
        .bind(&class)
        .fetch_one(&mut *connection)
        .await?;
    if count >= most {
        return Ok((Entered::Full, None));
    }
    let at = now(connection).await?;
    insert(connection, student, Some(&class), at).await?;
    transaction.commit().await?;
    Ok((Entered::Done, Some(stored_id(&class)?)))
}

async fn insert(
    connection: &mut Connection,
    NewPerson { person, key_hash }: &NewPerson,
    class: Option<&str>,
    at: i64,
) -> Result<(), StoreError> {
    sqlx::query(
        "INSERT INTO person (id, role, class_id, name, login, key_hash, password, created_at) \
         VALUES ($1, $2, $3, $4, $5, $6, $7, $8)",
    )
    .bind(person.id.to_string())
    .bind(person.role.id())
    .bind(class)
    .bind(&person.name)
    .bind(&person.login)
    .bind(key_hash)
    .bind(&person.password)
    .bind(at)
    .execute(connection)
    .await?;
    Ok(())
}

pub(super) async fn person(pool: &Pool, id: Uuid) -> Result<Option<Person>, StoreError> {
    let query = sqlx::query_as(concat!("SELECT ", person_columns!(), " FROM person WHERE id = $1"));
    let row: Option<PersonRow> = query.bind(id.to_string()).fetch_optional(pool).await?;
    row.map(Person::try_from).transpose()
}

pub(super) async fn by_login(pool: &Pool, login: &str) -> Result<Option<Person>, StoreError> {
    let query = sqlx::query_as(concat!("SELECT ", person_columns!(), " FROM person WHERE login = $1"));
    let row: Option<PersonRow> = query.bind(login).fetch_optional(pool).await?;
    row.map(Person::try_from).transpose()
}

pub(super) async fn by_key(pool: &Pool, hash: &str) -> Result<Option<Person>, StoreError> {
    let query = sqlx::query_as(concat!("SELECT ", person_columns!(), " FROM person WHERE key_hash = $1"));
    let row: Option<PersonRow> = query.bind(hash).fetch_optional(pool).await?;
    row.map(Person::try_from).transpose()
}

pub(super) async fn students(pool: &Pool, class: Uuid) -> Result<Vec<Person>, StoreError> {
    let query = sqlx::query_as(concat!("SELECT ", person_columns!(), " FROM person WHERE class_id = $1 ORDER BY id"));
    let rows: Vec<PersonRow> = query.bind(class.to_string()).fetch_all(pool).await?;
    rows.into_iter().map(Person::try_from).collect()
}

pub(super) async fn set_password(
    pool: &Pool,
    id: Uuid,
    password: Option<&str>,
    spared: &str,
) -> Result<(), StoreError> {
    let mut transaction = begin(pool).await?;
    sqlx::query("UPDATE person SET password = $2 WHERE id = $1")
        .bind(id.to_string())
        .bind(password)
        .execute(&mut *transaction)
        .await?;
    sessions::close_all(&mut transaction, id, spared).await?;
    transaction.commit().await?;
    Ok(())
}

pub(super) async fn set_key(pool: &Pool, id: Uuid, hash: &str, spared: &str) -> Result<(), StoreError> {
    let mut transaction = begin(pool).await?;
    sqlx::query("UPDATE person SET key_hash = $2 WHERE id = $1")
        .bind(id.to_string())
        .bind(hash)
        .execute(&mut *transaction)
        .await?;
    sessions::close_all(&mut transaction, id, spared).await?;
    transaction.commit().await?;
    Ok(())
}
