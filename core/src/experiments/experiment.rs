//! An experiment that has been checked: its runs can be planned, any range of them anywhere.
//!
//! What cannot be known without planning every run, a draw that makes a scenario which is not allowed, is an outcome of that
//! run: it is refused, counted and said, and never quietly replaced.

use super::document::{ExperimentDocument, ExperimentKind};
use super::fields::Tree;
use super::layout::{Layout, Place};
use super::limits::EXPERIMENT_LIMITS;
use super::resolve;
use super::row::{ResultColumns, Row};
use super::tuning::TuningPlan;
use crate::scenario::{Problem, ReadError, Report, Scenario, ScenarioError, read_document, run_each};
use serde::Deserializer;
use std::ops::{ControlFlow, Range};

/// A base scenario, checked.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Base {
    pub name: String,
    pub scenario: Scenario,
    pub tree: Tree,
}

/// What an experiment does.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Work {
    /// All runs are known from the start.
    LaidOut(Layout),
    /// Each generation follows from the one before.
    Searched(TuningPlan),
}

/// An experiment that has been checked.
#[derive(Debug, Clone, PartialEq)]
pub struct Experiment {
    pub(super) document: ExperimentDocument,
    pub(super) bases: Vec<Base>,
    pub(super) columns: ResultColumns,
    pub(super) work: Work,
}

/// A run to be made.
#[derive(Debug, Clone, PartialEq)]
pub struct PlannedRun {
    /// Its number.
    pub index: u64,
    /// Its scenario, or why there is none.
    pub scenario: Result<Scenario, ScenarioError>,
}

impl Experiment {
    /// Checks a document.
    pub fn new(document: ExperimentDocument) -> Result<Self, ScenarioError> {
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

    /// The document with every base filled in.
    pub fn document(&self) -> &ExperimentDocument {
        &self.document
    }

    /// What is asked.
    pub fn kind(&self) -> ExperimentKind {
        self.document.kind
    }

    /// Hash of the document's CBOR encoding: equal hashes mean equal experiments.
    pub fn hash(&self) -> String {
        let mut bytes = Vec::new();
        if ciborium::into_writer(&self.document, &mut bytes).is_err() {
            unreachable!("an experiment document always encodes");
        }
        blake3::hash(&bytes).to_hex().to_string()
    }

    /// Columns of the results.
    pub fn columns(&self) -> &ResultColumns {
        &self.columns
    }

    /// Names of the bases.
    pub fn base_names(&self) -> impl ExactSizeIterator<Item = &str> {
        self.bases.iter().map(|base| base.name.as_str())
    }

    /// Their scenarios.
    pub fn base_scenarios(&self) -> impl ExactSizeIterator<Item = &Scenario> {
        self.bases.iter().map(|base| &base.scenario)
    }

    /// Runs of all kinds at most: those that there are, or what a tuning may come to.
    pub fn most_runs(&self) -> u64 {
        match &self.work {
            Work::LaidOut(layout) => layout.runs(),
            Work::Searched(plan) => plan.most_runs(),
        }
    }

    pub(super) fn layout(&self) -> Option<&Layout> {
        match &self.work {
            Work::LaidOut(layout) => Some(layout),
            Work::Searched(_) => None,
        }
    }

    /// Number of runs; `None` for a tuning, which asks for them generation by generation.
    pub fn runs(&self) -> Option<u64> {
        self.layout().map(Layout::runs)
    }

    /// Names of the conditions; empty for a tuning.
    pub fn condition_names(&self) -> Vec<&str> {
        let conditions = self.layout().map_or(&[][..], |layout| &layout.conditions);
        conditions.iter().map(|condition| condition.name.as_str()).collect()
    }

    /// The fields that vary from point to point, as JSON pointers.
    pub fn fields(&self) -> Vec<&str> {
        let fields = self.layout().map_or(&[][..], |layout| &layout.fields);
        fields.iter().map(|field| field.pointer.as_str()).collect()
    }

    /// Point, condition and base of a run.
    pub fn place(&self, index: u64) -> Option<Place> {
        self.layout().filter(|layout| index < layout.runs()).map(|layout| layout.place(index))
    }

    /// Values of the fields at a point, in the order of [`Experiment::fields`]; factors where a field is relative.
    pub fn values(&self, point: u64) -> Vec<f64> {
        self.layout().map_or_else(Vec::new, |layout| layout.design.values(layout.seed, point))
    }

    /// The runs of a range; those that there are not are left out. Needs no other run.
    pub fn plan(&self, range: Range<u64>) -> Vec<PlannedRun> {
        let Some(layout) = self.layout() else { return Vec::new() };
        let last = range.end.min(layout.runs());
        (range.start..last).map(|index| PlannedRun { index, scenario: self.scenario(layout, index) }).collect()
    }

    fn scenario(&self, layout: &Layout, index: u64) -> Result<Scenario, ScenarioError> {
        let place = layout.place(index);
        let mut tree = self.bases[place.base].tree.clone();
        for (change, value) in &layout.conditions[place.condition].changes {
            tree.apply(change, *value)?;
        }
        for (change, value) in layout.fields.iter().zip(layout.design.values(layout.seed, place.point)) {
            tree.apply(change, value)?;
        }
        if let Some(seed) = layout.noise_seed(place.point) {
            tree.set_seed(seed);
        }
        bounded(tree.scenario()?, layout.runs())
    }

    /// Makes runs, as many side by side as the machine has lanes, and hands over what is kept of each; breaks off where
    /// `each` says so. A row's bits do not depend on which runs are made together.
    pub fn run(&self, planned: Vec<PlannedRun>, mut each: impl FnMut(Row) -> ControlFlow<()>) -> ControlFlow<()> {
        let (mut indices, mut scenarios) = (Vec::new(), Vec::new());
        for run in planned {
            match run.scenario {
                Ok(scenario) => {
                    indices.push(run.index);
                    scenarios.push(scenario);
                }
                Err(error) => each(self.refused(run.index, &error))?,
            }
        }
        run_each(&scenarios, |n, run| each(self.row(indices[n], &run.report)))
    }

    /// What is kept of a run that was made.
    pub fn row(&self, index: u64, report: &Report) -> Row {
        Row::of(index, &self.columns, report)
    }

    /// What is kept of a run whose scenario is not allowed.
    pub fn refused(&self, index: u64, why: &ScenarioError) -> Row {
        Row::refused(index, &self.columns, why.to_string())
    }
}

/// A scenario whose steps, times the number of runs, are within the limit.
pub(super) fn bounded(scenario: Scenario, runs: u64) -> Result<Scenario, ScenarioError> {
    let (steps, most) = (scenario.settings().steps() as f64, EXPERIMENT_LIMITS.steps);
    if steps * runs as f64 <= most {
        return Ok(scenario);
    }
    let message = format!("{steps} steps in each of {runs} runs are more than the {most:e} steps that are allowed");
    Err(ScenarioError::new("/integration", Problem::Conflict { message }))
}
