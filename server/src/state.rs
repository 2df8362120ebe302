//! What every request can reach.

use crate::guard::Hosts;
use crate::jobs::Engine;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Shared by all requests; a clone is the same state.
#[derive(Clone)]
pub struct AppState {
    /// Runs jobs.
    pub engine: Engine,
    /// Whose names are answered.
    pub hosts: Hosts,
    draining: Arc<AtomicBool>,
}

impl AppState {
    /// State around an engine.
    pub fn new(engine: Engine, hosts: Hosts) -> Self {
        Self { engine, hosts, draining: Arc::default() }
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
