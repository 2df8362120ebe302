//! The paper's numbers, and ours beside them.

use super::of;
use crate::scenario::{Run, Scheme};
use serde::Serialize;

/// Performance index of the tracking errors, labelled deg, joints 1 to 3. Source: paper Table 1.
pub const TABLE_1_DEG: [(Scheme, [f64; 3]); 3] = [
    (Scheme::Proposed, [0.0004, 0.0351, 0.00004]),
    (Scheme::TangArteaga, [0.0011, 0.0334, 0.0033]),
    (Scheme::SlotineLi, [0.0016, 0.0180, 0.0086]),
];

/// Performance index of the velocity errors, labelled deg/s, joints 1 to 3. Source: paper Table 2.
pub const TABLE_2_DEG_S: [(Scheme, [f64; 3]); 3] = [
    (Scheme::Proposed, [0.0037, 0.3350, 0.0023]),
    (Scheme::TangArteaga, [0.0504, 0.3228, 0.0222]),
    (Scheme::SlotineLi, [0.0174, 0.1501, 0.0244]),
];

/// Bounds of the observer errors, deg, joints 1 to 3. Source: paper section 4.3.
pub const OBSERVER_PEAKS_DEG: [f64; 3] = [0.023, 0.027, 0.019];

/// One number beside the paper's.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct TableEntry {
    /// Ours.
    pub ours: f64,
    /// The paper's.
    pub paper: f64,
    /// Ours divided by the paper's.
    pub ratio: f64,
}

/// A table of performance indices.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct IndexTable {
    /// Number in the paper.
    pub number: u8,
    /// What it lists.
    pub title: &'static str,
    /// Unit.
    pub unit: &'static str,
    /// Scheme's identifier, its name, and an entry per joint.
    pub rows: Vec<(&'static str, &'static str, [TableEntry; 3])>,
}

/// Table 1 beside ours.
pub fn table_1(runs: &[Run; 3]) -> IndexTable {
    table(1, "Performance index of the tracking errors", "°", &TABLE_1_DEG, |run| &run.report.metrics.index_e_deg, runs)
}

/// Table 2 beside ours.
pub fn table_2(runs: &[Run; 3]) -> IndexTable {
    table(
        2,
        "Performance index of the velocity errors",
        "°/s",
        &TABLE_2_DEG_S,
        |run| &run.report.metrics.index_de_deg_s,
        runs,
    )
}

fn table(
    number: u8,
    title: &'static str,
    unit: &'static str,
    paper: &[(Scheme, [f64; 3]); 3],
    index: impl Fn(&Run) -> &Vec<f64>,
    runs: &[Run; 3],
) -> IndexTable {
    let rows = paper.iter().map(|(scheme, paper)| {
        let ours = index(of(runs, *scheme));
        let entry =
            |joint: usize| TableEntry { ours: ours[joint], paper: paper[joint], ratio: ours[joint] / paper[joint] };
        (scheme.id(), scheme.name(), [entry(0), entry(1), entry(2)])
    });
    IndexTable { number, title, unit, rows: rows.collect() }
}
