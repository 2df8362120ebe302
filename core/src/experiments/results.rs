//! The rows of an experiment, folded in any order and in any parts: what they say depends on which there are, not on how they
//! came.

use super::experiment::Experiment;
use super::row::{Row, RowOutcome};
use super::row_store::{InMemory, RowStore, RowStoreError};
use thiserror::Error;

/// Rows by the number of their run, kept by a [`RowStore`]; here is a byte per run.
#[derive(Debug)]
pub struct Results {
    store: Box<dyn RowStore>,
    outcomes: Vec<Option<RowOutcome>>,
    count: usize,
}

/// The numbers of one column by run.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ResultColumn(Vec<Option<f64>>);

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
    /// Rows could not be kept.
    #[error(transparent)]
    Store(#[from] RowStoreError),
}

impl Default for Results {
    fn default() -> Self {
        Self { store: Box::new(InMemory::default()), outcomes: Vec::new(), count: 0 }
    }
}

impl Results {
    /// None yet, to be kept in memory.
    pub fn new() -> Self {
        Self::default()
    }

    /// The rows of a store, and those that will come.
    pub fn kept_in(store: impl RowStore + 'static) -> Result<Self, RowStoreError> {
        let outcomes = store.outcomes()?;
        let count = outcomes.iter().flatten().count();
        Ok(Self { store: Box::new(store), outcomes, count })
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
        if self.outcome(index).is_some() {
            return if self.row(index)? == Some(row) { Ok(()) } else { Err(FoldError::Differs { index }) };
        }
        let (place, outcome) = (index as usize, row.outcome);
        self.store.put(row)?;
        if self.outcomes.len() <= place {
            self.outcomes.resize(place + 1, None);
        }
        self.outcomes[place] = Some(outcome);
        self.count += 1;
        Ok(())
    }

    /// Takes in the rows of another part.
    pub fn merge(&mut self, experiment: &Experiment, other: &Self) -> Result<(), FoldError> {
        other.rows().try_for_each(|row| self.insert(experiment, row?))
    }

    /// How a run ended; `None` if it has not.
    pub fn outcome(&self, index: u64) -> Option<RowOutcome> {
        self.outcomes.get(index as usize).copied().flatten()
    }

    /// Runs that have a row, with how they ended, by number.
    pub fn outcomes(&self) -> impl Iterator<Item = (u64, RowOutcome)> {
        self.outcomes.iter().enumerate().filter_map(|(index, outcome)| Some((index as u64, (*outcome)?)))
    }

    /// The row of a run.
    pub fn row(&self, index: u64) -> Result<Option<Row>, RowStoreError> {
        if self.outcome(index).is_some() { self.store.row(index) } else { Ok(None) }
    }

    /// All rows, by number.
    pub fn rows(&self) -> impl Iterator<Item = Result<Row, RowStoreError>> {
        let missing = |index| RowStoreError(format!("run {index} is gone"));
        self.outcomes().map(move |(index, _)| self.store.row(index)?.ok_or_else(|| missing(index)))
    }

    /// One column of all rows.
    pub(crate) fn column(&self, column: usize) -> Result<ResultColumn, RowStoreError> {
        let mut numbers = self.store.column(column)?;
        // What a store has of a run without a row is none of ours.
        numbers.truncate(self.outcomes.len());
        numbers.iter_mut().zip(&self.outcomes).filter(|(_, outcome)| outcome.is_none()).for_each(|(it, _)| *it = None);
        Ok(ResultColumn(numbers))
    }

    /// The numbers of one column, in the order of [`Self::outcomes`].
    pub fn numbers(&self, column: usize) -> Result<Vec<Option<f64>>, RowStoreError> {
        let numbers = self.column(column)?;
        Ok(self.outcomes().map(|(index, _)| numbers.of(index)).collect())
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.count
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }
}

impl ResultColumn {
    /// The number of a run, if it has one.
    pub(crate) fn of(&self, index: u64) -> Option<f64> {
        self.0.get(index as usize).copied().flatten()
    }
}
