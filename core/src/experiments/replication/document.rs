//! The section `replication` of an experiment, as it is written and read: what is unknown, and how a run's samples are read.
//!
//! Unknowns are searched by simulation, every combination of their options; horizons, windows and units are only ways to read
//! the samples of one simulation.

use ciborium::Value;
use serde::{Deserialize, Serialize};

/// A search for the settings behind the paper's numbers. The bases are the study's three schemes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct ReplicationDocument {
    /// What the paper leaves unsaid; every combination of options is simulated.
    #[serde(default)]
    pub unknowns: Vec<UnknownDocument>,
    /// Durations that the paper may mean, s: whole numbers of samples of the bases, at most their duration.
    pub horizons_s: Vec<f64>,
    /// Parts of a horizon over which its indices may be meant.
    pub windows: Vec<WindowDocument>,
    /// Units in which its numbers may be.
    #[serde(default = "labelled")]
    pub units: Vec<UnitsDocument>,
    /// An entry counts as reached within this factor of the paper's number.
    #[serde(default = "default_factor")]
    pub reached_factor: f64,
    /// A reading counts as plausible if its distance is at most this many times the best reading's.
    #[serde(default = "default_factor")]
    pub plausible_factor: f64,
}

fn labelled() -> Vec<UnitsDocument> {
    vec![UnitsDocument::Labelled]
}

fn default_factor() -> f64 {
    1.25
}

/// Something that the paper leaves unsaid.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct UnknownDocument {
    /// How tables and figures call it.
    pub name: String,
    /// Identifiers of the schemes that it concerns; all if left out. The others are not simulated again for it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub schemes: Option<Vec<String>>,
    /// What it may be.
    pub options: Vec<OptionDocument>,
}

/// What an unknown may be.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct OptionDocument {
    /// How tables and figures call it.
    pub name: String,
    /// What it changes in a base: an object whose members replace the scenario's, member by member and level by level (null
    /// takes one away). Source: RFC 7396, JSON Merge Patch.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(schema_with = "object"))]
    pub change: Option<Value>,
}

#[cfg(feature = "schema")]
fn object(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
    schemars::json_schema!({ "type": ["object", "null"] })
}

/// A part of the horizon.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct WindowDocument {
    /// How tables and figures call it.
    pub name: String,
    /// Its start as a share of the horizon.
    #[serde(default)]
    pub from: f64,
    /// Its end as a share of the horizon.
    #[serde(default = "whole")]
    pub to: f64,
}

fn whole() -> f64 {
    1.0
}

/// Units of the paper's numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum UnitsDocument {
    /// Degrees and degrees per second, as labelled.
    Labelled,
    /// The tables are in radians and radians per second, the observer peaks in degrees.
    RadianTables,
    /// Everything is in radians and radians per second.
    Radians,
}

impl UnitsDocument {
    /// Name for people.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Labelled => "degrees, as labelled",
            Self::RadianTables => "tables in radians",
            Self::Radians => "everything in radians",
        }
    }
}
