//! The whole engine in one process, on a real SQLite file and a real folder.

use super::{JobState, NewJob, NewScenario, collect_garbage};
use crate::config::{Config, Limits, Retention};
use crate::laboratory::Laboratory;
use adaptarm_core::scenario::{Scenario, Scheme};
use std::path::Path;
use std::time::{Duration, Instant};
use tokio::task::JoinHandle;
use tokio::time::sleep;
use uuid::Uuid;

/// Two threads, and turns short enough to take many.
async fn open(data: &Path) -> Laboratory {
    let mut config = Config { data: Some(data.to_owned()), threads: Some(2), ..Config::default() };
    config.queue.heartbeat_ms = 10;
    config.queue.slice_s = 0.05;
    Laboratory::open(&config).await.unwrap()
}

fn scenario(scheme: Scheme, seed: u64, duration_s: f64) -> Scenario {
    let mut document = scheme.paper();
    document.seed = seed;
    document.integration.duration_s = duration_s;
    document.recording.samples = 100;
    Scenario::new(document).unwrap()
}

fn job(owner: &str, scenarios: &[Scenario]) -> NewJob {
    NewJob::study(owner, scenarios.iter().map(NewScenario::of).collect())
}

async fn submit(lab: &Laboratory, job: NewJob) -> Uuid {
    lab.store.submit(job, &Limits::default()).await.unwrap().job.id
}

async fn end(lab: &Laboratory, owner: &str, id: Uuid) -> JobState {
    let deadline = Instant::now() + Duration::from_mins(1);
    loop {
        let job = lab.store.job(owner, id).await.unwrap().unwrap();
        if job.state.is_final() {
            return job.state;
        }
        assert!(Instant::now() < deadline, "{job:?}");
        sleep(Duration::from_millis(5)).await;
    }
}

/// Sets the laboratory's engine to work; it ends after `lab.engine.stop()`.
fn start(lab: &Laboratory) -> JoinHandle<()> {
    let engine = lab.engine.clone();
    tokio::spawn(async move { engine.run().await })
}

/// Whether the stored reports and samples are those of an undisturbed run.
async fn assert_undisturbed(lab: &Laboratory, id: Uuid, scenarios: &[Scenario]) {
    for (n, scenario) in scenarios.iter().enumerate() {
        let run = scenario.run();
        let (row, _) = lab.store.scenario(id, n as i64).await.unwrap().unwrap();
        assert_eq!(row.report.as_deref(), Some(&*serde_json::to_string(&run.report).unwrap()));
        let recording = lab.results.get(&row.hash, adaptarm_core::VERSION, &row.checksum.unwrap()).await.unwrap();
        assert!(recording == run.recording, "scenario {n}");
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn long_work_takes_turns_and_gives_the_bits_of_an_undisturbed_run() {
    let folder = tempfile::tempdir().unwrap();
    let lab = open(folder.path()).await;
    let working = start(&lab);
    let long: Vec<_> = Scheme::ALL.into_iter().map(|scheme| scenario(scheme, 1, 600.0)).collect();
    let short = [scenario(Scheme::SlotineLi, 2, 1.0)];
    let slow = submit(&lab, job("ana", &long)).await;
    sleep(Duration::from_millis(200)).await;
    let quick = submit(&lab, job("ben", &short)).await;
    assert_eq!(end(&lab, "ben", quick).await, JobState::Succeeded);
    assert_eq!(lab.store.job("ana", slow).await.unwrap().unwrap().state, JobState::Running);
    assert_eq!(end(&lab, "ana", slow).await, JobState::Succeeded);
    assert_undisturbed(&lab, slow, &long).await;
    assert_undisturbed(&lab, quick, &short).await;
    assert_eq!(lab.results.checkpoints().await.unwrap(), []);
    lab.engine.stop();
    working.await.unwrap();
}

#[tokio::test(flavor = "multi_thread")]
async fn a_stopped_engine_s_work_goes_on_from_where_it_was() {
    let folder = tempfile::tempdir().unwrap();
    let long = [scenario(Scheme::Proposed, 1, 1000.0)];
    let lab = open(folder.path()).await;
    let id = submit(&lab, job("ana", &long)).await;
    let working = start(&lab);
    sleep(Duration::from_millis(700)).await;
    lab.engine.stop();
    working.await.unwrap();
    let stopped = lab.store.job("ana", id).await.unwrap().unwrap();
    assert_eq!(stopped.state, JobState::Running);
    assert!(stopped.steps_done > 0);
    assert_eq!(lab.results.checkpoints().await.unwrap(), [(id, 0)]);
    let kept = lab.results.load(id, 0).await.unwrap().unwrap();
    assert_eq!(kept.snapshots.iter().map(|snapshot| snapshot.step as i64).sum::<i64>(), stopped.steps_done);
    drop(lab);

    let lab = open(folder.path()).await;
    let working = start(&lab);
    assert_eq!(end(&lab, "ana", id).await, JobState::Succeeded);
    assert_undisturbed(&lab, id, &long).await;
    lab.engine.stop();
    working.await.unwrap();
}

#[tokio::test(flavor = "multi_thread")]
async fn what_nobody_needs_is_forgotten_and_nothing_else() {
    let folder = tempfile::tempdir().unwrap();
    let lab = open(folder.path()).await;
    let working = start(&lab);
    let scenarios = [scenario(Scheme::SlotineLi, 1, 0.5), scenario(Scheme::SlotineLi, 2, 0.5)];
    let both = submit(&lab, job("ana", &scenarios)).await;
    end(&lab, "ana", both).await;
    let one = submit(&lab, job("ben", &scenarios[..1])).await;
    end(&lab, "ben", one).await;
    lab.store.delete("ana", both).await.unwrap();
    lab.results.save(both, 7, b"left behind".as_slice().into()).await.unwrap();
    let collect = async |finished_jobs_days, results_days| {
        let retention = Retention { finished_jobs_days, results_days };
        let forgotten = collect_garbage(&*lab.store, &*lab.queue, &lab.results, &retention).await.unwrap();
        [forgotten.jobs, forgotten.results, forgotten.checkpoints]
    };
    assert_eq!(collect(30, 90).await, [0, 0, 1]);
    // One result still has a job.
    assert_eq!(collect(30, 0).await, [0, 1, 0]);
    assert_undisturbed(&lab, one, &scenarios[..1]).await;
    let gone = lab.results.get(&scenarios[1].hash(), adaptarm_core::VERSION, "").await;
    assert!(matches!(gone, Err(crate::results::ResultError::Missing(_))), "{gone:?}");
    assert_eq!(collect(0, 0).await, [1, 1, 0]);
    assert_eq!(lab.store.job("ben", one).await.unwrap(), None);
    lab.engine.stop();
    working.await.unwrap();
}

#[tokio::test(flavor = "multi_thread")]
async fn a_ticket_that_was_used_is_done_with() {
    let folder = tempfile::tempdir().unwrap();
    let lab = open(folder.path()).await;
    let working = start(&lab);
    for seed in 0..5 {
        let id = submit(&lab, job("ana", &[scenario(Scheme::SlotineLi, seed, 0.1)])).await;
        end(&lab, "ana", id).await;
    }
    // A ticket that still counts as under way would be handed out again after a restart.
    let (mut done, deadline) = (0, Instant::now() + Duration::from_secs(20));
    while done < 5 {
        assert!(Instant::now() < deadline, "{done} of 5");
        done += lab.queue.sweep().await.unwrap();
        sleep(Duration::from_millis(50)).await;
    }
    lab.engine.stop();
    working.await.unwrap();
}

#[tokio::test]
async fn a_data_folder_belongs_to_one_process() {
    let folder = tempfile::tempdir().unwrap();
    let _first = open(folder.path()).await;
    let config = Config { data: Some(folder.path().to_owned()), ..Config::default() };
    let second = Laboratory::open(&config).await.err().unwrap().to_string();
    assert!(second.contains("another adaptarm uses the data folder"), "{second}");
}
