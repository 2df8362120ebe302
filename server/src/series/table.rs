//! What people get of a recording: some of its columns and rows, in the units of [`Signal::exported`].
//!
//! Every format is written from this one view, so that all of them carry the same doubles.

use super::selection::{Selection, SelectionError};
use adaptarm_core::recording::{Columns, Recording, Signal};
use std::sync::Arc;

/// A view of a recording. Holds the recording, not a copy of its numbers.
#[derive(Debug, Clone)]
pub struct Table {
    recording: Arc<Recording>,
    names: Vec<String>,
    /// Per column: its place in a row, and the factor from SI to its unit.
    columns: Vec<(usize, f64)>,
    every: usize,
}

impl Table {
    /// The selected part of a recording; an error names a column that it does not have.
    pub fn new(recording: Arc<Recording>, selection: &Selection) -> Result<Self, SelectionError> {
        let shape = recording.columns();
        let (names, scales, places) = (shape.names(), scales(shape), selection.places(shape)?);
        Ok(Self {
            recording,
            names: places.iter().map(|place| names[*place].clone()).collect(),
            columns: places.iter().map(|place| (*place, scales[*place])).collect(),
            every: selection.every(),
        })
    }

    /// Names of the columns.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Number of rows: those that are kept, and the last one in any case.
    pub fn row_count(&self) -> usize {
        let last = self.recording.len().checked_sub(1);
        last.map_or(0, |last| last.div_ceil(self.every) + 1)
    }

    /// One row, column by column. `row` is below [`Table::row_count`].
    pub fn row(&self, row: usize) -> impl Iterator<Item = f64> + '_ {
        let row = self.recorded(row);
        self.columns.iter().map(move |(place, scale)| row[*place] * scale)
    }

    /// One column, row by row. `column` is below the number of names.
    pub fn column(&self, column: usize) -> impl ExactSizeIterator<Item = f64> + '_ {
        let (place, scale) = self.columns[column];
        (0..self.row_count()).map(move |row| self.recorded(row)[place] * scale)
    }

    fn recorded(&self, row: usize) -> &[f64] {
        let width = self.recording.columns().width();
        let row = (row * self.every).min(self.recording.len() - 1);
        &self.recording.rows()[row * width..][..width]
    }
}

/// Factor from SI to the exported unit, per entry of a row.
fn scales(shape: Columns) -> Vec<f64> {
    let mut scales = vec![1.0];
    for signal in Signal::ALL {
        scales.extend(std::iter::repeat_n(signal.exported().1, shape.count(signal)));
    }
    scales
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::series::csv;

    /// Rows of numbers with all their digits in use, and some that formats like to get wrong.
    pub fn recording(rows: usize) -> Arc<Recording> {
        let columns = Columns { joints: 3, parameters: 18 };
        let mut numbers: Vec<_> = (0..rows * columns.width()).map(|n| (n as f64 + 0.5).sin()).collect();
        for (number, special) in numbers.iter_mut().zip([0.0, -0.0, 5e-324, -1.5e300, 1.0, 0.1, f64::MIN_POSITIVE]) {
            *number = special;
        }
        Arc::new(Recording::from_rows(columns, numbers).unwrap())
    }

    /// Whether these columns are, to the bit, what the table's CSV says.
    pub fn same_as_csv(table: &Table, names: &[String], columns: &[Vec<f64>]) {
        let text: String = (0..csv::piece_count(table)).map(|n| csv::piece(table, n)).collect();
        let mut lines = text.lines();
        assert_eq!(lines.next().unwrap(), names.join(","));
        assert_eq!(columns.len(), names.len());
        let mut count = 0;
        for line in lines {
            for (text, column) in line.split(',').zip(columns) {
                assert_eq!(text.parse::<f64>().unwrap().to_bits(), column[count].to_bits(), "row {count}");
            }
            count += 1;
        }
        assert!(columns.iter().all(|column| column.len() == count), "{count} lines");
    }

    fn times(rows: usize, every: &str) -> Vec<usize> {
        let numbers = (0..rows * 25).map(|n| (n / 25) as f64).collect();
        let recording = Recording::from_rows(Columns { joints: 3, parameters: 6 }, numbers).unwrap();
        let selection = Selection::parse(Some("t_s"), Some(every)).unwrap();
        let table = Table::new(Arc::new(recording), &selection).unwrap();
        assert_eq!(table.column(0).len(), table.row_count());
        (0..table.row_count()).map(|row| table.row(row).next().unwrap() as usize).collect()
    }

    #[test]
    fn keeps_every_kth_row_and_the_last() {
        assert_eq!(times(0, "3"), [0; 0]);
        assert_eq!(times(1, "3"), [0]);
        assert_eq!(times(3, "1"), [0, 1, 2]);
        assert_eq!(times(7, "3"), [0, 3, 6]);
        assert_eq!(times(8, "3"), [0, 3, 6, 7]);
        assert_eq!(times(5, "1000000"), [0, 4]);
    }

    #[test]
    fn columns_and_rows_are_one_table() {
        let selection = Selection::parse(Some("q_rad_2,z_deg_1,theta_hat_18"), Some("4")).unwrap();
        let table = Table::new(recording(30), &selection).unwrap();
        assert_eq!(table.names(), ["q_rad_2", "z_deg_1", "theta_hat_18"]);
        for column in 0..3 {
            let down: Vec<_> = table.column(column).collect();
            let across: Vec<_> = (0..table.row_count()).map(|row| table.row(row).nth(column).unwrap()).collect();
            assert_eq!(down, across);
        }
    }
}
