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

pub(crate) use rows::{damaged, id as stored_id, state as stored_state, time as stored_time};

use super::{JobStore, Queue, StoreError};
use crate::classroom::ClassroomStore;
use crate::config::DatabaseUrl;
use sqlx::migrate::Migrator;
use std::path::Path;
use std::sync::Arc;

/// What one database holds.
pub struct Stores {
    /// Jobs.
    pub jobs: Arc<dyn JobStore>,
    /// The queue beside them.
    pub queue: Arc<dyn Queue>,
    /// Classes.
    pub classroom: Arc<dyn ClassroomStore>,
}

impl Stores {
    fn of<S: JobStore + Queue + ClassroomStore + Clone>(store: S) -> Self {
        Self { jobs: Arc::new(store.clone()), queue: Arc::new(store.clone()), classroom: Arc::new(store) }
    }
}

/// Opens the database and brings it to this version. A database in the data folder belongs to one process at a time.
pub async fn connect(database: Option<&DatabaseUrl>, data: &Path) -> Result<Stores, StoreError> {
    Ok(match database {
        None => Stores::of(sqlite::open(&data.join("adaptarm.sqlite3")).await?),
        Some(database) => Stores::of(postgres::open(database.expose()).await?),
    })
}

/// Our tables, in a list of their own: the queue keeps its migrations where sqlx does by default.
fn migrations() -> Migrator {
    let mut migrations = sqlx::migrate!("./migrations");
    migrations.dangerous_set_table_name("adaptarm_migrations");
    migrations
}
