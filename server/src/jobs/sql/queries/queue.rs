//! The queue in the same database, by apalis.

use super::{Pool, QueueConfig, SqlStore, begin, push, storage};
use crate::jobs::StoreError;
use crate::jobs::queue::{Handler, Queue};
use apalis::prelude::{BoxDynError, Data, ParallelizeExt, PollWith, Strategy, TaskBuilder, WorkerBuilder, WorkerError};
use async_trait::async_trait;
use futures_util::future::BoxFuture;
use serde_json::Value;
use std::future::Future;
use std::time::Duration;
use tokio::sync::watch;
use tokio::time::sleep;

/// How often the queue is looked at even if nobody rang: other machines ring only their own bell.
const POLL_INTERVAL: Duration = Duration::from_millis(500);

/// How long to listen for more rings before looking.
const RING_PAUSE: Duration = Duration::from_millis(20);

/// Time between a worker's signs of life, and how many may be missing: then its tasks are handed out again.
const HEARTBEAT: Duration = Duration::from_secs(10);
const MISSED_HEARTBEATS: usize = 3;

#[async_trait]
impl Queue for SqlStore {
    async fn push(&self, queue: &str, payload: Value, delay: Duration) -> Result<(), StoreError> {
        let task = TaskBuilder::new(payload.to_string().into_bytes()).max_attempts(1).run_after(delay).build();
        let mut transaction = begin(&self.write).await?;
        push(&mut transaction, queue, vec![task]).await?;
        transaction.commit().await?;
        Ok(())
    }

    async fn run(
        &self,
        queue: &'static str,
        worker: &str,
        at_a_time: usize,
        handler: Handler,
        mut stop: watch::Receiver<bool>,
    ) -> Result<(), StoreError> {
        let (pool, bell, worker) = (self.write.clone(), self.pushed.subscribe(), worker.to_owned());
        let stopped = async move {
            // Whoever could tell it to stop is gone: that tells it too.
            let _ = stop.wait_for(|stop| *stop).await;
            Ok::<(), std::io::Error>(())
        };
        let running = hand_out(&pool, queue, &worker, at_a_time, handler, bell, stopped);
        running.await.map_err(|error| StoreError::Queue(error.to_string()))
    }

    async fn sweep(&self) -> Result<u64, StoreError> {
        let swept = sqlx::query(super::SWEEP).execute(&self.write).await?;
        Ok(swept.rows_affected())
    }
}

/// Hands out tasks until stopped. A function of its own, because the compiler cannot prove within another future that
/// this one may change threads.
fn hand_out(
    pool: &Pool,
    queue: &str,
    worker: &str,
    at_a_time: usize,
    handler: Handler,
    bell: watch::Receiver<u64>,
    stopped: impl Future<Output = Result<(), std::io::Error>> + Send + 'static,
) -> BoxFuture<'static, Result<(), WorkerError>> {
    let config = QueueConfig::default()
        .queue(queue)
        .batch_size(at_a_time)
        .heartbeat_interval(HEARTBEAT)
        .missed_heartbeats(MISSED_HEARTBEATS)
        // A task is taken by being fetched; only that it is done must still be noted.
        .lock_tasks(false);
    let bell = futures_util::stream::unfold(bell, |mut bell| async move {
        bell.changed().await.ok()?;
        // Many rings in a moment are one look.
        sleep(RING_PAUSE).await;
        bell.mark_unchanged();
        Some(((), bell))
    });
    let strategy = Strategy::new().stream(Box::pin(bell)).interval(POLL_INTERVAL);
    let worker = WorkerBuilder::new(worker)
        .backend(PollWith::new(storage(pool, config), strategy))
        .data(handler)
        .parallelize(tokio::spawn)
        .build(perform);
    Box::pin(worker.run_until(stopped))
}

async fn perform(payload: Value, handler: Data<Handler>) -> Result<(), BoxDynError> {
    handler(payload).await;
    Ok(())
}
