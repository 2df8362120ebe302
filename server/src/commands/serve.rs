//! `adaptarm serve`: binds, announces the address, serves until told to stop, and lets answers under way finish.

use super::Failure;
use super::options::{ComputeOptions, StorageOptions};
use super::shutdown::Shutdown;
use crate::classroom::{Desk, forget_sessions, grade};
use crate::config::{Config, Retention};
use crate::guard::Hosts;
use crate::jobs::{JobStore, Queue, collect_garbage};
use crate::laboratory::{Laboratory, data_folder};
use crate::results::Results;
use crate::state::AppState;
use crate::stdout::print;
use crate::{listener, lti, metrics, router, telemetry, webhooks};
use clap::Args;
use std::sync::Arc;
use std::time::Duration;
use tokio::net::TcpListener;
use tokio::sync::watch;
use tokio::time::{sleep, timeout};

/// Time between two looks at what can be forgotten.
const UPKEEP_INTERVAL: Duration = Duration::from_hours(1);

/// How long the end waits for calls to webhooks that are under way.
pub(super) const CALLS_DRAIN: Duration = Duration::from_secs(2);

#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  adaptarm serve                          http://127.0.0.1:8080
  adaptarm serve --bind 127.0.0.1:0       any free port; the first line printed names it
  adaptarm serve --config adaptarm.toml   with settings from a file
  RUST_LOG=debug adaptarm serve           with more in the log, which goes to standard error

Stop it with Ctrl-C or SIGTERM: requests under way are answered, and jobs go on when it is started again.
Jobs and results are kept in the data folder, by default ./adaptarm-data; also if it is killed, nothing is lost.")]
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
    telemetry::start(&config.log);
    metrics::start();
    super::runtime()?.block_on(serve(&config))
}

async fn serve(config: &Config) -> Result<(), Failure> {
    let shutdown = Shutdown::watch().map_err(|error| Failure::system(format!("cannot watch for signals: {error}")))?;
    let failure = |error| Failure::system(format!("bind {}: cannot listen there: {error}", config.bind));
    let listener = TcpListener::bind(config.bind).await.map_err(failure)?;
    let bound = listener.local_addr().map_err(failure)?;
    let laboratory = Laboratory::open(config).await.map_err(Failure::chain)?;
    let desk = laboratory.desk(config).await.map_err(Failure::chain)?;
    let tool = laboratory.tool(&desk, config).map_err(Failure::chain)?;
    let state = AppState::new(&laboratory, desk.clone(), tool.clone(), config, Hosts::of(bound));
    let app = router::build_app(state.clone());
    let engine = laboratory.engine.clone();
    let working = tokio::spawn({
        let engine = engine.clone();
        async move { engine.run().await }
    });
    let (end, ending) = watch::channel(false);
    let grading = tokio::spawn(grade(desk.clone(), laboratory.store.clone(), ending.clone()));
    let passing = tokio::spawn(lti::pass_back(tool, ending.clone()));
    let calling = tokio::spawn(webhooks::worker::run(laboratory.queue.clone(), laboratory.sender(config), ending));
    let upkeep = tokio::spawn(keep_tidy(
        laboratory.store.clone(),
        laboratory.queue.clone(),
        laboratory.results.clone(),
        desk.clone(),
        config.retention.clone(),
    ));
    let measuring = tokio::spawn(metrics::keep_small());
    if !bound.ip().is_loopback() && laboratory.store.tokens().await.map_err(Failure::chain)?.is_empty() {
        tracing::warn!(
            "other machines can reach {bound}, so every request for jobs needs a token, and there are none yet: \
             `adaptarm token create --owner NAME`, with the same --data or --database, makes one"
        );
    }
    if config.database.is_some() && config.results.is_none() {
        tracing::warn!("results are kept on this machine alone; workers and other servers need --results in common");
    }
    tracing::info!(
        version = env!("CARGO_PKG_VERSION"),
        data = %data_folder(config).display(),
        database = config.database.as_ref().map_or_else(|| "in the data folder".to_owned(), ToString::to_string),
        threads = config.thread_count(),
        "serving"
    );
    print(&format!("adaptarm is listening on http://{bound}\n"))?;
    if let Some(link) = desk.first_link(&format!("http://{bound}")).await.map_err(Failure::chain)? {
        print(&format!("The first teacher begins here, once and within a day: {link}\n"))?;
    }
    let stop = || {
        state.drain();
        engine.stop();
        end.send_replace(true);
    };
    listener::serve(listener, app, &config.server, shutdown.wait(stop)).await;
    upkeep.abort();
    measuring.abort();
    // It saves how far everything has come; the next server goes on from there.
    if timeout(config.server.drain(), working).await.is_err() {
        tracing::warn!("some shards were still saving their state after {} s", config.server.drain_s);
    }
    // What is not delivered by then stays in the queue.
    let _ = timeout(CALLS_DRAIN, calling).await;
    // Nor is a grade forgotten that no platform has yet.
    let _ = timeout(CALLS_DRAIN, passing).await;
    // Nor is a grade that is not written yet: the next server makes it.
    let _ = timeout(CALLS_DRAIN, grading).await;
    tracing::info!("stopped");
    Ok(())
}

/// Forgets, now and then, what is older than it should become.
async fn keep_tidy(
    store: Arc<dyn JobStore>,
    queue: Arc<dyn Queue>,
    results: Results,
    desk: Arc<Desk>,
    retention: Retention,
) {
    loop {
        sleep(UPKEEP_INTERVAL).await;
        match collect_garbage(&*store, &*queue, &results, &retention).await {
            Ok(forgotten) => tracing::info!(?forgotten, "upkeep"),
            Err(error) => tracing::warn!("upkeep: {error:#}"),
        }
        if let Err(error) = forget_sessions(&desk).await {
            tracing::warn!("upkeep: {error}");
        }
    }
}
