//! Computing one scenario on a thread of the pool, able to pause between two slices.

use crate::document::parse_scenario;
use crate::metrics::FailureReason;
use crate::results::{Checkpoint, Encoded};
use adaptarm_core::scenario::Report;
use adaptarm_core::simulation::Snapshot;
use bytes::Bytes;
use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

/// Steps between two looks at whether to pause: a few milliseconds.
const SLICE_STEPS: u64 = 2_000;

/// What the computing thread and the one that watches over it tell each other.
#[derive(Debug)]
pub(super) struct Control {
    pause: AtomicBool,
    steps: AtomicU64,
}

impl Control {
    /// Of a computation that starts at this step. Who asks before a thread is free must not hear that work is lost.
    pub(super) fn starting_at(step: u64) -> Self {
        Self { pause: AtomicBool::new(false), steps: AtomicU64::new(step) }
    }

    /// Makes the computation pause within a slice.
    pub(super) fn pause(&self) {
        self.pause.store(true, Ordering::Relaxed);
    }

    /// Steps taken so far.
    pub(super) fn steps(&self) -> u64 {
        self.steps.load(Ordering::Relaxed)
    }
}

/// A scenario that is done.
#[derive(Debug)]
pub(super) struct Finished {
    /// The report.
    pub(super) report: Report,
    /// The samples.
    pub(super) encoded: Encoded,
    /// Time of the arm's movement, s.
    pub(super) simulated_s: f64,
}

/// How a stretch of computing ended.
#[derive(Debug)]
pub(super) enum Stretch {
    /// With the scenario done.
    Finished(Box<Finished>),
    /// On request: how far it came, as bytes and as it is.
    Paused(Bytes, Box<Snapshot>),
    /// With an error that another try would meet again.
    Failed(FailureReason, String),
}

/// Computes scenario `n` of a job from where it was left, until its end or until it is told to pause.
pub(super) fn compute(n: i64, document: &str, from: Option<Snapshot>, control: &Control) -> Stretch {
    match catch_unwind(AssertUnwindSafe(|| try_compute(n, document, from, control))) {
        Ok(Ok(stretch)) => stretch,
        Ok(Err((kind, reason))) => Stretch::Failed(kind, format!("scenario {n}: {reason}")),
        Err(panic) => {
            let reason = format!("scenario {n} made the simulation fail: {}", words(&*panic));
            Stretch::Failed(FailureReason::Panicked, reason)
        }
    }
}

fn try_compute(
    n: i64,
    document: &str,
    from: Option<Snapshot>,
    control: &Control,
) -> Result<Stretch, (FailureReason, String)> {
    let scenario = parse_scenario(document.as_bytes()).map_err(|error| (FailureReason::Document, error.to_string()))?;
    let mut simulation = match from.map(|snapshot| scenario.resume(snapshot)) {
        None => scenario.start(),
        Some(Ok(simulation)) => simulation,
        Some(Err(error)) => {
            // Another version of the core made it, mostly: only time is lost.
            tracing::warn!("scenario {n} begins anew: {error}");
            scenario.start()
        }
    };
    control.steps.store(simulation.steps(), Ordering::Relaxed);
    while !simulation.advance(SLICE_STEPS) {
        control.steps.store(simulation.steps(), Ordering::Relaxed);
        if control.pause.load(Ordering::Relaxed) {
            let checkpoint = Checkpoint { n, snapshot: simulation.snapshot() };
            let bytes = checkpoint.encode().map_err(|error| (FailureReason::Storage, error.to_string()))?;
            return Ok(Stretch::Paused(bytes, Box::new(checkpoint.snapshot)));
        }
    }
    let simulated_s = simulation.time_s();
    let run = scenario.finish(simulation);
    let encoded =
        Encoded::new(&run.report, &run.recording).map_err(|error| (FailureReason::Storage, error.to_string()))?;
    Ok(Stretch::Finished(Box::new(Finished { report: run.report, encoded, simulated_s })))
}

/// What a panic said.
fn words(panic: &(dyn Any + Send)) -> &str {
    panic
        .downcast_ref::<String>()
        .map(String::as_str)
        .or_else(|| panic.downcast_ref::<&str>().copied())
        .unwrap_or("it did not say why")
}
