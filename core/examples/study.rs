//! Runs the paper's study and prints its indices and how long it took: a first look at the core.

use adaptarm_core::scenario::{Scenario, Scheme};
use std::time::Instant;

fn main() {
    let start = Instant::now();
    for scheme in Scheme::ALL {
        let run = match Scenario::new(scheme.paper()) {
            Ok(scenario) => scenario.run(),
            Err(error) => return eprintln!("{error}"),
        };
        println!(
            "{:<17} I(e) = {:.4?} deg  {}",
            scheme.name(),
            run.report.metrics.index_e_deg,
            run.report.trajectory_hash
        );
    }
    println!("{:.1} ms", start.elapsed().as_secs_f64() * 1e3);
}
