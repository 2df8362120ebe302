//! A run as figures see it, and the quantities that can be read off its rows.

use super::style::Rgb;
use crate::decomposition::TorqueParts;
use crate::diagnostics::{Trace, Traced};
use crate::recording::Recording;
use crate::scenario::Scheme;
use std::ops::Range;

/// A run to be plotted.
#[derive(Debug, Clone, Copy)]
pub struct PlottedRun<'a> {
    /// Its scheme, which decides colour, dash and name.
    pub scheme: Scheme,
    /// Its samples.
    pub recording: &'a Recording,
    /// Whether it reached its duration; the last values of a diverged run must not decide a panel's range.
    pub completed: bool,
    /// True parameters of its arm; none are drawn if it is empty.
    pub theta_true: &'a [f64],
    /// Its torques, split; needed by the figure that shows them and by no other.
    pub parts: Option<&'a TorqueParts>,
    /// Curves of its diagnostics; needed by the figures that show them and by no other.
    pub trace: Option<&'a Trace>,
    /// Name in the legend; the scheme's own without.
    pub label: Option<&'a str>,
    /// Drawn lighter, thinner and below the others: a run to compare with.
    pub faded: bool,
    /// Colour instead of the scheme's.
    pub color: Option<Rgb>,
}

/// A quantity of a sample, in the unit of its label.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Quantity {
    /// A column of the recording times a factor.
    Column { column: usize, factor: f64 },
    /// One column minus another, times a factor.
    Difference { of: usize, minus: usize, factor: f64 },
    /// Root mean square of the relative parameter errors; `first` is the first estimate's column.
    ParameterError { first: usize },
    /// A part of a joint's torque.
    Part { joint: usize, part: usize },
    /// A curve of the diagnostics.
    Traced(Traced),
}

impl<'a> PlottedRun<'a> {
    /// A live run with its scheme's own look.
    pub fn new(scheme: Scheme, recording: &'a Recording, completed: bool, theta_true: &'a [f64]) -> Self {
        Self { scheme, recording, completed, theta_true, parts: None, trace: None, label: None, faded: false, color: None }
    }

    /// Its name in legends.
    pub(super) fn name(&self) -> &'a str {
        self.label.unwrap_or(self.scheme.name())
    }

    /// Time of a row, s.
    pub(super) fn time_s(&self, row: usize) -> f64 {
        self.recording.rows()[row * self.recording.columns().width()]
    }

    /// Time of the last row, s.
    pub(super) fn end_s(&self) -> Option<f64> {
        self.recording.len().checked_sub(1).map(|last| self.time_s(last))
    }

    /// First row at or after a time.
    fn row_from(&self, time_s: f64) -> usize {
        let (mut low, mut high) = (0, self.recording.len());
        while low < high {
            let middle = usize::midpoint(low, high);
            if self.time_s(middle) < time_s { low = middle + 1 } else { high = middle }
        }
        low
    }

    /// Rows within a window of time.
    pub(super) fn rows_within(&self, (from_s, to_s): (f64, f64)) -> Range<usize> {
        let first = self.row_from(from_s);
        let mut end = self.row_from(to_s);
        if end < self.recording.len() && self.time_s(end) == to_s {
            end += 1;
        }
        first..end.max(first)
    }

    /// Rows within a window and one more on either side, so that lines run to the window's edge.
    pub(super) fn rows_about(&self, window: (f64, f64)) -> Range<usize> {
        let Range { start, end } = self.rows_within(window);
        start.saturating_sub(1)..(end + 1).min(self.recording.len())
    }

    /// The row whose time is nearest.
    pub(super) fn nearest_row(&self, time_s: f64) -> Option<usize> {
        let after = self.row_from(time_s).min(self.recording.len().checked_sub(1)?);
        let before = after.saturating_sub(1);
        let is_before = (time_s - self.time_s(before)).abs() <= (self.time_s(after) - time_s).abs();
        Some(if is_before { before } else { after })
    }

    /// Calls `each` with time and value of every one of the rows. The choice of quantity is made once, not per row.
    pub(super) fn visit(&self, quantity: Quantity, rows: Range<usize>, mut each: impl FnMut(f64, f64)) {
        let width = self.recording.columns().width();
        let samples = self.recording.rows()[rows.start * width..rows.end * width].chunks_exact(width);
        match quantity {
            Quantity::Column { column, factor } => samples.for_each(|row| each(row[0], row[column] * factor)),
            Quantity::Difference { of, minus, factor } => {
                samples.for_each(|row| each(row[0], (row[of] - row[minus]) * factor));
            }
            Quantity::ParameterError { first } => {
                samples.for_each(|row| each(row[0], relative_error(&row[first..], self.theta_true)));
            }
            Quantity::Traced(traced) => {
                if let Some(trace) = self.trace.filter(|trace| trace.len() >= rows.end) {
                    samples.zip(rows).for_each(|(row, sample)| each(row[0], trace.at(traced, sample)));
                }
            }
            Quantity::Part { joint, part } => {
                if let Some(parts) = self.parts.filter(|parts| parts.len() >= rows.end) {
                    samples.zip(rows).for_each(|(row, sample)| each(row[0], parts.at(sample, joint)[part]));
                }
            }
        }
    }

    /// Value of one row.
    pub(super) fn value(&self, quantity: Quantity, row: usize) -> Option<f64> {
        let mut found = None;
        self.visit(quantity, row..row + 1, |_, value| found = Some(value));
        found.filter(|value| value.is_finite())
    }
}

/// Root mean square of `(θ̂k − θk) / θk`; not a number without true values.
fn relative_error(estimates: &[f64], truth: &[f64]) -> f64 {
    let sum: f64 = estimates.iter().zip(truth).map(|(estimate, truth)| (estimate - truth) / truth).map(|x| x * x).sum();
    (sum / truth.len() as f64).sqrt()
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::recording::Columns;

    /// A recording of one joint and no parameters whose error is `f(t)` at `count` times from 0, `step` apart.
    pub fn recording(count: usize, step: f64, f: impl Fn(f64) -> f64) -> Recording {
        let columns = Columns { joints: 1, parameters: 0 };
        let rows = (0..count).flat_map(|n| {
            let t = n as f64 * step;
            [t, f(t), 0.0, 0.0, 0.0, 0.0, 0.0]
        });
        Recording::from_rows(columns, rows.collect()).unwrap()
    }

    pub const ERROR: Quantity = Quantity::Column { column: 1, factor: 1.0 };

    #[test]
    fn rows_of_a_window_and_their_neighbours() {
        let recording = recording(11, 1.0, |t| 10.0 * t);
        let run = PlottedRun::new(Scheme::Proposed, &recording, true, &[]);
        assert_eq!(run.rows_within((2.5, 5.0)), 3..6);
        assert_eq!(run.rows_about((2.5, 5.0)), 2..7);
        assert_eq!(run.rows_about((-1.0, 99.0)), 0..11);
        assert_eq!(run.rows_within((3.1, 3.2)), 4..4);
        assert_eq!(run.rows_about((3.1, 3.2)), 3..5, "a window between two samples shows the line between them");
        assert_eq!([-5.0, 2.4, 2.6, 50.0].map(|t| run.nearest_row(t)), [Some(0), Some(2), Some(3), Some(10)]);
        assert_eq!(run.value(ERROR, 3), Some(30.0));
        assert_eq!(run.value(Quantity::Part { joint: 0, part: 0 }, 3), None);
    }

    #[test]
    fn relative_errors_are_one_where_nothing_is_known() {
        assert_eq!(relative_error(&[0.0, 0.0], &[0.001, 25.0]), 1.0);
        assert_eq!(relative_error(&[0.001, 25.0], &[0.001, 25.0]), 0.0);
        assert!((relative_error(&[0.003, 25.0], &[0.001, 25.0]) - 2.0_f64.sqrt()).abs() < 1e-12);
        assert!(relative_error(&[1.0], &[]).is_nan());
    }
}
