//! `adaptarm config`: the settings in force and where they come from, and an example file.

use super::Failure;
use super::options::{ComputeOptions, StorageOptions};
use crate::config;
use crate::stdout::print;
use clap::{Args, Subcommand};

#[derive(Debug, Args)]
pub(super) struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Check the settings and print those in force as TOML, each with its place if it is not a default.
    #[command(after_help = "\
Settings come from the file, then the environment (ADAPTARM_LIMITS_WAIT_S sets limits.wait_s), then flags; later ones win.
Passwords are masked. A mistake is told in one line, and the exit code is 2.")]
    Check {
        #[command(flatten)]
        storage: StorageOptions,
        #[command(flatten)]
        compute: ComputeOptions,
    },
    /// Print a commented file that sets every setting to its default.
    ShowDefault,
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    match &arguments.command {
        Command::Check { storage, compute } => {
            let sources = storage.sources(compute.flags());
            let loaded = sources.load()?;
            // A misspelt name would otherwise go unnoticed; other programs may own it, so it is no mistake.
            let ignored = sources.ignored().into_iter().map(|name| format!("# {name} is no setting and was ignored\n"));
            print(&(config::effective(&loaded) + &ignored.collect::<String>()))?;
        }
        Command::ShowDefault => print(&config::example())?,
    }
    Ok(())
}
