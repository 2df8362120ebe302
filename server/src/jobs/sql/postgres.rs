//! What is special about PostgreSQL: many writers, its own clock, and telling others that there is work.

use crate::jobs::StoreError;
use apalis_core::task::Task;
use apalis_postgres::PostgresStorage;
use apalis_postgres::queries::push_tasks;
use serde_json::Value;
use sqlx::postgres::{PgConnectOptions, PgPoolOptions};
use sqlx::{ConnectOptions, Connection as _};
use std::time::Duration;

pub(super) use apalis_postgres::Config as QueueConfig;
pub(super) use sqlx::{PgConnection as Connection, PgPool as Pool, Postgres as Db};

#[path = "queries/mod.rs"]
mod queries;
pub(super) use queries::SqlStore;

/// Connections of one process.
const CONNECTIONS: u32 = 16;

/// Held while a shard is chosen. Any number will do, as long as nothing else in the database uses it.
const CLAIM_LOCK: i64 = 0x0061_6461_7074_6172;

/// Held while the tables are made: several processes may start at once.
const MIGRATION_LOCK: i64 = CLAIM_LOCK + 1;

/// Held by all who submit, and alone by whoever forgets results.
const FORGET_LOCK: i64 = CLAIM_LOCK + 2;

/// What every session keeps to. A worker that is frozen or cut off in the middle of a transaction would hold its locks for
/// ever; after this time, ms, the database takes them back, and the worker finds its connection gone.
const SESSION: [(&str, &str); 3] =
    [("idle_in_transaction_session_timeout", "5000"), ("lock_timeout", "10000"), ("tcp_keepalives_idle", "30")];

/// Connects.
pub(super) async fn open(url: &str) -> Result<SqlStore, StoreError> {
    let options: PgConnectOptions = url.parse()?;
    // The pool would try until its time is up, and then say no more than that.
    options.connect().await?.close().await?;
    let pool = PgPoolOptions::new()
        .max_connections(CONNECTIONS)
        .acquire_timeout(Duration::from_secs(10))
        .connect_with(options.application_name("adaptarm").options(SESSION))
        .await?;
    let mut held = pool.acquire().await?;
    // Whoever comes second waits for however long the first one takes.
    sqlx::query("SET lock_timeout = 0").execute(&mut *held).await?;
    sqlx::query("SELECT pg_advisory_lock($1)").bind(MIGRATION_LOCK).execute(&mut *held).await?;
    let migrated = async {
        super::migrations().run(&pool).await?;
        PostgresStorage::migrations().run(&pool).await
    }
    .await;
    sqlx::query("SELECT pg_advisory_unlock($1)").bind(MIGRATION_LOCK).execute(&mut *held).await?;
    migrated?;
    // It has other settings than the rest.
    held.close().await?;
    Ok(SqlStore::new(pool.clone(), pool))
}

/// Whether writers take turns, so that joining what they write is worth it.
pub(super) const ONE_WRITER: bool = false;

/// Begins a transaction.
pub(super) async fn begin(pool: &Pool) -> Result<sqlx::Transaction<'static, Db>, sqlx::Error> {
    pool.begin().await
}

/// The database's time, µs since 1970: the machines' own clocks differ.
pub(super) async fn now(connection: &mut Connection) -> Result<i64, sqlx::Error> {
    sqlx::query_scalar("SELECT CAST(EXTRACT(EPOCH FROM clock_timestamp()) * 1000000 AS BIGINT)")
        .fetch_one(connection)
        .await
}

/// Keeps two workers from choosing the same shard, until the end of the transaction.
pub(super) async fn one_at_a_time(connection: &mut Connection) -> Result<(), sqlx::Error> {
    sqlx::query("SELECT pg_advisory_xact_lock($1)").bind(CLAIM_LOCK).execute(connection).await?;
    Ok(())
}

/// Keeps a user's submissions apart, so that each sees what the ones before it asked for, and forgetting results from all.
pub(super) async fn while_submitting(connection: &mut Connection, owner: &str) -> Result<(), sqlx::Error> {
    sqlx::query("SELECT pg_advisory_xact_lock_shared($1), pg_advisory_xact_lock(hashtextextended($2, $1))")
        .bind(FORGET_LOCK)
        .bind(owner)
        .execute(connection)
        .await?;
    Ok(())
}

/// Keeps submissions away while a result is forgotten: one of them may have just found it.
pub(super) async fn while_forgetting(connection: &mut Connection) -> Result<(), sqlx::Error> {
    sqlx::query("SELECT pg_advisory_xact_lock($1)").bind(FORGET_LOCK).execute(connection).await?;
    Ok(())
}

/// Forgets tasks that are done with.
pub(super) const SWEEP: &str = "DELETE FROM apalis.jobs WHERE status IN ('Done', 'Killed', 'Failed')";

/// Puts tasks into the queue, as part of the connection's transaction.
pub(super) async fn push(
    connection: &mut Connection,
    queue: &str,
    tasks: Vec<Task<Vec<u8>>>,
) -> Result<(), StoreError> {
    push_tasks(connection, queue, tasks).await.map_err(|error| StoreError::Queue(error.to_string()))
}

/// The queue's side of the database.
pub(super) fn storage(pool: &Pool, config: QueueConfig) -> PostgresStorage<Value> {
    PostgresStorage::new(pool).with_config(config)
}
