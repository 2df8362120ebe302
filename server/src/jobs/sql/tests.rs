//! What the tables promise, on a real SQLite file.

use super::sqlite;
use crate::config::Limits;
use crate::jobs::{
    Claim, EventKind, JobState, JobStore, NewJob, NewScenario, Order, StoreError, StoredResult, Submitted, Task, Tick,
};
use adaptarm_core::scenario::{Scenario, Scheme};
use std::time::Duration;
use tempfile::TempDir;

const LEASE: Duration = Duration::from_mins(1);
const NO_LEASE: Duration = Duration::ZERO;

struct Lab {
    store: sqlite::SqlStore,
    _folder: TempDir,
}

async fn lab() -> Lab {
    let folder = tempfile::tempdir().unwrap();
    Lab { store: sqlite::open(&folder.path().join("test.sqlite3")).await.unwrap(), _folder: folder }
}

fn scenario(seed: u64) -> Scenario {
    let mut document = Scheme::SlotineLi.paper();
    document.seed = seed;
    document.integration.duration_s = 0.1;
    document.recording.samples = 10;
    Scenario::new(document).unwrap()
}

/// A job whose every scenario is a shard of its own.
fn job(owner: &str, seeds: std::ops::Range<u64>) -> NewJob {
    NewJob::study(owner, seeds.map(|seed| NewScenario { cost_us: 1e6, ..NewScenario::of(&scenario(seed)) }).collect())
}

fn result(claim: &Claim) -> StoredResult {
    let Task::Scenarios(scenarios) = &claim.task else { panic!("{claim:?}") };
    let (n, document) = &scenarios[0];
    let report = crate::document::parse_scenario(document.as_bytes()).unwrap().run().report;
    StoredResult { n: *n, report, bytes: 1000, checksum: "0".repeat(64), last: scenarios.len() == 1 }
}

impl Lab {
    async fn submit(&self, job: NewJob) -> Submitted {
        self.store.submit(job, &Limits::default()).await.unwrap()
    }

    async fn claim(&self) -> Option<Claim> {
        self.store.claim("worker", LEASE).await.unwrap()
    }

    async fn deliver(&self, claim: &Claim) -> Order {
        self.store.deliver(claim, &result(claim), 0, Duration::from_millis(1)).await.unwrap().order
    }

    async fn tick(&self, claim: &Claim, tick: Tick) -> Order {
        self.store.tick(claim, tick, LEASE, &Limits::default()).await.unwrap()
    }

    async fn state(&self, submitted: &Submitted) -> JobState {
        self.store.job(&submitted.job.owner, submitted.job.id).await.unwrap().unwrap().state
    }
}

fn tick(steps_done: i64) -> Tick {
    Tick { steps_done, steps_before: 0, computed: Duration::from_millis(1), saved: false, turn_over: false }
}

#[tokio::test]
async fn a_user_with_many_shards_does_not_keep_another_waiting() {
    let lab = lab().await;
    lab.submit(job("ana", 0..200)).await;
    let first = lab.claim().await.unwrap();
    let small = lab.submit(job("ben", 300..301)).await;
    let second = lab.claim().await.unwrap();
    assert_eq!((first.owner.as_str(), second.owner.as_str()), ("ana", "ben"));
    lab.deliver(&second).await;
    assert_eq!(lab.state(&small).await, JobState::Succeeded);
    // And the other way round: who waited longest is next.
    lab.submit(job("ben", 301..310)).await;
    lab.deliver(&first).await;
    let owners = [lab.claim().await.unwrap().owner, lab.claim().await.unwrap().owner];
    assert_eq!(owners, ["ana", "ben"]);
}

#[tokio::test]
async fn among_one_user_s_jobs_priority_goes_before_age() {
    let lab = lab().await;
    lab.submit(job("ana", 0..2)).await;
    let urgent = lab.submit(NewJob { priority: 5, ..job("ana", 2..3) }).await;
    assert_eq!(lab.claim().await.unwrap().job, urgent.job.id);
}

#[tokio::test]
async fn a_shard_lets_go_when_its_turn_is_over_and_others_wait() {
    let lab = lab().await;
    lab.submit(job("ana", 0..5)).await;
    let claim = lab.claim().await.unwrap();
    let over = Tick { turn_over: true, ..tick(1) };
    assert_eq!(lab.tick(&claim, over).await, Order::Continue);
    lab.submit(job("ben", 5..6)).await;
    assert_eq!(lab.tick(&claim, tick(1)).await, Order::Continue);
    assert_eq!(lab.tick(&claim, over).await, Order::Yield);
    lab.store.release(&claim).await.unwrap();
    let next = lab.claim().await.unwrap();
    assert_eq!(next.owner, "ben");
    // One's own more urgent job is a reason too, an equal one is not.
    lab.submit(NewJob { priority: 1, ..job("ben", 6..7) }).await;
    assert_eq!(lab.tick(&next, over).await, Order::Yield);
}

#[tokio::test]
async fn whoever_was_overtaken_changes_nothing() {
    let lab = lab().await;
    let submitted = lab.submit(job("ana", 0..2)).await;
    let stale = lab.store.claim("sleeper", NO_LEASE).await.unwrap().unwrap();
    // Its lease ran out at once; after the pause that suspects wait, someone else takes the shard.
    lab.claim().await.unwrap();
    tokio::time::sleep(Duration::from_millis(2100)).await;
    let fresh = lab.claim().await.unwrap();
    assert_eq!((stale.shard, fresh.shard), (0, 0));
    assert!(fresh.attempt > stale.attempt && fresh.suspect);
    assert_eq!(lab.deliver(&stale).await, Order::Stop);
    assert_eq!(lab.tick(&stale, tick(5)).await, Order::Stop);
    lab.store.release(&stale).await.unwrap();
    lab.store.fail(&stale, "too late").await.unwrap();
    let job = lab.store.job("ana", submitted.job.id).await.unwrap().unwrap();
    assert_eq!((job.state, job.scenarios_done, job.steps_done), (JobState::Running, 0, 0));
    assert_eq!(lab.deliver(&fresh).await, Order::Continue);
    assert_eq!(lab.deliver(&fresh).await, Order::Stop);
    let job = lab.store.job("ana", submitted.job.id).await.unwrap().unwrap();
    assert_eq!((job.scenarios_done, job.attempts), (1, fresh.attempt));
}

#[tokio::test]
async fn what_kills_three_workers_fails_its_job_and_no_other() {
    let lab = lab().await;
    let poison = lab.submit(job("ana", 0..1)).await;
    for kill in 1..=3 {
        let claim = loop {
            if let Some(claim) = lab.claim().await {
                break claim;
            }
            tokio::time::sleep(Duration::from_millis(100)).await;
        };
        assert_eq!(claim.suspect, kill > 1);
        assert_eq!(lab.store.bury_all().await.unwrap(), 1);
    }
    let healthy = lab.submit(job("ana", 1..2)).await;
    let claim = lab.claim().await.unwrap();
    assert_eq!((claim.job, claim.suspect), (healthy.job.id, false));
    let failed = lab.store.job("ana", poison.job.id).await.unwrap().unwrap();
    assert_eq!(failed.state, JobState::Failed);
    assert!(failed.reason.unwrap().contains("lost its worker 3 times"));
}

#[tokio::test]
async fn a_shard_that_comes_forward_is_no_suspect() {
    let lab = lab().await;
    lab.submit(job("ana", 0..1)).await;
    for _ in 0..4 {
        let claim = loop {
            if let Some(claim) = lab.claim().await {
                break claim;
            }
            tokio::time::sleep(Duration::from_millis(100)).await;
        };
        lab.tick(&claim, Tick { saved: true, ..tick(10) }).await;
        lab.store.bury_all().await.unwrap();
    }
    assert_eq!(lab.store.unfinished().await.unwrap(), [0, 1]);
}

#[tokio::test]
async fn the_same_request_makes_one_job() {
    let lab = lab().await;
    let request = |hash: &str| NewJob { idempotency: Some(("key".into(), hash.into())), ..job("ana", 0..1) };
    let first = lab.submit(request("a")).await;
    let again = lab.submit(request("a")).await;
    assert_eq!((again.job.id, first.repeated, again.repeated), (first.job.id, false, true));
    let refused = lab.store.submit(request("b"), &Limits::default()).await;
    assert!(matches!(refused, Err(StoreError::KeyReused { .. })), "{refused:?}");
    // Keys are each user's own.
    let other = lab.submit(NewJob { owner: "ben".into(), ..request("b") }).await;
    assert!(!other.repeated);
}

#[tokio::test]
async fn what_is_known_is_answered_at_once() {
    let lab = lab().await;
    lab.submit(job("ana", 0..1)).await;
    let claim = lab.claim().await.unwrap();
    assert_eq!(lab.deliver(&claim).await, Order::Stop);
    let half = lab.submit(job("ben", 0..2)).await.job;
    assert_eq!((half.state, half.cached, half.scenarios_done), (JobState::Queued, false, 1));
    let whole = lab.submit(job("ben", 0..1)).await.job;
    assert_eq!((whole.state, whole.cached, whole.scenarios_done), (JobState::Succeeded, true, 1));
    let kinds: Vec<_> = lab.store.events(whole.id, 0, 10).await.unwrap().iter().map(|event| event.kind).collect();
    assert_eq!(kinds, [EventKind::State, EventKind::Summary, EventKind::State]);
}

#[tokio::test]
async fn every_limit_of_a_user_has_its_own_refusal() {
    let lab = lab().await;
    lab.submit(job("ana", 0..1)).await;
    let claim = lab.claim().await.unwrap();
    lab.deliver(&claim).await;
    lab.submit(job("ana", 1..2)).await;
    let limits = [
        ("unfinished jobs", Limits { unfinished_jobs_per_user: 1, ..Limits::default() }),
        ("integration steps", Limits { queued_steps_per_user: 150, ..Limits::default() }),
        ("bytes", Limits { stored_bytes_per_user: 999, ..Limits::default() }),
    ];
    for (what, limits) in limits {
        let refused = lab.store.submit(job("ana", 2..3), &limits).await.unwrap_err().to_string();
        assert!(refused.starts_with(what), "{refused}");
        // Another user's work is not counted.
        lab.store.submit(job(what, 2..3), &limits).await.unwrap();
    }
}

#[tokio::test]
async fn computing_time_is_bounded() {
    let lab = lab().await;
    let submitted = lab.submit(job("ana", 0..1)).await;
    let claim = lab.claim().await.unwrap();
    let limits = Limits { compute_s_per_job: 10, ..Limits::default() };
    let long = Tick { computed: Duration::from_secs(11), ..tick(1) };
    assert_eq!(lab.store.tick(&claim, long, LEASE, &limits).await.unwrap(), Order::Stop);
    let job = lab.store.job("ana", submitted.job.id).await.unwrap().unwrap();
    assert!(job.reason.unwrap().contains("computed for 10 s"));
}

#[tokio::test]
async fn events_are_numbered_in_order_and_end_with_the_end() {
    let lab = lab().await;
    let submitted = lab.submit(job("ana", 0..2)).await;
    for _ in 0..2 {
        let claim = lab.claim().await.unwrap();
        lab.deliver(&claim).await;
    }
    let events = lab.store.events(submitted.job.id, 0, 100).await.unwrap();
    let numbers: Vec<_> = events.iter().map(|event| event.seq).collect();
    assert_eq!(numbers, [1, 2, 3, 4, 5]);
    assert!(events.last().unwrap().data.contains(r#""state":"succeeded""#));
    assert_eq!(lab.store.pulses(&[submitted.job.id]).await.unwrap()[0].seq, 5);
    assert_eq!(lab.store.events(submitted.job.id, 3, 1).await.unwrap()[0].seq, 4);
}

#[tokio::test]
async fn another_user_s_job_does_not_exist() {
    let lab = lab().await;
    let id = lab.submit(job("ana", 0..1)).await.job.id;
    assert_eq!(lab.store.job("ben", id).await.unwrap(), None);
    assert_eq!(lab.store.cancel("ben", id).await.unwrap(), None);
    assert!(!lab.store.delete("ben", id).await.unwrap());
    assert_eq!(lab.store.cancel("ana", id).await.unwrap().unwrap().state, JobState::Canceled);
    assert_eq!(lab.claim().await, None);
    assert!(lab.store.delete("ana", id).await.unwrap());
    assert_eq!(lab.store.job("ana", id).await.unwrap(), None);
}
