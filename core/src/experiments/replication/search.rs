//! The search laid out: which simulations there are, and what is kept of each.
//!
//! A combination takes one option of every unknown. A scheme that an unknown does not concern is not simulated again for its
//! options, and horizons, windows and units are cut from the samples of one simulation.

use super::document::{ReplicationDocument, UnknownDocument, WindowDocument};
use super::findings::{Findings, Horizon, HorizonFindings, JOINTS};
use crate::experiments::experiment::Base;
use crate::experiments::fields::Tree;
use crate::experiments::layout::Place;
use crate::experiments::limits::conflict;
use crate::experiments::row::{ResultColumns, Row};
use crate::scenario::{Run, Scenario, ScenarioError, Scheme};
use ciborium::Value;
use std::ops::Range;

/// An unknown, checked.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Unknown {
    /// Whether it concerns each scheme of [`Scheme::ALL`].
    pub concerns: [bool; 3],
    /// What each option changes.
    pub options: Vec<Option<Value>>,
}

/// A search for the settings behind the paper's numbers.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::experiments) struct Search {
    pub(super) unknowns: Vec<Unknown>,
    /// In samples.
    pub(super) horizons: Vec<usize>,
    pub(super) windows: Vec<WindowDocument>,
    /// Most steps that an option gives a base's run.
    pub steps: u64,
}

impl Search {
    /// Checks a section and lays it out.
    pub fn new(document: &ReplicationDocument, bases: &[Base]) -> Result<Self, ScenarioError> {
        super::validate::search(document, bases)
    }

    /// How many combinations of options there are.
    pub fn combinations(&self) -> u64 {
        self.unknowns.iter().fold(1, |count: u64, unknown| count.saturating_mul(unknown.options.len() as u64))
    }

    /// How many of them differ for a scheme.
    fn own_combinations(&self, base: usize) -> u64 {
        let concerning = self.unknowns.iter().filter(|unknown| unknown.concerns[base]);
        concerning.fold(1, |count: u64, unknown| count.saturating_mul(unknown.options.len() as u64))
    }

    /// How many simulations there are: scheme by scheme.
    pub fn runs(&self) -> u64 {
        (0..3).fold(0, |runs: u64, base| runs.saturating_add(self.own_combinations(base)))
    }

    /// The option of every unknown in a combination; the last unknown changes fastest.
    pub fn options(&self, combination: u64) -> Vec<usize> {
        let mut rest = combination;
        let mut options = vec![0; self.unknowns.len()];
        for (option, unknown) in options.iter_mut().zip(&self.unknowns).rev() {
            let count = unknown.options.len() as u64;
            *option = (rest % count) as usize;
            rest /= count;
        }
        options
    }

    /// The simulation of a scheme in a combination.
    pub fn index(&self, options: &[usize], base: usize) -> u64 {
        let before: u64 = (0..base).map(|base| self.own_combinations(base)).sum();
        let concerning = options.iter().zip(&self.unknowns).filter(|(_, unknown)| unknown.concerns[base]);
        before + concerning.fold(0, |rank, (option, unknown)| rank * unknown.options.len() as u64 + *option as u64)
    }

    /// Which simulation that is: of combinations that share it, the one with first options.
    pub fn place(&self, index: u64) -> Place {
        let (mut base, mut rank) = (0, index);
        while rank >= self.own_combinations(base) && base < 2 {
            rank -= self.own_combinations(base);
            base += 1;
        }
        let (mut point, mut weight) = (0, 1);
        for unknown in self.unknowns.iter().rev() {
            let count = unknown.options.len() as u64;
            if unknown.concerns[base] {
                point += weight * (rank % count);
                rank /= count;
            }
            weight *= count;
        }
        Place { point, condition: 0, base }
    }

    /// The scenario of a simulation.
    pub fn scenario(&self, bases: &[Base], index: u64) -> Result<Scenario, ScenarioError> {
        let place = self.place(index);
        let base = &bases[place.base];
        let mut tree = base.tree.clone();
        for (option, unknown) in self.options(place.point).into_iter().zip(&self.unknowns) {
            if let Some(change) = &unknown.options[option] {
                tree.merge(change);
            }
        }
        changed(&tree, base)
    }

    /// Names of the numbers that are kept of a simulation.
    pub fn columns(&self, document: &ReplicationDocument) -> ResultColumns {
        let mut names = Vec::new();
        for horizon_s in &document.horizons_s {
            for window in &self.windows {
                for name in ["index_e_deg", "index_de_deg_s"] {
                    let joint = |joint| format!("{horizon_s} s, {}: {name}_{joint}", window.name);
                    names.extend((1..=JOINTS).map(joint));
                }
            }
            names.extend(HorizonFindings::names().into_iter().map(|name| format!("{horizon_s} s: {name}")));
        }
        ResultColumns::of_replication(names)
    }

    /// What is kept of a simulation; of one that diverged, the horizons before that.
    pub fn row(&self, index: u64, run: &Run) -> Row {
        let observed = run.report.metrics.z_peak_deg.is_some();
        let mut metrics = Vec::new();
        for &samples in &self.horizons {
            if run.recording.len() <= samples {
                metrics.resize(metrics.len() + self.width(), None);
                continue;
            }
            let horizon = Horizon { recording: &run.recording, samples };
            for window in &self.windows {
                let indices = horizon.indices(&horizon.range(window.from, window.to));
                metrics.extend(indices.into_iter().flatten().map(|index| index.is_finite().then_some(index)));
            }
            metrics.extend(horizon.findings(observed, &run.report.theta_true).numbers());
        }
        Row::with(index, &run.report, metrics)
    }

    /// Numbers per horizon.
    fn width(&self) -> usize {
        2 * JOINTS * self.windows.len() + HorizonFindings::names().len()
    }

    /// What a row says up to a horizon with indices over a window.
    pub fn findings(&self, row: &Row, horizon: usize, window: usize) -> Option<Findings> {
        let width = self.width();
        let numbers = row.metrics.get(horizon * width..(horizon + 1) * width)?;
        let (indices, rest) = numbers.split_at(2 * JOINTS * self.windows.len());
        let indices = |range: Range<usize>| -> Option<Vec<f64>> { indices[range].iter().copied().collect() };
        let start = 2 * JOINTS * window;
        Some(Findings {
            index_e_deg: indices(start..start + JOINTS)?.try_into().ok()?,
            index_de_deg_s: indices(start + JOINTS..start + 2 * JOINTS)?.try_into().ok()?,
            horizon: HorizonFindings::read(rest),
        })
    }
}

/// The scenario of a changed tree, which still is of its base's scheme and has its base's samples.
pub(super) fn changed(tree: &Tree, base: &Base) -> Result<Scenario, ScenarioError> {
    let scenario = tree.merged_scenario()?;
    let (settings, wanted) = (scenario.settings(), base.scenario.settings());
    if scenario.scheme() != base.scenario.scheme() || scenario.robot().id != base.scenario.robot().id {
        return Err(conflict("/scheme", "an option changes neither robot nor scheme".to_owned()));
    }
    if settings.duration_s != wanted.duration_s || settings.samples != wanted.samples {
        return Err(conflict("/recording", "an option changes neither duration nor samples: horizons do".to_owned()));
    }
    Ok(scenario)
}

/// Whether an unknown concerns each of the study's schemes; `Err` is a name that is none of them.
pub(super) fn concerns(unknown: &UnknownDocument) -> Result<[bool; 3], &str> {
    let Some(schemes) = &unknown.schemes else { return Ok([true; 3]) };
    if let Some(other) = schemes.iter().find(|name| !Scheme::ALL.iter().any(|scheme| scheme.id() == name.as_str())) {
        return Err(other);
    }
    Ok(Scheme::ALL.map(|scheme| schemes.iter().any(|name| name == scheme.id())))
}
