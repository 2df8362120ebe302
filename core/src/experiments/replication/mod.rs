//! Replication of the paper's study: its tables beside ours, its claims tested, every assumption listed, and what it leaves
//! unsaid searched against its numbers.
//!
//! Judges finished runs and renders nothing. What is judged holds for the settings of those runs only.

mod assumptions;
mod claims;
mod document;
mod entries;
mod findings;
mod passes;
mod readings;
mod search;
mod summary;
mod tables;
mod validate;

pub use assumptions::{Assumption, assumptions};
pub use claims::{Claim, Verdict, check_claims};
pub use document::{OptionDocument, ReplicationDocument, UnitsDocument, UnknownDocument, WindowDocument};
pub use summary::{
    ClaimSummary, EntrySummary, OptionSummary, ReadingSummary, ReplicationSummary, UnknownSummary, VerdictCounts,
};
pub use tables::{IndexTable, OBSERVER_PEAKS_DEG, TABLE_1_DEG, TABLE_2_DEG_S, TableEntry, table_1, table_2};

pub(super) use search::Search;

use crate::scenario::{Scenario, ScenarioDocument, ScenarioError, Scheme};

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

/// What belongs to one scheme among what stands in the order of [`Scheme::ALL`].
fn of<T>(study: &[T; 3], scheme: Scheme) -> &T {
    match scheme {
        Scheme::Proposed => &study[0],
        Scheme::TangArteaga => &study[1],
        Scheme::SlotineLi => &study[2],
        Scheme::Pd | Scheme::PdGravity | Scheme::ComputedTorque => {
            unreachable!("claims are about the study's schemes: {}", scheme.id())
        }
    }
}
