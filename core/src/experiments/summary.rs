//! What an experiment says so far: per base and condition the statistics of every metric and joint, what the fields do to
//! them, and bases against each other.
//!
//! A pure function of the rows that there are; partial results have a summary too.

use super::document::ExperimentKind;
use super::experiment::Experiment;
use super::layout::{Layout, Place};
use super::paired::{PairSummary, Ranking, compare};
use super::results::Results;
use super::row::{Row, RowOutcome};
use super::statistics::{Share, Statistics, rank_correlation};
use serde::{Deserialize, Serialize};

/// Summary of a sweep, a Monte Carlo study or a comparison.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Summary {
    /// `adaptarm.experiment_summary/1`.
    pub format: String,
    /// Version of the core that computed it.
    pub core_version: String,
    /// Hash of the experiment.
    pub experiment_hash: String,
    /// What was asked.
    pub kind: ExperimentKind,
    /// For people.
    pub title: String,
    /// Runs planned.
    pub runs: u64,
    /// Runs made so far, or refused.
    pub done: u64,
    /// Confidence of all intervals.
    pub confidence: f64,
    /// The first run that was refused and why.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub first_refusal: Option<Refusal>,
    /// Every base under every condition.
    pub groups: Vec<GroupSummary>,
    /// What the fields do.
    pub sensitivities: Vec<Sensitivity>,
    /// Bases against each other; empty with one base.
    pub pairs: Vec<PairSummary>,
    /// Bases by every metric; empty with one base.
    pub rankings: Vec<Ranking>,
}

/// A run that was refused.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Refusal {
    /// Number of the run.
    pub run: u64,
    /// Why.
    pub why: String,
}

/// A base under a condition.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct GroupSummary {
    /// Base.
    pub base: String,
    /// Condition.
    pub condition: String,
    /// Runs that reached their end.
    pub completed: usize,
    /// Runs refused: in no other number.
    pub refused: usize,
    /// Runs given up, of those made.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub diverged: Option<Share>,
    /// Every metric and joint, over the completed runs.
    pub metrics: Vec<MetricSummary>,
}

/// A metric over the completed runs of a group that have it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct MetricSummary {
    /// Column.
    pub metric: String,
    /// What its numbers say.
    #[serde(flatten)]
    pub statistics: Statistics,
    /// Point at which it is least.
    pub best_point: u64,
}

/// What a field does to a metric.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Sensitivity {
    /// Base.
    pub base: String,
    /// Condition.
    pub condition: String,
    /// Metric over all joints.
    pub metric: String,
    /// JSON pointer to the field.
    pub field: String,
    /// Spearman's rank correlation of field and metric.
    pub rank_correlation: f64,
}

impl Summary {
    /// Identifier of the format.
    pub const FORMAT: &'static str = "adaptarm.experiment_summary/1";

    /// Of the rows that there are; of a tuning it says nothing.
    pub fn of(experiment: &Experiment, results: &Results) -> Self {
        let document = experiment.document();
        let (pairs, rankings) = compare(experiment, results);
        let refusal = |row: &Row| Some(Refusal { run: row.index, why: row.refusal.clone()? });
        let (groups, sensitivities) =
            experiment.layout().map(|layout| groups(experiment, layout, results)).unwrap_or_default();
        Self {
            format: Self::FORMAT.to_owned(),
            core_version: crate::VERSION.to_owned(),
            experiment_hash: experiment.hash(),
            kind: document.kind,
            title: document.title.clone(),
            runs: experiment.runs().unwrap_or(0),
            done: results.len() as u64,
            confidence: document.confidence,
            first_refusal: results.rows().find_map(refusal),
            groups,
            sensitivities,
            pairs,
            rankings,
        }
    }
}

fn groups(experiment: &Experiment, layout: &Layout, results: &Results) -> (Vec<GroupSummary>, Vec<Sensitivity>) {
    let (mut groups, mut sensitivities) = (Vec::new(), Vec::new());
    for base in 0..layout.bases {
        for condition in 0..layout.conditions.len() {
            let rows: Vec<_> = (0..layout.points)
                .filter_map(|point| Some((point, results.row(layout.index(Place { point, condition, base }))?)))
                .collect();
            let group = group(experiment, layout, base, condition, &rows);
            sensitivities.extend(sensitivity(experiment, layout, &group, &rows));
            groups.push(group);
        }
    }
    (groups, sensitivities)
}

fn group(
    experiment: &Experiment,
    layout: &Layout,
    base: usize,
    condition: usize,
    rows: &[(u64, &Row)],
) -> GroupSummary {
    let confidence = experiment.document.confidence;
    let count = |outcome| rows.iter().filter(|(_, row)| row.outcome == outcome).count();
    let [completed, diverged, refused] = [RowOutcome::Completed, RowOutcome::Diverged, RowOutcome::Refused].map(count);
    let metric = |(column, name): (usize, &String)| {
        let values: Vec<_> = rows.iter().filter_map(|(_, row)| row.metrics[column]).collect();
        let statistics = Statistics::of(&values, confidence)?;
        let best = rows.iter().find(|(_, row)| row.metrics[column] == Some(statistics.min));
        Some(MetricSummary { metric: name.clone(), best_point: best.map_or(0, |(point, _)| *point), statistics })
    };
    GroupSummary {
        base: experiment.bases[base].name.clone(),
        condition: layout.conditions[condition].name.clone(),
        completed,
        refused,
        diverged: (completed + diverged > 0).then(|| Share::new(diverged, completed + diverged, confidence)),
        metrics: experiment.columns().names().iter().enumerate().filter_map(metric).collect(),
    }
}

/// Of every field and metric over all joints, from three completed runs on.
fn sensitivity(
    experiment: &Experiment,
    layout: &Layout,
    group: &GroupSummary,
    rows: &[(u64, &Row)],
) -> Vec<Sensitivity> {
    const FEWEST: usize = 3;
    let mut found = Vec::new();
    if group.completed < FEWEST || layout.fields.is_empty() {
        return found;
    }
    let values: Vec<_> = rows.iter().map(|(point, _)| experiment.values(*point)).collect();
    for column in experiment.columns().overall() {
        for (n, field) in layout.fields.iter().enumerate() {
            let (x, y): (Vec<_>, Vec<_>) = rows
                .iter()
                .zip(&values)
                .filter_map(|((_, row), values)| Some((values[n], row.metrics[column]?)))
                .unzip();
            if let Some(rank_correlation) = rank_correlation(&x, &y).filter(|_| x.len() >= FEWEST) {
                found.push(Sensitivity {
                    base: group.base.clone(),
                    condition: group.condition.clone(),
                    metric: experiment.columns().names()[column].clone(),
                    field: field.pointer.clone(),
                    rank_correlation,
                });
            }
        }
    }
    found
}
