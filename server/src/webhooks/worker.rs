//! Makes the calls that the queue holds, in every process that serves or computes. A failed one goes back into the queue
//! with its pause; one whose process died during the attempt is handed out again, so a receiver may see an event twice.

use super::{Delivery, Outcome, Sender};
use crate::jobs::{Handler, Queue, WEBHOOKS};
use crate::metrics;
use std::sync::Arc;
use std::time::Duration;
use tokio::sync::{Semaphore, watch};
use tokio::time::timeout;
use uuid::Uuid;

/// Calls made at a time: slow receivers must not hold up all others.
const AT_A_TIME: usize = 16;

/// How long to wait before listening to the queue again after it failed.
const LISTEN_AGAIN: Duration = Duration::from_secs(1);

/// How long to wait before an attempt is put back again into a queue that failed.
const PUSH_AGAIN: Duration = Duration::from_secs(5);

/// Makes calls until told to stop.
pub async fn run(queue: Arc<dyn Queue>, sender: Sender, mut stop: watch::Receiver<bool>) {
    let worker = format!("webhooks-{}-{}", std::process::id(), Uuid::now_v7());
    let handler: Handler = {
        let (queue, places) = (queue.clone(), Arc::new(Semaphore::new(AT_A_TIME)));
        Arc::new(move |payload| {
            let (queue, sender, places) = (queue.clone(), sender.clone(), places.clone());
            Box::pin(async move {
                // It is never closed, and a failure to wait is no reason not to call.
                let _place = places.acquire().await;
                match serde_json::from_value(payload) {
                    Ok(delivery) => attempt(&*queue, &sender, delivery).await,
                    Err(error) => tracing::error!("the queue holds a call that cannot be read: {error}"),
                }
            })
        })
    };
    while !*stop.borrow() {
        if let Err(error) = queue.run(WEBHOOKS, &worker, AT_A_TIME, handler.clone(), stop.clone()).await {
            tracing::warn!("{error}; listening again for calls to make");
        }
        // Either way it is time to look again.
        let _ = timeout(LISTEN_AGAIN, stop.wait_for(|stop| *stop)).await;
    }
}

async fn attempt(queue: &dyn Queue, sender: &Sender, delivery: Delivery) {
    let outcome = sender.deliver(&delivery).await;
    metrics::webhook_delivery(&outcome);
    let (job, event, attempt) = (delivery.job, delivery.event_id.clone(), delivery.attempt);
    match outcome {
        Outcome::Delivered => tracing::debug!(%job, event, attempt, "delivered"),
        Outcome::GiveUp { why } => tracing::warn!(%job, event, attempt, "not delivered, and given up: {why}"),
        Outcome::Retry { after, why } => {
            tracing::info!(%job, event, attempt, "not delivered, to be tried again in {:.0} s: {why}", after.as_secs_f64());
            let next = Delivery { attempt: attempt.saturating_add(1), ..delivery };
            put_back(queue, &next, after).await;
        }
    }
}

/// Puts a call back into the queue; while that fails, the queue counts this attempt as under way.
async fn put_back(queue: &dyn Queue, delivery: &Delivery, after: Duration) {
    let payload = match serde_json::to_value(delivery) {
        Ok(payload) => payload,
        Err(error) => return tracing::error!("a call cannot be written down: {error}"),
    };
    while let Err(error) = queue.push(WEBHOOKS, payload.clone(), after).await {
        tracing::warn!("cannot put a call back into the queue: {error}");
        tokio::time::sleep(PUSH_AGAIN).await;
    }
}
