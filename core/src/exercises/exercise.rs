//! An exercise that has been checked: gains and a seed make its runs, the same ones in the browser and on the server.
//!
//! Visible and hidden variants are drawn from seeds that should differ: who knows the seed and the document knows the variants.

use super::document::ExerciseDocument;
use super::measures::Measure;
use super::resolve;
use crate::experiments::{Change, Distribution, Purpose, Stream, Tree, check_range, conflict, unknown};
use crate::robots::RobotData;
use crate::scenario::{ReadError, Scenario, ScenarioError, read_document};
use serde::{Deserialize, Deserializer, Serialize};
use std::collections::BTreeMap;

/// Which variants.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Visibility {
    /// Those that the student sees.
    Visible,
    /// Those that count.
    Hidden,
}

/// What of an exercise its student may see by now.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Released {
    /// Graded attempts so far, which unlock hints.
    pub attempts: u32,
    /// Whether the deadline is over, and with it the time for explanations.
    pub explanation: bool,
}

/// The fields that follow a number of the student's.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Move {
    pub changes: Vec<Change>,
}

/// Variants, ready to be drawn.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Variants {
    pub count: u32,
    pub changes: Vec<Change>,
    pub distributions: Vec<Distribution>,
    pub vary_seed: bool,
}

/// Where the document's criterion of the same place finds its number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Criterion {
    pub measure: Measure,
}

/// An exercise that has been checked.
#[derive(Debug, Clone, PartialEq)]
pub struct Exercise {
    pub(super) document: ExerciseDocument,
    pub(super) robot: &'static RobotData,
    pub(super) tree: Tree,
    pub(super) moves: Vec<Move>,
    pub(super) visible: Variants,
    pub(super) hidden: Option<Variants>,
    pub(super) criteria: Vec<Criterion>,
}

/// Seeds above this are not kept exact by every reader of JSON.
const LARGEST_SEED: f64 = 9_007_199_254_740_992.0;

impl Exercise {
    /// Checks a document.
    pub fn new(document: ExerciseDocument) -> Result<Self, ScenarioError> {
        resolve::resolve(document)
    }

    /// Reads and checks a document.
    pub fn read<'de, D>(deserializer: D) -> Result<Self, ReadError<D::Error>>
    where
        D: Deserializer<'de>,
        D::Error: serde::de::Error,
    {
        Ok(Self::new(read_document(deserializer)?)?)
    }

    /// The whole document with its scenario filled in. Not for students: [`Exercise::public`] is.
    pub fn document(&self) -> &ExerciseDocument {
        &self.document
    }

    /// The robot.
    pub fn robot(&self) -> &'static RobotData {
        self.robot
    }

    /// The document as its student may see it: without hidden variants, solutions and teacher's note, and without what is not
    /// released yet. Is itself an exercise, with the same visible runs.
    pub fn public(&self, released: Released) -> ExerciseDocument {
        let mut document = self.document.clone();
        document.hidden = None;
        document.solutions.clear();
        document.teacher_note = None;
        document.hints.retain(|hint| hint.after_attempts <= released.attempts);
        document.explanation.take_if(|_| !released.explanation);
        document
    }

    /// Hash over everything that a grade depends on: scenario, moves, variants and criteria, but no text.
    pub fn fingerprint(&self) -> String {
        let ExerciseDocument { format, id, scenario, moves, visible, hidden, criteria, .. } = &self.document;
        let moves: Vec<_> = moves.iter().map(|own| (&own.name, &own.fields, own.relative, own.min, own.max)).collect();
        let criteria: Vec<_> = criteria
            .iter()
            .map(|own| (&own.id, &own.metric, own.aggregate, own.quantile, own.full, own.zero, own.weight))
            .collect();
        let mut bytes = Vec::new();
        // Only strings, numbers and lists, and a vector takes whatever is written.
        if ciborium::into_writer(&(format, id, scenario, moves, visible, hidden, criteria), &mut bytes).is_err() {
            unreachable!("an exercise document always encodes");
        }
        blake3::hash(&bytes).to_hex().to_string()
    }

    /// Where the student starts.
    pub fn start(&self) -> BTreeMap<String, f64> {
        self.document.moves.iter().map(|own| (own.name.clone(), own.start)).collect()
    }

    /// Checks what a student submits: a number for each move, within its range, and nothing else.
    pub fn check(&self, gains: &BTreeMap<String, f64>) -> Result<(), ScenarioError> {
        let names = || self.document.moves.iter().map(|own| own.name.as_str()).collect::<Vec<_>>().join(", ");
        let is_known = |name: &str| self.document.moves.iter().any(|own| own.name == name);
        if let Some(stray) = gains.keys().find(|name| !is_known(name)) {
            return Err(unknown("/gains", stray, names()));
        }
        for own in &self.document.moves {
            let at = format!("/gains/{}", own.name);
            let value = gains.get(&own.name);
            let value = value.ok_or_else(|| conflict(at.clone(), format!("missing; needed are {}", names())))?;
            check_range(&at, *value, [own.min, own.max], "")?;
        }
        Ok(())
    }

    /// The runs by which gains are judged, in the order of the variants.
    ///
    /// An error at `/gains` is the submission's. Any other is the exercise's: this draw makes a scenario that is not allowed.
    pub fn runs(
        &self,
        gains: &BTreeMap<String, f64>,
        seed: u64,
        visibility: Visibility,
    ) -> Result<Vec<Scenario>, ScenarioError> {
        self.check(gains)?;
        check_range("/seed", seed as f64, [0.0, LARGEST_SEED], "")?;
        let (variants, purpose) = match (visibility, &self.hidden) {
            (Visibility::Visible, _) => (&self.visible, Purpose::VisibleVariant),
            (Visibility::Hidden, Some(hidden)) => (hidden, Purpose::HiddenVariant),
            (Visibility::Hidden, None) => return Err(conflict("/hidden", "this document has no such variants".into())),
        };
        let mut base = self.tree.clone();
        for (own, document) in self.moves.iter().zip(&self.document.moves) {
            for change in &own.changes {
                // Checked above: there is a value for every move.
                let value = gains.get(&document.name).copied().unwrap_or(document.start);
                base.apply(change, value).map_err(|error| blamed(error, &document.name))?;
            }
        }
        // What the student's numbers make of the scenario itself is wrong before the first draw.
        base.scenario().map_err(|error| error.within("/gains/scenario"))?;
        let scenario = |n| {
            let tree = variants.draw(&base, seed, purpose, n)?;
            tree.scenario().map_err(|error| error.within("/scenario"))
        };
        (0..u64::from(variants.count)).map(scenario).collect()
    }
}

/// An error of a field, put where the student's number is.
fn blamed(mut error: ScenarioError, name: &str) -> ScenarioError {
    error.pointer = format!("/gains/{name}");
    error
}

impl Variants {
    /// Variant `n`: a stream of its own, whatever the others are.
    fn draw(&self, base: &Tree, seed: u64, purpose: Purpose, n: u64) -> Result<Tree, ScenarioError> {
        let mut tree = base.clone();
        let mut stream = Stream::new(seed, purpose, n);
        for (change, distribution) in self.changes.iter().zip(&self.distributions) {
            tree.apply(change, distribution.quantile(stream.unit())).map_err(|error| error.within("/scenario"))?;
        }
        if self.vary_seed {
            tree.set_seed(stream.seed());
        }
        Ok(tree)
    }
}
