//! How a run ended: completed, or diverged with its time and reason.

use std::fmt;

/// A run counts as diverged when a joint is further than this from where it should be: sixteen turns, far beyond any
/// arm, yet small enough that every number before it is finite and worth keeping.
pub const TRACKING_ERROR_LIMIT_RAD: f64 = 100.0;

/// Why a run was given up.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Divergence {
    /// The tracking error of this joint (1 is the first) left [`TRACKING_ERROR_LIMIT_RAD`].
    TrackingError(usize),
    /// A number stopped being finite.
    NotFinite,
    /// The adaptive integrator needed steps shorter than the clock resolves.
    StepTooSmall,
    /// The adaptive integrator took this many steps and was not done: the problem is too stiff for it, or the tolerances are
    /// out of reach.
    TooManySteps(u64),
}

impl fmt::Display for Divergence {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TrackingError(joint) => {
                write!(f, "the tracking error of joint {joint} exceeded {TRACKING_ERROR_LIMIT_RAD} rad")
            }
            Self::NotFinite => f.write_str("a state or torque is no longer a finite number"),
            Self::TooManySteps(steps) => {
                write!(
                    f,
                    "too stiff for the adaptive method: not done after {steps} steps; use rk4, a wider friction sign or looser tolerances"
                )
            }
            Self::StepTooSmall => f.write_str("the adaptive step became too small: too stiff or singular"),
        }
    }
}

/// How a run ended.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// It reached its duration.
    Completed,
    /// It was given up; what was recorded before stays valid.
    Diverged {
        /// When, s.
        at_s: f64,
        /// Why.
        reason: Divergence,
    },
}
