//! The engine: a bounded pool of threads that works on whatever shard's turn it is, woken by the queue.
//!
//! Computation never happens inside a future. A shard that may have killed its process before is tried alone, so that it
//! can take nothing else with it.

use super::experiment::Opened;
use super::queue::{Handler, TICKETS};
use super::shard;
use super::shared::{EngineSettings, Shared};
use super::{Claim, JobStore, NewJob, Order, Queue, StoreError, Submitted, Tick};
use crate::results::Results;
use anyhow::Context;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::Duration;
use tokio::sync::{Notify, RwLock, Semaphore, watch};
use tokio::task::JoinSet;
use tokio::time::{interval, sleep, timeout};
use uuid::Uuid;

/// How long to wait before looking for work without having been told of any.
const LOOK_INTERVAL: Duration = Duration::from_secs(1);

/// How long to wait before listening to the queue again after it failed.
const LISTEN_AGAIN: Duration = Duration::from_secs(1);

/// Tickets taken from the queue at a time.
const TICKETS_AT_A_TIME: usize = 64;

/// How much the computing threads give way, on the system's scale from 0 to 19.
#[cfg(target_os = "linux")]
const NICE: i32 = 10;

/// A job with this label ends its process when it begins: tests prove by it that nothing else suffers.
const ABORT_LABEL: &str = "ADAPTARM_TEST_ABORT_ON_LABEL";

/// The engine; a clone is the same engine.
#[derive(Clone)]
pub struct Engine {
    shared: Arc<Shared>,
}

impl Engine {
    /// An engine at rest.
    pub fn new(
        store: Arc<dyn JobStore>,
        queue: Arc<dyn Queue>,
        results: Results,
        settings: EngineSettings,
    ) -> anyhow::Result<Self> {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(settings.threads.max(1))
            .thread_name(|n| format!("simulation-{n}"))
            .start_handler(|_| give_way())
            .build()
            .context("cannot start the simulation threads")?;
        let shared = Shared {
            store,
            results,
            pool,
            queue,
            worker: format!("{}-{}", std::process::id(), Uuid::now_v7()),
            slots: Arc::new(Semaphore::new(settings.threads)),
            settings,
            bell: Notify::new(),
            rung: AtomicBool::new(false),
            company: RwLock::default(),
            suspects_waiting: AtomicUsize::new(0),
            stopping: watch::Sender::new(false),
            experiments: Opened::default(),
            abort_label: std::env::var(ABORT_LABEL).ok().filter(|label| !label.is_empty()),
        };
        Ok(Self { shared: Arc::new(shared) })
    }

    /// Accepts a job; it runs when its turn comes.
    pub async fn submit(&self, job: NewJob) -> Result<Submitted, StoreError> {
        self.shared.store.submit(job, &self.shared.settings.limits).await
    }

    /// Works until [`Self::stop`], then lets every shard save its state and go.
    pub async fn run(&self) {
        if self.shared.settings.threads == 0 {
            let _ = self.shared.stopping.subscribe().wait_for(|stop| *stop).await;
            return;
        }
        let listener = tokio::spawn(listen(self.shared.clone()));
        let mut stopping = self.shared.stopping.subscribe();
        let mut look = interval(LOOK_INTERVAL);
        let mut slots = JoinSet::new();
        loop {
            tokio::select! {
                _ = stopping.wait_for(|stop| *stop) => break,
                _ = look.tick() => {}
                () = self.shared.bell.notified() => {}
                Some(_) = slots.join_next() => continue,
            }
            match self.shared.slots.clone().try_acquire_owned() {
                Ok(permit) => {
                    let shared = self.shared.clone();
                    slots.spawn(async move {
                        drain(&shared).await;
                        drop(permit);
                    });
                }
                Err(_) => self.shared.rung.store(true, Ordering::Release),
            }
        }
        while slots.join_next().await.is_some() {}
        // It has heard of the end itself; what it still does is of no use to anyone.
        listener.abort();
    }

    /// Makes every shard save its state and go.
    pub fn stop(&self) {
        self.shared.stopping.send_replace(true);
    }
}

/// Makes the calling thread one that runs when no other needs the processor: answers come before computing.
fn give_way() {
    #[cfg(target_os = "linux")]
    if let Err(error) = rustix::process::setpriority_process(None, NICE) {
        tracing::debug!("computing threads keep their priority: {error}");
    }
}

/// Turns tickets into wake-ups, for as long as this process works.
async fn listen(shared: Arc<Shared>) {
    let rung = shared.clone();
    let handler: Handler = Arc::new(move |_| {
        rung.bell.notify_one();
        Box::pin(std::future::ready(()))
    });
    while !shared.is_stopping() {
        let stop = shared.stopping.subscribe();
        if let Err(error) = shared.queue.run(TICKETS, &shared.worker, TICKETS_AT_A_TIME, handler.clone(), stop).await {
            tracing::warn!("{error}; listening again");
        }
        let mut stop = shared.stopping.subscribe();
        // Either way it is time to look again.
        let _ = timeout(LISTEN_AGAIN, stop.wait_for(|stop| *stop)).await;
    }
}

/// Works on one shard after another until none is left.
async fn drain(shared: &Arc<Shared>) {
    while !shared.is_stopping() {
        // Before the claim: one that waits for a suspect to end would run out of its lease.
        let in_company = shared.company.read().await;
        let claim = match shared.store.claim(&shared.worker, shared.settings.lease).await {
            Ok(claim) => claim,
            Err(error) => {
                drop(in_company);
                tracing::warn!("cannot look for work: {error}");
                sleep(LOOK_INTERVAL).await;
                continue;
            }
        };
        match claim {
            Some(claim) if claim.suspect => {
                shared.bell.notify_one();
                drop(in_company);
                alone(shared, &claim).await;
            }
            Some(claim) => {
                // Where there was one shard there may be more: a neighbour should look.
                shared.bell.notify_one();
                begin(shared, &claim).await;
            }
            // Someone rang while this slot was busy.
            None if shared.rung.swap(false, Ordering::AcqRel) => {}
            None => return,
        }
    }
}

/// Works on a suspect, once everything else in this process has let go; until then its claim is kept alive.
async fn alone(shared: &Arc<Shared>, claim: &Claim) {
    shared.suspects_waiting.fetch_add(1, Ordering::Relaxed);
    let settings = &shared.settings;
    let mut waiting = std::pin::pin!(shared.company.write());
    let alone = loop {
        if let Ok(alone) = timeout(settings.heartbeat, &mut waiting).await {
            break Some(alone);
        }
        match shared.store.tick(claim, Tick::waiting(claim), settings.lease, &settings.limits).await {
            Ok(Order::Stop) => break None,
            Ok(_) => {}
            Err(error) => tracing::warn!(job = %claim.job, "cannot reach the store: {error}"),
        }
    };
    shared.suspects_waiting.fetch_sub(1, Ordering::Relaxed);
    if alone.is_some() {
        begin(shared, claim).await;
    }
}

async fn begin(shared: &Arc<Shared>, claim: &Claim) {
    if shared.abort_label.is_some() && shared.abort_label == claim.label {
        tracing::error!(job = %claim.job, "{ABORT_LABEL} names this job's label: ending the process");
        std::process::abort();
    }
    shard::work(shared, claim).await;
}
