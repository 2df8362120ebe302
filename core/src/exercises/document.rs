//! The exercise document `adaptarm.exercise/1`, as it is written and read. Fields are stable: add, never rename.
//!
//! Only shapes and defaults live here; what is allowed is decided in `resolve`. A field of the scenario is named by its JSON
//! pointer; `*` at its end stands for every element of a list.

use crate::experiments::RandomFieldDocument;
use crate::scenario::ScenarioDocument;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The format that this version reads and writes.
pub const EXERCISE_FORMAT: &str = "adaptarm.exercise/1";

/// An exercise as written. What students may not see is optional: a document without it is what their browser gets.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct ExerciseDocument {
    /// `adaptarm.exercise/1`.
    pub format: String,
    /// Identifier: lower-case letters, digits and hyphens.
    pub id: String,
    /// For whom.
    pub level: Level,
    /// Estimated working time, min.
    pub minutes: u32,
    /// Name.
    pub title: Text,
    /// What one can do afterwards.
    pub goal: Text,
    /// The task, Markdown.
    pub statement: Text,
    /// Help that unlocks.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub hints: Vec<HintDocument>,
    /// Why the solution is one, Markdown; released after the deadline.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub explanation: Option<Text>,
    /// For the teacher alone, Markdown.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub teacher_note: Option<Text>,
    /// What everything starts from.
    pub scenario: ScenarioDocument,
    /// What the student may move.
    pub moves: Vec<MoveDocument>,
    /// Variants that the student sees and tries on.
    pub visible: VariantsDocument,
    /// Variants that count.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hidden: Option<VariantsDocument>,
    /// What is wanted.
    pub criteria: Vec<CriterionDocument>,
    /// Values that solve it, kept from students.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub solutions: Vec<SolutionDocument>,
}

/// A text in every language of the page.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Text {
    /// English.
    pub en: String,
    /// Spanish.
    pub es: String,
}

/// For whom an exercise is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Level {
    /// First lesson.
    First,
    /// Knows feedback.
    Intermediate,
    /// Knows adaptive control.
    Advanced,
    /// Open questions.
    Research,
}

/// A hint.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct HintDocument {
    /// Graded attempts after which it is shown.
    pub after_attempts: u32,
    /// The hint, Markdown.
    pub text: Text,
}

/// A number that the student may move.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct MoveDocument {
    /// How a submission calls it.
    pub name: String,
    /// What it is.
    pub label: Text,
    /// Symbol and unit for a slider.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub unit: String,
    /// JSON pointers into the scenario; each gets the value.
    pub fields: Vec<String>,
    /// Whether the value is a factor on what the scenario says.
    #[serde(default)]
    pub relative: bool,
    /// Least value.
    pub min: f64,
    /// Greatest value.
    pub max: f64,
    /// Whether a slider moves in the logarithm.
    #[serde(default)]
    pub log: bool,
    /// A slider's step; any value of the range is accepted.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub step: Option<f64>,
    /// Where the student starts.
    pub start: f64,
}

/// Variants of the scenario, drawn from a seed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct VariantsDocument {
    /// How many.
    pub count: u32,
    /// What is random in them; none: each is the scenario itself.
    #[serde(default)]
    pub fields: Vec<RandomFieldDocument>,
    /// Whether each has its own seed for the noise and the random trajectory in its run.
    #[serde(default)]
    pub vary_seed: bool,
}

/// How the variants' shares of a criterion make one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum ShareAggregate {
    /// The smallest.
    #[default]
    Worst,
    /// Their mean.
    Mean,
    /// The one below which `quantile` of them lie.
    Quantile,
}

/// What is wanted of one metric: the whole weight up to `full`, none from `zero` on, linear between.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct CriterionDocument {
    /// Identifier.
    pub id: String,
    /// What students read.
    pub label: Text,
    /// Metric of a run, as in experiments, or `theta_error_percent`; with `_1`, `_2` and so on of one joint or parameter.
    pub metric: String,
    /// How the variants' shares make one.
    #[serde(default)]
    pub aggregate: ShareAggregate,
    /// For aggregate `quantile`: which, from 0 (the worst) to 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub quantile: Option<f64>,
    /// Bound of full credit.
    pub full: f64,
    /// Bound of no credit; where it is below `full`, more is better.
    pub zero: f64,
    /// Points.
    pub weight: f64,
}

/// A solution by name.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct SolutionDocument {
    /// How the calibration calls it.
    pub name: String,
    /// A value for each move.
    pub gains: BTreeMap<String, f64>,
}
