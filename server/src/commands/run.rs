//! `adaptarm run`: one scenario in, one report out.

use super::{Failure, presets, samples};
use crate::document::{FileError, parse_scenario, read_bounded, read_file};
use crate::stdout::print;
use adaptarm_core::diagnostics::Diagnostics;
use adaptarm_core::scenario::{Report, Run, Scenario};
use clap::Args;
use indicatif::{ProgressBar, ProgressStyle};
use serde::Serialize;
use std::fs::{File, OpenOptions};
use std::io::{self, Write};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Steps between two looks at the clock: some milliseconds.
const SLICE_STEPS: u64 = 5_000;

/// Runs shorter than this need no progress bar.
const PATIENCE: Duration = Duration::from_millis(500);

#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  adaptarm run --preset slotine_li
  adaptarm run my.json --csv my.csv --compact >> reports.jsonl
  adaptarm run my.json --follow way.csv
  adaptarm run my.json --diagnostics | jq .diagnostics.violations
  adaptarm presets --show proposed | sed 's/\"duration_s\": 12.0/\"duration_s\": 60.0/' | adaptarm run -

A scenario may be as short as {\"format\": \"adaptarm.scenario/1\", \"scheme\": {\"kind\": \"proposed\"}}:
whatever it leaves out is as in the paper.

The table (--csv) has a row for each of the k samples and, if the run completed, one more for its
end; indices and peaks count the k samples only. Its columns z_deg_* mean something only for a
scheme with an observer; elsewhere they are the distance from the start.

Exit codes:
  0  simulated to the end, or until it diverged: the report's `outcome` tells which
  1  the scenario could not be read, or the result not written
  2  the scenario is wrong; one line on standard error says where and what would be allowed")]
pub(super) struct Arguments {
    /// Scenario file (JSON), or - for standard input.
    #[arg(value_name = "SCENARIO.json")]
    scenario: Option<PathBuf>,
    /// Run the preset of this name instead; `adaptarm presets` lists them.
    #[arg(long, value_name = "NAME", conflicts_with = "scenario")]
    preset: Option<String>,
    /// Follow the joint angles of this table instead of the scenario's trajectory: lines of time (s) and one angle per
    /// joint (deg), comma-separated. They become part of the scenario.
    #[arg(long, value_name = "IN.csv")]
    follow: Option<PathBuf>,
    /// Also write the samples to this file, as comma-separated values.
    #[arg(long, value_name = "OUT.csv")]
    csv: Option<PathBuf>,
    /// Add `diagnostics` to the report: excitation and what cannot be identified, the Lyapunov function, violated assumptions,
    /// parameter error, bounds, energy, chatter.
    #[arg(long)]
    diagnostics: bool,
    /// Print the report on one line.
    #[arg(long)]
    compact: bool,
}

/// What is printed: the report, and what else was asked for.
#[derive(Serialize)]
struct Told {
    #[serde(flatten)]
    report: Report,
    #[serde(skip_serializing_if = "Option::is_none")]
    diagnostics: Option<Diagnostics>,
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    if arguments.csv.as_deref().is_some_and(|path| path.as_os_str() == "-") {
        let message = "--csv -: standard output carries the report; name a file (./- for one called that)";
        return Err(Failure::input(message));
    }
    let scenario = match (&arguments.preset, &arguments.scenario) {
        (Some(name), _) => presets::scenario(name)?,
        (None, Some(path)) => read(path)?,
        (None, None) => {
            let message = "run what? Name a scenario file (- for standard input) or a preset (--preset proposed)";
            return Err(Failure::input(message));
        }
    };
    let scenario = match &arguments.follow {
        Some(path) => follow(&scenario, path)?,
        None => scenario,
    };
    let table = arguments.csv.as_deref().map(|path| Table::open(path, arguments.scenario.as_deref())).transpose()?;
    let Run { report, recording } = simulate(&scenario);
    if let Some(table) = table {
        table.write(&recording.to_csv())?;
    }
    let diagnostics = arguments.diagnostics.then(|| scenario.diagnose(&recording).0);
    let told = Told { report, diagnostics };
    let text = if arguments.compact { serde_json::to_string(&told) } else { serde_json::to_string_pretty(&told) };
    Ok(print(&(text.map_err(Failure::system)? + "\n"))?)
}

fn read(path: &Path) -> Result<Scenario, Failure> {
    let (name, bytes) = read_input(path)?;
    parse_scenario(&bytes).map_err(|error| Failure::input(format!("{name}: {error}")))
}

/// The scenario along a table of joint angles.
fn follow(scenario: &Scenario, path: &Path) -> Result<Scenario, Failure> {
    let (name, bytes) = read_input(path)?;
    let text = str::from_utf8(&bytes).map_err(|error| Failure::input(format!("{name}: {error}")))?;
    let mut document = scenario.document().clone();
    document.trajectory = samples::trajectory(text).map_err(|error| Failure::input(format!("{name}: {error}")))?;
    Scenario::new(document).map_err(|error| Failure::input(format!("{name}: {error}")))
}

/// A document's name and bytes, from a file or, called -, from standard input.
pub(super) fn read_input(path: &Path) -> Result<(String, Vec<u8>), Failure> {
    let (name, bytes) = if path.as_os_str() == "-" {
        ("standard input".to_owned(), read_bounded(io::stdin().lock()))
    } else {
        (path.display().to_string(), read_file(path))
    };
    let bytes = bytes.map_err(|error| match error {
        FileError::Unreadable(_) => Failure::system(format!("{name}: {error}")),
        FileError::Folder | FileError::TooLarge(_) | FileError::Endless => Failure::input(format!("{name}: {error}")),
    })?;
    Ok((name, bytes))
}

/// Simulates, and shows how far it came to whoever is watching.
fn simulate(scenario: &Scenario) -> Run {
    let started = Instant::now();
    let mut bar: Option<ProgressBar> = None;
    let run = scenario.run_in_slices(SLICE_STEPS, &mut |simulation| {
        if started.elapsed() > PATIENCE {
            // Draws on standard error, and only if that is a terminal.
            let bar = bar.get_or_insert_with(|| progress_bar(scenario.settings().duration_s));
            bar.set_position((simulation.progress() * 1000.0) as u64);
        }
        ControlFlow::Continue(())
    });
    if let Some(bar) = bar {
        bar.finish_and_clear();
    }
    // Only the closure above could break it off, and it never does.
    run.expect("a run that nobody breaks off ends")
}

fn progress_bar(duration_s: f64) -> ProgressBar {
    let bar = ProgressBar::new(1000);
    let template = "simulating {msg} [{bar:30}] {percent:>3} %, {eta} left";
    let style = ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar());
    bar.with_style(style.progress_chars("=> ")).with_message(format!("{duration_s} s"))
}

/// A table to be written: opened before the simulation, so that hours of it are not lost to a misspelt folder.
struct Table<'a> {
    path: &'a Path,
    file: File,
}

impl<'a> Table<'a> {
    fn open(path: &'a Path, scenario: Option<&Path>) -> Result<Self, Failure> {
        let same = |other: &Path| path.canonicalize().ok().is_some_and(|path| other.canonicalize().ok() == Some(path));
        if scenario.is_some_and(same) {
            return Err(Failure::input(format!("{}: the table would replace the scenario", path.display())));
        }
        // What is there stays there until something can take its place.
        let file = OpenOptions::new().write(true).create(true).truncate(false).open(path);
        Ok(Self { path, file: file.map_err(|error| Self::failure(path, &error))? })
    }

    fn write(mut self, csv: &str) -> Result<(), Failure> {
        // A pipe or a device has no length to take away.
        let emptied = if self.file.metadata().is_ok_and(|data| data.is_file()) { self.file.set_len(0) } else { Ok(()) };
        emptied
            .and_then(|()| self.file.write_all(csv.as_bytes()))
            .and_then(|()| self.file.flush())
            .map_err(|error| Self::failure(self.path, &error))
    }

    fn failure(path: &Path, error: &io::Error) -> Failure {
        Failure::system(format!("{}: cannot write it: {error}", path.display()))
    }
}
