//! The hub: asks the tables how all watched jobs stand, in one statement, and tells everyone who watches.

use crate::jobs::{Event, JobStore, Pulse, StoreError};
use std::collections::HashMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;
use tokio::sync::watch;
use tokio::task::JoinHandle;
use tokio::time::{sleep, timeout};
use uuid::Uuid;

/// Time between two looks.
const LOOK_INTERVAL: Duration = Duration::from_millis(100);

/// Time between two looks at a database that fails.
const LOOK_AGAIN: Duration = Duration::from_secs(1);

/// Latest events of a job that are held for its followers; who needs older ones reads them from the tables.
const RECENT: usize = 64;

/// What is known of a watched job.
#[derive(Debug, Clone, Default)]
pub enum Sight {
    /// Nothing yet.
    #[default]
    Unseen,
    /// How it stands.
    Seen {
        /// Its state, progress and last event.
        pulse: Pulse,
        /// Some of its latest events, in order and without gaps; possibly none.
        recent: Arc<[Arc<Event>]>,
    },
    /// There is no such job any more.
    Gone,
}

/// Where jobs can be watched; a clone is the same hub.
#[derive(Clone)]
pub struct Hub {
    inner: Arc<Inner>,
}

struct Inner {
    store: Arc<dyn JobStore>,
    watched: Mutex<Watched>,
    closing: watch::Sender<bool>,
}

#[derive(Default)]
struct Watched {
    jobs: HashMap<Uuid, watch::Sender<Sight>>,
    /// Runs for as long as anyone watches.
    looking: Option<JoinHandle<()>>,
}

impl Hub {
    /// A hub over these tables.
    pub fn new(store: Arc<dyn JobStore>) -> Self {
        Self { inner: Arc::new(Inner { store, watched: Mutex::default(), closing: watch::Sender::new(false) }) }
    }

    /// The tables.
    pub fn store(&self) -> &Arc<dyn JobStore> {
        &self.inner.store
    }

    /// Watches a job for as long as the receiver lives.
    pub fn watch(&self, id: Uuid) -> watch::Receiver<Sight> {
        let mut watched = self.inner.lock();
        let receiver = watched.jobs.entry(id).or_default().subscribe();
        if watched.looking.as_ref().is_none_or(JoinHandle::is_finished) {
            watched.looking = Some(tokio::spawn(look(self.inner.clone())));
        }
        receiver
    }

    /// Waits until a job has ended, but not longer than this and not beyond the end of the server.
    pub async fn wait(&self, id: Uuid, longest: Duration) {
        let (mut sight, mut closed) = (self.watch(id), self.closing());
        let ended = |sight: &Sight| match sight {
            Sight::Unseen => false,
            Sight::Seen { pulse, .. } => pulse.state.is_final(),
            Sight::Gone => true,
        };
        tokio::select! {
            _ = timeout(longest, sight.wait_for(ended)) => {}
            _ = closed.wait_for(|closed| *closed) => {}
        }
    }

    /// Sends everyone away: the server is about to end.
    pub fn close(&self) {
        self.inner.closing.send_replace(true);
    }

    /// Tells of [`Self::close`].
    pub(super) fn closing(&self) -> watch::Receiver<bool> {
        self.inner.closing.subscribe()
    }
}

impl Inner {
    fn lock(&self) -> MutexGuard<'_, Watched> {
        self.watched.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Forgets jobs that nobody watches any more; those that are left.
    fn watched(&self) -> Vec<Uuid> {
        let mut watched = self.lock();
        watched.jobs.retain(|_, sight| sight.receiver_count() > 0);
        if watched.jobs.is_empty() {
            watched.looking = None;
        }
        watched.jobs.keys().copied().collect()
    }

    /// Looks at these jobs and tells what is new.
    async fn tell(&self, ids: &[Uuid]) -> Result<(), StoreError> {
        let mut pulses: HashMap<_, _> =
            self.store.pulses(ids).await?.into_iter().map(|pulse| (pulse.id, pulse)).collect();
        for id in ids {
            let Some(before) = self.lock().jobs.get(id).map(|sight| sight.borrow().clone()) else { continue };
            let now = match (pulses.remove(id), before) {
                (None, Sight::Gone) => continue,
                (None, _) => Sight::Gone,
                (Some(pulse), Sight::Seen { pulse: before, .. }) if pulse == before => continue,
                (Some(pulse), before) => Sight::Seen { pulse, recent: self.recent(&pulse, before).await? },
            };
            if let Some(sight) = self.lock().jobs.get(id) {
                sight.send_replace(now);
            }
        }
        Ok(())
    }

    /// The latest events, if there are few new ones.
    async fn recent(&self, pulse: &Pulse, before: Sight) -> Result<Arc<[Arc<Event>]>, StoreError> {
        let Sight::Seen { pulse: before, recent } = before else { return Ok(Arc::default()) };
        let new = pulse.seq.saturating_sub(before.seq);
        if new == 0 {
            return Ok(recent);
        }
        if new > RECENT as i64 {
            return Ok(Arc::default());
        }
        let found = self.store.events(pulse.id, before.seq, RECENT as i64).await?.into_iter().map(Arc::new);
        // They go on from those at hand, or stand alone.
        let known = recent.iter().take_while(|event| event.seq <= before.seq).cloned();
        let all: Vec<_> = known.chain(found).collect();
        Ok(all[all.len().saturating_sub(RECENT)..].into())
    }
}

async fn look(hub: Arc<Inner>) {
    loop {
        let ids = hub.watched();
        if ids.is_empty() {
            return;
        }
        if let Err(error) = hub.tell(&ids).await {
            tracing::warn!("cannot look at the jobs that are watched: {error}");
            sleep(LOOK_AGAIN).await;
        }
        sleep(LOOK_INTERVAL).await;
    }
}
