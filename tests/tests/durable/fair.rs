//! One user's mountain of work does not make another wait, and within it her own urgent job goes first.

use adaptarm_tests::client::{Client, is_final, surely};
use adaptarm_tests::workload::{scenario, study};
use adaptarm_tests::{Launch, machine};
use anyhow::{Context, Result, ensure};
use serde_json::{Value, json};
use std::time::{Duration, Instant};

/// About a second of computing each, so each is a part of its own.
const SCENARIOS_PER_JOB: usize = 1000;

/// Longest that a small job of someone who has nothing else may take.
const SMALL_JOB: Duration = Duration::from_secs(5);

/// Longest that an urgent job waits: for the parts under way, and their owner's turn.
const URGENT_JOB: Duration = Duration::from_secs(10);

pub fn users() -> Result<()> {
    let (jobs, tries) = if machine::soak() { (10, 10) } else { (2, 2) };
    let server = Launch::new().serve()?;
    let nobody = Client::new(&server.url);
    let ana = nobody.with_token(&server.token("ana", &[])?);
    let ben = nobody.with_token(&server.token("ben", &[])?);

    let long = ana.submit(&study(&[simulation(1e5, 0)]))?;
    let mountain = (0..jobs)
        .map(|job| {
            let first = 1 + job * SCENARIOS_PER_JOB;
            let scenarios: Vec<_> = (first..first + SCENARIOS_PER_JOB).map(|n| simulation(600.0, n)).collect();
            ana.submit(&study(&scenarios))
        })
        .collect::<Result<Vec<_>>>()?;
    surely(machine::promised(URGENT_JOB), || Ok((ana.job(&mountain[0])?["state"] == "running").then_some(())))
        .context("the mountain is not begun")?;

    let mut slowest = Duration::ZERO;
    for n in 0..tries {
        let scenarios: Vec<_> = (0..20).map(|k| simulation(12.0, 20 * n + k)).collect();
        let took = time(&ben, &study(&scenarios), SMALL_JOB).context("ben's small job")?;
        slowest = slowest.max(took);
    }
    let mut urgent = study(&[simulation(12.0, 1_000_000)]);
    urgent["priority"] = json!(5);
    let took = time(&ana, &urgent, URGENT_JOB).context("ana's urgent job")?;
    println!(
        "beside {} simulations of ana's: ben's small job took at most {slowest:.1?}, ana's urgent one {took:.1?}",
        jobs * SCENARIOS_PER_JOB + 1
    );
    // All of that was while she still had work; the older jobs are behind the urgent one.
    for id in mountain.iter().chain([&long]) {
        let job = ana.job(id)?;
        ensure!(!is_final(&job), "not the mountain that was meant: {job}");
    }
    ensure!(ana.job(&mountain[jobs - 1])?["state"] == "queued", "the last job began before its turn");

    for id in mountain.iter().chain([&long]) {
        let canceled = ana.cancel(id)?.expect(200)?;
        ensure!(canceled["state"] == "canceled", "{canceled}");
    }
    ana.wait_for_all(Duration::ZERO)?;
    time(&ben, &study(&[simulation(12.0, 2_000_000)]), SMALL_JOB).context("a job after the mountain is gone")?;
    Ok(())
}

/// A simulation unlike any other.
fn simulation(duration_s: f64, seed: usize) -> Value {
    let mut scenario = scenario("proposed", &json!({"duration_s": duration_s}));
    scenario["recording"] = json!({"samples": 10});
    scenario["seed"] = json!(seed);
    scenario
}

/// From the request to the end of a job, which is promised within this time.
fn time(client: &Client, job: &Value, promised: Duration) -> Result<Duration> {
    let within = machine::promised(promised);
    let started = Instant::now();
    let ended = client.wait(&client.submit(job)?, within)?;
    let took = started.elapsed();
    ensure!(ended["state"] == "succeeded" && ended["cached"] == false, "{ended}");
    ensure!(took <= within, "it took {took:?}");
    Ok(took)
}
