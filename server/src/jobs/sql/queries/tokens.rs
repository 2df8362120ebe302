//! Tokens. Their secrets are not here, only hashes of them.

use super::Pool;
use super::rows::TokenRow;
use crate::jobs::{StoreError, StoredToken};
use jiff::Timestamp;

/// Keeps a new token.
pub(super) async fn add(pool: &Pool, token: &StoredToken) -> Result<(), StoreError> {
    sqlx::query(
        "INSERT INTO token (id, owner, name, scopes, secret_hash, created_at, expires_at) \
         VALUES ($1, $2, $3, $4, $5, $6, $7)",
    )
    .bind(&token.id)
    .bind(&token.owner)
    .bind(&token.name)
    .bind(&token.scopes)
    .bind(&token.secret_hash)
    .bind(token.created_at.as_microsecond())
    .bind(token.expires_at.map(Timestamp::as_microsecond))
    .execute(pool)
    .await?;
    Ok(())
}

/// The token with this public part.
pub(super) async fn find(pool: &Pool, id: &str) -> Result<Option<StoredToken>, StoreError> {
    let row: Option<TokenRow> =
        sqlx::query_as("SELECT * FROM token WHERE id = $1").bind(id).fetch_optional(pool).await?;
    row.map(StoredToken::try_from).transpose()
}

/// All tokens, oldest first.
pub(super) async fn all(pool: &Pool) -> Result<Vec<StoredToken>, StoreError> {
    let rows: Vec<TokenRow> = sqlx::query_as("SELECT * FROM token ORDER BY created_at, id").fetch_all(pool).await?;
    rows.into_iter().map(StoredToken::try_from).collect()
}

/// Revokes a token; whether there was one.
pub(super) async fn revoke(pool: &Pool, id: &str) -> Result<bool, StoreError> {
    let done = sqlx::query("UPDATE token SET revoked_at = COALESCE(revoked_at, $2) WHERE id = $1")
        .bind(id)
        .bind(Timestamp::now().as_microsecond())
        .execute(pool)
        .await?;
    Ok(done.rows_affected() > 0)
}

/// Notes that a token was used.
pub(super) async fn touch(pool: &Pool, id: &str) -> Result<(), StoreError> {
    sqlx::query("UPDATE token SET last_used_at = $2 WHERE id = $1")
        .bind(id)
        .bind(Timestamp::now().as_microsecond())
        .execute(pool)
        .await?;
    Ok(())
}
