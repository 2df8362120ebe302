//! Fifty clients at once: every job succeeds, requests are answered quickly, memory stays small.

use adaptarm_tests::client::Client;
use adaptarm_tests::workload::{Work, Workload};
use adaptarm_tests::{Launch, machine};
use anyhow::{Result, ensure};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;
use std::time::{Duration, Instant};

const CLIENTS: usize = 50;
const MOST_MEMORY_BYTES: u64 = 300_000_000;
const SLOWEST_POST: Duration = Duration::from_millis(100);

pub fn clients() -> Result<()> {
    let jobs = if machine::soak() { 2000 } else { 300 };
    let mut workload = Workload::new(5, 1.0)?;
    let work: Vec<_> = (0..jobs).map(|_| workload.smallest()).collect();
    let server = Launch::new().serve()?;
    let started = Instant::now();
    let next = AtomicUsize::new(0);
    let answered = thread::scope(|scope| {
        let clients: Vec<_> = (0..CLIENTS).map(|_| scope.spawn(|| post(&server.url, &work, &next))).collect();
        clients.into_iter().map(|client| client.join().expect("a client does not panic")).collect::<Result<Vec<_>>>()
    })?
    .concat();
    let handed_in = started.elapsed();

    let client = Client::new(&server.url);
    client.wait_for_all(Duration::from_mins(5))?;
    let ended = started.elapsed();
    for (n, id, _) in &answered {
        work[*n].check(&client, &client.job(id)?)?;
    }
    ensure!(client.jobs("state=succeeded")?.len() == jobs, "not as many jobs as requests");

    let mut times: Vec<_> = answered.into_iter().map(|(_, _, time)| time).collect();
    times.sort();
    let (median, p99) = (times[times.len() / 2], times[times.len() * 99 / 100]);
    let memory = server.peak_memory_bytes()?;
    println!(
        "{jobs} jobs from {CLIENTS} clients: handed in within {handed_in:.1?}, done within {ended:.1?}; POST took \
         {median:.1?} (median), {p99:.1?} (99 %), {:.1?} (slowest); peak memory {} MB",
        times[times.len() - 1],
        memory / 1_000_000
    );
    ensure!(memory < MOST_MEMORY_BYTES, "{memory} bytes of memory");
    // In the short form, other tests run beside this one.
    ensure!(!machine::soak() || p99 < SLOWEST_POST, "1 % of requests took more than {p99:?}");
    Ok(())
}

/// What one client does: numbers of its jobs, their identifiers, and how long each request took.
fn post(url: &str, work: &[Work], next: &AtomicUsize) -> Result<Vec<(usize, String, Duration)>> {
    let client = Client::new(url);
    let mut answered = Vec::new();
    loop {
        let n = next.fetch_add(1, Ordering::Relaxed);
        let Some(work) = work.get(n) else { return Ok(answered) };
        let started = Instant::now();
        let id = client.submit(&work.body)?;
        answered.push((n, id, started.elapsed()));
    }
}
