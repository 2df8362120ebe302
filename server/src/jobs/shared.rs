//! What all work in one process shares: the stores, the pool, and who waits for whom.

use super::experiment::Opened;
use super::{Claim, JobStore, Queue};
use crate::config::{Config, Limits};
use crate::results::Results;
use rayon::ThreadPool;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::Duration;
use tokio::sync::{Notify, RwLock, Semaphore, watch};

/// What an engine keeps to.
#[derive(Debug, Clone)]
pub struct EngineSettings {
    /// Threads; 0 only accepts jobs.
    pub threads: usize,
    /// For how long a claim holds without a sign of life.
    pub lease: Duration,
    /// Time between two signs of life.
    pub heartbeat: Duration,
    /// Time after which a shard saves its state and lets others have their turn.
    pub slice: Duration,
    /// Bounds on jobs and users.
    pub limits: Limits,
}

impl EngineSettings {
    /// As the configuration says.
    pub fn of(config: &Config) -> Self {
        Self {
            threads: config.thread_count(),
            lease: config.queue.lease(),
            heartbeat: config.queue.heartbeat(),
            slice: config.queue.slice(),
            limits: config.limits.clone(),
        }
    }
}

/// What all work in this process shares.
pub(super) struct Shared {
    pub(super) store: Arc<dyn JobStore>,
    pub(super) results: Results,
    pub(super) settings: EngineSettings,
    pub(super) pool: ThreadPool,
    pub(super) queue: Arc<dyn Queue>,
    /// Name of this process in claims.
    pub(super) worker: String,
    pub(super) slots: Arc<Semaphore>,
    /// Rung when there may be work.
    pub(super) bell: Notify,
    /// Told of work while every slot was taken.
    pub(super) rung: AtomicBool,
    /// Held by all for ordinary shards, by one for a suspect.
    pub(super) company: RwLock<()>,
    pub(super) suspects_waiting: AtomicUsize,
    pub(super) stopping: watch::Sender<bool>,
    pub(super) abort_label: Option<String>,
    pub(super) experiments: Opened,
}

impl Shared {
    /// Whether this process is about to end.
    pub(super) fn is_stopping(&self) -> bool {
        *self.stopping.borrow()
    }

    /// Whether a suspect waits for everything else to let go.
    pub(super) fn is_wanted_alone(&self, claim: &Claim) -> bool {
        !claim.suspect && self.suspects_waiting.load(Ordering::Relaxed) > 0
    }
}
