//! Forgetting: deleted jobs, old jobs, results that nobody refers to.

use super::work::cancel;
use super::{Pool, begin, while_forgetting};
use crate::jobs::StoreError;
use jiff::Timestamp;
use uuid::Uuid;

/// Forgets a user's job; whether there was one. Whoever computes it finds its fence gone.
pub(super) async fn delete(pool: &Pool, owner: &str, id: Uuid) -> Result<bool, StoreError> {
    // Whoever waits to be told of its end is told.
    cancel(pool, owner, id).await?;
    let mut transaction = begin(pool).await?;
    let deleted = sqlx::query("DELETE FROM job WHERE id = $1 AND owner = $2")
        .bind(id.to_string())
        .bind(owner)
        .execute(&mut *transaction)
        .await?;
    transaction.commit().await?;
    Ok(deleted.rows_affected() > 0)
}

/// Jobs forgotten in one transaction: each may have ten thousand scenarios, and others want to write too.
const BATCH: i64 = 1;

/// Forgets jobs that ended before this moment; how many.
pub(super) async fn forget_jobs(pool: &Pool, before: Timestamp) -> Result<u64, StoreError> {
    let mut forgotten = 0;
    loop {
        let done = sqlx::query(
            "DELETE FROM job WHERE id IN (SELECT id FROM job WHERE finished_at < $1 ORDER BY finished_at LIMIT $2)",
        )
        .bind(before.as_microsecond())
        .bind(BATCH)
        .execute(pool)
        .await?
        .rows_affected();
        forgotten += done;
        if done < BATCH as u64 {
            return Ok(forgotten);
        }
    }
}

/// Results that no job refers to.
pub(super) async fn unused_results(
    pool: &Pool,
    before: Timestamp,
    limit: i64,
) -> Result<Vec<(String, String)>, StoreError> {
    let rows = sqlx::query_as(
        "SELECT hash, core_version FROM result r WHERE stored_at < $1 \
         AND NOT EXISTS (SELECT 1 FROM job_scenario s WHERE s.hash = r.hash) ORDER BY stored_at LIMIT $2",
    )
    .bind(before.as_microsecond())
    .bind(limit)
    .fetch_all(pool)
    .await?;
    Ok(rows)
}

/// Forgets a result that no job refers to; whether it did.
pub(super) async fn forget_unused_result(pool: &Pool, hash: &str, core_version: &str) -> Result<bool, StoreError> {
    let mut transaction = begin(pool).await?;
    while_forgetting(&mut transaction).await?;
    let done = sqlx::query(
        "DELETE FROM result WHERE hash = $1 AND core_version = $2 \
         AND NOT EXISTS (SELECT 1 FROM job_scenario s WHERE s.hash = result.hash)",
    )
    .bind(hash)
    .bind(core_version)
    .execute(&mut *transaction)
    .await?;
    transaction.commit().await?;
    Ok(done.rows_affected() > 0)
}

/// Forgets a result whose samples are lost.
pub(super) async fn forget_lost_result(pool: &Pool, hash: &str, core_version: &str) -> Result<(), StoreError> {
    sqlx::query("DELETE FROM result WHERE hash = $1 AND core_version = $2")
        .bind(hash)
        .bind(core_version)
        .execute(pool)
        .await?;
    Ok(())
}

/// Whether this shard still exists.
pub(super) async fn has_shard(pool: &Pool, job: Uuid, shard: i64) -> Result<bool, StoreError> {
    let found: Option<i64> = sqlx::query_scalar("SELECT number FROM shard WHERE job_id = $1 AND number = $2")
        .bind(job.to_string())
        .bind(shard)
        .fetch_optional(pool)
        .await?;
    Ok(found.is_some())
}
