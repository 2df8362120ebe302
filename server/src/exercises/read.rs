//! One exercise out of TOML: limits, then the text, then what it says; a mistake is told with its place.

use crate::document::{FileError, brief, read_file};
use adaptarm_core::exercises::Exercise;
use adaptarm_core::scenario::{ReadError, ScenarioError};
use std::path::Path;
use thiserror::Error;

/// Why a file is no exercise.
#[derive(Debug, Error)]
pub enum ExerciseError {
    /// It cannot be read.
    #[error(transparent)]
    File(#[from] FileError),
    /// Not UTF-8.
    #[error("is not UTF-8 text: {0}")]
    Encoding(#[from] std::str::Utf8Error),
    /// Not TOML, or a field is missing, doubled or of another kind.
    #[error("{0}")]
    Syntax(String),
    /// Readable, but not allowed.
    #[error("{}", told(.0))]
    Invalid(#[from] ScenarioError),
}

/// An error of the whole document is about an exercise here, not about a scenario.
fn told(error: &ScenarioError) -> String {
    if error.pointer.is_empty() { format!("exercise: {}", error.problem) } else { error.to_string() }
}

/// Reads and checks a file.
pub fn read(path: &Path) -> Result<Exercise, ExerciseError> {
    let bytes = read_file(path)?;
    parse(std::str::from_utf8(&bytes)?)
}

/// Reads and checks an exercise.
pub fn parse(text: &str) -> Result<Exercise, ExerciseError> {
    let syntax = |error: toml::de::Error| ExerciseError::Syntax(format!("not TOML: {}", brief(&error.to_string())));
    let document = toml::Deserializer::parse(text).map_err(syntax)?;
    Exercise::read(document).map_err(|error| match error {
        ReadError::Invalid(error) => ExerciseError::Invalid(error),
        ReadError::Document { .. } => ExerciseError::Syntax(brief(&error.to_string())),
    })
}
