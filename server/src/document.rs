//! Reading documents from outside: a size limit before anything else, then JSON with the place of every mistake.
//!
//! Shared by the command line and the HTTP API, which must refuse the same documents in the same words.

use crate::config::DOCUMENT_BYTES;
use adaptarm_core::scenario::{
    Problem, ReadError, Scenario, ScenarioDocument, ScenarioError, in_plain_words, read_document,
};
use serde::de::DeserializeOwned;
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;
use thiserror::Error;

/// Longest message to people; what is quoted from a hostile document is cut there.
const LONGEST_MESSAGE_CHARS: usize = 500;

/// Why bytes are not the document they should be.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum DocumentError {
    /// Not JSON.
    #[error("{}", at(pointer, message))]
    Syntax {
        /// JSON pointer to the value in which reading failed; empty at the top.
        pointer: String,
        /// What the reader said, with line and column.
        message: String,
        /// Line, the first is 1.
        line: usize,
        /// Column, the first is 1; 0 at the very start.
        column: usize,
    },
    /// JSON, but not what is asked for.
    #[error(transparent)]
    Invalid(#[from] ScenarioError),
}

impl DocumentError {
    /// The same in words, about a document of this kind: what the core calls a scenario may be another one as a whole.
    pub fn about(&self, kind: &str) -> String {
        match self {
            Self::Invalid(error) if error.pointer.is_empty() => format!("{kind}: {}", error.problem),
            _ => self.to_string(),
        }
    }
}

fn at(pointer: &str, message: &str) -> String {
    let malformed = Problem::Malformed { message: format!("not JSON: {message}") };
    if pointer.is_empty() { malformed.to_string() } else { ScenarioError::new(pointer, malformed).to_string() }
}

/// Why a file could not be read.
#[derive(Debug, Error)]
pub enum FileError {
    /// The system said so.
    #[error("cannot read it: {0}")]
    Unreadable(#[from] io::Error),
    /// A folder.
    #[error("is a folder; a file is needed")]
    Folder,
    /// Longer than a document may be.
    #[error("is {0} bytes long; a document may have at most {DOCUMENT_BYTES} bytes (1 MiB)")]
    TooLarge(u64),
    /// Longer than a document may be; how long, only reading it all would tell.
    #[error("is longer than the {DOCUMENT_BYTES} bytes (1 MiB) that a document may have")]
    Endless,
}

/// The whole of a file, unless it is too large for a document; then hardly any of it is read.
pub fn read_file(path: &Path) -> Result<Vec<u8>, FileError> {
    let file = File::open(path)?;
    let metadata = file.metadata()?;
    if metadata.is_dir() {
        return Err(FileError::Folder);
    }
    if metadata.len() > DOCUMENT_BYTES as u64 {
        return Err(FileError::TooLarge(metadata.len()));
    }
    // The length of a pipe or a device is unknown before its end.
    read_bounded(file)
}

/// Everything up to the end of `input`, unless it is too large for a document.
pub fn read_bounded(input: impl Read) -> Result<Vec<u8>, FileError> {
    let mut bytes = Vec::new();
    input.take(DOCUMENT_BYTES as u64 + 1).read_to_end(&mut bytes)?;
    if bytes.len() > DOCUMENT_BYTES { Err(FileError::Endless) } else { Ok(bytes) }
}

/// Reads a JSON document of any kind.
pub fn parse<T: DeserializeOwned>(bytes: &[u8]) -> Result<T, DocumentError> {
    let text = std::str::from_utf8(bytes).map_err(|error| not_utf8(bytes, error))?;
    // Some editors begin a file with a byte order mark, which RFC 8259 lets readers ignore.
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    if text.trim().is_empty() {
        let message = "it is empty".to_owned();
        return Err(DocumentError::Syntax { pointer: String::new(), message, line: 1, column: 0 });
    }
    let mut json = serde_json::Deserializer::from_str(text);
    let document = read_document(&mut json).map_err(|error| match error {
        ReadError::Document { pointer, source } => from_json(pointer, &source),
        ReadError::Invalid(error) => DocumentError::Invalid(error),
    })?;
    json.end().map_err(|error| from_json(String::new(), &error))?;
    Ok(document)
}

/// Reads and checks a scenario.
pub fn parse_scenario(bytes: &[u8]) -> Result<Scenario, DocumentError> {
    Ok(Scenario::new(parse::<ScenarioDocument>(bytes)?)?)
}

fn not_utf8(bytes: &[u8], error: std::str::Utf8Error) -> DocumentError {
    let before = &bytes[..error.valid_up_to()];
    let mut lines = before.split(|byte| *byte == b'\n');
    let column = lines.next_back().map_or(0, <[u8]>::len) + 1;
    let line = lines.count() + 1;
    let message = format!("byte {} is not UTF-8 text at line {line} column {column}", before.len() + 1);
    DocumentError::Syntax { pointer: String::new(), message, line, column }
}

fn from_json(pointer: String, error: &serde_json::Error) -> DocumentError {
    use serde_json::error::Category;
    let message = brief(&in_plain_words(&error.to_string()));
    let pointer = if pointer.len() > LONGEST_MESSAGE_CHARS { String::new() } else { pointer };
    match error.classify() {
        Category::Data => ScenarioError::new(pointer, Problem::Malformed { message }).into(),
        Category::Syntax | Category::Eof | Category::Io => {
            DocumentError::Syntax { pointer, message, line: error.line(), column: error.column() }
        }
    }
}

/// A message as one line of bounded length, whatever it quotes.
pub fn brief(message: &str) -> String {
    let mut line = String::new();
    for (count, c) in message.chars().enumerate() {
        if count == LONGEST_MESSAGE_CHARS {
            line.push('…');
            break;
        }
        if c.is_control() { line.extend(c.escape_default()) } else { line.push(c) }
    }
    line
}

#[cfg(test)]
mod tests {
    use super::*;

    fn error(text: &str) -> String {
        parse_scenario(text.as_bytes()).unwrap_err().to_string()
    }

    #[test]
    fn names_where_json_ends_being_json() {
        assert_eq!(error("{"), "not JSON: EOF while parsing an object at line 1 column 1");
        assert_eq!(error(" \n"), "not JSON: it is empty");
        assert!(error(r#"{"integration": {"step_s": NaN}}"#).starts_with("integration.step_s: not JSON: "));
        let nested = format!(r#"{{"format": {}"#, "[".repeat(200_000));
        let message = error(&nested);
        assert!(message.starts_with("format[0][0]") && message.contains("not JSON: recursion limit"), "{message}");
    }

    #[test]
    fn speaks_of_json_and_not_of_rust() {
        assert_eq!(error("3"), "scenario: invalid type: integer `3`, expected an object");
        assert_eq!(error("[]"), "scenario: invalid type: list, expected an object");
        assert_eq!(error(r#"{"seed": -3}"#), "seed: invalid value: integer `-3`, expected a whole number from 0 up");
        assert_eq!(
            error(r#"{"integration": {"step_s": "NaN, expected f64"}}"#),
            r#"integration.step_s: invalid type: string "NaN, expected f64", expected a number"#
        );
        assert_eq!(error(r#"{"trajectory": 5}"#), "trajectory: invalid type: integer `5`, expected an object");
        for kind in [r#"{"scheme": {"kind": 3}}"#, r#"{"trajectory": {"kind": 3}}"#] {
            assert!(error(kind).ends_with(".kind: invalid type: integer `3`, expected a name"), "{}", error(kind));
        }
    }

    #[test]
    fn a_document_that_is_no_scenario_is_not_called_one() {
        let missing = parse_scenario(b"{}").unwrap_err();
        assert!(missing.about("receipt").starts_with("receipt: missing field"), "{}", missing.about("receipt"));
        let below = parse_scenario(br#"{"trajectory": 5}"#).unwrap_err();
        assert_eq!(below.about("receipt"), below.to_string());
    }

    #[test]
    fn a_hostile_name_makes_neither_a_long_nor_a_broken_line() {
        let message = error(&format!(r#"{{"a\n{}": 1}}"#, "b".repeat(10_000)));
        assert!(message.chars().count() < 2 * LONGEST_MESSAGE_CHARS && !message.contains('\n'), "{message}");
    }

    #[test]
    fn text_in_other_encodings_is_refused_with_its_place() {
        let DocumentError::Syntax { line, column, .. } = parse_scenario(b"{\n \"\xff\"}").unwrap_err() else {
            panic!("invalid text was read")
        };
        assert_eq!((line, column), (2, 3));
    }
}
