//! What is special about SQLite: one writer at a time, a file, durability by setting.

use crate::jobs::StoreError;
use apalis_core::task::Task;
use apalis_sqlite::SqliteStorage;
use apalis_sqlite::queries::push_tasks;
use serde_json::Value;
use sqlx::sqlite::{SqliteConnectOptions, SqliteJournalMode, SqlitePoolOptions, SqliteSynchronous};
use std::path::Path;
use std::time::Duration;

pub(super) use apalis_sqlite::Config as QueueConfig;
pub(super) use sqlx::{Sqlite as Db, SqliteConnection as Connection, SqlitePool as Pool};

#[path = "queries/mod.rs"]
mod queries;
pub(super) use queries::SqlStore;

/// Connections that only read; with a write-ahead log they never wait for the writer.
const READERS: u32 = 4;

/// Opens the file, or makes it.
pub(super) async fn open(path: &Path) -> Result<SqlStore, StoreError> {
    let options = SqliteConnectOptions::new()
        .filename(path)
        .create_if_missing(true)
        .journal_mode(SqliteJournalMode::Wal)
        // What a client was told is on disk, also when the power fails.
        .synchronous(SqliteSynchronous::Full)
        .foreign_keys(true)
        .busy_timeout(Duration::from_secs(30));
    // One writer: waiting in the pool's fair queue beats SQLite's polling for the lock.
    let write = SqlitePoolOptions::new().max_connections(1).connect_with(options.clone()).await?;
    super::migrations().run(&write).await?;
    // Not its `setup`, which switches durability off for the whole connection.
    SqliteStorage::migrations().run(&write).await?;
    let read = SqlitePoolOptions::new().max_connections(READERS).connect_with(options.read_only(true)).await?;
    Ok(SqlStore::new(write, read))
}

/// Whether writers take turns, so that joining what they write is worth it.
pub(super) const ONE_WRITER: bool = true;

/// Begins a transaction that will write. Beginning as a reader and writing later could fail halfway.
pub(super) async fn begin(pool: &Pool) -> Result<sqlx::Transaction<'static, Db>, sqlx::Error> {
    pool.begin_with("BEGIN IMMEDIATE").await
}

/// The time that leases are measured in, µs since 1970.
pub(super) async fn now(_: &mut Connection) -> Result<i64, sqlx::Error> {
    Ok(jiff::Timestamp::now().as_microsecond())
}

/// Keeps two workers from choosing the same shard; here every writing transaction does.
pub(super) async fn one_at_a_time(_: &mut Connection) -> Result<(), sqlx::Error> {
    Ok(())
}

/// Keeps a user's submissions apart, and forgetting results from all of them; here every writing transaction does.
pub(super) async fn while_submitting(_: &mut Connection, _: &str) -> Result<(), sqlx::Error> {
    Ok(())
}

/// Keeps submissions away while a result is forgotten; here every writing transaction does.
pub(super) async fn while_forgetting(_: &mut Connection) -> Result<(), sqlx::Error> {
    Ok(())
}

/// Forgets tasks that are done with.
pub(super) const SWEEP: &str = "DELETE FROM Jobs WHERE status IN ('Done', 'Killed', 'Failed')";

/// Puts tasks into the queue, as part of the connection's transaction.
pub(super) async fn push(
    connection: &mut Connection,
    queue: &str,
    tasks: Vec<Task<Vec<u8>>>,
) -> Result<(), StoreError> {
    push_tasks(connection, queue, &tasks).await.map_err(|error| StoreError::Queue(error.to_string()))
}

/// The queue's side of the database.
pub(super) fn storage(pool: &Pool, config: QueueConfig) -> SqliteStorage<Value> {
    SqliteStorage::new(pool).with_config(config)
}
