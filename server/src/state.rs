//! What every request can reach.

use crate::auth::Gate;
use crate::classroom::Desk;
use crate::config::Config;
use crate::events::Hub;
use crate::guard::Hosts;
use crate::jobs::{Engine, JobStore};
use crate::laboratory::Laboratory;
use crate::lti::Tool;
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
    /// Who may do what.
    pub gate: Arc<Gate>,
    /// Classes.
    pub desk: Arc<Desk>,
    /// Learning platforms.
    pub lti: Arc<Tool>,
    /// Where jobs are watched.
    pub hub: Hub,
    draining: Arc<AtomicBool>,
}

impl AppState {
    /// State around a laboratory.
    pub fn new(laboratory: &Laboratory, desk: Arc<Desk>, lti: Arc<Tool>, config: &Config, hosts: Hosts) -> Self {
        Self {
            engine: laboratory.engine.clone(),
            store: laboratory.store.clone(),
            results: laboratory.results.clone(),
            receivers: laboratory.receivers.clone(),
            config: Arc::new(config.clone()),
            hosts,
            // Elsewhere than on this machine's own address, anyone may come.
            gate: Arc::new(Gate::new(laboratory.store.clone(), &config.auth, hosts == Hosts::Loopback)),
            desk,
            lti,
            hub: Hub::new(laboratory.store.clone()),
            draining: Arc::default(),
        }
    }

    /// Tells whoever asks that this server is about to end, and sends away whoever follows a job.
    pub fn drain(&self) {
        self.hub.close();
        self.draining.store(true, Ordering::Relaxed);
    }

    /// Whether it is about to end.
    pub fn is_draining(&self) -> bool {
        self.draining.load(Ordering::Relaxed)
    }
}
