//! `adaptarm experiment`: one experiment in, its summary out, everything else in a folder.

use super::Failure;
use super::run::read_input;
use crate::document::{DocumentError, parse};
use crate::experiment::{CheckpointError, Refused, Settings, run as work};
use crate::stdout::print;
use adaptarm_core::experiments::{Experiment, ExperimentDocument};
use clap::Args;
use std::path::PathBuf;

/// More threads than this help nobody.
const MOST_THREADS: i64 = 1024;

#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  adaptarm experiment docs/experiments/robustness.json --out robustness
  adaptarm experiment tuning.json --out tuning --threads 2
  adaptarm experiment docs/replication/search.json --out search
  adaptarm experiment tuning.json --out tuning --resume     after a kill, a crash, a restart

The folder gets summary.json, experiment.json (with everything filled in), runs.csv and runs.parquet with a row for each run
(of a tuning best.json, a scenario, and generations.csv; of a replication also report.md and figures), and checkpoint.bin, from which --resume goes on. The files are the
same with any number of threads and however often the work was interrupted.

Exit codes:
  0  done; runs that diverged or were refused are counted in the summary
  1  something could not be read or written
  2  the experiment is wrong; one line on standard error says where and what would be allowed")]
pub(super) struct Arguments {
    /// Experiment file (JSON), or - for standard input.
    #[arg(value_name = "EXPERIMENT.json")]
    file: PathBuf,
    /// Threads; as many as there are processors if not given.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(i64).range(1..=MOST_THREADS))]
    threads: Option<i64>,
    /// Folder to write into; made if it does not exist.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Go on from what is done in that folder.
    #[arg(long, requires = "out")]
    resume: bool,
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let (name, bytes) = read_input(&arguments.file)?;
    let wrong = |error: &dyn std::fmt::Display| Failure::input(format!("{name}: {error}"));
    let document = parse::<ExperimentDocument>(&bytes).map_err(|error| wrong(&error.about("experiment")))?;
    let experiment =
        Experiment::new(document).map_err(|error| wrong(&DocumentError::from(error).about("experiment")))?;
    let settings = Settings {
        threads: arguments.threads.map(|threads| threads as usize),
        out: arguments.out.clone(),
        resume: arguments.resume,
    };
    let outcome = work(&experiment, &settings).map_err(|error| match error.downcast_ref::<Refused>() {
        Some(Refused::Checkpoint(CheckpointError::Damaged(_))) | None => Failure::chain(error),
        Some(refused @ (Refused::Checkpoint(_) | Refused::Objective(_) | Refused::Occupied(_))) => {
            Failure::input(refused)
        }
    })?;
    Ok(print(&(serde_json::to_string_pretty(&outcome).map_err(Failure::system)? + "\n"))?)
}
