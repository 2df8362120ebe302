//! What every contestant prints: how long each of its runs took, and rows to check them by. One JSON document.

use crate::rounds::Pinned;
use adaptarm_core::scenario::Scheme;
use anyhow::{Context, Result, bail};
use serde_json::Value;
use std::path::PathBuf;
use std::process::Stdio;

/// The state that rows show, by name: joint angles, their velocities, tracking errors, estimates.
pub const SIGNALS: [(&str, usize); 4] = [("q", 3), ("dq", 3), ("e", 3), ("theta_hat", 18)];

/// How a contestant integrates.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Steps {
    /// RK4 for all 12 s, with as many steps per millisecond as it is told.
    Fixed,
    /// For half a second, as its tolerances demand; its time is given per millisecond all the same.
    Adaptive,
}

/// A program that runs the study: called with a scheme, a number of repetitions and, if its steps are fixed, their number per
/// millisecond.
pub struct Contestant {
    /// For the table.
    pub name: String,
    pub program: PathBuf,
    /// Before scheme and repetitions.
    pub arguments: Vec<String>,
    pub steps: Steps,
}

/// Some runs of one scheme.
pub struct Measurement {
    /// Libraries and compiler, with their versions.
    pub with: String,
    /// Steps in a run; of 1 ms unless told otherwise.
    pub steps: u64,
    /// How long each run took, s.
    pub seconds: Vec<f64>,
    /// Instants of a run.
    pub rows: Vec<Row>,
}

/// One instant: its time (s) and the numbers of [`SIGNALS`], one after another, SI units.
pub struct Row {
    pub time_s: f64,
    pub numbers: Vec<f64>,
}

impl Contestant {
    /// Runs `scheme` so many times, as it is timed: with steps of 1 ms, where they are fixed.
    pub fn measure(&self, pinned: &Pinned, scheme: Scheme, repetitions: usize) -> Result<Measurement> {
        self.run(pinned, scheme, repetitions, 1)
    }

    /// Runs `scheme` so many times with so many steps per millisecond.
    pub fn run(&self, pinned: &Pinned, scheme: Scheme, repetitions: usize, steps_per_ms: u32) -> Result<Measurement> {
        let mut command = pinned.command(&self.program);
        command.args(&self.arguments).args([scheme.id(), &repetitions.to_string()]).stderr(Stdio::inherit());
        if self.steps == Steps::Fixed {
            command.arg(steps_per_ms.to_string());
        }
        let output = command.output().with_context(|| format!("{} cannot be started", self.name))?;
        if !output.status.success() {
            bail!("{} ended with {}", self.name, output.status);
        }
        let printed =
            serde_json::from_slice(&output.stdout).with_context(|| format!("{} printed no JSON", self.name))?;
        Measurement::read(&printed).with_context(|| format!("{} printed something unexpected", self.name))
    }
}

impl Measurement {
    /// Microseconds per step, the mean of its runs.
    pub fn us_per_step(&self) -> f64 {
        1e6 * self.seconds.iter().sum::<f64>() / (self.seconds.len() as f64 * self.steps as f64)
    }

    fn read(printed: &Value) -> Result<Self> {
        let rows = printed["rows"].as_array().context("no rows")?.iter().map(Row::read).collect::<Result<_>>()?;
        Ok(Self {
            with: printed["with"].as_str().context("no versions")?.to_owned(),
            steps: printed["steps"].as_u64().context("no number of steps")?,
            seconds: numbers(&printed["seconds"]).filter(|seconds| !seconds.is_empty()).context("no times")?,
            rows,
        })
    }
}

impl Row {
    fn read(printed: &Value) -> Result<Self> {
        let mut row = Self { time_s: printed["t_s"].as_f64().context("a row without time")?, numbers: Vec::new() };
        for (name, count) in SIGNALS {
            let signal = numbers(&printed[name]).filter(|numbers| numbers.len() == count);
            row.numbers.extend(signal.with_context(|| format!("a row without {count} numbers {name}"))?);
        }
        Ok(row)
    }
}

fn numbers(list: &Value) -> Option<Vec<f64>> {
    list.as_array()?.iter().map(Value::as_f64).collect()
}
