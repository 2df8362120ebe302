//! The queue: wakes workers and carries webhook deliveries, durably. What a woken worker does is decided by the tables.
//!
//! A ticket says "there may be work" and nothing more, so a lost or doubled one changes no result: fairness, priorities,
//! cancellation and retries are the tables' business, which the queue knows nothing of.

use super::StoreError;
use async_trait::async_trait;
use futures_util::future::BoxFuture;
use std::sync::Arc;
use std::time::Duration;
use tokio::sync::watch;

/// Tickets for workers.
pub(in crate::jobs) const TICKETS: &str = "adaptarm.tickets";

/// Deliveries to webhooks.
pub const WEBHOOKS: &str = "adaptarm.webhooks";

/// What is done with each task.
pub type Handler = Arc<dyn Fn(serde_json::Value) -> BoxFuture<'static, ()> + Send + Sync>;

/// A durable queue.
#[async_trait]
pub trait Queue: Send + Sync + 'static {
    /// Adds a task that is handed out after a delay.
    async fn push(&self, queue: &str, payload: serde_json::Value, delay: Duration) -> Result<(), StoreError>;

    /// Hands out tasks, some at a time, until told to stop. A task whose handler did not end is handed out again.
    async fn run(
        &self,
        queue: &'static str,
        worker: &str,
        at_a_time: usize,
        handler: Handler,
        stop: watch::Receiver<bool>,
    ) -> Result<(), StoreError>;

    /// Forgets tasks that are done.
    async fn sweep(&self) -> Result<u64, StoreError>;
}
