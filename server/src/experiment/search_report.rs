//! The report of a replication search for people, `report.md`.
//!
//! Search space and distance stand before results; nothing here decides anything.

use adaptarm_core::experiments::Experiment;
use adaptarm_core::experiments::replication::{EntrySummary, ReadingSummary, ReplicationDocument, ReplicationSummary};
use anyhow::{Context, Result};
use std::fmt::Write as _;

/// The report; its figures are files beside it.
pub(super) fn report(experiment: &Experiment, summary: &ReplicationSummary) -> Result<String> {
    let document = experiment.document().replication.as_ref().context("a replication has its section")?;
    let mut text = String::new();
    compose(experiment, document, summary, &mut text)?;
    Ok(text)
}

fn scheme(entry: &EntrySummary) -> &'static str {
    use adaptarm_core::scenario::Scheme;
    Scheme::ALL.into_iter().find(|scheme| scheme.id() == entry.scheme).map_or("", Scheme::name)
}

fn compose(
    experiment: &Experiment,
    document: &ReplicationDocument,
    summary: &ReplicationSummary,
    text: &mut String,
) -> Result<()> {
    writeln!(text, "# {}\n", if summary.title.is_empty() { "Replication search" } else { &summary.title })?;
    writeln!(
        text,
        "Written by `adaptarm experiment`, core {}; experiment `{}`.\n",
        summary.core_version, summary.experiment_hash
    )?;
    writeln!(text, "## What was searched\n")?;
    writeln!(
        text,
        "Everything that the paper leaves unsaid is an unknown; every combination of the options below is a reading of it."
    )?;
    writeln!(text, "The first option of each is what this program does otherwise.\n")?;
    writeln!(text, "| Unknown | Options | Simulated for |\n|---|---|---|")?;
    for (n, unknown) in summary.unknowns.iter().enumerate() {
        let options: Vec<_> = unknown.options.iter().map(|option| option.name.as_str()).collect();
        let concerned = match document.unknowns.get(n) {
            None => "nothing: read from the samples".to_owned(),
            Some(unknown) => unknown.schemes.as_ref().map_or("all schemes".to_owned(), |schemes| schemes.join(", ")),
        };
        writeln!(text, "| {} | {} | {concerned} |", unknown.name, options.join("; "))?;
    }
    let samples = experiment.document().bases.first().map(|base| {
        let (integration, recording) = (&base.scenario.integration, &base.scenario.recording);
        format!("{} s each, steps of {} s, {} samples", integration.duration_s, integration.step_s, recording.samples)
    });
    writeln!(
        text,
        "\n{} readings, from {} simulations ({}); {} of these diverged, {} were refused, and {} readings have a number for every entry.\n",
        summary.readings,
        summary.runs,
        samples.unwrap_or_default(),
        summary.diverged,
        summary.refused,
        summary.complete
    )?;
    writeln!(text, "**Distance** of a reading: {}.", summary.distance)?;
    writeln!(
        text,
        "An entry is *reached* within a factor of {}. A reading is *plausible* if its distance is at most {} times the best one's.\n",
        summary.reached_factor, summary.plausible_factor
    )?;
    readings(summary, text)?;
    entries(summary, text)?;
    unknowns(summary, text)?;
    claims(summary, text)
}

fn readings(summary: &ReplicationSummary, text: &mut String) -> Result<()> {
    writeln!(text, "## The nearest readings\n")?;
    let names: Vec<_> = summary.unknowns.iter().map(|unknown| unknown.name.as_str()).collect();
    writeln!(text, "| | Distance | Reached of {} | {} |", summary.entries.len(), names.join(" | "))?;
    writeln!(text, "|---|---|---|{}", "---|".repeat(names.len()))?;
    let mut row = |name: &str, reading: &ReadingSummary| {
        writeln!(text, "| {name} | {:.2} | {} | {} |", reading.distance, reading.reached, reading.options.join(" | "))
    };
    for (n, reading) in summary.best.iter().enumerate() {
        row(&(n + 1).to_string(), reading)?;
    }
    if let Some(reading) = &summary.most_reached {
        row("most entries reached", reading)?;
    }
    if let Some(reading) = &summary.first {
        row("first options", reading)?;
    }
    Ok(writeln!(text)?)
}

fn entries(summary: &ReplicationSummary, text: &mut String) -> Result<()> {
    writeln!(text, "## Entry by entry\n")?;
    writeln!(
        text,
        "Quotients of ours and the paper's number. *Nearest* is the best that any of all readings does for this entry alone.\n"
    )?;
    writeln!(text, "![Ours divided by the paper's, entry by entry](entries.svg)\n")?;
    writeln!(
        text,
        "| | Scheme | Entry | Paper | First options | Best reading | Plausible readings | Nearest | Reached by (plausible) |"
    )?;
    writeln!(text, "|---|---|---|---|---|---|---|---|---|")?;
    for (n, entry) in summary.entries.iter().enumerate() {
        let at = |reading: Option<&ReadingSummary>| {
            reading.map_or("–".to_owned(), |reading| quotient(reading.ours[n] / entry.paper))
        };
        let range =
            entry.plausible_ratio.map_or("–".to_owned(), |[a, b]| format!("{} to {}", quotient(a), quotient(b)));
        writeln!(
            text,
            "| {} | {} | {} | {} | {} | {} | {range} | {} | {} ({}) |",
            entry.place,
            scheme(entry),
            entry.symbol,
            entry.paper,
            at(summary.first.as_ref()),
            at(summary.best.first()),
            entry.nearest_ratio.map_or("–".to_owned(), quotient),
            entry.reached_by,
            entry.reached_by_plausible
        )?;
    }
    let names = |found: &dyn Fn(&EntrySummary) -> bool| {
        let names = summary.entries.iter().filter(|entry| found(entry));
        let names: Vec<_> = names.map(|entry| format!("{} of {}", entry.symbol, scheme(entry))).collect();
        if names.is_empty() { "none".to_owned() } else { names.join(", ") }
    };
    writeln!(text, "\nReached by **no reading at all**: {}.", names(&|entry| entry.reached_by == 0))?;
    let only_implausible = |entry: &EntrySummary| entry.reached_by > 0 && entry.reached_by_plausible == 0;
    writeln!(text, "Reached, but by **no plausible reading**: {}.", names(&only_implausible))?;
    if let Some(most) = &summary.most_reached {
        writeln!(text, "No reading reaches more than **{} of {}** at once.\n", most.reached, summary.entries.len())?;
    }
    Ok(())
}

/// Three digits.
fn quotient(value: f64) -> String {
    if !(0.01..99.5).contains(&value) {
        format!("{value:.1e}")
    } else if value >= 9.95 {
        format!("{value:.1}")
    } else {
        format!("{value:.2}")
    }
}

fn unknowns(summary: &ReplicationSummary, text: &mut String) -> Result<()> {
    writeln!(text, "## Unknown by unknown\n")?;
    writeln!(
        text,
        "The distance of the best reading with each option, whatever the others are, and the share of plausible readings with it.\n"
    )?;
    writeln!(text, "![Distance of the best reading with each option](unknowns.svg)\n")?;
    writeln!(text, "| Unknown | Option | Distance | Plausible |\n|---|---|---|---|")?;
    for unknown in &summary.unknowns {
        for option in &unknown.options {
            let distance = option.distance.map_or("–".to_owned(), |distance| format!("{distance:.2}"));
            let share = 100.0 * option.plausible as f64 / summary.plausible.max(1) as f64;
            writeln!(text, "| {} | {} | {distance} | {share:.0} % |", unknown.name, option.name)?;
        }
    }
    Ok(writeln!(text)?)
}

fn claims(summary: &ReplicationSummary, text: &mut String) -> Result<()> {
    writeln!(text, "## The paper's claims over the {} plausible readings\n", summary.plausible)?;
    writeln!(text, "Criteria are this program's; the paper states none.\n")?;
    writeln!(text, "| Claim | Holds when | Best reading | Plausible readings in which it holds |\n|---|---|---|---|")?;
    for claim in &summary.claims {
        let best = claim.at_best.map_or("–", |holds| if holds { "holds" } else { "does not hold" });
        let (holds, all) = (claim.plausible.holds, summary.plausible);
        let share = 100.0 * holds as f64 / all.max(1) as f64;
        writeln!(text, "| {} | {} | {best} | {holds} of {all} ({share:.0} %) |", claim.claim, claim.criterion)?;
    }
    Ok(())
}
