//! What can be wrong with settings: one line each, with the place, the key, the value and what would be allowed.

use super::setting::Setting;
use crate::document::FileError;
use std::path::PathBuf;
use thiserror::Error;

/// Why there are no settings.
#[derive(Debug, Error)]
pub enum ConfigError {
    /// The file cannot be read.
    #[error("{}: {error}", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// What the system said.
        error: FileError,
    },
    /// The file is not TOML.
    #[error("{place}: not TOML: {message}")]
    Syntax {
        /// File, line and column.
        place: String,
        /// What the reader said.
        message: String,
    },
    /// A key without meaning.
    #[error("{place}: there is no setting {key}; {}", allowed_keys(allowed))]
    Unknown {
        /// Where it stands.
        place: String,
        /// Its whole name.
        key: String,
        /// What there is in its place.
        allowed: Vec<&'static str>,
    },
    /// A value of another type.
    #[error("{place}: {key}: found {found}, expected {expected}")]
    Type {
        /// Where it stands.
        place: String,
        /// Its whole name.
        key: String,
        /// What it is.
        found: String,
        /// What it should be.
        expected: String,
    },
    /// A number outside its range.
    #[error("{place}: {key}: {value} is outside the allowed range {range}")]
    OutOfRange {
        /// Where it stands.
        place: String,
        /// Its whole name.
        key: String,
        /// What it is.
        value: String,
        /// From, to and unit.
        range: String,
    },
    /// A text that does not mean what it should.
    #[error("{place}: {key}{}: {message}", value.as_ref().map(|value| format!(" {value:?}")).unwrap_or_default())]
    Text {
        /// Where it stands.
        place: String,
        /// Its whole name.
        key: String,
        /// What it is, unless that is a secret.
        value: Option<String>,
        /// What is wrong with it.
        message: String,
    },
    /// Two settings that contradict each other.
    #[error("{place}: {message}")]
    Conflict {
        /// Where the later one stands.
        place: String,
        /// Both, with their values.
        message: String,
    },
    /// Settings that passed every check above and still cannot be used.
    #[error("settings cannot be put together: {0}")]
    Merge(#[from] config::ConfigError),
}

fn allowed_keys(allowed: &[&str]) -> String {
    if allowed.is_empty() {
        "it has no settings within it".to_owned()
    } else {
        format!("there are {}", allowed.join(", "))
    }
}

impl ConfigError {
    /// A value of another type than the setting's.
    pub(super) fn wrong_type(place: &str, setting: &Setting, found: impl Into<String>) -> Self {
        // What was meant as a password must not appear, whatever it was written as.
        let found = if setting.rule.secret { "something else".to_owned() } else { found.into() };
        Self::Type { place: place.to_owned(), key: setting.key(), found, expected: setting.rule.form.describe() }
    }

    /// Whether the fault lies with the system and not with what was written.
    pub fn is_systems(&self) -> bool {
        matches!(self, Self::File { error: FileError::Unreadable(_), .. })
    }
}
