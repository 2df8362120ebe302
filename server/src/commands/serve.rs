//! `adaptarm serve`: binds, announces the address, serves until told to stop, and lets answers under way finish.

use super::Failure;
use super::options::{ComputeOptions, StorageOptions};
use crate::config::{Capacity, Config};
use crate::guard::Hosts;
use crate::state::AppState;
use crate::stdout::print;
use crate::{listener, metrics, router, telemetry};
use clap::Args;
use tokio::net::TcpListener;

#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  adaptarm serve                          http://127.0.0.1:8080
  adaptarm serve --bind 127.0.0.1:0       any free port; the first line printed names it
  adaptarm serve --config adaptarm.toml   with settings from a file
  RUST_LOG=debug adaptarm serve           with more in the log, which goes to standard error

Stop it with Ctrl-C or SIGTERM: requests under way are answered, unfinished jobs are dropped.
Jobs and results are kept in memory and end with the process.")]
pub(super) struct Arguments {
    /// Address and port to listen on; port 0 means any free one [default: 127.0.0.1:8080, env: ADAPTARM_BIND].
    #[arg(long, value_name = "ADDRESS:PORT")]
    bind: Option<String>,
    #[command(flatten)]
    storage: StorageOptions,
    #[command(flatten)]
    compute: ComputeOptions,
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let mut flags = arguments.compute.flags();
    flags.extend(arguments.bind.iter().map(|bind| ("bind", bind.clone())));
    let config = arguments.storage.load(flags)?.config;
    if !config.bind.ip().is_loopback() {
        return Err(Failure::input(format!(
            "--bind {}: other machines could reach this address, and there are no accounts or keys yet to keep them \
             from using it; bind to 127.0.0.1, and use an SSH tunnel or an authenticating proxy to come from elsewhere",
            config.bind
        )));
    }
    telemetry::start(&config.log);
    metrics::start();
    if let Some(data) = &config.data {
        let failure = |error| Failure::system(format!("data {}: cannot make this folder: {error}", data.display()));
        std::fs::create_dir_all(data).map_err(failure)?;
    }
    let runtime = tokio::runtime::Builder::new_multi_thread()
        .enable_all()
        .build()
        .map_err(|error| Failure::system(format!("cannot start the runtime: {error}")))?;
    runtime.block_on(serve(&config))
}

async fn serve(config: &Config) -> Result<(), Failure> {
    let shutdown = Shutdown::watch().map_err(|error| Failure::system(format!("cannot watch for signals: {error}")))?;
    let failure = |error| Failure::system(format!("bind {}: cannot listen there: {error}", config.bind));
    let listener = TcpListener::bind(config.bind).await.map_err(failure)?;
    let bound = listener.local_addr().map_err(failure)?;
    let state = AppState::in_memory(Capacity::default(), Hosts::of(bound)).map_err(Failure::system)?;
    let app = router::build_app(state.clone());
    let upkeep = tokio::spawn(metrics::keep_small());
    print(&format!("adaptarm is listening on http://{bound}\n"))?;
    listener::serve(listener, app, &config.server, shutdown.wait(&state)).await;
    upkeep.abort();
    state.engine.stop();
    match state.engine.store().unfinished().await {
        Ok(0) | Err(_) => tracing::info!("stopped"),
        Ok(count) => tracing::warn!("stopped; {count} unfinished jobs are dropped"),
    }
    Ok(())
}

/// The signals that end a server.
#[cfg(unix)]
struct Shutdown {
    interrupt: tokio::signal::unix::Signal,
    terminate: tokio::signal::unix::Signal,
}

#[cfg(unix)]
impl Shutdown {
    /// Watches from now on.
    fn watch() -> std::io::Result<Self> {
        use tokio::signal::unix::{SignalKind, signal};
        Ok(Self { interrupt: signal(SignalKind::interrupt())?, terminate: signal(SignalKind::terminate())? })
    }

    /// Done at the first signal; a second one ends the process at once.
    async fn wait(mut self, state: &AppState) {
        self.next().await;
        tracing::info!("stopping: answering requests under way; a second signal stops at once");
        state.drain();
        tokio::spawn(async move {
            self.next().await;
            std::process::exit(1);
        });
    }

    async fn next(&mut self) {
        tokio::select! {
            _ = self.interrupt.recv() => {}
            _ = self.terminate.recv() => {}
        }
    }
}

/// Ctrl-C, where there is nothing else.
#[cfg(not(unix))]
struct Shutdown;

#[cfg(not(unix))]
impl Shutdown {
    fn watch() -> std::io::Result<Self> {
        Ok(Self)
    }

    async fn wait(self, state: &AppState) {
        // Without a way to hear of it, nothing but killing the process stops it.
        if tokio::signal::ctrl_c().await.is_err() {
            std::future::pending::<()>().await;
        }
        state.drain();
    }
}
