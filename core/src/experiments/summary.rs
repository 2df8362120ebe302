//! What an experiment says so far: per base and condition the statistics of every metric and joint, what the fields do to
//! them, and bases against each other.
//!
//! A pure function of the rows that there are; partial results have a summary too.

use super::document::ExperimentKind;
use super::experiment::Experiment;
use super::layout::{Layout, Place};
use super::paired::{PairSummary, Ranking, compare};
use super::results::{ResultColumn, Results};
use super::row::RowOutcome;
use super::row_store::RowStoreError;
use super::statistics::{Share, Statistics, rank_correlation};
use serde::{Deserialize, Serialize};

/// Fields whose values at all points are held at a time.
const FIELDS_AT_ONCE: usize = 8;

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

    /// Of the rows that there are; of a tuning it says nothing. Holds a few columns at a time.
    pub fn of(experiment: &Experiment, results: &Results) -> Result<Self, RowStoreError> {
        let document = experiment.document();
        let (pairs, rankings) = compare(experiment, results)?;
        let groups = experiment.layout().map_or(Ok(Vec::new()), |layout| groups(experiment, layout, results))?;
        let sensitivities =
            experiment.layout().map_or(Ok(Vec::new()), |layout| sensitivities(experiment, layout, &groups, results))?;
        Ok(Self {
            format: Self::FORMAT.to_owned(),
            core_version: crate::VERSION.to_owned(),
            experiment_hash: experiment.hash(),
            kind: document.kind,
            title: document.title.clone(),
            runs: experiment.runs().unwrap_or(0),
            done: results.len() as u64,
            confidence: document.confidence,
            first_refusal: first_refusal(results)?,
            groups,
            sensitivities,
            pairs,
            rankings,
        })
    }
}

fn first_refusal(results: &Results) -> Result<Option<Refusal>, RowStoreError> {
    let Some((run, _)) = results.outcomes().find(|(_, outcome)| *outcome == RowOutcome::Refused) else {
        return Ok(None);
    };
    Ok(results.row(run)?.and_then(|row| Some(Refusal { run, why: row.refusal? })))
}

/// Runs of a base under a condition, with their points.
fn members(layout: &Layout, group: usize) -> impl Iterator<Item = (u64, u64)> {
    let (base, condition) = (group / layout.conditions.len(), group % layout.conditions.len());
    (0..layout.points).map(move |point| (point, layout.index(Place { point, condition, base })))
}

fn groups(experiment: &Experiment, layout: &Layout, results: &Results) -> Result<Vec<GroupSummary>, RowStoreError> {
    let count = layout.bases * layout.conditions.len();
    let mut groups: Vec<_> = (0..count).map(|group| ends(experiment, layout, group, results)).collect();
    for (column, name) in experiment.columns().names().iter().enumerate() {
        let numbers = results.column(column)?;
        for (n, group) in groups.iter_mut().enumerate() {
            group.metrics.extend(metric(experiment, name, &numbers, members(layout, n)));
        }
    }
    Ok(groups)
}

/// How the runs of a group ended, before anything is said of their metrics.
fn ends(experiment: &Experiment, layout: &Layout, group: usize, results: &Results) -> GroupSummary {
    let count = |outcome| members(layout, group).filter(|(_, index)| results.outcome(*index) == Some(outcome)).count();
    let [completed, diverged, refused] = [RowOutcome::Completed, RowOutcome::Diverged, RowOutcome::Refused].map(count);
    let made = completed + diverged;
    GroupSummary {
        base: experiment.bases[group / layout.conditions.len()].name.clone(),
        condition: layout.conditions[group % layout.conditions.len()].name.clone(),
        completed,
        refused,
        diverged: (made > 0).then(|| Share::new(diverged, made, experiment.document.confidence)),
        metrics: Vec::new(),
    }
}

fn metric(
    experiment: &Experiment,
    name: &str,
    numbers: &ResultColumn,
    members: impl Iterator<Item = (u64, u64)>,
) -> Option<MetricSummary> {
    let (points, values): (Vec<_>, Vec<_>) =
        members.filter_map(|(point, index)| Some((point, numbers.of(index)?))).unzip();
    let statistics = Statistics::of(&values, experiment.document.confidence)?;
    let best = values.iter().position(|value| *value == statistics.min);
    Some(MetricSummary { metric: name.to_owned(), best_point: best.map_or(0, |n| points[n]), statistics })
}

/// Of every field and metric over all joints, in groups of three completed runs or more.
fn sensitivities(
    experiment: &Experiment,
    layout: &Layout,
    groups: &[GroupSummary],
    results: &Results,
) -> Result<Vec<Sensitivity>, RowStoreError> {
    const FEWEST: usize = 3;
    let told: Vec<_> = (0..groups.len()).filter(|group| groups[*group].completed >= FEWEST).collect();
    if told.is_empty() {
        return Ok(Vec::new());
    }
    let mut found = Vec::new();
    let fields: Vec<_> = (0..layout.fields.len()).collect();
    for some in fields.chunks(FIELDS_AT_ONCE) {
        let mut values = vec![Vec::with_capacity(layout.points as usize); some.len()];
        for point in 0..layout.points {
            let all = experiment.values(point);
            values.iter_mut().zip(some).for_each(|(values, field)| values.push(all[*field]));
        }
        for column in experiment.columns().overall() {
            let numbers = results.column(column)?;
            for &group in &told {
                for (values, &field) in values.iter().zip(some) {
                    let pairs =
                        members(layout, group).filter_map(|(at, run)| Some((values[at as usize], numbers.of(run)?)));
                    let (x, y): (Vec<_>, Vec<_>) = pairs.unzip();
                    if let Some(correlation) = rank_correlation(&x, &y).filter(|_| x.len() >= FEWEST) {
                        found.push(([group, column, field], correlation));
                    }
                }
            }
        }
    }
    found.sort_by_key(|(place, _)| *place);
    let tell = |([group, column, field], rank_correlation): ([usize; 3], f64)| Sensitivity {
        base: groups[group].base.clone(),
        condition: groups[group].condition.clone(),
        metric: experiment.columns().names()[column].clone(),
        field: layout.fields[field].pointer.clone(),
        rank_correlation,
    };
    Ok(found.into_iter().map(tell).collect())
}
