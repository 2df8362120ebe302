//! The report on a finished run: the one JSON object that the command line, the server and the page all show.

use crate::metrics::Metrics;
use crate::simulation::{Divergence, Outcome};
use serde::{Deserialize, Serialize};

/// What a run gave. Every number is finite, also of a diverged run, whose end is its last good state.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Report {
    /// `adaptarm.report/1`.
    pub format: String,
    /// Version of the core that computed it.
    pub core_version: String,
    /// Robot's identifier.
    pub robot: String,
    /// Scheme's identifier.
    pub scheme: String,
    /// Hash of the scenario with all defaults filled in.
    pub scenario_hash: String,
    /// Hash over the bits of the recorded samples.
    pub trajectory_hash: String,
    /// `completed` or `diverged` (or `unfinished`).
    pub outcome: OutcomeKind,
    /// When a diverged run was given up, s.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub at_s: Option<f64>,
    /// Why a diverged run was given up.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
    /// Index, peaks, settling, effort; over the samples before the divergence if it diverged.
    #[serde(flatten)]
    pub metrics: Metrics,
    /// True parameters of the simulated arm, which the estimates do not know.
    pub theta_true: Vec<f64>,
    /// Estimates at the end of the run, or before the step that diverged.
    pub theta_hat_end: Vec<f64>,
    /// Joint angles at the end of the run, or before the step that diverged, rad.
    pub q_end_rad: Vec<f64>,
    /// Samples recorded.
    pub samples: usize,
    /// Integration steps taken.
    pub steps: u64,
    /// Evaluations of the right-hand side.
    pub evaluations: u64,
}

/// How a run ended, without details.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum OutcomeKind {
    /// Reached its duration.
    Completed,
    /// Given up.
    Diverged,
    /// Still under way when it was reported.
    Unfinished,
}

impl Report {
    /// Identifier of the report's format.
    pub const FORMAT: &'static str = "adaptarm.report/1";
}

/// An outcome's kind, time and reason.
pub(super) fn describe(outcome: Option<Outcome>) -> (OutcomeKind, Option<f64>, Option<Divergence>) {
    match outcome {
        None => (OutcomeKind::Unfinished, None, None),
        Some(Outcome::Completed) => (OutcomeKind::Completed, None, None),
        Some(Outcome::Diverged { at_s, reason }) => (OutcomeKind::Diverged, Some(at_s), Some(reason)),
    }
}
