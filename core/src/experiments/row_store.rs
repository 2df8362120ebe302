//! Where the rows of an experiment are kept: in memory here, or wherever a program keeps them.
//!
//! Memory need not grow with the number of runs: everything that is said of them is computed column by column, and a column
//! is a number per run.

use super::row::{Row, RowOutcome};
use std::collections::BTreeMap;
use std::fmt::Debug;
use thiserror::Error;

/// Rows could not be kept or read.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("the rows of the experiment cannot be kept or read: {0}")]
pub struct RowStoreError(pub String);

/// Keeps at most one row per run, whose numbers come back to the bit.
pub trait RowStore: Debug + Send + Sync {
    /// How each run ended, by number; runs beyond the last one and `None` have no row.
    fn outcomes(&self) -> Result<Vec<Option<RowOutcome>>, RowStoreError>;

    /// Keeps the row of a run that has none.
    fn put(&mut self, row: Row) -> Result<(), RowStoreError>;

    /// The row of a run.
    fn row(&self, index: u64) -> Result<Option<Row>, RowStoreError>;

    /// The numbers of one column, by run; runs beyond the last one have no row.
    fn column(&self, column: usize) -> Result<Vec<Option<f64>>, RowStoreError>;
}

/// Rows in memory.
#[derive(Debug, Clone, Default)]
pub(super) struct InMemory(BTreeMap<u64, Row>);

impl InMemory {
    /// A value per run up to the last one that has a row.
    fn each<T>(&self, value: impl Fn(&Row) -> Option<T>) -> Vec<Option<T>> {
        let length = self.0.last_key_value().map_or(0, |(index, _)| index + 1);
        (0..length).map(|index| self.0.get(&index).and_then(&value)).collect()
    }
}

impl RowStore for InMemory {
    fn outcomes(&self) -> Result<Vec<Option<RowOutcome>>, RowStoreError> {
        Ok(self.each(|row| Some(row.outcome)))
    }

    fn put(&mut self, row: Row) -> Result<(), RowStoreError> {
        self.0.insert(row.index, row);
        Ok(())
    }

    fn row(&self, index: u64) -> Result<Option<Row>, RowStoreError> {
        Ok(self.0.get(&index).cloned())
    }

    fn column(&self, column: usize) -> Result<Vec<Option<f64>>, RowStoreError> {
        Ok(self.each(|row| row.metrics.get(column).copied().flatten()))
    }
}
