//! `adaptarm worker`: computes for servers that share a PostgreSQL database, without serving anything itself.

use super::Failure;
use super::options::{ComputeOptions, StorageOptions};
use super::serve::CALLS_DRAIN;
use super::shutdown::Shutdown;
use crate::config::Config;
use crate::laboratory::Laboratory;
use crate::stdout::print;
use crate::{metrics, telemetry, webhooks};
use clap::Args;
use tokio::sync::watch;
use tokio::time::timeout;

#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  adaptarm worker --database postgres://adaptarm@db/adaptarm --results /shared/results
  adaptarm worker --database postgres://adaptarm@db/adaptarm --results s3://bucket/results --threads 8

Stop it with Ctrl-C or SIGTERM: it saves how far its work has come, and others go on with it.
If it dies instead, others take over from its last checkpoint when its lease has run out.")]
pub(super) struct Arguments {
    #[command(flatten)]
    storage: StorageOptions,
    #[command(flatten)]
    compute: ComputeOptions,
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let config = arguments.storage.load(arguments.compute.flags())?.config;
    if config.database.is_none() {
        return Err(Failure::input(
            "a worker needs --database postgres://...: the database in a data folder belongs to one server alone, which \
             computes by itself",
        ));
    }
    if config.results.is_none() {
        return Err(Failure::input("a worker needs --results: a folder or bucket that it shares with the servers"));
    }
    if config.thread_count() == 0 {
        return Err(Failure::input("threads: a worker with 0 threads would do nothing; 1 to 1024 are allowed"));
    }
    telemetry::start(&config.log);
    metrics::start();
    super::runtime()?.block_on(work(&config))
}

async fn work(config: &Config) -> Result<(), Failure> {
    let shutdown = Shutdown::watch().map_err(|error| Failure::system(format!("cannot watch for signals: {error}")))?;
    let laboratory = Laboratory::open(config).await.map_err(Failure::chain)?;
    print("adaptarm worker is ready\n")?;
    let engine = laboratory.engine.clone();
    let (end, ending) = watch::channel(false);
    let calling = tokio::spawn(webhooks::worker::run(laboratory.queue.clone(), laboratory.sender(config), ending));
    let working = tokio::spawn(async move { engine.run().await });
    shutdown.wait(|| laboratory.engine.stop()).await;
    end.send_replace(true);
    // It saves how far everything has come; whatever cannot be saved by then is left to its lease.
    if timeout(config.server.drain(), working).await.is_err() {
        tracing::warn!("some shards were still saving their state after {} s", config.server.drain_s);
    }
    // What is not delivered by then stays in the queue.
    let _ = timeout(CALLS_DRAIN, calling).await;
    tracing::info!("stopped");
    Ok(())
}
