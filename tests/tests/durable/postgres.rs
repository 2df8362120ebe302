//! One server that only answers, workers that compute, a database between them: each may die, stand still or come back.

use crate::accounts::Batch;
use adaptarm_tests::client::Client;
use adaptarm_tests::postgres::Cluster;
use adaptarm_tests::workload::{Work, Workload};
use adaptarm_tests::{Launch, Server, Worker, machine};
use anyhow::{Context, Result, ensure};
use jiff::Timestamp;
use std::ffi::OsString;
use std::path::Path;
use std::thread::sleep;
use std::time::Duration;

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
    // Half a minute for one worker, three times over; otherwise only that it works.
    let (scenarios, rounds) = if machine::soak() { (36, 3) } else { (4, 1) };
    let site = Site::open()?;
    let client = Client::new(&site.server.url);
    let mut workload = Workload::new(3, 600.0)?;
    let mut time = |workers: &[&Worker]| batch_s(&client, &workload.even(scenarios), workers);
    let first = site.worker()?;
    let mut ratios = Vec::new();
    for _ in 0..rounds {
        // In turn, so that what else the machine does falls on both.
        let one = time(&[&first])?;
        let second = site.worker()?;
        let two = time(&[&first, &second])?;
        drop(second);
        ratios.push(one / two);
        println!("{scenarios} simulations: ratio {:.2}", one / two);
    }
    ratios.sort_by(f64::total_cmp);
    let ratio = ratios[ratios.len() / 2];
    // In the short form other tests run beside this one.
    ensure!(!machine::soak() || ratio >= 1.7, "two workers do only {ratio:.2} times the work of one: {ratios:?}");
    Ok(())
}

/// Time from when a job's first part is claimed until its last one has ended, s.
fn batch_s(client: &Client, work: &Work, workers: &[&Worker]) -> Result<f64> {
    let processor_s = || workers.iter().map(|worker| Ok(worker.processor_time()?.as_secs_f64())).sum::<Result<f64>>();
    let before = processor_s()?;
    let id = client.submit(&work.body)?;
    let job = client.wait(&id, Duration::from_mins(10))?;
    let processors = processor_s()? - before;
    work.check(client, &job)?;
    let moment = |field: &str| -> Result<Timestamp> { Ok(job[field].as_str().context("no such moment")?.parse()?) };
    let took = moment("finished_at")?.duration_since(moment("started_at")?).as_secs_f64();
    // Less than one processor for each worker means that the machine had something else to do.
    println!("{} workers: {took:.1} s, {:.2} processors in use", workers.len(), processors / took);
    Ok(took)
}
