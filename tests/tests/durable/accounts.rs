//! Handing in work through everything that happens, and counting afterwards: nothing lost, nothing doubled, every bit as
//! an undisturbed computation gives it.

use adaptarm_tests::client::{Client, is_final};
use adaptarm_tests::workload::Work;
use anyhow::{Context, Result, ensure};
use std::collections::BTreeSet;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread::{self, sleep};
use std::time::Duration;

/// Longest outage that a client sits out.
const PATIENCE: Duration = Duration::from_mins(2);

/// Work that several clients hand in, each waiting for one job before the next.
pub struct Batch<'a> {
    url: &'a str,
    work: &'a [Work],
    next: AtomicUsize,
    done: AtomicUsize,
    broken: AtomicBool,
}

impl<'a> Batch<'a> {
    /// Hands nothing in yet.
    pub fn new(url: &'a str, work: &'a [Work]) -> Self {
        Self { url, work, next: AtomicUsize::new(0), done: AtomicUsize::new(0), broken: AtomicBool::new(false) }
    }

    /// Returns once this share of the work has ended.
    pub fn reach(&self, share: f64) -> Result<()> {
        while (self.done.load(Ordering::Relaxed) as f64) < share * self.work.len() as f64 {
            ensure!(!self.broken.load(Ordering::Relaxed), "a client gave up");
            sleep(Duration::from_millis(5));
        }
        Ok(())
    }

    /// Hands all of it in through this many clients while `disturb` does what it does, and checks the books at the end.
    pub fn survive(&self, clients: usize, disturb: impl FnOnce(&Self) -> Result<()>) -> Result<()> {
        let mut identifiers = thread::scope(|scope| {
            let clients: Vec<_> = (0..clients).map(|_| scope.spawn(|| self.note(self.hand_in()))).collect();
            let disturbed = self.note(disturb(self));
            let handed_in: Result<Vec<_>> =
                clients.into_iter().map(|client| client.join().expect("a client does not panic")).collect();
            let handed_in = handed_in?;
            disturbed?;
            anyhow::Ok(handed_in)
        })?
        .concat();
        identifiers.sort();
        let identifiers: Vec<_> = identifiers.into_iter().map(|(_, id)| id).collect();
        self.check(&identifiers)
    }

    /// Makes everyone stop soon if this went wrong.
    fn note<T>(&self, outcome: Result<T>) -> Result<T> {
        if outcome.is_err() {
            self.broken.store(true, Ordering::Relaxed);
            self.next.store(self.work.len(), Ordering::Relaxed);
        }
        outcome
    }

    /// What one client does: its jobs by their number in the batch.
    fn hand_in(&self) -> Result<Vec<(usize, String)>> {
        let client = Client::new(self.url);
        let mut identifiers = Vec::new();
        loop {
            let n = self.next.fetch_add(1, Ordering::Relaxed);
            let Some(work) = self.work.get(n) else { return Ok(identifiers) };
            let id = client.submit_surely(&work.body, &work.label, PATIENCE)?;
            client.wait(&id, PATIENCE)?;
            self.done.fetch_add(1, Ordering::Relaxed);
            identifiers.push((n, id));
        }
    }

    fn check(&self, identifiers: &[String]) -> Result<()> {
        let client = Client::new(self.url);
        let unique: BTreeSet<_> = identifiers.iter().collect();
        ensure!(unique.len() == self.work.len(), "{} jobs for {} requests", unique.len(), self.work.len());
        for (work, id) in self.work.iter().zip(identifiers) {
            let job = client.job(id)?;
            work.check(&client, &job)?;
            check_events(&client, id, work.hashes.len()).with_context(|| work.label.clone())?;
            let again = client.submit_surely(&work.body, &work.label, PATIENCE)?;
            ensure!(again == *id, "{}: the same request made a second job", work.label);
        }
        let listed: BTreeSet<_> =
            client.jobs("")?.iter().map(|job| job["id"].as_str().unwrap_or_default().to_owned()).collect();
        ensure!(listed.iter().eq(unique), "{} jobs are listed, {} were accepted", listed.len(), identifiers.len());
        Ok(())
    }
}

/// Checks that the events of a job that succeeded tell its story once: each scenario, and one end.
pub fn check_events(client: &Client, id: &str, scenarios: usize) -> Result<()> {
    let events = client.events(id, None)?.collect::<Result<Vec<_>>>()?;
    let ends: Vec<_> = events.iter().map(|event| event.kind == "state" && is_final(&event.data)).collect();
    ensure!(ends.iter().filter(|end| **end).count() == 1 && ends.last() == Some(&true), "not one end: {events:?}");
    let told: Vec<_> = events.iter().filter(|event| event.kind == "summary").collect();
    let distinct: BTreeSet<_> = told.iter().filter_map(|event| event.data["scenario"].as_u64()).collect();
    ensure!((told.len(), distinct.len()) == (scenarios, scenarios), "not every scenario once: {events:?}");
    Ok(())
}
