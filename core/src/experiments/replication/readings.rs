//! Every reading of the paper: a combination of options, a horizon, a window and units; and how far it is from the numbers.
//!
//! The distance of a reading is the typical factor between its numbers and the paper's: `exp` of the root mean square of the
//! logarithms of all entries' factors. It is 1 where every number rounds to the paper's.

use super::claims::Study;
use super::document::{ReplicationDocument, UnitsDocument};
use super::entries::{Entry, entries};
use super::search::Search;
use crate::experiments::results::Results;
use crate::experiments::row::Row;
use crate::experiments::row_store::RowStoreError;
use crate::scalar::{exponential, logarithm};

/// How the distance is told.
pub(super) const DISTANCE: &str = "the typical factor between a reading's numbers and the paper's: exp of the root mean \
     square, over the 9 entries of Table 1, the 9 of Table 2 and the 3 observer peaks, of ln of the factor between ours and \
     the nearest number that rounds to the printed one";

/// One reading.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Reading {
    pub combination: u64,
    pub horizon: usize,
    pub window: usize,
    pub units: UnitsDocument,
}

/// A reading's numbers: one per entry of the paper.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Measured {
    pub ours: Vec<f64>,
    pub factors: Vec<f64>,
    pub distance: f64,
}

/// How far a study is from the paper's entries; `None` where one has no number.
pub(super) fn measure(entries: &[Entry], study: &Study, units: UnitsDocument) -> Option<Measured> {
    let ours: Vec<_> = entries.iter().map(|entry| entry.ours(study, units)).collect::<Option<_>>()?;
    let factors: Vec<_> = entries.iter().zip(&ours).map(|(entry, ours)| entry.factor(*ours)).collect();
    let squares = factors.iter().map(|factor| {
        let log = logarithm(*factor);
        log * log
    });
    let distance = exponential((squares.sum::<f64>() / factors.len() as f64).sqrt());
    distance.is_finite().then_some(Measured { ours, factors, distance })
}

/// Visits every reading whose numbers there are, always in the same order.
pub(super) fn each_reading(
    search: &Search,
    document: &ReplicationDocument,
    results: &Results,
    mut visit: impl FnMut(Reading, &Study, Measured),
) -> Result<(), RowStoreError> {
    let entries = entries();
    for combination in 0..search.combinations() {
        let Some(rows) = rows(search, results, combination)? else { continue };
        for horizon in 0..search.horizons.len() {
            for window in 0..search.windows.len() {
                let findings = |row| search.findings(row, horizon, window);
                let [Some(one), Some(two), Some(three)] = rows.each_ref().map(findings) else { continue };
                let study = [one, two, three];
                for &units in &document.units {
                    let Some(measured) = measure(&entries, &study, units) else { continue };
                    visit(Reading { combination, horizon, window, units }, &study, measured);
                }
            }
        }
    }
    Ok(())
}

/// The rows of the three schemes in a combination.
fn rows(search: &Search, results: &Results, combination: u64) -> Result<Option<[Row; 3]>, RowStoreError> {
    let options = search.options(combination);
    let row = |base| results.row(search.index(&options, base));
    Ok(match [row(0)?, row(1)?, row(2)?] {
        [Some(one), Some(two), Some(three)] => Some([one, two, three]),
        _ => None,
    })
}
