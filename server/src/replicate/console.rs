//! The replication on the terminal: plain text that survives being piped into a file.

use super::Replication;
use adaptarm_core::experiments::replication::{IndexTable, OBSERVER_PEAKS_DEG, Verdict};
use anyhow::Result;
use std::fmt::Write as _;
use std::io::Write as _;

/// Prints everything but the figures.
pub(super) fn print(replication: &Replication) -> Result<()> {
    let mut text = String::new();
    compose(replication, &mut text)?;
    print_line(text.trim_end())
}

/// Prints a line; a reader that has gone away is no error.
pub(super) fn print_line(line: &str) -> Result<()> {
    match writeln!(std::io::stdout(), "{line}") {
        Err(error) if error.kind() == std::io::ErrorKind::BrokenPipe => Ok(()),
        other => Ok(other?),
    }
}

fn compose(replication: &Replication, text: &mut String) -> std::fmt::Result {
    writeln!(text, "Replication of the study: {}\n", replication.settings())?;
    for report in &replication.reports {
        if let (Some(at_s), Some(reason)) = (report.at_s, &report.reason) {
            writeln!(text, "{} DIVERGED at {at_s} s: {reason}\n", report.scheme)?;
        }
    }
    for table in &replication.tables {
        compose_table(table, text)?;
    }
    if let Some(peaks) = &replication.runs[0].report.metrics.z_peak_deg {
        writeln!(text, "Peak observer error [°], proposed scheme (K_d is calibrated to the paper's: no evidence)")?;
        for (joint, (ours, paper)) in peaks.iter().zip(OBSERVER_PEAKS_DEG).enumerate() {
            writeln!(text, "  z{}  ours {ours:.5}  paper {paper:.3}  ratio {:.3}", joint + 1, ours / paper)?;
        }
        writeln!(text)?;
    }
    writeln!(text, "Claims of the paper under these settings")?;
    for claim in &replication.claims {
        let verdict = match claim.verdict {
            Verdict::Holds => "HOLDS        ",
            Verdict::DoesNotHold => "DOES NOT HOLD",
        };
        writeln!(text, "  {verdict}  {}", claim.claim)?;
        writeln!(text, "                 criterion: {}", claim.criterion)?;
        writeln!(text, "                 found: {}", claim.evidence)?;
    }
    writeln!(text, "\nAssumptions")?;
    for assumption in replication.assumptions {
        writeln!(text, "  {}: paper {}; here {}", assumption.about, assumption.paper, assumption.here)?;
    }
    writeln!(text)
}

fn compose_table(table: &IndexTable, text: &mut String) -> std::fmt::Result {
    writeln!(text, "Table {}. {} [{}]", table.number, table.title, table.unit)?;
    writeln!(text, "  {:<18}{:>7}{:>12}{:>12}{:>10}", "", "joint", "ours", "paper", "ratio")?;
    for (_, name, entries) in &table.rows {
        for (joint, entry) in entries.iter().enumerate() {
            let name = if joint == 0 { name } else { "" };
            writeln!(
                text,
                "  {name:<18}{:>7}{:>12.5}{:>12.5}{:>10.1}",
                joint + 1,
                entry.ours,
                entry.paper,
                entry.ratio
            )?;
        }
    }
    writeln!(text)
}
