//! What a replication says so far: the best readings, the paper's entries one by one, the unknowns option by option, and how
//! the claims fare over the plausible readings.
//!
//! A pure function of the rows that there are.

use super::claims::{CRITERIA, TestedClaim};
use super::document::ReplicationDocument;
use super::entries::{Entry, entries};
use super::passes::{Found, Names, Nearest, Plausible, is_reached, names, nearest, options, plausible};
use super::readings::DISTANCE;
use super::search::Search;
use crate::experiments::document::ExperimentKind;
use crate::experiments::experiment::Experiment;
use crate::experiments::results::Results;
use crate::experiments::row::RowOutcome;
use crate::experiments::row_store::RowStoreError;
use serde::{Deserialize, Serialize};

/// Summary of a replication.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ReplicationSummary {
    /// `adaptarm.replication_summary/1`.
    pub format: String,
    /// Version of the core that computed it.
    pub core_version: String,
    /// Hash of the experiment.
    pub experiment_hash: String,
    /// What was asked.
    pub kind: ExperimentKind,
    /// For people.
    pub title: String,
    /// Simulations planned.
    pub runs: u64,
    /// Simulations made so far.
    pub done: u64,
    /// Of these, given up before their end. Readings up to an earlier horizon still count.
    pub diverged: usize,
    /// Of these, not made: options that exclude each other.
    pub refused: usize,
    /// Readings that were asked for.
    pub readings: u64,
    /// Readings with a number for every entry.
    pub complete: u64,
    /// How the distance is defined.
    pub distance: String,
    /// An entry counts as reached within this factor.
    pub reached_factor: f64,
    /// A reading counts as plausible within this factor of the best distance.
    pub plausible_factor: f64,
    /// Plausible readings.
    pub plausible: u64,
    /// The reading with every first option, horizon, window and unit.
    pub first: Option<ReadingSummary>,
    /// The nearest readings, the best first.
    pub best: Vec<ReadingSummary>,
    /// The reading that reaches most entries at once, the nearest of those.
    pub most_reached: Option<ReadingSummary>,
    /// The paper's entries.
    pub entries: Vec<EntrySummary>,
    /// The unknowns, with duration, window and units as the last three.
    pub unknowns: Vec<UnknownSummary>,
    /// The paper's claims.
    pub claims: Vec<ClaimSummary>,
}

/// One reading.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ReadingSummary {
    /// Its distance.
    pub distance: f64,
    /// The name of its option for every unknown, in the order of [`ReplicationSummary::unknowns`].
    pub options: Vec<String>,
    /// Entries that it reaches.
    pub reached: usize,
    /// Its numbers, in the order and units of [`ReplicationSummary::entries`] as read.
    pub ours: Vec<f64>,
}

/// One of the paper's numbers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct EntrySummary {
    /// Where it stands.
    pub place: String,
    /// Identifier of its scheme.
    pub scheme: String,
    /// What it is.
    pub symbol: String,
    /// As printed.
    pub paper: f64,
    /// Least and greatest quotient of ours and the paper's over the plausible readings.
    pub plausible_ratio: Option<[f64; 2]>,
    /// The quotient nearest to 1 that any reading has.
    pub nearest_ratio: Option<f64>,
    /// Readings that reach it.
    pub reached_by: u64,
    /// Plausible readings that reach it.
    pub reached_by_plausible: u64,
}

/// An unknown.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct UnknownSummary {
    /// Its name.
    pub name: String,
    /// What it may be.
    pub options: Vec<OptionSummary>,
}

/// What an unknown may be.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct OptionSummary {
    /// Its name.
    pub name: String,
    /// Distance of the best reading with it.
    pub distance: Option<f64>,
    /// Plausible readings with it.
    pub plausible: u64,
}

/// A claim of the paper.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ClaimSummary {
    /// Identifier.
    pub id: String,
    /// The claim, in our words.
    pub claim: String,
    /// When we say that it holds.
    pub criterion: String,
    /// Whether it holds in the best reading.
    pub at_best: Option<bool>,
    /// Over the plausible readings.
    pub plausible: VerdictCounts,
}

/// Verdicts over a set of readings.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct VerdictCounts {
    /// Readings in which it holds.
    pub holds: u64,
    /// Readings in which it does not.
    pub does_not_hold: u64,
}

impl ReplicationSummary {
    /// Identifier of the format.
    pub const FORMAT: &'static str = "adaptarm.replication_summary/1";

    /// Of the rows that there are; `None` of other kinds.
    pub fn of(experiment: &Experiment, results: &Results) -> Result<Option<Self>, RowStoreError> {
        let (Some(search), Some(document)) = (experiment.search(), &experiment.document().replication) else {
            return Ok(None);
        };
        let names = names(document);
        let nearest = nearest(search, document, results, &names)?;
        let limit = nearest.best.first().map(|(_, best)| best.distance * document.plausible_factor);
        let plausible = plausible(search, document, results, &nearest, limit.unwrap_or(0.0), &names)?;
        let count = |outcome| results.outcomes().filter(|(_, it)| *it == outcome).count();
        let cuts = (document.horizons_s.len() * document.windows.len() * document.units.len()) as u64;
        let tell = |found: &Found| tell(search, document, &names, found);
        Ok(Some(Self {
            format: Self::FORMAT.to_owned(),
            core_version: crate::VERSION.to_owned(),
            experiment_hash: experiment.hash(),
            kind: experiment.kind(),
            title: experiment.document().title.clone(),
            runs: search.runs(),
            done: results.len() as u64,
            diverged: count(RowOutcome::Diverged),
            refused: count(RowOutcome::Refused),
            readings: search.combinations() * cuts,
            complete: nearest.complete,
            distance: DISTANCE.to_owned(),
            reached_factor: document.reached_factor,
            plausible_factor: document.plausible_factor,
            plausible: plausible.count,
            first: nearest.first.as_ref().map(tell),
            best: nearest.best.iter().map(tell).collect(),
            most_reached: nearest.most_reached.as_ref().map(|(_, found)| tell(found)),
            entries: entry_summaries(&nearest, &plausible),
            unknowns: unknown_summaries(&names, &nearest, &plausible),
            claims: claim_summaries(&plausible),
        }))
    }
}

fn tell(search: &Search, document: &ReplicationDocument, names: &Names, (reading, measured): &Found) -> ReadingSummary {
    let options = options(search, document, reading);
    let within = document.reached_factor;
    ReadingSummary {
        distance: measured.distance,
        options: names.iter().zip(options).map(|((_, names), option)| names[option].clone()).collect(),
        reached: measured.factors.iter().filter(|factor| is_reached(**factor, within)).count(),
        ours: measured.ours.clone(),
    }
}

fn entry_summaries(nearest: &Nearest, plausible: &Plausible) -> Vec<EntrySummary> {
    let summary = |(n, entry): (usize, &Entry)| EntrySummary {
        place: entry.place().to_owned(),
        scheme: entry.scheme.id().to_owned(),
        symbol: entry.symbol(),
        paper: entry.paper,
        plausible_ratio: plausible.ratios[n],
        nearest_ratio: nearest.entries[n].0.map(|(_, ratio)| ratio),
        reached_by: nearest.entries[n].1,
        reached_by_plausible: plausible.reached_by[n],
    };
    entries().iter().enumerate().map(summary).collect()
}

fn unknown_summaries(names: &Names, nearest: &Nearest, plausible: &Plausible) -> Vec<UnknownSummary> {
    let summary = |(n, (name, options)): (usize, &(String, Vec<String>))| {
        let option = |(m, name): (usize, &String)| OptionSummary {
            name: name.clone(),
            distance: nearest.options[n][m],
            plausible: plausible.options[n][m],
        };
        UnknownSummary { name: name.clone(), options: options.iter().enumerate().map(option).collect() }
    };
    names.iter().enumerate().map(summary).collect()
}

fn claim_summaries(plausible: &Plausible) -> Vec<ClaimSummary> {
    let summary = |(n, criterion): (usize, &TestedClaim)| ClaimSummary {
        id: criterion.id.to_owned(),
        claim: criterion.claim.to_owned(),
        criterion: criterion.criterion.to_owned(),
        at_best: plausible.at_best[n],
        plausible: plausible.verdicts[n],
    };
    CRITERIA.iter().enumerate().map(summary).collect()
}
