//! One server that only answers, workers that compute, a database between them: each may die, stand still or come back.

use crate::accounts::Batch;
use adaptarm_tests::client::Client;
use adaptarm_tests::postgres::Cluster;
use adaptarm_tests::workload::{Work, Workload};
use adaptarm_tests::{Launch, Server, Worker, machine};
use anyhow::{Result, ensure};
use std::ffi::OsString;
use std::path::Path;
use std::thread::sleep;
use std::time::{Duration, Instant};

/// Short, so that the death of a worker shows within the test.
const LEASE: Duration = Duration::from_secs(2);

/// A database, a server on it that computes nothing, and the folder of results.
struct Site {
    cluster: Cluster,
    server: Server,
    results: tempfile::TempDir,
    arguments: Vec<OsString>,
}

impl Site {
    fn open() -> Result<Self> {
        let cluster = Cluster::start()?;
        let results = tempfile::tempdir()?;
        let arguments = arguments(&cluster.database("adaptarm")?, results.path());
        let server = Launch::new().arguments(&arguments).arguments(["--threads", "0"]).serve()?;
        Ok(Self { cluster, server, results, arguments })
    }

    fn worker(&self) -> Result<Worker> {
        Launch::new()
            .arguments(&self.arguments)
            .arguments(["--threads", "1"])
            .variable("ADAPTARM_QUEUE_LEASE_S", &LEASE.as_secs().to_string())
            .work()
    }
}

fn arguments(database: &str, results: &Path) -> Vec<OsString> {
    vec!["--database".into(), database.into(), "--results".into(), results.into()]
}

pub fn crashes() -> Result<()> {
    let (jobs, rounds, long_s) = if machine::soak() { (300, 5, 3000.0) } else { (50, 1, 600.0) };
    let work = Workload::new(2, long_s)?.mixed(jobs, 10);
    let mut site = Site::open()?;
    let (mut first, second) = (site.worker()?, site.worker()?);
    let url = site.server.url.clone();
    Batch::new(&url, &work).survive(6, |batch| {
        for round in 0..rounds {
            let reach = |moment: f64| batch.reach((f64::from(round) + moment) / f64::from(rounds));
            reach(0.1)?;
            first.restart()?;
            reach(0.3)?;
            // Others take its work; when it wakes, what it still holds must count for nothing.
            second.freeze()?;
            sleep(LEASE * 2);
            second.thaw()?;
            reach(0.7)?;
            site.cluster.crash()?;
            sleep(Duration::from_millis(300));
            site.cluster.resume()?;
        }
        Ok(())
    })?;
    let recordings = walk(site.results.path())?;
    ensure!(recordings > 0, "the results are not where they were asked for");
    Ok(())
}

/// Files below a folder.
fn walk(folder: &Path) -> Result<usize> {
    let mut files = 0;
    for entry in std::fs::read_dir(folder)? {
        let entry = entry?;
        files += if entry.file_type()?.is_dir() { walk(&entry.path())? } else { 1 };
    }
    Ok(files)
}

pub fn throughput() -> Result<()> {
    let scenarios = if machine::soak() { 1500 } else { 60 };
    let site = Site::open()?;
    let mut workload = Workload::new(3, 1.0)?;
    let mut time = |workers: usize| -> Result<f64> {
        let workers = (0..workers).map(|_| site.worker()).collect::<Result<Vec<_>>>()?;
        // The same shapes each time would be fairer still; many of them come to the same.
        let work: Vec<_> = (0..10).map(|_| workload.study(scenarios / 10)).collect();
        let started = Instant::now();
        let client = Client::new(&site.server.url);
        finish(&client, &work)?;
        drop(workers);
        Ok(scenarios as f64 / started.elapsed().as_secs_f64())
    };
    let (one, two) = (time(1)?, time(2)?);
    println!("one worker: {one:.1} scenarios/s; two: {two:.1}; ratio {:.2}", two / one);
    // In the short form starting and ending count for too much, and other tests run beside it.
    ensure!(!machine::soak() || two >= 1.7 * one, "two workers do only {:.2} times the work of one", two / one);
    Ok(())
}

fn finish(client: &Client, work: &[Work]) -> Result<()> {
    let identifiers = work.iter().map(|work| client.submit(&work.body)).collect::<Result<Vec<_>>>()?;
    for (work, id) in work.iter().zip(&identifiers) {
        work.check(client, &client.wait(id, Duration::from_mins(10))?)?;
    }
    Ok(())
}
