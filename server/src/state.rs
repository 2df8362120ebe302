//! What every request can reach.

use crate::config::Config;
use crate::guard::Hosts;
use crate::jobs::{Engine, JobStore};
use crate::laboratory::Laboratory;
use crate::results::Results;
use crate::webhooks::Policy;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Shared by all requests; a clone is the same state.
#[derive(Clone)]
pub struct AppState {
    /// Accepts and runs jobs.
    pub engine: Engine,
    /// The tables.
    pub store: Arc<dyn JobStore>,
    /// Samples.
    pub results: Results,
    /// Whom webhooks may reach.
    pub receivers: Arc<Policy>,
    /// What the server was started with.
    pub config: Arc<Config>,
    /// Whose names are answered.
    pub hosts: Hosts,
    draining: Arc<AtomicBool>,
}

impl AppState {
    /// State around a laboratory.
    pub fn new(laboratory: &Laboratory, config: &Config, hosts: Hosts) -> Self {
        Self {
            engine: laboratory.engine.clone(),
            store: laboratory.store.clone(),
            results: laboratory.results.clone(),
            receivers: laboratory.receivers.clone(),
            config: Arc::new(config.clone()),
            hosts,
            draining: Arc::default(),
        }
    }

    /// Tells whoever asks that this server is about to end.
    pub fn drain(&self) {
        self.draining.store(true, Ordering::Relaxed);
    }

    /// Whether it is about to end.
    pub fn is_draining(&self) -> bool {
        self.draining.load(Ordering::Relaxed)
    }
}
