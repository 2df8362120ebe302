//! Computing scenarios together on a thread of the pool, in lanes where they can be, able to pause between two slices.

use crate::metrics::FailureReason;
use crate::results::Checkpoint;
use adaptarm_core::experiments::Row;
use adaptarm_core::scenario::{Group, Run, Scenario};
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
    before: u64,
    steps: AtomicU64,
}

impl Control {
    /// Of a computation behind so many steps that are done, which itself starts at this step. Who asks before a thread is free
    /// must not hear that work is lost.
    pub(super) fn starting_at(before: u64, step: u64) -> Self {
        Self { pause: AtomicBool::new(false), before, steps: AtomicU64::new(step) }
    }

    /// Makes the computation pause within a slice.
    pub(super) fn pause(&self) {
        self.pause.store(true, Ordering::Relaxed);
    }

    /// Steps taken so far.
    pub(super) fn steps(&self) -> u64 {
        self.before + self.steps.load(Ordering::Relaxed)
    }
}

/// Why a computation failed: another try would meet the same.
pub type Failure = (FailureReason, String);

/// Scenarios that are computed together.
#[derive(Debug)]
pub(super) struct Members {
    /// Numbers of the scenarios in their job, or of the runs in their experiment.
    pub(super) numbers: Vec<i64>,
    /// The scenarios.
    pub(super) scenarios: Vec<Scenario>,
    /// Rows of an experiment's part that are done already.
    pub(super) rows: Vec<Row>,
    /// Steps that those took.
    pub(super) steps: u64,
}

/// How a stretch of computing ended.
#[derive(Debug)]
pub(super) enum Stretch<T> {
    /// With all scenarios done: what is kept of each.
    Finished(Vec<T>),
    /// On request: how far they came, as bytes and as it is.
    Paused(Bytes, Vec<Snapshot>),
    /// With an error that another try would meet again.
    Failed(FailureReason, String),
}

/// Computes scenarios from where they were left (from the start without snapshots) until their end or until told to pause;
/// `keep` makes of each run what is kept.
pub(super) fn compute<T>(
    members: &Members,
    from: &[Snapshot],
    control: &Control,
    keep: impl Fn(i64, &Scenario, Run) -> Result<T, Failure>,
) -> Stretch<T> {
    match catch_unwind(AssertUnwindSafe(|| try_compute(members, from, control, keep))) {
        Ok(Ok(stretch)) => stretch,
        Ok(Err((kind, reason))) => Stretch::Failed(kind, format!("{}: {reason}", name_of(members))),
        Err(panic) => {
            let reason = format!("{} made the simulation fail: {}", name_of(members), words(&*panic));
            Stretch::Failed(FailureReason::Panicked, reason)
        }
    }
}

/// What messages call them.
fn name_of(members: &Members) -> String {
    match &members.numbers[..] {
        [number] => format!("scenario {number}"),
        numbers => {
            format!("one of the scenarios {}", numbers.iter().map(i64::to_string).collect::<Vec<_>>().join(", "))
        }
    }
}

fn try_compute<T>(
    members: &Members,
    from: &[Snapshot],
    control: &Control,
    keep: impl Fn(i64, &Scenario, Run) -> Result<T, Failure>,
) -> Result<Stretch<T>, Failure> {
    let scenarios: Vec<_> = members.scenarios.iter().collect();
    let mut group = match (!from.is_empty()).then(|| Group::resume(&scenarios, from)) {
        None => Group::start(&scenarios),
        Some(Ok(group)) => group,
        Some(Err(error)) => {
            // Another version of the core made it, mostly: only time is lost.
            tracing::warn!("{} begins anew: {error}", name_of(members));
            Group::start(&scenarios)
        }
    };
    control.steps.store(group.steps(), Ordering::Relaxed);
    while !group.advance(SLICE_STEPS) {
        control.steps.store(group.steps(), Ordering::Relaxed);
        if control.pause.load(Ordering::Relaxed) {
            let checkpoint = Checkpoint {
                numbers: members.numbers.clone(),
                snapshots: group.snapshots(),
                rows: members.rows.clone(),
                steps: members.steps,
            };
            let bytes = checkpoint.encode().map_err(|error| (FailureReason::Storage, error.to_string()))?;
            return Ok(Stretch::Paused(bytes, checkpoint.snapshots));
        }
    }
    let runs = members.numbers.iter().zip(&members.scenarios).zip(group.finish());
    let kept = runs.map(|((number, scenario), run)| keep(*number, scenario, run));
    Ok(Stretch::Finished(kept.collect::<Result<_, _>>()?))
}

/// What a panic said.
pub(super) fn words(panic: &(dyn Any + Send)) -> &str {
    panic
        .downcast_ref::<String>()
        .map(String::as_str)
        .or_else(|| panic.downcast_ref::<&str>().copied())
        .unwrap_or("it did not say why")
}
