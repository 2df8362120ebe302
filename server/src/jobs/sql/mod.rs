//! Jobs in tables, of SQLite on one machine or of PostgreSQL for many.
//!
//! The statements are the same: `queries/` is compiled once for each database, with what differs taken from `sqlite.rs`
//! or `postgres.rs`. What changes a job and its shards touches the job's row first, so that two such
//! transactions cannot wait for each other.

mod postgres;
mod rows;
mod sqlite;
#[cfg(test)]
mod tests;

use super::{JobStore, Queue, StoreError};
use crate::config::DatabaseUrl;
use sqlx::migrate::Migrator;
use std::path::Path;
use std::sync::Arc;

/// Opens the database and brings it to this version. A database in the data folder belongs to one process at a time.
pub async fn connect(
    database: Option<&DatabaseUrl>,
    data: &Path,
) -> Result<(Arc<dyn JobStore>, Arc<dyn Queue>), StoreError> {
    match database {
        None => {
            let store = sqlite::open(&data.join("adaptarm.sqlite3")).await?;
            Ok((Arc::new(store.clone()), Arc::new(store)))
        }
        Some(database) => {
            let store = postgres::open(database.expose()).await?;
            Ok((Arc::new(store.clone()), Arc::new(store)))
        }
    }
}

/// Our tables, in a list of their own: the queue keeps its migrations where sqlx does by default.
fn migrations() -> Migrator {
    let mut migrations = sqlx::migrate!("./migrations");
    migrations.dangerous_set_table_name("adaptarm_migrations");
    migrations
}
