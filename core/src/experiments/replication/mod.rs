//! Replication of the paper's study: its tables beside ours, its claims tested, every assumption listed.
//!
//! Judges finished runs and renders nothing. What is judged holds for the settings of those runs only.

mod assumptions;
mod claims;
mod tables;

pub use assumptions::{Assumption, assumptions};
pub use claims::{Claim, Verdict, check_claims};
pub use tables::{IndexTable, OBSERVER_PEAKS_DEG, TABLE_1_DEG, TABLE_2_DEG_S, TableEntry, table_1, table_2};

use crate::scenario::{Run, Scenario, ScenarioDocument, ScenarioError, Scheme};

/// The study's three scenarios under the same settings, in the order of the paper's tables.
pub fn study(adjust: impl Fn(&mut ScenarioDocument)) -> Result<Vec<Scenario>, ScenarioError> {
    Scheme::ALL
        .into_iter()
        .map(|scheme| {
            let mut document = scheme.paper();
            adjust(&mut document);
            Scenario::new(document)
        })
        .collect()
}

/// The run of one scheme among a study's runs; they stand in the order of [`Scheme::ALL`].
fn of(runs: &[Run; 3], scheme: Scheme) -> &Run {
    match scheme {
        Scheme::Proposed => &runs[0],
        Scheme::TangArteaga => &runs[1],
        Scheme::SlotineLi => &runs[2],
        Scheme::Pd | Scheme::PdGravity | Scheme::ComputedTorque => {
            unreachable!("claims are about the study's schemes: {}", scheme.id())
        }
    }
}
