//! The page in a real Chromium, served by the real binary: one trial per case, one fresh profile per page, two at a time.
//!
//! Without `chromium` and `chromedriver` the trials show as ignored, unless `REQUIRE_BROWSER=1` makes that a failure;
//! `ADAPTARM_NO_BROWSER=1` always ignores them. Screenshots go to `target/screenshots`, or `ADAPTARM_SCREENSHOTS`.
//! Trials with axe-core need `ADAPTARM_AXE`, the path of its script, and are ignored without it unless `REQUIRE_PYTHON=1`:
//! it comes with a Python package. `ADAPTARM_BENCH=1` measures the page's speed instead of running trials.

mod bench;
mod cases;
mod contrast;
mod driver;
mod moves;
mod native;
mod page;
mod pictures;
mod relay;

use adaptarm_tests::machine;
use anyhow::Result;
use bench::Bench;
use libtest_mimic::{Arguments, Failed, Trial};
use std::sync::{Arc, Mutex, PoisonError, RwLock};

fn main() {
    if switched_on("ADAPTARM_BENCH") {
        if let Err(error) = Bench::start().and_then(|bench| cases::benchmark::run(&bench)) {
            eprintln!("{error:#}");
            std::process::exit(1);
        }
        return;
    }
    let mut arguments = Arguments::from_args();
    // Pages and the server wait for each other; what is measured in a soak is measured alone.
    arguments.test_threads.get_or_insert(if machine::soak() { 1 } else { 2 });
    let missing = driver::missing();
    let ignored = switched_on("ADAPTARM_NO_BROWSER") || missing.is_some() && !switched_on("REQUIRE_BROWSER");
    if let Some(program) = missing.filter(|_| ignored) {
        println!(
            "browser tests are ignored: {program} is not on PATH (Debian: apt-get install chromium chromium-driver)"
        );
    }
    let benches = Arc::new(Benches::default());
    let trials = cases::ALL.iter().map(|&(name, case)| {
        let benches = Arc::clone(&benches);
        let trial = Trial::test(name, move || {
            let run = if cases::ALONE.contains(&name) { Benches::alone } else { Benches::beside };
            run(&benches, case).map_err(|error| Failed::from(format!("{error:#}")))
        });
        let lacks_axe = name.starts_with("axe_") && cases::axe().is_none() && !switched_on("REQUIRE_PYTHON");
        trial.with_ignored_flag(ignored || lacks_axe)
    });
    let conclusion = libtest_mimic::run(&arguments, trials.collect());
    // Exiting runs no destructors, and these stop processes.
    drop(benches);
    conclusion.exit();
}

/// Benches that no trial uses just now: as many as trials run at a time, started by the first that find none.
#[derive(Default)]
struct Benches {
    idle: Mutex<Vec<Bench>>,
    /// Whoever measures has it alone.
    quiet: RwLock<()>,
}

impl Benches {
    fn beside(&self, case: cases::Case) -> Result<()> {
        let _others = self.quiet.read().unwrap_or_else(PoisonError::into_inner);
        self.run(case)
    }

    fn alone(&self, case: cases::Case) -> Result<()> {
        let _alone = self.quiet.write().unwrap_or_else(PoisonError::into_inner);
        self.run(case)
    }

    fn run(&self, case: cases::Case) -> Result<()> {
        let idle = self.idle.lock().unwrap_or_else(PoisonError::into_inner).pop();
        let bench = idle.map_or_else(Bench::start, Ok)?;
        let outcome = case(&bench);
        self.idle.lock().unwrap_or_else(PoisonError::into_inner).push(bench);
        outcome
    }
}

fn switched_on(name: &str) -> bool {
    std::env::var(name).is_ok_and(|value| !value.is_empty() && value != "0")
}
