//! An experiment that has been checked: its runs can be planned, any range of them anywhere.
//!
//! What cannot be known without planning every run, a draw that makes a scenario which is not allowed, is an outcome of that
//! run: it is refused, counted and said, and never quietly replaced.

use super::document::{ExperimentDocument, ExperimentKind};
use super::fields::Tree;
use super::layout::{Layout, Place};
use super::replication::Search;
use super::resolve;
use super::row::{ResultColumns, Row};
use super::tuning::TuningPlan;
use crate::scenario::{ReadError, Run, Scenario, ScenarioError, read_document, run_each};
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
    /// What a paper leaves unsaid.
    Replicated(Search),
}

/// An experiment that has been checked.
#[derive(Debug, Clone, PartialEq)]
pub struct Experiment {
    pub(super) document: ExperimentDocument,
    pub(super) bases: Vec<Base>,
    pub(super) columns: ResultColumns,
    pub(super) work: Work,
    /// Integration steps of all runs.
    pub(super) steps: u64,
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
            Work::Replicated(search) => search.runs(),
        }
    }

    /// Integration steps of all runs, of a tuning or a replication at most (an adaptive method may take more).
    pub fn steps(&self) -> u64 {
        self.steps
    }

    pub(super) fn layout(&self) -> Option<&Layout> {
        match &self.work {
            Work::LaidOut(layout) => Some(layout),
            Work::Searched(_) | Work::Replicated(_) => None,
        }
    }

    pub(super) fn search(&self) -> Option<&Search> {
        match &self.work {
            Work::Replicated(search) => Some(search),
            Work::LaidOut(_) | Work::Searched(_) => None,
        }
    }

    /// Number of runs; `None` for a tuning, which asks for them generation by generation.
    pub fn runs(&self) -> Option<u64> {
        match &self.work {
            Work::LaidOut(layout) => Some(layout.runs()),
            Work::Replicated(search) => Some(search.runs()),
            Work::Searched(_) => None,
        }
    }

    /// Names of the conditions; empty for a tuning.
    pub fn condition_names(&self) -> Vec<&str> {
        match &self.work {
            Work::LaidOut(layout) => layout.conditions.iter().map(|condition| condition.name.as_str()).collect(),
            Work::Replicated(_) => vec!["nominal"],
            Work::Searched(_) => Vec::new(),
        }
    }

    /// The fields that vary from point to point, as JSON pointers; of a replication, its unknowns.
    pub fn fields(&self) -> Vec<&str> {
        let unknowns = self.document.replication.iter().flat_map(|section| &section.unknowns);
        let fields = self.layout().into_iter().flat_map(|layout| &layout.fields);
        fields.map(|field| field.pointer.as_str()).chain(unknowns.map(|unknown| unknown.name.as_str())).collect()
    }

    /// Point, condition and base of a run.
    pub fn place(&self, index: u64) -> Option<Place> {
        match &self.work {
            _ if index >= self.runs()? => None,
            Work::LaidOut(layout) => Some(layout.place(index)),
            Work::Replicated(search) => Some(search.place(index)),
            Work::Searched(_) => None,
        }
    }

    /// Values of the fields at a point, in the order of [`Experiment::fields`]; factors where a field is relative, and the
    /// numbers of a replication's options, from 0.
    pub fn values(&self, point: u64) -> Vec<f64> {
        match &self.work {
            Work::LaidOut(layout) => layout.design.values(layout.seed, point),
            Work::Replicated(search) => search.options(point).into_iter().map(|option| option as f64).collect(),
            Work::Searched(_) => Vec::new(),
        }
    }

    /// The runs of a range; those that there are not are left out. Needs no other run.
    pub fn plan(&self, range: Range<u64>) -> Vec<PlannedRun> {
        let scenario = |index| match &self.work {
            Work::LaidOut(layout) => Some(self.scenario(layout, index)),
            Work::Replicated(search) => Some(search.scenario(&self.bases, index)),
            Work::Searched(_) => None,
        };
        let last = range.end.min(self.runs().unwrap_or(0));
        (range.start..last).filter_map(|index| Some(PlannedRun { index, scenario: scenario(index)? })).collect()
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
        tree.scenario()
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
        run_each(&scenarios, |n, run| each(self.row(indices[n], &run)))
    }

    /// What is kept of a run that was made.
    pub fn row(&self, index: u64, run: &Run) -> Row {
        match &self.work {
            Work::Replicated(search) => search.row(index, run),
            Work::LaidOut(_) | Work::Searched(_) => Row::of(index, &self.columns, &run.report),
        }
    }

    /// What is kept of a run whose scenario is not allowed.
    pub fn refused(&self, index: u64, why: &ScenarioError) -> Row {
        Row::refused(index, &self.columns, why.to_string())
    }
}
