//! Our own contestants. They run in a process of their own, as the peers do: this program, started with [`MODE`].
//!
//! Each records as many samples as the paper's scenario asks for, 3000, which peers do not do, but for one, which keeps what they keep; one makes
//! the report too (hash of the samples, metrics).

use crate::measurement::{Contestant, SIGNALS, Steps};
use adaptarm_core::lanes;
use adaptarm_core::recording::{Recording, Signal};
use adaptarm_core::scenario::{Scenario, Scheme, SideBySide};
use adaptarm_core::trajectories::Fourier;
use anyhow::{Context, Result};
use serde_json::{Map, Value, json};
use std::time::Instant;

/// First argument of this program as a contestant; name, scheme, repetitions and steps per millisecond follow.
pub const MODE: &str = "own";

/// Instants that are printed.
const ROWS: usize = 25;

/// One of our ways to run a scenario.
struct Own {
    name: &'static str,
    /// Samples to record; as many as the scenario says where that is `None`.
    samples: Option<usize>,
    /// Runs; gives what was recorded and how long one simulation took, s.
    run: fn(&Scenario) -> (Recording, f64),
}

/// Runs of a batch.
const BATCH: usize = 64;

/// Every way of ours. Another one is another line.
fn all() -> Vec<Own> {
    vec![
        Own { name: "adaptarm, scalar", samples: None, run: scalar },
        Own { name: "adaptarm, scalar, with report", samples: None, run: with_report },
        Own { name: "adaptarm, batch of 64, per run", samples: None, run: batch },
        Own { name: "adaptarm, batch of 64, 25 samples", samples: Some(ROWS), run: batch },
    ]
}

fn scalar(scenario: &Scenario) -> (Recording, f64) {
    let start = Instant::now();
    let mut simulation = scenario.start();
    simulation.advance(u64::MAX);
    let seconds = start.elapsed().as_secs_f64();
    (simulation.into_recording(), seconds)
}

fn with_report(scenario: &Scenario) -> (Recording, f64) {
    let start = Instant::now();
    let run = std::hint::black_box(scenario.run());
    (run.recording, start.elapsed().as_secs_f64())
}

/// As many side by side as the machine has lanes, group after group. Every lane is held to the bits of a run alone.
fn batch(scenario: &Scenario) -> (Recording, f64) {
    let width = lanes::widths()[0];
    let group = vec![scenario; width];
    let mut seconds = 0.0;
    let mut runs = Vec::new();
    for _ in 0..BATCH / width {
        let start = Instant::now();
        let Some(mut lanes) = SideBySide::start(&group, width) else { continue };
        lanes.advance(u64::MAX);
        seconds += start.elapsed().as_secs_f64();
        runs = lanes.finish();
    }
    let alone = scenario.run();
    assert!(runs.iter().all(|run| *run == alone), "a lane has other bits than a run alone");
    (alone.recording, seconds / BATCH as f64)
}

/// Ours as contestants; the first is what others are compared with.
pub fn contestants() -> Result<Vec<Contestant>> {
    let program = std::env::current_exe().context("this program does not know its own path")?;
    let contestant = |own: Own| Contestant {
        name: own.name.to_owned(),
        program: program.clone(),
        arguments: vec![MODE.to_owned(), own.name.to_owned()],
        steps: Steps::Fixed,
    };
    Ok(all().into_iter().map(contestant).collect())
}

/// Runs and prints, as a contestant.
pub fn print(name: &str, scheme: &str, repetitions: &str, steps_per_ms: &str) -> Result<()> {
    let own = all().into_iter().find(|own| own.name == name).context("no such contestant")?;
    let scheme = Scheme::ALL.into_iter().find(|known| known.id() == scheme).context("no such scheme")?;
    let repetitions: usize = repetitions.parse().context("repetitions")?;
    let mut document = scheme.paper();
    document.integration.step_s = 1e-3 / f64::from(steps_per_ms.parse::<u32>().context("steps per millisecond")?);
    document.recording.samples = own.samples.unwrap_or(document.recording.samples);
    let scenario = Scenario::new(document)?;
    // Only the last recording is kept, as the peers do with their rows: memory of the others is used again.
    let (mut seconds, mut last) = (Vec::with_capacity(repetitions), None);
    for _ in 0..repetitions {
        drop(last.take());
        let (recording, run_s) = (own.run)(&scenario);
        seconds.push(run_s);
        last = Some(recording);
    }
    let duration_s = scenario.settings().duration_s;
    let times_s: Vec<f64> = (1..=ROWS).map(|n| n as f64 * duration_s / ROWS as f64).collect();
    let rows = rows(&last.context("no repetitions")?, &times_s)?;
    let print = |(time_s, numbers): (&f64, Vec<f64>)| {
        let mut row = Map::from_iter([("t_s".to_owned(), json!(time_s))]);
        let mut rest = numbers.as_slice();
        for (name, count) in SIGNALS {
            let (signal, after) = rest.split_at(count);
            row.insert(name.to_owned(), json!(signal));
            rest = after;
        }
        Value::Object(row)
    };
    let printed = json!({
        "scheme": scheme.id(),
        "with": format!("adaptarm-core {}", adaptarm_core::VERSION),
        "steps": scenario.settings().steps(),
        "seconds": seconds,
        "rows": times_s.iter().zip(rows).map(print).collect::<Vec<_>>(),
    });
    println!("{printed}");
    Ok(())
}

/// The numbers of [`SIGNALS`] at these times of a recording, which must be times of samples.
pub fn rows(recording: &Recording, times_s: &[f64]) -> Result<Vec<Vec<f64>>> {
    times_s.iter().map(|&time_s| row(recording, time_s)).collect()
}

fn row(recording: &Recording, time_s: f64) -> Result<Vec<f64>> {
    let is_there = |t: f64| (t - time_s).abs() < 1e-9;
    let index = recording.times_s().position(is_there).with_context(|| format!("no sample at {time_s} s"))?;
    let read = |signal: Signal| -> Vec<f64> {
        let count = recording.columns().count(signal);
        (0..count).filter_map(|component| recording.signal(signal, component).nth(index)).collect()
    };
    // Recordings hold the velocity's error.
    let desired = Fourier::<f64, 3>::paper().at(time_s).velocity;
    let velocity: Vec<f64> =
        read(Signal::ErrorRate).iter().zip(&desired).map(|(error, desired)| error + desired).collect();
    Ok([read(Signal::Position), velocity, read(Signal::Error), read(Signal::ThetaHat)].concat())
}
