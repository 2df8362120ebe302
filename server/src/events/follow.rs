//! Following one job to its end: every event once and in order, and progress in between.

use super::hub::{Hub, Sight};
use crate::jobs::{Event, EventKind, JobState, JobStore, Pulse};
use crate::metrics::SseSubscriber;
use serde::Serialize;
use std::collections::VecDeque;
use std::sync::Arc;
use std::time::Duration;
use tokio::sync::watch;
use tokio::time::{Instant, sleep, sleep_until};
use uuid::Uuid;

/// Shortest time between two tellings of progress.
const PROGRESS_INTERVAL: Duration = Duration::from_millis(250);

/// Events read from the tables at a time.
const PAGE: i64 = 200;

/// Time before reading again from tables that failed.
const READ_AGAIN: Duration = Duration::from_secs(1);

/// What a follower is told.
#[derive(Debug, Clone, PartialEq)]
pub enum Told {
    /// An event as it is stored.
    Event(Arc<Event>),
    /// How far the job is.
    Progress(Progress),
    /// The job was deleted before it ended.
    Deleted,
}

/// How far a job is.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, utoipa::ToSchema)]
pub struct Progress {
    /// Share done, 0 to 1.
    #[schema(minimum = 0, maximum = 1)]
    pub progress: f64,
    /// Scenarios with a result.
    #[schema(minimum = 0)]
    pub scenarios_done: i64,
}

/// Someone who follows a job. Takes its time: nothing is held for it but what it takes next.
pub struct Follower {
    id: Uuid,
    store: Arc<dyn JobStore>,
    sight: watch::Receiver<Sight>,
    closing: watch::Receiver<bool>,
    /// Number of the last event it was told.
    after: i64,
    /// Next ones.
    pending: VecDeque<Arc<Event>>,
    /// Whether there may be more in the tables than the hub tells of.
    behind: bool,
    progress: Option<Progress>,
    progress_due: Instant,
    ended: bool,
    _counted: SseSubscriber,
}

impl Follower {
    /// Follows a job from the event after this one.
    pub fn new(hub: &Hub, id: Uuid, after: i64) -> Self {
        Self {
            id,
            store: hub.store().clone(),
            sight: hub.watch(id),
            closing: hub.closing(),
            after,
            pending: VecDeque::new(),
            behind: true,
            progress: None,
            progress_due: Instant::now(),
            ended: false,
            _counted: SseSubscriber::enter(),
        }
    }

    /// What comes next; nothing after the job's final state, or when the server is about to end.
    pub async fn next(&mut self) -> Option<Told> {
        while !self.ended && !*self.closing.borrow() {
            if let Some(event) = self.pending.pop_front() {
                self.after = event.seq;
                self.ended = is_final(&event);
                return Some(Told::Event(event));
            }
            if self.behind {
                self.catch_up().await;
                if self.pending.is_empty() && !self.behind {
                    // The job is being deleted; the hub will say so in a moment.
                    self.wait().await;
                }
                continue;
            }
            let sight = self.sight.borrow_and_update().clone();
            match sight {
                Sight::Unseen => {}
                Sight::Gone => {
                    self.ended = true;
                    return Some(Told::Deleted);
                }
                Sight::Seen { pulse, recent } if pulse.seq > self.after => {
                    let whole = recent.first().is_some_and(|first| first.seq <= self.after + 1);
                    if whole {
                        self.pending.extend(recent.iter().filter(|event| event.seq > self.after).cloned());
                    }
                    self.behind = self.pending.is_empty();
                    continue;
                }
                Sight::Seen { pulse, .. } if pulse.state.is_final() => return None,
                Sight::Seen { pulse, .. } => {
                    if let Some(progress) = self.new_progress(&pulse) {
                        return Some(Told::Progress(progress));
                    }
                }
            }
            self.wait().await;
        }
        None
    }

    /// Reads from the tables what the hub no longer holds.
    async fn catch_up(&mut self) {
        match self.store.events(self.id, self.after, PAGE).await {
            Ok(events) => {
                self.behind = events.len() as i64 == PAGE;
                self.pending.extend(events.into_iter().map(Arc::new));
            }
            Err(error) => {
                tracing::warn!(job = %self.id, "cannot read events: {error}");
                sleep(READ_AGAIN).await;
            }
        }
    }

    /// Progress, if it is another one and the last telling was a while ago.
    fn new_progress(&mut self, pulse: &Pulse) -> Option<Progress> {
        let progress = Progress { progress: pulse.progress, scenarios_done: pulse.scenarios_done };
        if self.progress == Some(progress) || pulse.state == JobState::Queued || Instant::now() < self.progress_due {
            return None;
        }
        self.progress = Some(progress);
        self.progress_due = Instant::now() + PROGRESS_INTERVAL;
        Some(progress)
    }

    /// Until something may have changed.
    async fn wait(&mut self) {
        let due = self.progress_due;
        tokio::select! {
            _ = self.sight.changed() => {}
            _ = self.closing.wait_for(|closing| *closing) => {}
            () = sleep_until(due), if due > Instant::now() => {}
        }
    }
}

fn is_final(event: &Event) -> bool {
    let state =
        || serde_json::from_str::<serde_json::Value>(&event.data).ok()?["state"].as_str().and_then(JobState::from_id);
    event.kind == EventKind::State && state().is_some_and(JobState::is_final)
}
