//! Whether a contestant computes what we compute: its rows against our recording at the same instants.
//!
//! A difference is divided by a size that the number naturally has: the joint's largest angle (also for tracking errors, which
//! are differences of angles and no more exact than these), its largest velocity, the parameter's true value.
//!
//! With steps of 1 ms the proposed scheme's projection is stiffer than RK4 can follow: while it holds an estimate at zero, that
//! estimate jumps about (θ̂17 by some 5e-4), and rounding decides how (docs/physics.md, section 4, shows the same at 0.1 ms).
//! So whoever has fixed steps is compared twice: as it is timed, and strictly with steps of 0.1 ms.

use crate::measurement::{Contestant, Measurement, SIGNALS, Steps};
use crate::own;
use crate::rounds::Pinned;
use adaptarm_core::scenario::{Scenario, Scheme};
use anyhow::{Context, Result};
use std::fmt;

/// Steps per millisecond of the strict comparison, and of the run that stands for the solution itself.
const FINE: u32 = 10;

/// A contestant that computes what we compute.
pub struct Examined {
    /// Its first run, as it will be timed.
    pub first: Measurement,
    /// Largest scaled difference per comparison, the strict one last.
    pub differences: Vec<f64>,
}

/// Largest accepted differences.
struct Tolerance {
    motion: f64,
    estimates: f64,
}

/// How exactly correct programs agree.
fn tolerance(steps: Steps, scheme: Scheme, steps_per_ms: u32) -> Tolerance {
    match steps {
        Steps::Fixed if scheme == Scheme::Proposed && steps_per_ms == 1 => Tolerance { motion: 1e-6, estimates: 1e-4 },
        Steps::Fixed => Tolerance { motion: 1e-9, estimates: 1e-9 },
        // What the solver's own tolerances allow.
        Steps::Adaptive => Tolerance { motion: 1e-6, estimates: 1e-6 },
    }
}

/// Runs a contestant and compares; the inner error says where it differs too much.
pub fn examine(contestant: &Contestant, pinned: &Pinned, scheme: Scheme) -> Result<Result<Examined, Disagreement>> {
    let first = contestant.measure(pinned, scheme, 1)?;
    let mut differences = Vec::new();
    let comparisons: &[u32] = if contestant.steps == Steps::Fixed { &[1, FINE] } else { &[FINE] };
    for &steps_per_ms in comparisons {
        let fine;
        let measurement = if contestant.steps == Steps::Fixed && steps_per_ms == FINE {
            fine = contestant.run(pinned, scheme, 1, FINE)?;
            &fine
        } else {
            &first
        };
        let tolerance = tolerance(contestant.steps, scheme, steps_per_ms);
        match compare(measurement, &scenario(scheme, contestant.steps, steps_per_ms)?, &tolerance)? {
            Ok(difference) => differences.push(difference),
            Err(disagreement) => return Ok(Err(Disagreement { steps_per_ms, ..disagreement })),
        }
    }
    Ok(Ok(Examined { first, differences }))
}

/// Our run that the rows should agree with.
fn scenario(scheme: Scheme, steps: Steps, steps_per_ms: u32) -> Result<Scenario> {
    let mut document = scheme.paper();
    document.integration.step_s = 1e-3 / f64::from(steps_per_ms);
    if steps == Steps::Adaptive {
        document.integration.duration_s = 0.5;
        document.recording.samples = 125;
    }
    Ok(Scenario::new(document)?)
}

/// Where rows differ too much.
pub struct Disagreement {
    steps_per_ms: u32,
    time_s: f64,
    signal: &'static str,
    component: usize,
    found: f64,
    expected: f64,
    difference: f64,
    tolerance: f64,
}

impl fmt::Display for Disagreement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { steps_per_ms, time_s, signal, component, found, expected, difference, tolerance } = self;
        let component = component + 1;
        write!(
            f,
            "at {time_s} s, {steps_per_ms} steps per ms, {signal} {component} is {found:e} instead of {expected:e}; \
             scaled difference {difference:.1e}, allowed {tolerance:.0e}"
        )
    }
}

/// The largest scaled difference of all rows.
fn compare(measured: &Measurement, ours: &Scenario, tolerance: &Tolerance) -> Result<Result<f64, Disagreement>> {
    let times_s: Vec<f64> = measured.rows.iter().map(|row| row.time_s).collect();
    let rows = own::rows(&ours.run().recording, &times_s)?;
    let scales = scales(&rows, &ours.theta());
    let names: Vec<_> = SIGNALS.iter().flat_map(|&(name, count)| (0..count).map(move |n| (name, n))).collect();
    let mut largest: f64 = 0.0;
    for (row, expected) in measured.rows.iter().zip(&rows) {
        for (column, &(signal, component)) in names.iter().enumerate() {
            let (found, expected) = (row.numbers[column], expected[column]);
            let difference = (found - expected).abs() / scales[column];
            let tolerance = if signal == "theta_hat" { tolerance.estimates } else { tolerance.motion };
            if difference.is_nan() || difference > tolerance {
                let (time_s, steps_per_ms) = (row.time_s, 1);
                let found =
                    Disagreement { steps_per_ms, time_s, signal, component, found, expected, difference, tolerance };
                return Ok(Err(found));
            }
            largest = largest.max(difference);
        }
    }
    measured.rows.first().context("no rows to check by")?;
    Ok(Ok(largest))
}

/// What differences are divided by, in the order of [`SIGNALS`].
fn scales(rows: &[Vec<f64>], theta: &[f64]) -> Vec<f64> {
    let largest = |column: usize| rows.iter().map(|row| row[column].abs()).fold(0.0, f64::max);
    let (angles, velocities): (Vec<f64>, Vec<f64>) = ((0..3).map(largest).collect(), (3..6).map(largest).collect());
    [&angles[..], &velocities, &angles, theta].concat()
}
