//! Working on one shard: computing its scenarios one after another, telling the store how far it is, and letting go of it
//! when the store says so.

use super::compute::{Control, Finished, Stretch, compute};
use super::shared::Shared;
use super::{Claim, Delivered, Order, StoreError, StoredResult, Tick};
use crate::metrics::{self, FailureReason};
use crate::results::ResultError;
use adaptarm_core::simulation::Snapshot;
use bytes::Bytes;
use std::future::Future;
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
    let mut worker = Worker { shared, claim, counted: claim.steps_done, since_tick: now, told: now };
    match worker.work().await {
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
    /// Steps of the scenario under way that the store has counted.
    counted: i64,
    /// Since when computing time has not been reported.
    since_tick: Instant,
    /// When the store last heard that this shard is alive.
    told: Instant,
}

impl Worker<'_> {
    async fn work(&mut self) -> Result<(), Stopped> {
        let began = Instant::now();
        let results = &self.shared.results;
        let loaded = self.alive(results.load(self.claim.job, self.claim.shard)).await?;
        let mut checkpoint = match loaded {
            Ok(checkpoint) => checkpoint,
            Err(error) => {
                tracing::warn!(job = %self.claim.job, "cannot use a checkpoint, only time is lost: {error}");
                None
            }
        };
        let mut saved = checkpoint.is_some();
        for (n, document) in &self.claim.scenarios {
            let from = checkpoint.take_if(|checkpoint| checkpoint.n == *n).map(|checkpoint| checkpoint.snapshot);
            let finished = self.scenario(*n, document, from, &mut saved).await?;
            self.deliver(*n, *finished).await?;
            let slice = self.shared.settings.slice;
            // Short scenarios one after another are a long time too.
            if self.told.elapsed() >= self.shared.settings.heartbeat {
                match self.tick(0, true, began.elapsed() >= slice).await {
                    Ok(Order::Stop) if !self.is_last(*n) => return Err(Stopped::Lost),
                    Ok(Order::Yield) if !self.is_last(*n) => return Err(Stopped::Yielded),
                    Ok(_) => {}
                    Err(error) => tracing::warn!(job = %self.claim.job, "cannot reach the store: {error}"),
                }
            }
        }
        if saved && let Err(error) = self.shared.results.discard(self.claim.job, self.claim.shard).await {
            tracing::warn!(job = %self.claim.job, "cannot remove a checkpoint that is done with: {error}");
        }
        Ok(())
    }

    /// Computes one scenario, in stretches between which its state is saved.
    async fn scenario(
        &mut self,
        n: i64,
        document: &str,
        mut from: Option<Snapshot>,
        saved: &mut bool,
    ) -> Result<Box<Finished>, Stopped> {
        let mut interval = self.shared.settings.slice;
        loop {
            let control = Arc::new(Control::starting_at(from.as_ref().map_or(0, |snapshot| snapshot.step)));
            let (sender, receiver) = oneshot::channel();
            let (document, watched) = (document.to_owned(), control.clone());
            self.shared.pool.spawn_fifo(move || {
                // Nobody listens any more where the runtime has ended.
                let _ = sender.send(compute(n, &document, from, &watched));
            });
            let (stretch, order) = self.watch(receiver, &control, interval).await?;
            let (bytes, snapshot) = match stretch {
                Stretch::Finished(finished) => return Ok(finished),
                Stretch::Failed(kind, reason) => return Err(Stopped::Failed(kind, reason)),
                Stretch::Paused(bytes, snapshot) => (bytes, snapshot),
            };
            if order == Order::Stop {
                return Err(Stopped::Lost);
            }
            let began = Instant::now();
            let kept = self.save(bytes, &control).await?;
            *saved |= kept;
            // Letting go of what could not be saved would only lose it; at the end there is no choice.
            if order == Order::Yield && (kept || self.shared.is_stopping()) {
                return Err(Stopped::Yielded);
            }
            interval = self.shared.settings.slice.max(began.elapsed() * CHECKPOINT_SHARE);
            from = Some(*snapshot);
        }
    }

    /// Watches over a stretch of computing: tells the store that it goes on, and pauses it when it must.
    async fn watch(
        &mut self,
        mut stretch: oneshot::Receiver<Stretch>,
        control: &Control,
        interval: Duration,
    ) -> Result<(Stretch, Order), Stopped> {
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
        let computed = std::mem::replace(&mut self.since_tick, Instant::now()).elapsed();
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

    /// Whether this is the shard's last scenario.
    fn is_last(&self, n: i64) -> bool {
        self.claim.scenarios.last().is_some_and(|(last, _)| *last == n)
    }

    /// Saves how far the shard is. A full disk is no reason to stop computing: the result will show whether there is room.
    async fn save(&mut self, bytes: Bytes, control: &Control) -> Result<bool, Stopped> {
        let results = &self.shared.results;
        let kept = self.alive(results.save(self.claim.job, self.claim.shard, bytes)).await?;
        if let Err(error) = &kept {
            tracing::warn!(job = %self.claim.job, shard = self.claim.shard, "cannot save a checkpoint: {error}");
        }
        match self.tick(control.steps(), kept.is_ok(), false).await {
            Ok(Order::Stop) => Err(Stopped::Lost),
            Ok(_) => Ok(kept.is_ok()),
            Err(error) => {
                tracing::warn!(job = %self.claim.job, "cannot reach the store: {error}");
                Ok(kept.is_ok())
            }
        }
    }

    /// Stores a scenario's result, then tells that it is there.
    async fn deliver(&mut self, n: i64, Finished { report, encoded, simulated_s }: Finished) -> Result<(), Stopped> {
        let results = &self.shared.results;
        let mut pause = RETRY_FIRST;
        // A store that cannot be reached is waited for, however long: nothing that was computed is given up.
        while let Err(error) = self.alive(results.put(&report, &encoded)).await? {
            if !matches!(error, ResultError::Unavailable(_)) {
                return Err(Stopped::Failed(FailureReason::Storage, format!("scenario {n}: {error}")));
            }
            if self.shared.is_stopping() {
                return Err(Stopped::Yielded);
            }
            tracing::warn!(job = %self.claim.job, "scenario {n}: {error}; trying again");
            self.alive(sleep(pause)).await?;
            pause = (2 * pause).min(RETRY_LONGEST);
        }
        metrics::result_stored(encoded.bytes.len() as u64);
        metrics::simulated(simulated_s, report.steps);
        let computed = std::mem::replace(&mut self.since_tick, Instant::now()).elapsed();
        let result = StoredResult { n, report, bytes: encoded.bytes.len() as u64, checksum: encoded.checksum };
        let delivered =
            retry(self.shared, || self.shared.store.deliver(self.claim, &result, self.counted, computed)).await;
        self.counted = 0;
        match delivered.map_err(Stopped::Unreachable)? {
            Delivered { order: Order::Stop, ended: None } => Err(Stopped::Lost),
            _ if !self.is_last(n) && (self.claim.suspect || self.must_let_go()) => Err(Stopped::Yielded),
            _ => Ok(()),
        }
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
