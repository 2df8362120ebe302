//! `adaptarm replicate`: the paper's study again, from three simulations to a report that a reviewer can read.
//!
//! Runs the schemes, prints the tables beside the paper's, judges its claims and lists every assumption; writes scenarios,
//! series, figures and one self-contained HTML page into a folder. The judging is the core's; this only asks and writes.

mod cells;
mod console;
mod files;
mod html;

use crate::stdout;
use adaptarm_core::experiments::replication::{
    Assumption, Claim, IndexTable, assumptions, check_claims, study, table_1, table_2,
};
use adaptarm_core::scenario::{
    InitialVelocityDocument, OutcomeKind, Report, Run, Scenario, ScenarioDocument, ScenarioError,
};
use anyhow::{Context, Result};
use indicatif::{MultiProgress, ProgressBar, ProgressStyle};
use rayon::prelude::*;
use serde::Serialize;
use std::ops::ControlFlow;
use std::path::PathBuf;

/// Regenerate the published study.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "\
Examples:
  adaptarm replicate                          the default study into ./replication
  adaptarm replicate --duration 600           does convergence change the verdicts?
  adaptarm replicate --from-rest --out rest   the other reading of the start

What the paper leaves unsaid is searched by  adaptarm experiment docs/replication/search.json --out search

Open report.html in the folder afterwards. A claim that does not hold is a finding, not a failure: the exit code is 0.")]
pub struct ReplicateArgs {
    /// Folder to write into; made if it does not exist.
    #[arg(long, default_value = "replication", value_name = "DIR")]
    out: PathBuf,
    /// Duration of each simulation, s (the paper does not say).
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true)]
    duration: Option<f64>,
    /// Integration step, s.
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true)]
    step: Option<f64>,
    /// Number of samples of the performance index.
    #[arg(long, value_name = "COUNT")]
    samples: Option<usize>,
    /// Start at rest instead of at the desired velocity.
    #[arg(long)]
    from_rest: bool,
}

/// A finished replication.
#[derive(Debug, Serialize)]
struct Replication {
    format: &'static str,
    core_version: &'static str,
    duration_s: f64,
    step_s: f64,
    samples: usize,
    initial_velocity: InitialVelocityDocument,
    tables: [IndexTable; 2],
    claims: Vec<Claim>,
    assumptions: Vec<Assumption>,
    reports: Vec<Report>,
    #[serde(skip)]
    scenarios: Vec<Scenario>,
    #[serde(skip)]
    runs: [Run; 3],
}

/// Why a replication could not even start.
#[derive(Debug, thiserror::Error)]
#[error(transparent)]
pub struct BadSettings(#[from] ScenarioError);

/// Runs the study and writes everything.
pub fn replicate(args: &ReplicateArgs) -> Result<()> {
    let scenarios = study(|document| adjust(args, document)).map_err(BadSettings)?;
    // Before hours of simulation rather than after them.
    std::fs::create_dir_all(&args.out).with_context(|| format!("cannot make the folder {}", args.out.display()))?;
    let runs = simulate(&scenarios)?;
    let replication = judge(scenarios, runs);
    console::print(&replication)?;
    let bar = bar("writing figures and report", 1);
    let report = files::write(&replication, &args.out)?;
    bar.finish_and_clear();
    Ok(stdout::print(&format!("\nReport: {}\n", report.display()))?)
}

fn adjust(args: &ReplicateArgs, document: &mut ScenarioDocument) {
    if let Some(duration_s) = args.duration {
        document.integration.duration_s = duration_s;
    }
    if let Some(step_s) = args.step {
        document.integration.step_s = step_s;
    }
    if let Some(samples) = args.samples {
        document.recording.samples = samples;
    }
    if args.from_rest {
        document.initial.velocity = InitialVelocityDocument::Rest;
    }
}

/// All three at once, each with its bar.
fn simulate(scenarios: &[Scenario]) -> Result<[Run; 3]> {
    const SLICE: u64 = 2_000;
    let bars = MultiProgress::new();
    let with_bars: Vec<_> =
        scenarios.iter().map(|scenario| (scenario, bars.add(bar(scenario.scheme().name(), 1000)))).collect();
    let runs: Option<Vec<Run>> = with_bars
        .into_par_iter()
        .map(|(scenario, bar)| {
            let run = scenario.run_in_slices(SLICE, &mut |simulation| {
                bar.set_position((simulation.progress() * 1000.0) as u64);
                ControlFlow::Continue(())
            });
            bar.finish();
            run
        })
        .collect();
    // On the terminal the tables replace the bars.
    bars.clear().ok();
    runs.and_then(|runs| <[Run; 3]>::try_from(runs).ok()).context("the study does not have its three runs")
}

fn bar(what: &str, length: u64) -> ProgressBar {
    let style = ProgressStyle::with_template("{msg:28} {bar:32} {percent:>3} %  {elapsed}")
        .unwrap_or_else(|_| ProgressStyle::default_bar());
    ProgressBar::new(length).with_style(style).with_message(what.to_owned())
}

fn judge(scenarios: Vec<Scenario>, runs: [Run; 3]) -> Replication {
    let document = scenarios[0].document();
    Replication {
        format: "adaptarm.replication/1",
        core_version: adaptarm_core::VERSION,
        duration_s: document.integration.duration_s,
        step_s: document.integration.step_s,
        samples: document.recording.samples,
        initial_velocity: document.initial.velocity,
        tables: [table_1(&runs), table_2(&runs)],
        claims: check_claims(&runs),
        assumptions: assumptions(document),
        reports: runs.iter().map(|run| run.report.clone()).collect(),
        scenarios,
        runs,
    }
}

impl Replication {
    /// Whether the scheme of this identifier was given up before its end.
    fn diverged(&self, scheme: &str) -> bool {
        self.reports.iter().any(|report| report.scheme == scheme && report.outcome == OutcomeKind::Diverged)
    }

    /// The settings in one line.
    fn settings(&self) -> String {
        let start = match self.initial_velocity {
            InitialVelocityDocument::Desired => "from the desired velocity",
            InitialVelocityDocument::Rest => "from rest",
        };
        format!("{} s, step {} s, {} samples, {start}", self.duration_s, self.step_s, self.samples)
    }
}
