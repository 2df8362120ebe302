//! The command line: what can be asked, and what the exit code says about the answer.

mod config;
mod exercise;
mod experiment;
mod gc;
mod openapi;
mod options;
mod presets;
mod receipt;
mod run;
mod samples;
mod serve;
mod shutdown;
mod token;
mod worker;

use crate::document::brief;
use crate::replicate::{BadSettings, ReplicateArgs, replicate};
use crate::stdout::PrintError;
use clap::{Parser, Subcommand};
use std::fmt::Display;
use std::process::ExitCode;

const EXIT_CODES: &str = "\
Exit codes:
  0  done; a simulation that diverged is done too: its report says so
  1  something could not be read, written or bound
  2  the input or the arguments are wrong";

const EXAMPLES: &str = "\
Examples:
  adaptarm run --preset proposed            the paper's scheme: a report as JSON
  adaptarm presets --show proposed > my.json    a scenario to start from
  adaptarm run my.json --csv my.csv         its report, and its samples as a table
  adaptarm replicate                        the published study, regenerated
  adaptarm experiment tuning.json --out tuning    sweeps, Monte Carlo, comparisons, tuning
  adaptarm serve                            the laboratory at http://127.0.0.1:8080";

/// Adaptive control of robot arms: simulate, compare, explore.
#[derive(Debug, Parser)]
#[command(name = "adaptarm", version, after_help = format!("{EXAMPLES}\n\n{EXIT_CODES}"), arg_required_else_help = true)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Simulate one scenario and print the report on it.
    Run(run::Arguments),
    /// List the scenarios that have a name, or print one.
    Presets(presets::Arguments),
    /// Regenerate the published study: tables, claims, figures and a report in a folder.
    Replicate(ReplicateArgs),
    /// Make the runs of an experiment: a sweep, a Monte Carlo study, a comparison of schemes, or a tuning.
    Experiment(experiment::Arguments),
    /// List, check, calibrate and grade exercises.
    Exercise(exercise::Arguments),
    /// Check a signed receipt for a grade, and make its runs again.
    Receipt(receipt::Arguments),
    /// Serve the laboratory's page and its HTTP API.
    Serve(serve::Arguments),
    /// Compute for servers that share a PostgreSQL database.
    Worker(worker::Arguments),
    /// Forget jobs and results that are older than the settings say.
    Gc(gc::Arguments),
    /// Make, list or revoke the tokens by which a server on a public address knows its users.
    Token(token::Arguments),
    /// Print the description of the HTTP API as OpenAPI 3.1.
    Openapi,
    /// Check the settings, or print an example file.
    Config(config::Arguments),
}

/// Runs the program.
pub fn main() -> ExitCode {
    let done = match Cli::parse().command {
        Command::Run(arguments) => run::run(&arguments),
        Command::Presets(arguments) => presets::run(&arguments),
        Command::Replicate(arguments) => replicate(&arguments).map_err(|error| {
            // The whole chain of causes on one line.
            let message = format!("{error:#}");
            if error.is::<BadSettings>() { Failure::input(message) } else { Failure::system(message) }
        }),
        Command::Experiment(arguments) => experiment::run(&arguments),
        Command::Exercise(arguments) => exercise::run(&arguments),
        Command::Receipt(arguments) => receipt::run(&arguments),
        Command::Serve(arguments) => serve::run(&arguments),
        Command::Worker(arguments) => worker::run(&arguments),
        Command::Gc(arguments) => gc::run(&arguments),
        Command::Openapi => openapi::run(),
        Command::Token(arguments) => token::run(&arguments),
        Command::Config(arguments) => config::run(&arguments),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("adaptarm: {}", brief(&failure.message));
            ExitCode::from(failure.code)
        }
    }
}

/// What asynchronous work runs on.
fn runtime() -> Result<tokio::runtime::Runtime, Failure> {
    tokio::runtime::Builder::new_multi_thread()
        .enable_all()
        .build()
        .map_err(|error| Failure::system(format!("cannot start the runtime: {error}")))
}

/// Why a command did not do what it was asked: one line, and an exit code.
#[derive(Debug)]
pub struct Failure {
    code: u8,
    message: String,
}

impl Failure {
    /// The world did not cooperate.
    pub fn system(message: impl Display) -> Self {
        Self { code: 1, message: message.to_string() }
    }

    /// The same, with the whole chain of causes on one line.
    pub fn chain(error: impl Into<anyhow::Error>) -> Self {
        let mut told = String::new();
        for cause in error.into().chain().map(ToString::to_string) {
            // Many errors repeat what caused them.
            if !told.contains(&cause) {
                told = if told.is_empty() { cause } else { format!("{told}: {cause}") };
            }
        }
        Self::system(told)
    }

    /// What was asked makes no sense.
    pub fn input(message: impl Display) -> Self {
        Self { code: 2, message: message.to_string() }
    }
}

impl From<PrintError> for Failure {
    fn from(error: PrintError) -> Self {
        Self::system(error)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn arguments_are_consistent() {
        Cli::command().debug_assert();
    }
}
