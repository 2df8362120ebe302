//! Logs: one line per event on standard error, so that standard output stays for results. `RUST_LOG` chooses what.

use std::io::IsTerminal;
use tracing_subscriber::EnvFilter;

/// Starts logging for the rest of the process.
pub fn start() {
    // The page's files are listed one by one otherwise.
    let default = "info,memory_serve=warn";
    let filter = std::env::var("RUST_LOG").ok().filter(|filter| !filter.is_empty());
    let (filter, mistake) = match filter.as_deref().unwrap_or(default).parse::<EnvFilter>() {
        Ok(filter) => (filter, None),
        Err(error) => (EnvFilter::new(default), Some(error)),
    };
    let started = tracing_subscriber::fmt()
        .with_env_filter(filter)
        .with_writer(std::io::stderr)
        .with_ansi(std::io::stderr().is_terminal())
        .try_init();
    // Where someone in this process logs already, they may go on doing so.
    if let (Ok(()), Some(mistake)) = (started, mistake) {
        tracing::warn!("RUST_LOG is not understood and ignored: {mistake}");
    }
}
