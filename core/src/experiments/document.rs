//! The experiment document `adaptarm.experiment/1`, as it is written and read. Fields are stable: add, never rename.
//!
//! Only shapes and defaults live here; what is allowed is decided in `resolve`. A field of a scenario is named by its JSON
//! pointer; `*` at its end stands for every element of a list.

use super::distribution::DistributionDocument;
use crate::scenario::ScenarioDocument;
use serde::{Deserialize, Serialize};

/// The format that this version reads and writes.
pub const EXPERIMENT_FORMAT: &str = "adaptarm.experiment/1";

/// An experiment as written. The section called as its kind, and no other, is there.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct ExperimentDocument {
    /// `adaptarm.experiment/1`.
    pub format: String,
    /// What is asked.
    pub kind: ExperimentKind,
    /// For people.
    #[serde(default)]
    pub title: String,
    /// Seed of everything random in the experiment.
    #[serde(default)]
    pub seed: u64,
    /// Confidence of all intervals.
    #[serde(default = "default_confidence")]
    pub confidence: f64,
    /// Scenarios that everything starts from; several are compared under the same random numbers.
    pub bases: Vec<BaseDocument>,
    /// Where the fields of a scenario are tried systematically.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sweep: Option<SweepDocument>,
    /// Where they are random.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub monte_carlo: Option<MonteCarloDocument>,
    /// Where schemes meet conditions.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub compare: Option<CompareDocument>,
    /// Where the best values are searched.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tuning: Option<TuningDocument>,
}

fn default_confidence() -> f64 {
    0.95
}

/// Kind of an experiment.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum ExperimentKind {
    /// Fields tried systematically.
    Sweep,
    /// Fields at random.
    MonteCarlo,
    /// Schemes against conditions.
    Compare,
    /// Search for the best values.
    Tuning,
}

/// A scenario with a name.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct BaseDocument {
    /// How tables and figures call it.
    pub name: String,
    /// The scenario.
    pub scenario: ScenarioDocument,
}

/// A sweep.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct SweepDocument {
    /// How the points are laid.
    pub design: SweepDesign,
    /// Number of points of a Latin hypercube or a Sobol sequence; a grid has one for each combination.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub points: Option<u32>,
    /// What varies.
    pub axes: Vec<AxisDocument>,
}

/// How the points of a sweep are laid.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum SweepDesign {
    /// Every combination of the axes' values.
    Grid,
    /// Each of N parts of every axis once.
    LatinHypercube,
    /// Sobol's sequence.
    Sobol,
}

/// A field that a sweep varies: its `values`, or a range (with `points` values on a grid).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct AxisDocument {
    /// JSON pointer into the scenario.
    pub field: String,
    /// Values on a grid.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub values: Option<Vec<f64>>,
    /// Least value.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub min: Option<f64>,
    /// Greatest value.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max: Option<f64>,
    /// Number of values on a grid.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub points: Option<u32>,
    /// Whether the range is evenly covered in the logarithm.
    #[serde(default)]
    pub log: bool,
    /// Whether values are factors on what the base says.
    #[serde(default)]
    pub relative: bool,
}

/// A field with a distribution.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct RandomFieldDocument {
    /// JSON pointer into the scenario; `*` at its end: each element on its own.
    pub field: String,
    /// Its distribution.
    pub distribution: DistributionDocument,
    /// Whether values are factors on what the base says.
    #[serde(default)]
    pub relative: bool,
}

/// A Monte Carlo study.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct MonteCarloDocument {
    /// Draws; each is run with every base.
    pub draws: u32,
    /// What is random. May be empty where only the noise is.
    #[serde(default)]
    pub fields: Vec<RandomFieldDocument>,
    /// Whether each draw has its own seed for the noise in its runs.
    #[serde(default = "yes")]
    pub vary_seed: bool,
}

fn yes() -> bool {
    true
}

/// A comparison: every base under every condition.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct CompareDocument {
    /// Under which conditions.
    pub conditions: Vec<ConditionDocument>,
    /// Draws under each condition.
    #[serde(default = "one")]
    pub draws: u32,
    /// What is random in each draw.
    #[serde(default)]
    pub fields: Vec<RandomFieldDocument>,
    /// Whether each draw has its own seed for the noise in its runs.
    #[serde(default = "yes")]
    pub vary_seed: bool,
}

fn one() -> u32 {
    1
}

/// A condition with a name.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct ConditionDocument {
    /// How tables and figures call it.
    pub name: String,
    /// What it changes in every base; nothing if empty.
    #[serde(default)]
    pub set: Vec<SettingDocument>,
}

/// A field with a value.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct SettingDocument {
    /// JSON pointer into the scenario; `*` at its end: every element.
    pub field: String,
    /// Its value.
    pub value: f64,
    /// Whether the value is a factor on what the base says.
    #[serde(default)]
    pub relative: bool,
}

/// A search for the best values, by CMA-ES with restarts; or, with several objectives, for the values of which none beats another, by
/// NSGA-II.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct TuningDocument {
    /// What may be changed.
    pub variables: Vec<VariableDocument>,
    /// What should be small: the weighted sum of these.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub objective: Vec<GoalDocument>,
    /// In its place two or three, each a weighted sum.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub objectives: Vec<ObjectiveDocument>,
    /// What must not be exceeded, or costs.
    #[serde(default)]
    pub constraints: Vec<ConstraintDocument>,
    /// The plants that every candidate is tried on; the base's alone if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub plants: Option<PlantsDocument>,
    /// Candidates per generation; `4 + 3 ln n` for n variables if left out, 40 with several objectives. Doubled by each restart.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub population: Option<u32>,
    /// Candidates in all; a generation that has begun is finished.
    pub evaluations: u32,
    /// Restarts, each from a random place, once the search has settled; none with several objectives.
    #[serde(default)]
    pub restarts: u32,
    /// Standard deviation of the first candidates, as a share of each variable's range; with several objectives they are anywhere.
    #[serde(default = "default_step")]
    pub initial_step: f64,
}

fn default_step() -> f64 {
    0.2
}

/// A field that the search may change.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct VariableDocument {
    /// JSON pointer into the scenario; `*` at its end: each element on its own.
    pub field: String,
    /// Least value.
    pub min: f64,
    /// Greatest value.
    pub max: f64,
    /// Whether it is searched in its logarithm.
    #[serde(default)]
    pub log: bool,
    /// Whether values are factors on what the base says.
    #[serde(default)]
    pub relative: bool,
}

/// One of several objectives.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct ObjectiveDocument {
    /// What it is called.
    pub name: String,
    /// The weighted sum of these.
    pub terms: Vec<GoalDocument>,
}

/// A part of the objective: `weight · metric / scale`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct GoalDocument {
    /// Column of the results.
    pub metric: String,
    /// Weight.
    pub weight: f64,
    /// What counts as one; the start's own value on the same plants if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scale: Option<f64>,
}

/// A limit: every run that exceeds it costs `weight · (metric / max − 1)`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct ConstraintDocument {
    /// Column of the results.
    pub metric: String,
    /// Its limit.
    pub max: f64,
    /// Price of exceeding it by its whole value.
    #[serde(default = "default_price")]
    pub weight: f64,
}

fn default_price() -> f64 {
    100.0
}

/// Plants on which candidates are tried.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct PlantsDocument {
    /// How many.
    pub count: u32,
    /// How they differ from the base.
    pub fields: Vec<RandomFieldDocument>,
    /// What counts of their objectives.
    #[serde(default)]
    pub aggregate: Aggregate,
    /// Other plants on which the start and the best found are compared in the end.
    #[serde(default)]
    pub validation: u32,
}

/// What counts of several plants' objectives.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Aggregate {
    /// Their mean.
    #[default]
    Mean,
    /// The worst.
    Worst,
}
