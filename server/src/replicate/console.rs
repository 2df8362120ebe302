//! The replication on the terminal: plain text that survives being piped into a file.

use super::{Replication, cells};
use crate::stdout;
use adaptarm_core::experiments::replication::{IndexTable, OBSERVER_PEAKS_DEG, Verdict};
use adaptarm_core::scenario::Scheme;
use anyhow::Result;
use std::fmt::Write as _;

/// Prints everything but the figures.
pub(super) fn print(replication: &Replication) -> Result<()> {
    let mut text = String::new();
    compose(replication, &mut text)?;
    Ok(stdout::print(&text)?)
}

fn compose(replication: &Replication, text: &mut String) -> std::fmt::Result {
    writeln!(text, "Replication of the study: {}\n", replication.settings())?;
    for report in &replication.reports {
        if let (Some(at_s), Some(reason)) = (report.at_s, &report.reason) {
            writeln!(text, "{} DIVERGED at {at_s:.4} s: {reason}\n", report.scheme)?;
        }
    }
    for table in &replication.tables {
        compose_table(replication, table, text)?;
    }
    if let Some(peaks) = &replication.runs[0].report.metrics.z_peak_deg {
        writeln!(text, "Peak observer error [°], proposed scheme (K_d is calibrated to the paper's: no evidence)")?;
        let diverged = replication.diverged(Scheme::Proposed.id());
        for (joint, (ours, paper)) in peaks.iter().zip(OBSERVER_PEAKS_DEG).enumerate() {
            let (cell, ratio) = (cells::ours(diverged, *ours), cells::ratio(diverged, ours / paper, 3));
            writeln!(text, "  z{}  ours {cell}  paper {paper:.3}  ratio {ratio}", joint + 1)?;
        }
        writeln!(text)?;
    }
    writeln!(text, "Claims of the paper under these settings")?;
    for claim in &replication.claims {
        let verdict = match claim.verdict {
            Verdict::Holds => "HOLDS        ",
            Verdict::DoesNotHold => "DOES NOT HOLD",
            Verdict::NotTested => "NOT TESTED   ",
        };
        writeln!(text, "  {verdict}  {}", claim.claim)?;
        writeln!(text, "                 criterion: {}", claim.criterion)?;
        writeln!(text, "                 found: {}", claim.evidence)?;
    }
    writeln!(text, "\nAssumptions")?;
    for assumption in &replication.assumptions {
        writeln!(text, "  {}: paper {}; here {}", assumption.about, assumption.paper, assumption.here)?;
    }
    Ok(())
}

fn compose_table(replication: &Replication, table: &IndexTable, text: &mut String) -> std::fmt::Result {
    writeln!(text, "Table {}. {} [{}]", table.number, table.title, table.unit)?;
    writeln!(text, "  {:<18}{:>7}{:>12}{:>12}{:>10}", "", "joint", "ours", "paper", "ratio")?;
    for (scheme, name, entries) in &table.rows {
        let diverged = replication.diverged(scheme);
        for (joint, entry) in entries.iter().enumerate() {
            let name = if joint == 0 { name } else { "" };
            writeln!(
                text,
                "  {name:<18}{:>7}{:>12}{:>12.5}{:>10}",
                joint + 1,
                cells::ours(diverged, entry.ours),
                entry.paper,
                cells::ratio(diverged, entry.ratio, 1)
            )?;
        }
    }
    writeln!(text)
}
