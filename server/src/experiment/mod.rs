//! Makes the runs of an experiment on threads of this process, keeps what is done, and writes the results.
//!
//! What is computed is the core's; the number of threads, the order in which runs end, and being killed in between change
//! nothing in the files.

mod checkpoint;
mod files;
mod pictures;
mod row_file;
mod search_report;

pub use checkpoint::CheckpointError;
pub use files::{File, Found};
pub use pictures::Picture;
pub use row_file::RowFile;

use adaptarm_core::experiments::replication::ReplicationSummary;
use adaptarm_core::experiments::{Experiment, PlannedRun, Results, Row, Summary, Tuning, TuningError, TuningSummary};
use anyhow::{Context, Result};
use checkpoint::{Checkpoint, NAME};
use indicatif::{ProgressBar, ProgressStyle};
use rayon::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};
use serde::Serialize;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::mpsc;

/// Points that a thread takes at once: twice as many of each base as the widest lanes hold.
const POINTS_AT_ONCE: usize = 16;

/// What came of an experiment.
#[derive(Debug, Serialize)]
#[serde(untagged)]
pub enum Outcome {
    /// Of a sweep, a Monte Carlo study or a comparison.
    Summary(Box<Summary>),
    /// Of a tuning.
    Tuning(Box<TuningSummary>),
    /// Of a replication.
    Replication(Box<ReplicationSummary>),
}

/// How an experiment is worked on.
#[derive(Debug, Clone)]
pub struct Settings {
    /// Threads; as many as the machine has processors if not given.
    pub threads: Option<usize>,
    /// Where results and the checkpoint go.
    pub out: Option<PathBuf>,
    /// Whether to go on from the checkpoint in that folder.
    pub resume: bool,
}

/// Why an experiment cannot be worked on as it was asked for.
#[derive(Debug, thiserror::Error)]
pub enum Refused {
    /// Its checkpoint is of something else.
    #[error(transparent)]
    Checkpoint(#[from] CheckpointError),
    /// Its objective cannot be measured.
    #[error(transparent)]
    Objective(#[from] TuningError),
    /// The folder for its results holds those of another.
    #[error("--out: {} holds another experiment's results: give another folder, or remove it", .0.display())]
    Occupied(PathBuf),
}

/// Works on an experiment to its end.
pub fn run(experiment: &Experiment, settings: &Settings) -> Result<Outcome> {
    let pool =
        ThreadPoolBuilder::new().num_threads(settings.threads.unwrap_or(0)).build().context("cannot start threads")?;
    // Before hours of simulation rather than after them.
    if let Some(folder) = &settings.out {
        std::fs::create_dir_all(folder).with_context(|| format!("cannot make the folder {}", folder.display()))?;
        files::take(experiment, folder)?;
    }
    let folder = settings.out.as_deref();
    let Some(start) = experiment.tuning() else {
        let rows = match folder.map(|folder| folder.join(NAME)) {
            None => RowFile::unnamed(experiment)?,
            Some(path) => {
                let earlier = if settings.resume { RowFile::open(experiment, &path)? } else { None };
                earlier.map_or_else(|| RowFile::create(experiment, &path), Ok)?
            }
        };
        return lay_out(experiment, Results::kept_in(rows)?, &pool, folder);
    };
    let mut checkpoint = Checkpoint::new(experiment, folder);
    let earlier = if settings.resume { checkpoint.load(experiment)? } else { None };
    search(experiment, earlier.unwrap_or(start), &pool, &mut checkpoint, folder)
}

/// All runs that are not done, in any order.
fn lay_out(experiment: &Experiment, mut results: Results, pool: &ThreadPool, folder: Option<&Path>) -> Result<Outcome> {
    let runs = experiment.runs().unwrap_or(0);
    let missing: Vec<_> = (0..runs).filter(|index| results.outcome(*index).is_none()).collect();
    let at_once = POINTS_AT_ONCE * experiment.base_names().len();
    let bar = progress_bar(runs, "runs");
    bar.set_position(results.len() as u64);
    let plan = |indices: &[u64]| indices.iter().flat_map(|n| experiment.plan(*n..*n + 1)).collect();
    let chunks: Vec<_> = missing.chunks(at_once).collect();
    each_row(experiment, &chunks, &plan, pool, &mut |row| {
        results.insert(experiment, row)?;
        bar.inc(1);
        Ok(())
    })?;
    bar.finish_and_clear();
    finish(experiment, Found::of(experiment, results)?, folder)
}

/// Writes what was found, and tells it.
fn finish(experiment: &Experiment, found: Found, folder: Option<&Path>) -> Result<Outcome> {
    if let Some(folder) = folder {
        files::write(experiment, &found, folder)?;
    }
    Ok(match found {
        Found::Rows(_, summary) => Outcome::Summary(summary),
        Found::Readings(_, summary) => Outcome::Replication(summary),
        Found::Search(tuning) => Outcome::Tuning(Box::new(tuning.summary(experiment))),
    })
}

/// Generation after generation.
fn search(
    experiment: &Experiment,
    mut tuning: Tuning,
    pool: &ThreadPool,
    checkpoint: &mut Checkpoint,
    folder: Option<&Path>,
) -> Result<Outcome> {
    let (done, all) = tuning.progress(experiment);
    let bar = progress_bar(all, "candidates");
    bar.set_position(done);
    while !tuning.is_done() {
        let planned = tuning.plan(experiment);
        // Enough for each thread, and full lanes where that is possible.
        let at_once = planned.len().div_ceil(pool.current_num_threads()).clamp(1, POINTS_AT_ONCE);
        let chunks: Vec<_> = planned.chunks(at_once).collect();
        let mut rows = Vec::new();
        each_row(experiment, &chunks, &<[PlannedRun]>::to_vec, pool, &mut |row| {
            rows.push(row);
            Ok(())
        })?;
        tuning.tell(experiment, rows).map_err(Refused::Objective)?;
        checkpoint.save_if_due(&tuning)?;
        let (done, all) = tuning.progress(experiment);
        bar.set_length(all);
        bar.set_position(done);
    }
    bar.finish_and_clear();
    checkpoint.save(&tuning)?;
    finish(experiment, Found::Search(Box::new(tuning)), folder)
}

/// Makes the runs of all chunks and hands their rows over, on this thread, as they come; the first failure ends everything.
fn each_row<C: Sync + ?Sized>(
    experiment: &Experiment,
    chunks: &[&C],
    plan: &(impl Fn(&C) -> Vec<PlannedRun> + Sync),
    pool: &ThreadPool,
    take: &mut dyn FnMut(Row) -> Result<()>,
) -> Result<()> {
    let (send, rows) = mpsc::channel();
    std::thread::scope(|scope| {
        scope.spawn(move || {
            pool.install(|| {
                chunks.par_iter().try_for_each_with(send, |send, chunk| {
                    // Nobody listens any more: whoever did has failed.
                    let each =
                        |row| if send.send(row).is_ok() { ControlFlow::Continue(()) } else { ControlFlow::Break(()) };
                    experiment.run(plan(chunk), each)
                })
            })
        });
        // Taken apart when the first failure leaves this scope, which tells the threads.
        for row in rows {
            take(row)?;
        }
        Ok(())
    })
}

fn progress_bar(length: u64, what: &'static str) -> ProgressBar {
    // Draws on standard error, and only if that is a terminal.
    let bar = ProgressBar::new(length);
    let template = "{pos} of {len} {msg} [{bar:30}] {percent:>3} %, {eta} left";
    let style = ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar());
    bar.with_style(style.progress_chars("=> ")).with_message(what)
}
