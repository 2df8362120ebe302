//! What a tuning tells: candidates, generations, the front of several objectives, the summary; and why it cannot go on.

use super::statistics::{Share, Statistics};
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// Values with what they cost on the plants of the search.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Candidate {
    /// Values of the variables; factors where a variable is relative.
    pub values: Vec<f64>,
    /// The objective with the price of exceeded limits.
    pub objective: f64,
    /// Generation in which it was tried, from 1; 0 is the start.
    pub generation: u32,
}

/// A generation in short.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Generation {
    /// Restarts before it.
    pub restart: u32,
    /// Its candidates.
    pub population: u64,
    /// The smallest objective in it.
    pub best: f64,
    /// Size of the distribution that they came from, in ranges of the variables; 0 of a search for a front, which has none.
    pub sigma: f64,
    /// Hypervolume of the front after it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hypervolume: Option<f64>,
}

/// Candidates that keep all limits and of which none beats another in every objective.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Front {
    /// Names of the objectives.
    pub objectives: Vec<String>,
    /// Twice the start's objectives: up to there the hypervolume counts.
    pub reference: Vec<f64>,
    /// Volume of what the front beats within the reference.
    pub hypervolume: f64,
    /// By rising first objective.
    pub candidates: Vec<FrontCandidate>,
}

/// A candidate of a front.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FrontCandidate {
    /// Values of the variables; factors where a variable is relative.
    pub values: Vec<f64>,
    /// What it costs, objective by objective.
    pub objectives: Vec<f64>,
    /// Generation in which it was tried, from 1; 0 is the start.
    pub generation: u32,
}

/// The start and the best found on plants that the search never saw.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Validation {
    /// Objective of the start.
    pub start: f64,
    /// Objective of the best.
    pub best: f64,
    /// Plants on which the best costs less than the start.
    pub better: Share,
    /// Runs of the start that reached no end.
    pub start_failed: usize,
    /// Runs of the best that reached no end.
    pub best_failed: usize,
    /// Cost of the best minus that of the start, plant by plant, where both reached the end.
    pub difference: Option<Statistics>,
}

/// What a tuning found.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct TuningSummary {
    /// `adaptarm.tuning_summary/1`.
    pub format: String,
    /// Version of the core that computed it.
    pub core_version: String,
    /// Hash of the experiment.
    pub experiment_hash: String,
    /// For people.
    pub title: String,
    /// Whether the search has ended.
    pub finished: bool,
    /// Candidates tried, with the start.
    pub candidates: u64,
    /// Runs made.
    pub runs: u64,
    /// JSON pointers of the variables.
    pub variables: Vec<String>,
    /// What counts as one for each part of the objective.
    pub scales: Vec<f64>,
    /// The base's own values.
    pub start: Option<Candidate>,
    /// The best found; the start if nothing was better. Of several objectives by their sum.
    pub best: Option<Candidate>,
    /// Of several objectives.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub front: Option<Front>,
    /// Both on other plants.
    pub validation: Option<Validation>,
    /// Generation by generation.
    pub history: Vec<Generation>,
}

/// Why rows cannot be learnt from.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum TuningError {
    /// Not the rows of the runs that were asked for.
    #[error("these are not the rows of the {expected} runs that come next")]
    OtherRows {
        /// Runs asked for.
        expected: usize,
    },
    /// The start has no number that could count as one.
    #[error("the start reaches no end or lacks {metric} on every plant, or it is 0: give {goal}/scale")]
    NoScale {
        /// Metric of the goal.
        metric: String,
        /// JSON pointer to it.
        goal: String,
    },
}
