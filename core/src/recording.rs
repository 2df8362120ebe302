//! Recordings: what a run leaves behind, one row per sample and one for its end, in SI units; and the hash over their bits.

use crate::scalar::{Scalar, are_finite};
use crate::spare;
use nalgebra::SVector;
use std::fmt::Write;

/// A recorded signal.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Signal {
    /// Tracking error `e = q − q_d`, rad.
    Error,
    /// Velocity error `ė = q̇ − q̇_d` of the true velocity, rad/s.
    ErrorRate,
    /// Observer error `z = q − q̂`, rad; means nothing where velocity is measured (see `Measured`).
    ObserverError,
    /// Torque τ, N·m.
    Torque,
    /// Joint angle q, rad.
    Position,
    /// Parameter estimates θ̂.
    ThetaHat,
    /// Sliding variable s, rad/s.
    SlidingVariable,
}

impl Signal {
    /// Every signal, in the order of a row.
    pub const ALL: [Self; 7] = [
        Self::Error,
        Self::ErrorRate,
        Self::ObserverError,
        Self::Torque,
        Self::Position,
        Self::ThetaHat,
        Self::SlidingVariable,
    ];

    /// Name of its columns in tables made for people, and what an SI value is multiplied by to get there.
    pub const fn exported(self) -> (&'static str, f64) {
        const DEGREES: f64 = 180.0 / std::f64::consts::PI;
        match self {
            Self::Error => ("e_deg", DEGREES),
            Self::ErrorRate => ("de_deg_s", DEGREES),
            Self::ObserverError => ("z_deg", DEGREES),
            Self::Torque => ("tau_nm", 1.0),
            Self::Position => ("q_rad", 1.0),
            Self::ThetaHat => ("theta_hat", 1.0),
            Self::SlidingVariable => ("s_rad_s", 1.0),
        }
    }
}

/// Writes a row without its time, in the order of [`Signal::ALL`]: e, ė, z, τ and q (N numbers each), θ̂, s (N numbers).
#[inline(always)]
pub(crate) fn write_row<T: Scalar, const N: usize>(
    row: &mut [T],
    before_theta_hat: &[SVector<T, N>; 5],
    theta_hat: &[T],
    sliding_variable: &SVector<T, N>,
) {
    let (joints, rest) = row.split_at_mut(before_theta_hat.len() * N);
    for (out, block) in joints.chunks_exact_mut(N).zip(before_theta_hat) {
        out.copy_from_slice(block.as_slice());
    }
    rest[..theta_hat.len()].copy_from_slice(theta_hat);
    rest[theta_hat.len()..].copy_from_slice(sliding_variable.as_slice());
}

/// Shape of a row: time, then each signal of [`Signal::ALL`] with its joints or parameters.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Columns {
    /// Joints.
    pub joints: usize,
    /// Parameters.
    pub parameters: usize,
}

impl Columns {
    /// Numbers in a row.
    pub const fn width(self) -> usize {
        1 + 6 * self.joints + self.parameters
    }

    /// How many columns a signal has.
    pub const fn count(self, signal: Signal) -> usize {
        if matches!(signal, Signal::ThetaHat) { self.parameters } else { self.joints }
    }

    /// First column of a signal.
    pub fn start(self, signal: Signal) -> usize {
        1 + Signal::ALL.iter().take_while(|s| **s != signal).map(|s| self.count(*s)).sum::<usize>()
    }

    /// Column names of the exported table, `t_s` first.
    pub fn names(self) -> Vec<String> {
        let mut names = vec!["t_s".to_owned()];
        for signal in Signal::ALL {
            names.extend((1..=self.count(signal)).map(|n| format!("{}_{n}", signal.exported().0)));
        }
        names
    }
}

/// A number that should have been recorded is not finite.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct NotFinite;

/// Samples of a run, row by row; a completed run has its end as one more row, which no index or peak counts.
#[derive(Debug, Clone, PartialEq)]
pub struct Recording {
    columns: Columns,
    rows: Vec<f64>,
}

impl Drop for Recording {
    fn drop(&mut self) {
        spare::give(std::mem::take(&mut self.rows));
    }
}

impl Recording {
    /// Empty, with room for `samples` rows.
    pub fn with_capacity(columns: Columns, samples: usize) -> Self {
        Self { columns, rows: spare::take(columns.width() * samples) }
    }

    /// From rows as [`Recording::rows`] gives them; `None` where they end in the middle of a row.
    pub fn from_rows(columns: Columns, rows: Vec<f64>) -> Option<Self> {
        rows.len().is_multiple_of(columns.width()).then_some(Self { columns, rows })
    }

    /// Adds a row that `observe` fills behind its time; a row with a number that is not finite is refused.
    pub(crate) fn push(&mut self, time_s: f64, observe: impl FnOnce(&mut [f64])) -> Result<(), NotFinite> {
        let start = self.rows.len();
        self.rows.resize(start + self.columns.width(), 0.0);
        self.rows[start] = time_s;
        observe(&mut self.rows[start + 1..]);
        if are_finite(&self.rows[start..]) {
            Ok(())
        } else {
            self.rows.truncate(start);
            Err(NotFinite)
        }
    }

    /// Adds a row of numbers that are finite, behind its time.
    pub(crate) fn push_finite(&mut self, time_s: f64, row: &[f64]) {
        self.rows.push(time_s);
        self.rows.extend_from_slice(row);
    }

    /// Shape of the rows.
    pub fn columns(&self) -> Columns {
        self.columns
    }

    /// All rows, one after another, SI units.
    pub fn rows(&self) -> &[f64] {
        &self.rows
    }

    /// All rows, given away.
    pub(crate) fn into_rows(mut self) -> Vec<f64> {
        std::mem::take(&mut self.rows)
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.rows.len() / self.columns.width()
    }

    /// Whether nothing was recorded.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// Sample times, s.
    pub fn times_s(&self) -> impl DoubleEndedIterator<Item = f64> + ExactSizeIterator + Clone + '_ {
        self.column(0)
    }

    /// One component of a signal (0 is the first), SI units.
    pub fn signal(
        &self,
        signal: Signal,
        component: usize,
    ) -> impl DoubleEndedIterator<Item = f64> + ExactSizeIterator + Clone + '_ {
        self.column(self.columns.start(signal) + component)
    }

    fn column(&self, column: usize) -> impl DoubleEndedIterator<Item = f64> + ExactSizeIterator + Clone + '_ {
        self.rows.chunks_exact(self.columns.width()).map(move |row| row[column])
    }

    /// Hash over the bits of every sample (little-endian, row by row): equal hashes mean equal trajectories.
    pub fn hash(&self) -> String {
        // BLAKE3 hashes many of its 1024-byte chunks side by side where whole ones arrive together: what is said first, too,
        // must not shift them.
        const AT_ONCE: usize = 1 << 16;
        let mut hasher = blake3::Hasher::new();
        let mut bytes = Vec::with_capacity(AT_ONCE + 8);
        bytes.extend_from_slice(b"adaptarm.trajectory/1");
        bytes.extend_from_slice(&(self.columns.joints as u64).to_le_bytes());
        bytes.extend_from_slice(&(self.columns.parameters as u64).to_le_bytes());
        let mut rest = self.rows.as_slice();
        while !rest.is_empty() {
            let missing = (AT_ONCE - bytes.len()).div_ceil(8);
            let (numbers, after) = rest.split_at(missing.min(rest.len()));
            let start = bytes.len();
            bytes.resize(start + 8 * numbers.len(), 0);
            for (bytes, number) in bytes[start..].chunks_exact_mut(8).zip(numbers) {
                bytes.copy_from_slice(&number.to_le_bytes());
            }
            rest = after;
            if bytes.len() >= AT_ONCE {
                hasher.update(&bytes[..AT_ONCE]);
                bytes.drain(..AT_ONCE);
            }
        }
        hasher.update(&bytes);
        hasher.finalize().to_hex().to_string()
    }

    /// Comma-separated table with a header, in the units of [`Signal::exported`]; every number reads back exactly.
    pub fn to_csv(&self) -> String {
        let names = self.columns.names();
        let mut scale = vec![1.0];
        for signal in Signal::ALL {
            scale.extend(std::iter::repeat_n(signal.exported().1, self.columns.count(signal)));
        }
        let mut csv = names.join(",");
        csv.push('\n');
        for row in self.rows.chunks_exact(self.columns.width()) {
            for (column, (number, scale)) in row.iter().zip(&scale).enumerate() {
                let separator = if column == 0 { "" } else { "," };
                // Writing to a string cannot fail.
                let _ = write!(csv, "{separator}{:?}", number * scale);
            }
            csv.push('\n');
        }
        csv
    }
}
