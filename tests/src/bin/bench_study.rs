//! How fast the default study is, natively on one core: `cargo xtask bench`.
//!
//! Prints the median, fastest and slowest of 15 rounds per scheme, in milliseconds and microseconds per step. The schemes
//! take turns within a round, so that a machine whose speed drifts slows them all alike.

use adaptarm_core::scenario::{Scenario, Scheme};
use anyhow::Result;
use std::time::Instant;

const ROUNDS: usize = 15;

fn main() -> Result<()> {
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
