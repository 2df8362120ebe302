//! What a replication search found, as two dot plots: our numbers divided by the paper's, entry by entry, and the distance of
//! the best reading with each option of every unknown.

use super::super::dot_plot::{DotPlot, DotRow};
use crate::experiments::replication::{EntrySummary, OptionSummary, ReplicationSummary};
use crate::scenario::Scheme;

pub(super) fn entries(summary: &ReplicationSummary) -> DotPlot<'static> {
    let mut groups: Vec<(String, Vec<DotRow>)> = Vec::new();
    for (n, entry) in summary.entries.iter().enumerate() {
        let title = format!("{}: {}", entry.place, scheme(entry));
        if groups.last().is_none_or(|(last, _)| *last != title) {
            groups.push((title, Vec::new()));
        }
        let row = DotRow {
            label: format!("{}, paper {}", entry.symbol, entry.paper),
            span: entry.plausible_ratio,
            filled: summary.best.first().map(|best| best.ours[n] / entry.paper),
            open: summary.first.as_ref().map(|first| first.ours[n] / entry.paper),
        };
        if let Some((_, rows)) = groups.last_mut() {
            rows.push(row);
        }
    }
    DotPlot {
        axis: "ours / paper",
        legend: ["plausible readings", "best reading", "this program's usual reading"],
        groups,
        reference: 1.0,
    }
}

pub(super) fn unknowns(summary: &ReplicationSummary) -> DotPlot<'static> {
    let groups = summary.unknowns.iter().map(|unknown| {
        let row = |option: &OptionSummary| DotRow {
            label: option.name.clone(),
            filled: option.distance,
            ..DotRow::default()
        };
        (unknown.name.clone(), unknown.options.iter().map(row).collect())
    });
    DotPlot {
        axis: "distance of the best reading with this option (typical factor)",
        legend: ["", "best reading with this option", ""],
        groups: groups.collect(),
        reference: summary.best.first().map_or(1.0, |best| best.distance),
    }
}

fn scheme(entry: &EntrySummary) -> &'static str {
    Scheme::ALL.into_iter().find(|scheme| scheme.id() == entry.scheme).map_or("", Scheme::name)
}
