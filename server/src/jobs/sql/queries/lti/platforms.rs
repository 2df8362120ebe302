//! Platforms, and what is good once: nonces and tickets.

use super::super::{Pool, begin, now};
use crate::jobs::StoreError;
use crate::lti::Platform;
use crate::lti::rows::{PlatformRow, platform_columns};
use jiff::Timestamp;
use uuid::Uuid;

pub(super) async fn kept_secret(pool: &Pool, name: &str) -> Result<Option<String>, StoreError> {
    let value = sqlx::query_scalar("SELECT value FROM classroom_secret WHERE name = $1").bind(name);
    Ok(value.fetch_optional(pool).await?)
}

pub(super) async fn add(pool: &Pool, platform: &Platform) -> Result<bool, StoreError> {
    // Texts always become JSON.
    let deployments = serde_json::to_string(&platform.deployments).unwrap_or_default();
    let done = sqlx::query(
        "INSERT INTO lti_platform (id, teacher_id, issuer, client_id, auth_url, token_url, keys_url, deployments, created_at) \
         VALUES ($1, $2, $3, $4, $5, $6, $7, $8, $9) ON CONFLICT (issuer, client_id) DO NOTHING",
    )
    .bind(platform.id.to_string())
    .bind(platform.teacher.to_string())
    .bind(&platform.issuer)
    .bind(&platform.client_id)
    .bind(&platform.auth_url)
    .bind(&platform.token_url)
    .bind(&platform.keys_url)
    .bind(deployments)
    .bind(platform.created_at.as_microsecond())
    .execute(pool)
    .await?;
    Ok(done.rows_affected() > 0)
}

pub(super) async fn find(pool: &Pool, id: Uuid) -> Result<Option<Platform>, StoreError> {
    let query = sqlx::query_as(concat!("SELECT ", platform_columns!(), " FROM lti_platform p WHERE p.id = $1"));
    let row: Option<PlatformRow> = query.bind(id.to_string()).fetch_optional(pool).await?;
    row.map(Platform::try_from).transpose()
}

pub(super) async fn all(pool: &Pool) -> Result<Vec<Platform>, StoreError> {
    let query = sqlx::query_as(concat!("SELECT ", platform_columns!(), " FROM lti_platform p ORDER BY p.id"));
    let rows: Vec<PlatformRow> = query.fetch_all(pool).await?;
    rows.into_iter().map(Platform::try_from).collect()
}

pub(super) async fn remove(pool: &Pool, id: Uuid, teacher: Option<Uuid>) -> Result<bool, StoreError> {
    let done = sqlx::query("DELETE FROM lti_platform WHERE id = $1 AND ($2 = '' OR teacher_id = $2)")
        .bind(id.to_string())
        .bind(teacher.map(|teacher| teacher.to_string()).unwrap_or_default())
        .execute(pool)
        .await?;
    Ok(done.rows_affected() > 0)
}

pub(super) async fn use_nonce(pool: &Pool, nonce: &str, expires_at: Timestamp) -> Result<bool, StoreError> {
    let mut transaction = begin(pool).await?;
    let at = now(&mut transaction).await?;
    sqlx::query("DELETE FROM lti_nonce WHERE expires_at < $1").bind(at).execute(&mut *transaction).await?;
    let done = sqlx::query("INSERT INTO lti_nonce (nonce, expires_at) VALUES ($1, $2) ON CONFLICT (nonce) DO NOTHING")
        .bind(nonce)
        .bind(expires_at.as_microsecond())
        .execute(&mut *transaction)
        .await?;
    transaction.commit().await?;
    Ok(done.rows_affected() > 0)
}

pub(super) async fn keep_ticket(pool: &Pool, hash: &str, data: &str, expires_at: Timestamp) -> Result<(), StoreError> {
    let mut transaction = begin(pool).await?;
    let at = now(&mut transaction).await?;
    sqlx::query("DELETE FROM lti_ticket WHERE expires_at < $1").bind(at).execute(&mut *transaction).await?;
    sqlx::query("INSERT INTO lti_ticket (hash, data, expires_at) VALUES ($1, $2, $3)")
        .bind(hash)
        .bind(data)
        .bind(expires_at.as_microsecond())
        .execute(&mut *transaction)
        .await?;
    transaction.commit().await?;
    Ok(())
}

pub(super) async fn take_ticket(pool: &Pool, hash: &str) -> Result<Option<String>, StoreError> {
    let mut transaction = begin(pool).await?;
    let at = now(&mut transaction).await?;
    let data = sqlx::query_scalar("DELETE FROM lti_ticket WHERE hash = $1 AND expires_at >= $2 RETURNING data")
        .bind(hash)
        .bind(at)
        .fetch_optional(&mut *transaction)
        .await?;
    transaction.commit().await?;
    Ok(data)
}
