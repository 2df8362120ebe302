//! What is kept of a run: one number per metric and joint, never its samples.
//!
//! All metrics are better when smaller. A run that diverged or that no arm can do has none.

use crate::metrics::Metrics;
use crate::scenario::{OutcomeKind, Report};
use serde::{Deserialize, Serialize};

/// How joints make one number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Joints {
    /// Root of the mean square.
    Rms,
    /// The largest.
    Max,
    /// The sum.
    Sum,
}

/// Name of a metric, its numbers per joint, and how they make one.
type Entry = (&'static str, fn(&Metrics) -> Vec<Option<f64>>, Joints);

fn all(numbers: &[f64]) -> Vec<Option<f64>> {
    numbers.iter().copied().map(Some).collect()
}

/// Metrics in the order of their columns.
const METRICS: [Entry; 12] = [
    ("index_e_deg", |metrics| all(&metrics.index_e_deg), Joints::Rms),
    ("index_de_deg_s", |metrics| all(&metrics.index_de_deg_s), Joints::Rms),
    ("e_peak_deg", |metrics| all(&metrics.e_peak_deg), Joints::Max),
    ("z_peak_deg", |metrics| metrics.z_peak_deg.as_deref().map(all).unwrap_or_default(), Joints::Max),
    ("tau_peak_nm", |metrics| all(&metrics.tau_peak_nm), Joints::Max),
    ("voltage_peak_v", |metrics| all(&metrics.voltage_peak_v), Joints::Max),
    ("tau_rms_nm", |metrics| all(&metrics.tau_rms_nm), Joints::Rms),
    ("control_effort_n2m2s", |metrics| all(&metrics.control_effort_n2m2s), Joints::Sum),
    ("settling_e_s", |metrics| metrics.settling_e_s.clone(), Joints::Max),
    ("settling_de_s", |metrics| metrics.settling_de_s.clone(), Joints::Max),
    ("ultimate_bound_e_deg", |metrics| all(&metrics.ultimate_bound_e_deg), Joints::Max),
    ("tau_variation_nm_s", |metrics| all(&metrics.tau_variation_nm_s), Joints::Sum),
];

/// Columns of an experiment's results: each metric over all joints, then joint by joint.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ResultColumns {
    names: Vec<String>,
    joints: usize,
}

impl ResultColumns {
    /// For arms of at most so many joints.
    pub(crate) fn new(joints: usize) -> Self {
        let of_metric = |(name, _, _): &Entry| {
            let single = (1..=joints).map(move |joint| format!("{name}_{joint}"));
            std::iter::once((*name).to_owned()).chain(single).collect::<Vec<_>>()
        };
        Self { names: METRICS.iter().flat_map(of_metric).collect(), joints }
    }

    /// Their names: `index_e_deg` over all joints, `index_e_deg_1` of the first.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Place of a column.
    pub fn place(&self, name: &str) -> Option<usize> {
        self.names.iter().position(|column| column == name)
    }

    /// Places of the columns over all joints.
    pub fn overall(&self) -> impl Iterator<Item = usize> {
        (0..self.names.len()).step_by(self.joints + 1)
    }

    /// A number per column where there is one.
    pub(crate) fn of(&self, metrics: &Metrics) -> Vec<Option<f64>> {
        let mut row = Vec::with_capacity(self.names.len());
        for (_, numbers, joints) in &METRICS {
            let mut numbers = numbers(metrics);
            row.push(joints.fold(&numbers));
            numbers.resize(self.joints, None);
            row.append(&mut numbers);
        }
        row
    }
}

impl Joints {
    /// Of all joints; nothing if one has none.
    fn fold(self, numbers: &[Option<f64>]) -> Option<f64> {
        let numbers: Vec<_> = numbers.iter().copied().collect::<Option<_>>()?;
        if numbers.is_empty() {
            return None;
        }
        let count = numbers.len() as f64;
        Some(match self {
            Self::Rms => (numbers.iter().map(|x| x * x).sum::<f64>() / count).sqrt(),
            Self::Max => numbers.iter().fold(0.0, |most, x| x.max(most)),
            Self::Sum => numbers.iter().sum(),
        })
    }
}

/// How a run ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum RowOutcome {
    /// Reached its duration.
    Completed,
    /// Given up.
    Diverged,
    /// Not run: its values make a scenario that is not allowed.
    Refused,
}

/// What is kept of a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Row {
    /// Number of the run.
    pub index: u64,
    /// How it ended.
    pub outcome: RowOutcome,
    /// When it was given up, s.
    pub at_s: Option<f64>,
    /// Why it was refused.
    pub refusal: Option<String>,
    /// A number per column where there is one.
    pub metrics: Vec<Option<f64>>,
}

impl Row {
    /// Of a run that was made.
    pub(super) fn of(index: u64, columns: &ResultColumns, report: &Report) -> Self {
        let completed = report.outcome == OutcomeKind::Completed;
        let metrics = if completed { columns.of(&report.metrics) } else { vec![None; columns.names.len()] };
        let outcome = if completed { RowOutcome::Completed } else { RowOutcome::Diverged };
        Self { index, outcome, at_s: report.at_s, refusal: None, metrics }
    }

    /// Of a run that was not.
    pub(super) fn refused(index: u64, columns: &ResultColumns, why: String) -> Self {
        let metrics = vec![None; columns.names.len()];
        Self { index, outcome: RowOutcome::Refused, at_s: None, refusal: Some(why), metrics }
    }
}
