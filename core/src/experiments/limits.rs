//! Limits on what an experiment may ask for, and the checks that name field, value and range.

use crate::scenario::{Problem, ScenarioError};

/// Limits on experiments. All are inclusive.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ExperimentLimits {
    /// Most runs, of a tuning most runs of all its generations.
    pub runs: u64,
    /// Most integration steps in all runs together.
    pub steps: f64,
    /// Most base scenarios.
    pub bases: usize,
    /// Most conditions of a comparison.
    pub conditions: usize,
    /// Most fields that vary.
    pub fields: usize,
    /// Most axes of a sweep.
    pub axes: usize,
    /// Most values on an axis of a grid.
    pub values: usize,
    /// Most variables of a tuning.
    pub variables: usize,
    /// Smallest and largest population of a tuning.
    pub population: [u32; 2],
    /// Most restarts of a tuning.
    pub restarts: u32,
    /// Most plants on which a candidate is tried.
    pub plants: u32,
    /// Most characters of a name or title.
    pub name_chars: usize,
    /// Narrowest and widest confidence.
    pub confidence: [f64; 2],
}

/// The limits of this version.
pub const EXPERIMENT_LIMITS: ExperimentLimits = ExperimentLimits {
    runs: 200_000,
    steps: 1e12,
    bases: 16,
    conditions: 64,
    fields: 64,
    axes: super::sobol::DIMENSIONS,
    values: 1000,
    variables: 64,
    population: [4, 256],
    restarts: 20,
    plants: 256,
    name_chars: 100,
    confidence: [0.5, 0.999],
};

type Check = Result<(), ScenarioError>;

/// Whether a number is within its limits.
pub(crate) fn check_range(pointer: &str, value: f64, [min, max]: [f64; 2], unit: &'static str) -> Check {
    // Written so that NaN fails.
    if value >= min && value <= max {
        Ok(())
    } else {
        Err(ScenarioError::new(pointer, Problem::OutOfRange { value, min, max, unit }))
    }
}

/// Whether a list has from 1 to `most` elements.
pub(crate) fn check_count(pointer: &str, found: usize, most: usize, what: &'static str) -> Check {
    match found {
        0 => Err(conflict(pointer, format!("is empty; it needs at least one of these: {what}"))),
        _ if found > most => Err(ScenarioError::new(pointer, Problem::TooMany { found, most, what })),
        _ => Ok(()),
    }
}

/// Whether a name can be shown and told from the others.
pub(crate) fn check_name<'a>(pointer: &str, name: &str, mut earlier: impl Iterator<Item = &'a str>) -> Check {
    let length = name.chars().count();
    check_range(pointer, length as f64, [1.0, EXPERIMENT_LIMITS.name_chars as f64], "characters")?;
    if name.chars().any(char::is_control) {
        return Err(conflict(pointer, "holds a control character; a name is one line of text".to_owned()));
    }
    if earlier.any(|other| other == name) {
        return Err(conflict(pointer, format!("{name:?} is taken already; every name is given once")));
    }
    Ok(())
}

/// An error about what a field means beside the others.
pub(crate) fn conflict(pointer: impl Into<String>, message: String) -> ScenarioError {
    ScenarioError::new(pointer, Problem::Conflict { message })
}

/// A name that means nothing where it stands.
pub(crate) fn unknown(pointer: impl Into<String>, value: &str, allowed: String) -> ScenarioError {
    // A hostile name must not make a hostile message.
    let value = value.chars().take(EXPERIMENT_LIMITS.name_chars).collect();
    ScenarioError::new(pointer, Problem::Unknown { value, allowed })
}
