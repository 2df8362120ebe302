//! What is wrong with a scenario: always which field, which value, and what would be allowed.

use serde::Serialize;
use thiserror::Error;

/// A scenario that cannot be run.
#[derive(Debug, Clone, PartialEq, Error, Serialize)]
#[error("{}: {problem}", field_name(pointer))]
pub struct ScenarioError {
    /// JSON pointer to the offending field; empty for the whole document.
    pub pointer: String,
    /// What is wrong with it.
    #[serde(flatten)]
    pub problem: Problem,
}

/// What is wrong with a field.
#[derive(Debug, Clone, PartialEq, Error, Serialize)]
#[serde(tag = "problem", rename_all = "snake_case")]
pub enum Problem {
    /// A number outside its range.
    #[error("{value} is outside the allowed range {min} to {max}{}", with_unit(unit))]
    OutOfRange {
        /// The value given.
        value: f64,
        /// Smallest allowed value.
        min: f64,
        /// Largest allowed value.
        max: f64,
        /// Unit of all three.
        unit: &'static str,
    },
    /// A list of the wrong length.
    #[error("has {found} numbers where {expected} are needed, {why}")]
    WrongLength {
        /// Numbers given.
        found: usize,
        /// Numbers needed.
        expected: usize,
        /// What fixes their number.
        why: &'static str,
    },
    /// A list that is too long.
    #[error("has {found} where at most {most} are allowed, {what}")]
    TooMany {
        /// Elements given.
        found: usize,
        /// Elements allowed.
        most: usize,
        /// What they are.
        what: &'static str,
    },
    /// A name that means nothing here.
    #[error("{value:?} is not known; allowed: {allowed}")]
    Unknown {
        /// The name given.
        value: String,
        /// Names that would do.
        allowed: String,
    },
    /// A field that has no place beside the others.
    #[error("{message}")]
    Conflict {
        /// What collides with what.
        message: String,
    },
    /// Not readable as the document it should be.
    #[error("{message}")]
    Malformed {
        /// What the reader said.
        message: String,
    },
}

impl ScenarioError {
    /// An error at `pointer`.
    pub fn new(pointer: impl Into<String>, problem: Problem) -> Self {
        Self { pointer: pointer.into(), problem }
    }

    /// The same error, seen from a document that holds the scenario at `prefix`.
    #[must_use]
    pub fn within(mut self, prefix: &str) -> Self {
        self.pointer.insert_str(0, prefix);
        self
    }
}

/// A reader's message in terms of documents instead of Rust.
pub fn in_plain_words(message: &str) -> String {
    // What is found may be quoted from the document and stays as it is; what is expected stands at the end.
    let Some((found, expected)) = message.rsplit_once(", expected ") else { return message.to_owned() };
    let found = match found {
        "invalid type: sequence" => "invalid type: list",
        "invalid type: map" => "invalid type: object",
        found => found,
    };
    let expected = match expected {
        "f64" => "a number",
        "u64" | "usize" => "a whole number from 0 up",
        "a sequence" => "a list",
        _ if expected.starts_with("struct ") || expected.contains(" tagged enum ") => "an object",
        _ if expected.starts_with("enum ") || expected.starts_with("variant of enum ") => "a name",
        _ => expected,
    };
    format!("{found}, expected {expected}")
}

/// `/scheme/gains/k_v/2` as `scheme.gains.k_v[2]`.
fn field_name(pointer: &str) -> String {
    let mut name = String::new();
    for part in pointer.split('/').skip(1) {
        if part.bytes().all(|byte| byte.is_ascii_digit()) && !part.is_empty() {
            name.extend(["[", part, "]"]);
        } else {
            if !name.is_empty() {
                name.push('.');
            }
            name.push_str(part);
        }
    }
    if name.is_empty() { "scenario".to_owned() } else { name }
}

fn with_unit(unit: &str) -> String {
    if unit.is_empty() { String::new() } else { format!(" {unit}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_the_field_as_people_write_it() {
        let problem = Problem::OutOfRange { value: -1.0, min: 0.0, max: 2.0, unit: "s" };
        let error = ScenarioError::new("/scheme/gains/k_v/2", problem).within("/spec/scenarios/0");
        assert_eq!(
            error.to_string(),
            "spec.scenarios[0].scheme.gains.k_v[2]: -1 is outside the allowed range 0 to 2 s"
        );
    }
}
