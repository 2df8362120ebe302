//! Timing: rounds in which all contestants take turns, so that a machine whose speed drifts slows them all alike.

use crate::check::Examined;
use crate::measurement::Contestant;
use adaptarm_core::scenario::Scheme;
use anyhow::Result;
use std::path::Path;
use std::process::{Command, Stdio};

/// Rounds that count; one more before them warms caches and clocks.
pub const ROUNDS: usize = 7;

/// A measurement lasts at least this long, or the clock's grain and interrupts would show.
const SHORTEST_S: f64 = 0.05;

/// Starts programs on one core, the same for all, where `taskset` can.
pub struct Pinned {
    core: Option<&'static str>,
}

impl Pinned {
    /// On core 1: core 0 is where most systems handle interrupts.
    pub fn find() -> Self {
        let mut probe = Command::new("taskset");
        probe.args(["-c", "1", "true"]).stdout(Stdio::null()).stderr(Stdio::null());
        Self { core: probe.status().is_ok_and(|status| status.success()).then_some("1") }
    }

    /// The core, if it is one.
    pub fn core(&self) -> Option<&str> {
        self.core
    }

    /// A command for `program`.
    pub fn command(&self, program: &Path) -> Command {
        let Some(core) = self.core else { return Command::new(program) };
        let mut command = Command::new("taskset");
        command.args(["-c", core]).arg(program);
        command
    }
}

/// How long a contestant takes for a scheme.
pub struct Time {
    /// Position among the contestants.
    pub contestant: usize,
    /// Libraries and compiler.
    pub with: String,
    /// Microseconds per step of 1 ms, sorted, one per round.
    pub us_per_step: Vec<f64>,
    /// Largest scaled differences of its rows from ours.
    pub differences: Vec<f64>,
}

impl Time {
    /// Median of the rounds.
    pub fn median(&self) -> f64 {
        self.us_per_step[self.us_per_step.len() / 2]
    }
}

/// Times of one scheme, in the contestants' order, without those that were refused.
pub struct SchemeTimes {
    pub scheme: Scheme,
    /// Runs per measurement of all whose run is short.
    pub repetitions: usize,
    pub times: Vec<Time>,
}

/// Times those that were accepted: position, contestant, what its examination gave.
pub fn take_turns(
    pinned: &Pinned,
    scheme: Scheme,
    accepted: Vec<(usize, &Contestant, Examined)>,
) -> Result<SchemeTimes> {
    let run_s: Vec<f64> = accepted.iter().map(|(.., examined)| examined.first.seconds[0]).collect();
    // The same number for all, but one for those that take long enough by themselves.
    let enough = |run_s: f64| (SHORTEST_S / run_s).ceil() as usize;
    let repetitions = run_s.iter().map(|&run_s| enough(run_s)).max().unwrap_or(1);
    let mut us_per_step = vec![Vec::with_capacity(ROUNDS); accepted.len()];
    for round in 0..=ROUNDS {
        for (n, (_, contestant, ..)) in accepted.iter().enumerate() {
            let repetitions = if enough(run_s[n]) > 1 { repetitions } else { 1 };
            let measured = contestant.measure(pinned, scheme, repetitions)?.us_per_step();
            if round > 0 {
                us_per_step[n].push(measured);
            }
        }
    }
    let times = accepted.into_iter().zip(us_per_step).map(|((contestant, _, examined), mut us_per_step)| {
        us_per_step.sort_by(f64::total_cmp);
        Time { contestant, with: examined.first.with, us_per_step, differences: examined.differences }
    });
    Ok(SchemeTimes { scheme, repetitions, times: times.collect() })
}
