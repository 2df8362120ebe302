//! `adaptarm teacher`: the way in for a teacher, for whoever can reach the server's data.

use super::Failure;
use super::options::StorageOptions;
use crate::classroom::invite;
use crate::laboratory::open_tables;
use crate::stdout::print;
use clap::{Args, Subcommand};

#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  adaptarm teacher link --data runs
  adaptarm teacher link --data runs --url https://lab.example.org")]
pub(super) struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Print a link that makes whoever opens it first a teacher, once and within a day. A running server knows it at once.
    Link {
        /// Where people reach the server; without this, the setting classroom.public_url, or the address of `bind`.
        #[arg(long, value_name = "URL")]
        url: Option<String>,
        #[command(flatten)]
        storage: StorageOptions,
    },
}

pub(super) fn run(Arguments { command: Command::Link { url, storage } }: &Arguments) -> Result<(), Failure> {
    let flags = url.iter().map(|url| ("classroom.public_url", url.clone())).collect();
    let config = storage.load(flags)?.config;
    let base = config.classroom.public_url.clone().unwrap_or_else(|| format!("http://{}", config.bind));
    super::runtime()?.block_on(async {
        let tables = open_tables(&config).await.map_err(Failure::chain)?;
        let made = invite(&*tables.classroom, base.trim_end_matches('/'), true).await;
        let (link, ends) = made.map_err(Failure::chain)?;
        eprintln!("It works once, until {ends}:");
        Ok(print(&format!("{link}\n"))?)
    })
}
