//! One exercise out of TOML: limits, then the text, then what it says; a mistake is told with its place.

use crate::document::{FileError, brief, read_file};
use adaptarm_core::exercises::Exercise;
use adaptarm_core::scenario::{Problem, ReadError, ScenarioError, in_plain_words};
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
    /// Not TOML.
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
    let document = toml::Deserializer::parse(text).map_err(|error| {
        let before = error.span().and_then(|span| text.get(..span.start)).unwrap_or_default();
        let line = before.matches('\n').count() + 1;
        ExerciseError::Syntax(format!("not TOML: {} at line {line}", brief(error.message())))
    })?;
    Exercise::read(document).map_err(|error| match error {
        ReadError::Invalid(error) => ExerciseError::Invalid(error),
        ReadError::Document { pointer, source } => {
            let message = brief(&in_plain_words(source.message()));
            ExerciseError::Invalid(ScenarioError::new(pointer, Problem::Malformed { message }))
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mistakes_have_their_place() {
        let error = |text: &str| parse(text).unwrap_err().to_string();
        assert!(error("a = 1\nb = ").starts_with("not TOML: ") && error("a = 1\nb = ").ends_with(" at line 2"));
        assert!(error("minutes = \"long\"").starts_with("minutes: invalid type: string \"long\", expected"));
        assert_eq!(error(""), "exercise: missing field `format`");
        assert!(error("extra = 1").starts_with("extra: unknown field `extra`"));
    }
}
