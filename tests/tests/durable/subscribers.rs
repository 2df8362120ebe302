//! A crowd that watches the same jobs: each sees every event once and in order, also after going away and coming back.

use crate::accounts::check_events;
use adaptarm_tests::client::{Client, is_final};
use adaptarm_tests::events::Event;
use adaptarm_tests::workload::{scenario, study};
use adaptarm_tests::{Launch, machine};
use anyhow::{Context, Result, ensure};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use serde_json::{Value, json};
use std::thread::{Builder, scope, sleep};
use std::time::Duration;

const JOBS: usize = 5;

/// Subscribers do little, and there are many.
const STACK_BYTES: usize = 256 << 10;

pub fn crowd() -> Result<()> {
    let (subscribers, scenarios) = if machine::soak() { (500, 1000) } else { (50, 60) };
    let server = Launch::new().serve()?;
    let client = Client::new(&server.url);
    let submit = |job: usize| {
        let scenarios: Vec<_> = (0..scenarios).map(|n| numbered(job * scenarios + n)).collect();
        client.submit(&study(&scenarios))
    };
    let jobs = (0..JOBS).map(submit).collect::<Result<Vec<_>>>()?;
    let memory_before = server.memory_bytes()?;
    let seen = scope(|scope| {
        let threads = (0..subscribers)
            .map(|n| {
                let (client, job) = (Client::new(&server.url), &jobs[n % JOBS]);
                // Half of them go away now and then.
                let restless = (n % 2 == 1).then(|| StdRng::seed_from_u64(n as u64));
                Ok(Builder::new().stack_size(STACK_BYTES).spawn_scoped(scope, move || watch(&client, job, restless))?)
            })
            .collect::<Result<Vec<_>>>()?;
        sleep(Duration::from_secs(2));
        println!(
            "{subscribers} subscribers: memory {} MB before, {} MB after two seconds",
            memory_before / 1_000_000,
            server.memory_bytes()? / 1_000_000
        );
        threads
            .into_iter()
            .map(|thread| thread.join().expect("a subscriber does not panic"))
            .collect::<Result<Vec<_>>>()
    })?;
    println!(
        "{subscribers} subscribers: memory {} MB at the end, {} MB at its peak",
        server.memory_bytes()? / 1_000_000,
        server.peak_memory_bytes()? / 1_000_000
    );
    for (n, job) in jobs.iter().enumerate() {
        check_events(&client, job, scenarios)?;
        let story = told(client.events(job, None)?.collect::<Result<Vec<_>>>()?);
        let identifiers: Vec<u64> = story.iter().filter_map(|(id, _)| id.parse().ok()).collect();
        ensure!(identifiers.len() == story.len() && identifiers.is_sorted_by(|a, b| a < b), "{identifiers:?}");
        for (subscriber, seen) in seen.iter().enumerate().filter(|(subscriber, _)| subscriber % JOBS == n) {
            ensure!(*seen == story, "subscriber {subscriber} of job {n} saw {} of {} events", seen.len(), story.len());
        }
    }
    Ok(())
}

/// A scenario unlike any other.
fn numbered(n: usize) -> Value {
    let mut scenario = scenario("proposed", &json!({"duration_s": 12}));
    scenario["recording"] = json!({"samples": 10});
    scenario["seed"] = json!(n);
    scenario
}

/// Reads a job's events to the end; a restless reader breaks off now and then and goes on where it was.
fn watch(client: &Client, job: &str, mut restless: Option<StdRng>) -> Result<Vec<(String, String)>> {
    let mut seen: Vec<Event> = Vec::new();
    loop {
        let last = seen.iter().rev().find_map(|event| event.id.clone());
        let most = restless.as_mut().map_or(usize::MAX, |random| random.random_range(1..30));
        for event in client.events(job, last.as_deref())?.take(most) {
            seen.push(event?);
        }
        if seen.iter().any(|event| event.kind == "state" && is_final(&event.data)) {
            return Ok(told(seen));
        }
        // A stream that ends by itself ends with the job.
        restless.as_ref().context("the stream ended before the job")?;
    }
}

/// What must be the same for everyone: events that have an identifier, with what they tell of.
fn told(events: Vec<Event>) -> Vec<(String, String)> {
    let identified = events.into_iter().filter_map(|event| Some((event.id?, event.kind, event.data)));
    identified
        .map(|(id, kind, data)| {
            let tells = if kind == "state" { &data["state"] } else { &data };
            (id, format!("{kind} {tells}"))
        })
        .collect()
}
