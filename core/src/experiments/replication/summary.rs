//! What a replication says so far: the best readings, the paper's entries one by one, the unknowns option by option, and how
//! the claims fare over the plausible readings.
//!
//! A pure function of the rows that there are. Two passes over all readings; the first finds the best, the second those that
//! are plausible beside it.

use super::claims::{CRITERIA, Study};
use super::document::ReplicationDocument;
use super::entries::{Entry, entries};
use super::readings::{DISTANCE, Measured, Reading, each_reading};
use super::search::Search;
use crate::experiments::document::ExperimentKind;
use crate::experiments::experiment::Experiment;
use crate::experiments::results::Results;
use crate::experiments::row::RowOutcome;
use serde::{Deserialize, Serialize};

/// Readings told in full.
const SHOWN: usize = 10;

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

/// A reading with its numbers.
type Found = (Reading, Measured);

/// What the first pass finds.
#[derive(Default)]
struct Nearest {
    complete: u64,
    first: Option<Found>,
    best: Vec<Found>,
    most_reached: Option<(usize, Found)>,
    /// Per entry: the quotient nearest to 1 with its factor, and how many readings reach it.
    entries: Vec<(Option<(f64, f64)>, u64)>,
    /// Per unknown and option.
    options: Vec<Vec<Option<f64>>>,
}

/// What the second pass finds.
struct Plausible {
    count: u64,
    ratios: Vec<Option<[f64; 2]>>,
    reached_by: Vec<u64>,
    options: Vec<Vec<u64>>,
    verdicts: Vec<VerdictCounts>,
    at_best: Vec<Option<bool>>,
}

impl ReplicationSummary {
    /// Identifier of the format.
    pub const FORMAT: &'static str = "adaptarm.replication_summary/1";

    /// Of the rows that there are; `None` of other kinds.
    pub fn of(experiment: &Experiment, results: &Results) -> Option<Self> {
        let (search, document) = (experiment.search()?, experiment.document().replication.as_ref()?);
        let names = names(document);
        let nearest = nearest(search, document, results, &names);
        let limit = nearest.best.first().map(|(_, best)| best.distance * document.plausible_factor);
        let plausible = plausible(search, document, results, &nearest, limit.unwrap_or(0.0), &names);
        let count = |outcome| results.rows().filter(|row| row.outcome == outcome).count();
        let cuts = (document.horizons_s.len() * document.windows.len() * document.units.len()) as u64;
        let tell = |found: &Found| tell(search, document, &names, found);
        Some(Self {
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
        })
    }
}

/// Every unknown with its options: those that are simulated, then horizons, windows and units.
fn names(document: &ReplicationDocument) -> Vec<(String, Vec<String>)> {
    let option = |option: &super::document::OptionDocument| option.name.clone();
    let mut names: Vec<_> = document
        .unknowns
        .iter()
        .map(|unknown| (unknown.name.clone(), unknown.options.iter().map(option).collect()))
        .collect();
    let horizons = document.horizons_s.iter().map(|horizon_s| format!("{horizon_s} s"));
    names.push(("duration".to_owned(), horizons.collect()));
    names.push(("window of the index".to_owned(), document.windows.iter().map(|it| it.name.clone()).collect()));
    names.push(("units".to_owned(), document.units.iter().map(|units| units.name().to_owned()).collect()));
    names
}

/// The option of every unknown in a reading, in the order of [`names`].
fn options(search: &Search, document: &ReplicationDocument, reading: &Reading) -> Vec<usize> {
    let mut options = search.options(reading.combination);
    let units = document.units.iter().position(|units| *units == reading.units);
    options.extend([reading.horizon, reading.window, units.unwrap_or(0)]);
    options
}

fn is_reached(factor: f64, within: f64) -> bool {
    (1.0 / within..=within).contains(&factor)
}

/// How large a factor is, whichever way.
fn size(factor: f64) -> f64 {
    factor.max(1.0 / factor)
}

fn nearest(
    search: &Search,
    document: &ReplicationDocument,
    results: &Results,
    names: &[(String, Vec<String>)],
) -> Nearest {
    let entries = entries();
    let mut found = Nearest {
        entries: vec![(None, 0); entries.len()],
        options: names.iter().map(|(_, options)| vec![None; options.len()]).collect(),
        ..Nearest::default()
    };
    each_reading(search, document, results, |reading, _, measured| {
        let options = options(search, document, &reading);
        found.complete += 1;
        let mut reached = 0;
        for ((nearest, reached_by), (factor, (ours, entry))) in
            found.entries.iter_mut().zip(measured.factors.iter().zip(measured.ours.iter().zip(&entries)))
        {
            if nearest.is_none_or(|(earlier, _)| size(*factor) < size(earlier)) {
                *nearest = Some((*factor, ours / entry.paper));
            }
            let is_reached = is_reached(*factor, document.reached_factor);
            *reached_by += u64::from(is_reached);
            reached += usize::from(is_reached);
        }
        for (distances, option) in found.options.iter_mut().zip(&options) {
            let least = &mut distances[*option];
            if least.is_none_or(|least| measured.distance < least) {
                *least = Some(measured.distance);
            }
        }
        if options.iter().all(|option| *option == 0) {
            found.first = Some((reading, measured.clone()));
        }
        let more = found.most_reached.as_ref().is_none_or(|(most, (_, earlier))| {
            reached > *most || (reached == *most && measured.distance < earlier.distance)
        });
        if more {
            found.most_reached = Some((reached, (reading, measured.clone())));
        }
        // Equally near readings stay in the order of their visit.
        let place = found.best.partition_point(|(_, better)| better.distance <= measured.distance);
        if place < SHOWN {
            found.best.insert(place, (reading, measured));
            found.best.truncate(SHOWN);
        }
    });
    found
}

fn plausible(
    search: &Search,
    document: &ReplicationDocument,
    results: &Results,
    nearest: &Nearest,
    limit: f64,
    names: &[(String, Vec<String>)],
) -> Plausible {
    let entries = entries();
    let mut found = Plausible {
        count: 0,
        ratios: vec![None; entries.len()],
        reached_by: vec![0; entries.len()],
        options: names.iter().map(|(_, options)| vec![0; options.len()]).collect(),
        verdicts: vec![VerdictCounts::default(); CRITERIA.len()],
        at_best: vec![None; CRITERIA.len()],
    };
    let best = nearest.best.first().map(|(reading, _)| *reading);
    each_reading(search, document, results, |reading, study, measured| {
        if measured.distance <= limit {
            found.take(&options(search, document, &reading), &entries, study, &measured, document.reached_factor);
            if best == Some(reading) {
                found.at_best = CRITERIA.iter().map(|criterion| Some((criterion.test)(study).0)).collect();
            }
        }
    });
    found
}

impl Plausible {
    fn take(&mut self, options: &[usize], entries: &[Entry], study: &Study, measured: &Measured, within: f64) {
        self.count += 1;
        for (n, entry) in entries.iter().enumerate() {
            let ratio = measured.ours[n] / entry.paper;
            let [least, most] = self.ratios[n].unwrap_or([ratio, ratio]);
            self.ratios[n] = Some([least.min(ratio), most.max(ratio)]);
            self.reached_by[n] += u64::from(is_reached(measured.factors[n], within));
        }
        for (counts, option) in self.options.iter_mut().zip(options) {
            counts[*option] += 1;
        }
        for (counts, criterion) in self.verdicts.iter_mut().zip(&CRITERIA) {
            let count = if (criterion.test)(study).0 { &mut counts.holds } else { &mut counts.does_not_hold };
            *count += 1;
        }
    }
}

fn tell(
    search: &Search,
    document: &ReplicationDocument,
    names: &[(String, Vec<String>)],
    (reading, measured): &Found,
) -> ReadingSummary {
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

fn unknown_summaries(
    names: &[(String, Vec<String>)],
    nearest: &Nearest,
    plausible: &Plausible,
) -> Vec<UnknownSummary> {
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
    let summary = |(n, criterion): (usize, &super::claims::Criterion)| ClaimSummary {
        id: criterion.id.to_owned(),
        claim: criterion.claim.to_owned(),
        criterion: criterion.criterion.to_owned(),
        at_best: plausible.at_best[n],
        plausible: plausible.verdicts[n],
    };
    CRITERIA.iter().enumerate().map(summary).collect()
}
