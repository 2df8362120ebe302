//! The page in a real Chromium, served by the real binary: one trial per case, one fresh profile per page.
//!
//! Without `chromium` and `chromedriver` the trials show as ignored, unless `REQUIRE_BROWSER=1` makes that a failure;
//! `ADAPTARM_NO_BROWSER=1` always ignores them. Screenshots go to `target/screenshots`, or `ADAPTARM_SCREENSHOTS`.
//! Trials with axe-core need `ADAPTARM_AXE`, the path of its script, and are ignored without it unless `REQUIRE_PYTHON=1`:
//! it comes with a Python package. `ADAPTARM_BENCH=1` measures the page's speed instead of running trials.

mod bench;
mod cases;
mod contrast;
mod driver;
mod native;
mod page;
mod pictures;
mod relay;

use bench::Bench;
use libtest_mimic::{Arguments, Failed, Trial};
use std::sync::{Arc, OnceLock};

fn main() {
    if switched_on("ADAPTARM_BENCH") {
        if let Err(error) = Bench::start().and_then(|bench| cases::benchmark::run(&bench)) {
            eprintln!("{error:#}");
            std::process::exit(1);
        }
        return;
    }
    let mut arguments = Arguments::from_args();
    // One at a time: two browsers on a small machine would measure each other.
    arguments.test_threads = Some(1);
    let missing = driver::missing();
    let ignored = switched_on("ADAPTARM_NO_BROWSER") || missing.is_some() && !switched_on("REQUIRE_BROWSER");
    if let Some(program) = missing.filter(|_| ignored) {
        println!(
            "browser tests are ignored: {program} is not on PATH (Debian: apt-get install chromium chromium-driver)"
        );
    }
    // Started by the first trial that runs, so that listing and ignoring start nothing.
    let bench = Arc::new(OnceLock::new());
    let trials = cases::ALL.iter().map(|&(name, case)| {
        let bench = Arc::clone(&bench);
        let trial = Trial::test(name, move || {
            let started = bench.get_or_init(|| Bench::start().map_err(|error| format!("{error:#}")));
            let bench = started.as_ref().map_err(Failed::from)?;
            case(bench).map_err(|error| Failed::from(format!("{error:#}")))
        });
        let lacks_axe = name.starts_with("axe_") && cases::axe().is_none() && !switched_on("REQUIRE_PYTHON");
        trial.with_ignored_flag(ignored || lacks_axe)
    });
    let conclusion = libtest_mimic::run(&arguments, trials.collect());
    // Exiting runs no destructors, and these stop processes.
    drop(bench);
    conclusion.exit();
}

fn switched_on(name: &str) -> bool {
    std::env::var(name).is_ok_and(|value| !value.is_empty() && value != "0")
}
