//! A study's shard: scenarios, computed as many together as there are lanes, each delivered with its samples.

use super::super::compute::{Failure, Members};
use super::super::{Delivered, Order, StoredResult};
use super::{RETRY_FIRST, RETRY_LONGEST, Stopped, Worker, retry};
use crate::document::parse_scenario;
use crate::metrics::{self, FailureReason};
use crate::results::{Encoded, ResultError};
use adaptarm_core::scenario::{Report, Run, Scenario, groups};
use tokio::time::sleep;

/// Most samples of scenarios that are computed together: memory must not grow with the number of lanes.
const SAMPLES_TOGETHER: usize = 200_000;

/// A scenario that is done.
#[derive(Debug)]
struct Finished {
    report: Report,
    encoded: Encoded,
    /// Time of the arm's movement, s.
    simulated_s: f64,
}

/// What is kept of a run. Takes milliseconds.
fn keep(_: i64, scenario: &Scenario, Run { report, recording }: Run) -> Result<Finished, Failure> {
    let encoded = Encoded::new(&report, &recording).map_err(|error| (FailureReason::Storage, error.to_string()))?;
    let simulated_s = report.at_s.unwrap_or(scenario.settings().duration_s);
    Ok(Finished { report, encoded, simulated_s })
}

/// Scenarios by which are computed together.
fn grouped(documents: &[(i64, String)], most: usize) -> Result<Vec<Members>, Failure> {
    let read = |(n, document): &(i64, String)| {
        let scenario = parse_scenario(document.as_bytes());
        scenario.map_err(|error| (FailureReason::Document, format!("scenario {n}: {error}")))
    };
    let scenarios: Vec<_> = documents.iter().map(read).collect::<Result<_, _>>()?;
    let samples = scenarios.iter().map(|scenario| scenario.settings().samples).max().unwrap_or(0);
    let most = most.min(SAMPLES_TOGETHER / samples.max(1)).max(1);
    let members = |group: Vec<usize>| Members {
        numbers: group.iter().map(|&n| documents[n].0).collect(),
        scenarios: group.iter().map(|&n| scenarios[n].clone()).collect(),
        rows: Vec::new(),
        steps: 0,
    };
    Ok(groups(&scenarios, most).into_iter().map(members).collect())
}

impl Worker<'_> {
    /// Works on a study's shard.
    pub(super) async fn study(&mut self, scenarios: &[(i64, String)]) -> Result<(), Stopped> {
        let checkpoint = self.load().await?;
        let (documents, most) = (scenarios.to_vec(), self.most_together());
        let mut left = scenarios.len();
        for members in self.on_pool(move || grouped(&documents, most)).await? {
            let numbers = members.numbers.clone();
            let finished = self.compute(members, &checkpoint, keep).await?;
            for (n, finished) in numbers.into_iter().zip(finished) {
                left -= 1;
                self.deliver(n, finished, left == 0).await?;
            }
            if left > 0 {
                if self.claim.suspect || self.must_let_go() {
                    return Err(Stopped::Yielded);
                }
                self.go_on(0).await?;
            }
        }
        self.discard().await;
        Ok(())
    }

    /// Stores a scenario's result, then tells that it is there.
    async fn deliver(
        &mut self,
        n: i64,
        Finished { report, encoded, simulated_s }: Finished,
        last: bool,
    ) -> Result<(), Stopped> {
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
        let computed = self.computed();
        let result = StoredResult { n, report, bytes: encoded.bytes.len() as u64, checksum: encoded.checksum, last };
        let delivered =
            retry(self.shared, || self.shared.store.deliver(self.claim, &result, self.counted, computed)).await;
        self.counted = 0;
        match delivered.map_err(Stopped::Unreachable)? {
            Delivered { order: Order::Stop, ended: None } => Err(Stopped::Lost),
            _ => Ok(()),
        }
    }
}
