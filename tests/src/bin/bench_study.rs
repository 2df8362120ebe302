//! How fast the core is, natively: `cargo xtask bench`.
//!
//! The default study on one core: median, fastest and slowest of 15 rounds per scheme, in milliseconds and microseconds per
//! step. Then ratios that should be one: time per step of long runs against short ones, and two threads against one over a
//! batch. What is compared takes turns within a round, so that a machine whose speed drifts slows all alike.

use adaptarm_core::lanes;
use adaptarm_core::scenario::{Scenario, Scheme, run_each};
use adaptarm_tests::timing::median;
use anyhow::Result;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

const ROUNDS: usize = 15;

fn main() -> Result<()> {
    study()?;
    durations()?;
    threads()
}

/// Seconds that `work` takes.
fn seconds(work: impl FnOnce()) -> f64 {
    let start = Instant::now();
    work();
    start.elapsed().as_secs_f64()
}

/// Time per step of runs of 3 s to 3000 s, as often one after another as makes 3000 s, against the shortest.
fn durations() -> Result<()> {
    const DURATIONS_S: [f64; 4] = [3.0, 30.0, 300.0, 3000.0];
    const DURATION_ROUNDS: usize = 7;
    let scenario = |duration_s: f64| {
        let mut document = Scheme::Proposed.paper();
        document.integration.duration_s = duration_s;
        // As many per second, whatever the duration.
        document.recording.samples = (10.0 * duration_s) as usize;
        Scenario::new(document)
    };
    let scenarios = DURATIONS_S.into_iter().map(scenario).collect::<Result<Vec<_>, _>>()?;
    let mut ratios = vec![Vec::new(); DURATIONS_S.len()];
    for _ in 0..DURATION_ROUNDS {
        let times: Vec<f64> = scenarios
            .iter()
            .zip(DURATIONS_S)
            .map(|(scenario, duration_s)| {
                let runs = (DURATIONS_S[3] / duration_s) as usize;
                seconds(|| {
                    for _ in 0..runs {
                        scenario.start().advance(u64::MAX);
                    }
                })
            })
            .collect();
        for (ratios, time) in ratios.iter_mut().zip(&times) {
            ratios.push(time / times[0]);
        }
    }
    println!("\nProposed scheme, 3000 s in runs of one duration, {DURATION_ROUNDS} rounds: time against runs of 3 s");
    for (duration_s, ratios) in DURATIONS_S.into_iter().zip(ratios) {
        println!("{duration_s:>8} s{:>10.3}", median(ratios));
    }
    Ok(())
}

/// A batch of different runs on one thread against two. Threads fetch shares of it, as workers fetch a job's shards, so that one that the
/// machine holds up makes the other wait for a share at most. Shares are small: were there 25, two threads could not be twice as fast.
fn threads() -> Result<()> {
    const RUNS: usize = 1000;
    const SHARE: usize = 8;
    const THREAD_ROUNDS: usize = 15;
    let scenarios = (0..RUNS)
        .map(|n| {
            let mut document = Scheme::Proposed.paper();
            document.integration.duration_s = 1.2;
            document.recording.samples = 300;
            document.plant.theta_scale = Some(vec![1.0 + n as f64 / RUNS as f64; 18]);
            Scenario::new(document)
        })
        .collect::<Result<Vec<_>, _>>()?;
    let shares: Vec<_> = scenarios.chunks(SHARE).collect();
    let work = |next: &AtomicUsize| {
        while let Some(share) = shares.get(next.fetch_add(1, Ordering::Relaxed)) {
            let _ = run_each(share, |_, run| {
                std::hint::black_box(run);
                ControlFlow::Continue(())
            });
        }
    };
    let on_threads = |count: usize| {
        let next = AtomicUsize::new(0);
        std::thread::scope(|scope| {
            for _ in 0..count {
                scope.spawn(|| work(&next));
            }
        });
    };
    let mut ratios = Vec::new();
    let mut one_thread_s = Vec::new();
    for _ in 0..THREAD_ROUNDS {
        let (one, two) = (seconds(|| on_threads(1)), seconds(|| on_threads(2)));
        ratios.push(one / two);
        one_thread_s.push(one);
    }
    println!(
        "\nBatch of {RUNS} different runs of 1.2 s, proposed scheme, {} side by side, {THREAD_ROUNDS} rounds:",
        lanes::widths()[0]
    );
    println!(
        "one thread {:.3} s ({:.3} us/step with reports), two threads {:.2} times as fast",
        median(one_thread_s.clone()),
        median(one_thread_s) * 1e6 / (RUNS as f64 * 1200.0),
        median(ratios)
    );
    Ok(())
}

/// The default study.
fn study() -> Result<()> {
    let scenarios =
        Scheme::ALL.into_iter().map(|scheme| Scenario::new(scheme.paper())).collect::<Result<Vec<_>, _>>()?;
    let mut times_ms = vec![Vec::with_capacity(ROUNDS); scenarios.len() + 1];
    // One round more than counted: the first warms caches and clocks.
    for round in 0..=ROUNDS {
        let mut study_ms = 0.0;
        for (scenario, times_ms) in scenarios.iter().zip(&mut times_ms) {
            let start = Instant::now();
            std::hint::black_box(scenario.run());
            let elapsed_ms = start.elapsed().as_secs_f64() * 1e3;
            study_ms += elapsed_ms;
            if round > 0 {
                times_ms.push(elapsed_ms);
            }
        }
        if round > 0 {
            times_ms[scenarios.len()].push(study_ms);
        }
    }
    println!("Default study, 12 s at 1 ms, RK4, one core, {ROUNDS} rounds");
    println!("{:<18}{:>12}{:>12}{:>12}{:>16}", "", "median ms", "fastest", "slowest", "median us/step");
    let names = Scheme::ALL.iter().map(|scheme| scheme.name()).chain(["whole study"]);
    let steps = scenarios.iter().map(|scenario| scenario.settings().steps());
    let steps: Vec<_> = steps.clone().chain([steps.sum()]).collect();
    for ((name, mut times_ms), steps) in names.zip(times_ms).zip(steps) {
        times_ms.sort_by(f64::total_cmp);
        let median = times_ms[ROUNDS / 2];
        println!(
            "{name:<18}{median:>12.2}{:>12.2}{:>12.2}{:>16.3}",
            times_ms[0],
            times_ms[ROUNDS - 1],
            median * 1e3 / steps as f64
        );
    }
    Ok(())
}
