//! The rows of an experiment, folded in any order and in any parts: what they say depends on which there are, not on how they
//! came.

use super::experiment::Experiment;
use super::row::Row;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use thiserror::Error;

/// Rows by the number of their run. Grows by one row per run and keeps no samples.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Results {
    rows: BTreeMap<u64, Row>,
}

/// A row that cannot belong to the results.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum FoldError {
    /// No such run.
    #[error("there is no run {index}; the experiment has {runs}")]
    NoSuchRun {
        /// Number given.
        index: u64,
        /// Runs that there are.
        runs: u64,
    },
    /// As many numbers as no row of this experiment has.
    #[error("the row of run {index} has {found} numbers where {expected} are needed")]
    Shape {
        /// Number of the run.
        index: u64,
        /// Numbers found.
        found: usize,
        /// Numbers needed.
        expected: usize,
    },
    /// The same run came twice with different numbers, which the same program never computes.
    #[error("run {index} came twice, with different results")]
    Differs {
        /// Number of the run.
        index: u64,
    },
}

impl Results {
    /// None yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Takes a row in; the same row twice is no mistake.
    pub fn insert(&mut self, experiment: &Experiment, row: Row) -> Result<(), FoldError> {
        let runs = experiment.runs().unwrap_or(0);
        if row.index >= runs {
            return Err(FoldError::NoSuchRun { index: row.index, runs });
        }
        let (index, found, expected) = (row.index, row.metrics.len(), experiment.columns().names().len());
        if found != expected {
            return Err(FoldError::Shape { index, found, expected });
        }
        match self.rows.insert(index, row) {
            Some(earlier) if earlier != self.rows[&index] => Err(FoldError::Differs { index }),
            _ => Ok(()),
        }
    }

    /// Takes in the rows of another part.
    pub fn merge(&mut self, experiment: &Experiment, other: Self) -> Result<(), FoldError> {
        other.rows.into_values().try_for_each(|row| self.insert(experiment, row))
    }

    /// The row of a run.
    pub fn row(&self, index: u64) -> Option<&Row> {
        self.rows.get(&index)
    }

    /// All rows, by number.
    pub fn rows(&self) -> impl ExactSizeIterator<Item = &Row> {
        self.rows.values()
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }
}
