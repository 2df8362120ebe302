//! A run of named steps: a headline and a clock for each, stop at the first failure, a table at the end.
//!
//! A failure names the step and the command that repeats it alone.

use std::time::{Duration, Instant};

use anyhow::{Result, anyhow};

/// How a step ended when it did not fail.
pub(crate) enum Outcome {
    Done,
    /// Not run, for this reason.
    Skipped(String),
}

struct Finished {
    name: &'static str,
    took: Duration,
    result: String,
}

/// The steps so far.
pub(crate) struct Steps {
    started: Instant,
    finished: Vec<Finished>,
}

impl Steps {
    pub(crate) fn new() -> Self {
        Self { started: Instant::now(), finished: Vec::new() }
    }

    /// Runs one step. An error carries the step's name and `repeat`, and the table has been printed.
    pub(crate) fn run(
        &mut self,
        name: &'static str,
        repeat: &str,
        step: impl FnOnce() -> Result<Outcome>,
    ) -> Result<()> {
        eprintln!("\n==> {name} ({} since start)", seconds(self.started.elapsed()));
        let began = Instant::now();
        let outcome = step();
        let result = match &outcome {
            Ok(Outcome::Done) => "ok".to_owned(),
            Ok(Outcome::Skipped(reason)) => {
                eprintln!("skipped: {reason}");
                format!("skipped: {reason}")
            }
            Err(_) => "FAILED".to_owned(),
        };
        self.finished.push(Finished { name, took: began.elapsed(), result });
        outcome.map(|_| ()).map_err(|error| {
            self.print_table();
            anyhow!("step `{name}` failed: {error:#}\nrepeat it with: {repeat}")
        })
    }

    pub(crate) fn print_table(&self) {
        eprintln!("\n{}", self.table());
    }

    fn table(&self) -> String {
        let width = self.finished.iter().map(|step| step.name.len()).max().unwrap_or(0).max("total".len());
        let mut lines: Vec<String> = self
            .finished
            .iter()
            .map(|step| format!("{:width$}  {:>9}  {}", step.name, seconds(step.took), step.result))
            .collect();
        let total = self.finished.iter().map(|step| step.took).sum();
        lines.push(format!("{:width$}  {:>9}", "total", seconds(total)));
        lines.join("\n")
    }
}

fn seconds(duration: Duration) -> String {
    format!("{:.1} s", duration.as_secs_f64())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_failure_names_the_step_and_how_to_repeat_it() {
        let mut steps = Steps::new();
        steps.run("tidy", "cargo xtask tidy", || Ok(Outcome::Done)).unwrap();
        let error = steps.run("lints", "cargo clippy", || Err(anyhow!("3 warnings"))).unwrap_err();
        assert_eq!(error.to_string(), "step `lints` failed: 3 warnings\nrepeat it with: cargo clippy");
        assert!(steps.table().contains("tidy ") && steps.table().contains("FAILED"), "{}", steps.table());
    }

    #[test]
    fn a_skipped_step_shows_its_reason_and_is_no_failure() {
        let mut steps = Steps::new();
        steps.run("lints", "cargo clippy", || Ok(Outcome::Skipped("no clippy".into()))).unwrap();
        assert!(steps.table().contains("skipped: no clippy"));
    }
}
