//! Errors as the page receives them: an object with the JSON pointer of the offending field, the core's own message, and
//! where the core has them the facts behind it, so that the page can say them in the reader's language.

use adaptarm_core::scenario::{Problem, ReadError, ScenarioError};
use serde::Serialize;
use wasm_bindgen::JsValue;

/// What is wrong and where.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(crate) struct Failure {
    /// JSON pointer to the offending field; empty for the whole document.
    pub pointer: String,
    /// One sentence for people.
    pub message: String,
    /// The same as numbers and names, where the document could be read.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub problem: Option<Problem>,
}

impl Failure {
    /// A failure of the whole document or of the caller.
    pub fn new(message: impl Into<String>) -> Self {
        Self::at("", message)
    }

    /// A failure at a place of a document.
    pub fn at(pointer: impl Into<String>, message: impl Into<String>) -> Self {
        Self { pointer: pointer.into(), message: message.into(), problem: None }
    }
}

impl From<Failure> for JsValue {
    /// The failure as JSON text: exceptions cross from workers as text anyway.
    fn from(failure: Failure) -> Self {
        Self::from_str(&serde_json::json!(failure).to_string())
    }
}

impl From<ScenarioError> for Failure {
    fn from(error: ScenarioError) -> Self {
        Self { pointer: error.pointer.clone(), message: error.to_string(), problem: Some(error.problem) }
    }
}

impl From<ReadError<serde_json::Error>> for Failure {
    fn from(error: ReadError<serde_json::Error>) -> Self {
        let pointer = error.pointer().to_owned();
        match &error {
            // Where in a text nobody sees: the pointer says where.
            ReadError::Document { source, .. } => {
                let place = format!(" at line {} column {}", source.line(), source.column());
                Self::at(pointer, error.to_string().replace(&place, ""))
            }
            ReadError::Invalid(_) => {
                let message = error.to_string();
                let problem = if let ReadError::Invalid(error) = error { Some(error.problem) } else { None };
                Self { pointer, message, problem }
            }
        }
    }
}

/// Reads and checks a scenario.
#[cfg(feature = "playground")]
pub(crate) fn read(json: &str) -> Result<adaptarm_core::scenario::Scenario, Failure> {
    Ok(adaptarm_core::scenario::Scenario::read(&mut serde_json::Deserializer::from_str(json))?)
}

#[cfg(all(test, feature = "playground"))]
mod tests {
    use super::*;

    fn failure(scheme: &str) -> Failure {
        let json = format!(r#"{{"format":"adaptarm.scenario/1","scheme":{scheme}}}"#);
        read(&json).unwrap_err()
    }

    #[test]
    fn a_failure_names_the_field_and_no_line() {
        let text = failure(r#"{"kind":"slotine_li","gains":{"k_s":[1,2,"abc"]}}"#);
        assert_eq!(text.pointer, "/scheme/gains/k_s/2");
        assert!(text.message.contains("\"abc\"") && !text.message.contains("line"), "{}", text.message);
        let range = failure(r#"{"kind":"slotine_li","gains":{"k_s":[1,2,-3]}}"#);
        assert_eq!(range.pointer, "/scheme/gains/k_s/2");
        assert!(range.message.contains("-3 is outside"), "{}", range.message);
        let facts = serde_json::json!(range)["problem"].clone();
        assert_eq!(facts["problem"], "out_of_range");
        assert_eq!((&facts["value"], &facts["min"], &facts["max"]), (&(-3.0).into(), &0.0.into(), &1e5.into()));
    }
}
