//! Working on one shard: computing what it holds, telling the store how far it is, and letting go of it when the store says
//! so. `study` and `part` say what a shard holds.

mod part;
mod study;

use super::compute::{Control, Failure, Members, Stretch, compute, words};
use super::shared::Shared;
use super::{Claim, Order, PartWork, StoreError, Task, Tick};
use crate::metrics::{self, FailureReason};
use crate::results::Checkpoint;
use adaptarm_core::lanes;
use adaptarm_core::scenario::{Run, Scenario};
use bytes::Bytes;
use std::future::Future;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::time::{Duration, Instant};
use tokio::sync::oneshot;
use tokio::time::{sleep, timeout};

/// A checkpoint may cost this share of the time between two of them.
const CHECKPOINT_SHARE: u32 = 20;

/// First and longest pause before something that failed is tried again, and how long to go on trying.
const RETRY_FIRST: Duration = Duration::from_millis(100);
const RETRY_LONGEST: Duration = Duration::from_secs(5);
const RETRY_FOR: Duration = Duration::from_mins(2);

/// How work on a shard ended, where it was not simply done.
#[derive(Debug)]
enum Stopped {
    /// The claim does not hold any more, or the job has ended.
    Lost,
    /// Others wait, or this process is about to end: the state is saved and the shard is given back.
    Yielded,
    /// Its job must fail.
    Failed(FailureReason, String),
    /// The store cannot be reached: others will find the shard when its lease has run out.
    Unreachable(StoreError),
}

/// Works on a shard until it is done or must be let go.
pub(super) async fn work(shared: &Arc<Shared>, claim: &Claim) {
    let began = Instant::now();
    let now = Instant::now();
    let mut worker =
        Worker { shared, claim, counted: claim.steps_done, began, since_tick: now, told: now, saved: false };
    let worked = match &claim.task {
        Task::Scenarios(scenarios) => worker.study(scenarios).await,
        Task::Part(part) => match &part.work {
            PartWork::Runs(range) => worker.runs(part, range).await,
            PartWork::Fold => worker.fold(part).await,
        },
    };
    match worked {
        Ok(()) => {}
        Err(Stopped::Lost) => {
            tracing::info!(job = %claim.job, shard = claim.shard, "let go: the job ended or others took over");
        }
        Err(Stopped::Yielded) => {
            if let Err(error) = retry(shared, || shared.store.release(claim)).await {
                tracing::warn!(job = %claim.job, shard = claim.shard, "cannot give the shard back: {error}");
            }
        }
        Err(Stopped::Failed(kind, reason)) => {
            metrics::job_failed(kind);
            tracing::error!(job = %claim.job, shard = claim.shard, "{reason}");
            if let Err(error) = retry(shared, || shared.store.fail(claim, &reason)).await {
                tracing::warn!(job = %claim.job, shard = claim.shard, "cannot note that the job failed: {error}");
            }
        }
        Err(Stopped::Unreachable(error)) => {
            tracing::warn!(job = %claim.job, shard = claim.shard, "left to its lease: {error}");
        }
    }
    metrics::shard_took(began.elapsed());
}

struct Worker<'a> {
    shared: &'a Arc<Shared>,
    claim: &'a Claim,
    /// Steps of what is under way that the store has counted.
    counted: i64,
    began: Instant,
    /// Since when computing time has not been reported.
    since_tick: Instant,
    /// When the store last heard that this shard is alive.
    told: Instant,
    /// Whether there is a checkpoint.
    saved: bool,
}

impl Worker<'_> {
    /// How far the shard was when it was let go.
    async fn load(&mut self) -> Result<Checkpoint, Stopped> {
        let results = &self.shared.results;
        let loaded = self.alive(results.load(self.claim.job, self.claim.shard)).await?;
        let checkpoint = loaded.unwrap_or_else(|error| {
            tracing::warn!(job = %self.claim.job, "cannot use a checkpoint, only time is lost: {error}");
            None
        });
        self.saved = checkpoint.is_some();
        Ok(checkpoint.unwrap_or_default())
    }

    /// Forgets it, once the shard is done.
    async fn discard(&self) {
        if self.saved
            && let Err(error) = self.shared.results.discard(self.claim.job, self.claim.shard).await
        {
            tracing::warn!(job = %self.claim.job, "cannot remove a checkpoint that is done with: {error}");
        }
    }

    /// Most scenarios that are computed together: as many as there are lanes, but a suspect is found out one by one.
    fn most_together(&self) -> usize {
        if self.claim.suspect { 1 } else { lanes::widths()[0] }
    }

    /// Does something on a thread of the pool. A panic there fails the job.
    async fn on_pool<T: Send + 'static>(
        &mut self,
        work: impl FnOnce() -> Result<T, Failure> + Send + 'static,
    ) -> Result<T, Stopped> {
        let (sender, receiver) = oneshot::channel();
        self.shared.pool.spawn_fifo(move || {
            let done = catch_unwind(AssertUnwindSafe(work));
            // Nobody listens any more where the runtime has ended.
            let _ = sender.send(done.unwrap_or_else(|panic| Err((FailureReason::Panicked, words(&*panic).to_owned()))));
        });
        let silent =
            |_| Stopped::Failed(FailureReason::Panicked, "the computing thread ended without a word".to_owned());
        let done = self.alive(receiver).await?.map_err(silent)?;
        done.map_err(|(kind, reason)| Stopped::Failed(kind, reason))
    }

    /// Computes scenarios together, in stretches between which their state is saved; what `keep` makes of each.
    async fn compute<T: Send + 'static>(
        &mut self,
        members: Members,
        checkpoint: &Checkpoint,
        keep: impl Fn(i64, &Scenario, Run) -> Result<T, Failure> + Clone + Send + 'static,
    ) -> Result<Vec<T>, Stopped> {
        let members = Arc::new(members);
        let mut from = checkpoint.snapshots_of(&members.numbers);
        let mut interval = self.shared.settings.slice;
        loop {
            let step = from.iter().map(|snapshot| snapshot.step).sum();
            let control = Arc::new(Control::starting_at(members.steps, step));
            let (sender, receiver) = oneshot::channel();
            let (computed, watched, keep) = (members.clone(), control.clone(), keep.clone());
            self.shared.pool.spawn_fifo(move || {
                // Nobody listens any more where the runtime has ended.
                let _ = sender.send(compute(&computed, &from, &watched, keep));
            });
            let (stretch, order) = self.watch(receiver, &control, interval).await?;
            let (bytes, snapshots) = match stretch {
                Stretch::Finished(finished) => return Ok(finished),
                Stretch::Failed(kind, reason) => return Err(Stopped::Failed(kind, reason)),
                Stretch::Paused(bytes, snapshots) => (bytes, snapshots),
            };
            if order == Order::Stop {
                return Err(Stopped::Lost);
            }
            let began = Instant::now();
            let kept = self.save(bytes, control.steps()).await?;
            // Letting go of what could not be saved would only lose it; at the end there is no choice.
            if order == Order::Yield && (kept || self.shared.is_stopping()) {
                return Err(Stopped::Yielded);
            }
            interval = self.shared.settings.slice.max(began.elapsed() * CHECKPOINT_SHARE);
            from = snapshots;
        }
    }

    /// Tells the store now and then that a shard of many short scenarios goes on, and asks whether it should.
    async fn go_on(&mut self, steps: u64) -> Result<(), Stopped> {
        // Short scenarios one after another are a long time too.
        if self.told.elapsed() < self.shared.settings.heartbeat {
            return Ok(());
        }
        match self.tick(steps, true, self.began.elapsed() >= self.shared.settings.slice).await {
            Ok(Order::Stop) => Err(Stopped::Lost),
            Ok(Order::Yield) => Err(Stopped::Yielded),
            Ok(Order::Continue) => Ok(()),
            Err(error) => {
                tracing::warn!(job = %self.claim.job, "cannot reach the store: {error}");
                Ok(())
            }
        }
    }

    /// Watches over a stretch of computing: tells the store that it goes on, and pauses it when it must.
    async fn watch<T>(
        &mut self,
        mut stretch: oneshot::Receiver<Stretch<T>>,
        control: &Control,
        interval: Duration,
    ) -> Result<(Stretch<T>, Order), Stopped> {
        let began = Instant::now();
        let mut order = Order::Continue;
        loop {
            if let Ok(done) = timeout(self.shared.settings.heartbeat, &mut stretch).await {
                let silent = |_| {
                    Stopped::Failed(FailureReason::Panicked, "the computing thread ended without a word".to_owned())
                };
                let stretch = done.map_err(silent)?;
                return Ok((stretch, order));
            }
            let turn_over = began.elapsed() >= interval;
            match self.tick(control.steps(), false, turn_over).await {
                Ok(Order::Continue) => {}
                Ok(told) => order = told,
                // Computing goes on: the fence decides in the end whether it was worth it.
                Err(error) => tracing::warn!(job = %self.claim.job, "cannot reach the store: {error}"),
            }
            // A suspect that has come this far is none any more, and need not keep everyone else waiting.
            let acquitted = turn_over && self.claim.suspect;
            if order == Order::Continue && (acquitted || self.must_let_go()) {
                order = Order::Yield;
            }
            if order != Order::Continue || turn_over {
                control.pause();
            }
        }
    }

    /// Whether this process is about to end, or a suspect waits to be alone in it.
    fn must_let_go(&self) -> bool {
        self.shared.is_stopping() || self.shared.is_wanted_alone(self.claim)
    }

    async fn tick(&mut self, steps: u64, saved: bool, turn_over: bool) -> Result<Order, StoreError> {
        let computed = self.computed();
        let tick = Tick { steps_done: steps as i64, steps_before: self.counted, computed, saved, turn_over };
        let settings = &self.shared.settings;
        let order = self.shared.store.tick(self.claim, tick, settings.lease, &settings.limits).await?;
        self.counted = tick.steps_done;
        self.told = Instant::now();
        Ok(order)
    }

    /// Waits for the result store for as long as it takes, telling meanwhile that this shard is alive: its lease must not
    /// run out because a disk or a network is slow.
    async fn alive<T>(&mut self, work: impl Future<Output = T>) -> Result<T, Stopped> {
        let mut work = std::pin::pin!(work);
        loop {
            if let Ok(done) = timeout(self.shared.settings.heartbeat, &mut work).await {
                return Ok(done);
            }
            match self.tick(self.counted as u64, false, false).await {
                Ok(Order::Stop) => return Err(Stopped::Lost),
                Ok(_) => {}
                Err(error) => tracing::warn!(job = %self.claim.job, "cannot reach the store: {error}"),
            }
        }
    }

    /// Saves how far the shard is. A full disk is no reason to stop computing: the result will show whether there is room.
    async fn save(&mut self, bytes: Bytes, steps: u64) -> Result<bool, Stopped> {
        let results = &self.shared.results;
        let kept = self.alive(results.save(self.claim.job, self.claim.shard, bytes)).await?;
        if let Err(error) = &kept {
            tracing::warn!(job = %self.claim.job, shard = self.claim.shard, "cannot save a checkpoint: {error}");
        }
        self.saved |= kept.is_ok();
        match self.tick(steps, kept.is_ok(), false).await {
            Ok(Order::Stop) => Err(Stopped::Lost),
            Ok(_) => Ok(kept.is_ok()),
            Err(error) => {
                tracing::warn!(job = %self.claim.job, "cannot reach the store: {error}");
                Ok(kept.is_ok())
            }
        }
    }

    /// Computing time since it was last told.
    fn computed(&mut self) -> Duration {
        std::mem::replace(&mut self.since_tick, Instant::now()).elapsed()
    }
}

/// Tries again for a while what fails because the database cannot be reached, but not when this process is about to end:
/// what is lost with it, others find by its lease.
async fn retry<T, F>(shared: &Shared, mut attempt: impl FnMut() -> F) -> Result<T, StoreError>
where
    F: Future<Output = Result<T, StoreError>>,
{
    let deadline = Instant::now() + RETRY_FOR;
    let mut pause = RETRY_FIRST;
    loop {
        match attempt().await {
            Err(StoreError::Database(error)) if Instant::now() < deadline && !shared.is_stopping() => {
                tracing::warn!("the database failed, trying again: {error}");
                sleep(pause).await;
                pause = (2 * pause).min(RETRY_LONGEST);
            }
            done => return done,
        }
    }
}
