//! Two passes over all readings: the first finds those nearest to the paper, the second those that are plausible beside them,
//! with what the paper's claims are worth there.

use super::claims::{CRITERIA, Study};
use super::document::{OptionDocument, ReplicationDocument};
use super::entries::{Entry, entries};
use super::readings::{Measured, Reading, each_reading};
use super::search::Search;
use super::summary::VerdictCounts;
use crate::experiments::results::Results;
use crate::experiments::row_store::RowStoreError;

/// Readings told in full.
const SHOWN: usize = 10;

/// Every unknown with its options: those that are simulated, then horizons, windows and units.
pub(super) type Names = [(String, Vec<String>)];

/// A reading with its numbers.
pub(super) type Found = (Reading, Measured);

/// What the first pass finds.
#[derive(Default)]
pub(super) struct Nearest {
    pub complete: u64,
    pub first: Option<Found>,
    pub best: Vec<Found>,
    pub most_reached: Option<(usize, Found)>,
    /// Per entry: the quotient nearest to 1 with its factor, and how many readings reach it.
    pub entries: Vec<(Option<(f64, f64)>, u64)>,
    /// Per unknown and option.
    pub options: Vec<Vec<Option<f64>>>,
}

/// What the second pass finds.
pub(super) struct Plausible {
    pub count: u64,
    pub ratios: Vec<Option<[f64; 2]>>,
    pub reached_by: Vec<u64>,
    pub options: Vec<Vec<u64>>,
    pub verdicts: Vec<VerdictCounts>,
    pub at_best: Vec<Option<bool>>,
}

/// The names of a search.
pub(super) fn names(document: &ReplicationDocument) -> Vec<(String, Vec<String>)> {
    let option = |option: &OptionDocument| option.name.clone();
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
pub(super) fn options(search: &Search, document: &ReplicationDocument, reading: &Reading) -> Vec<usize> {
    let mut options = search.options(reading.combination);
    let units = document.units.iter().position(|units| *units == reading.units);
    options.extend([reading.horizon, reading.window, units.unwrap_or(0)]);
    options
}

pub(super) fn is_reached(factor: f64, within: f64) -> bool {
    (1.0 / within..=within).contains(&factor)
}

/// How large a factor is, whichever way.
fn size(factor: f64) -> f64 {
    factor.max(1.0 / factor)
}

pub(super) fn nearest(
    search: &Search,
    document: &ReplicationDocument,
    results: &Results,
    names: &Names,
) -> Result<Nearest, RowStoreError> {
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
    })?;
    Ok(found)
}

pub(super) fn plausible(
    search: &Search,
    document: &ReplicationDocument,
    results: &Results,
    nearest: &Nearest,
    limit: f64,
    names: &Names,
) -> Result<Plausible, RowStoreError> {
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
    })?;
    Ok(found)
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
