//! An experiment's shard: making runs, of which one row each is kept, or folding the rows of a step into what they say. What
//! runs there are follows from the document and, in a tuning, from the search that the steps before left.

use super::super::compute::{Failure, Members};
use super::super::experiment::{Gathered, Work, fold};
use super::super::{Delivered, MadeRuns, Order, Part};
use super::{Stopped, Worker, retry};
use crate::metrics::{self, FailureReason};
use crate::packed;
use crate::results::Checkpoint;
use adaptarm_core::experiments::{PlannedRun, Row};
use adaptarm_core::scenario::{Run, Scenario, groups};
use std::ops::Range;
use std::sync::Arc;

/// Packed parts of rows read at a time.
const PAGE: i64 = 10;

fn storage(error: impl std::fmt::Display) -> Failure {
    (FailureReason::Storage, error.to_string())
}

/// Runs of a part that are not done, by which are made together; rows of those that are refused come with them.
fn grouped(work: &Work, range: Range<u64>, done: &[Row], most: usize) -> Result<(Vec<Members>, Vec<Row>), Failure> {
    let planned = work.plan(range)?;
    let (mut indices, mut scenarios, mut refused) = (Vec::new(), Vec::new(), Vec::new());
    for PlannedRun { index, scenario } in planned {
        if done.iter().any(|row| row.index == index) {
            continue;
        }
        match scenario {
            Ok(scenario) => {
                indices.push(index as i64);
                scenarios.push(scenario);
            }
            Err(why) => refused.push(work.experiment.refused(index, &why)),
        }
    }
    let members = |group: Vec<usize>| Members {
        numbers: group.iter().map(|&n| indices[n]).collect(),
        scenarios: group.iter().map(|&n| scenarios[n].clone()).collect(),
        rows: Vec::new(),
        steps: 0,
    };
    Ok((groups(&scenarios, most).into_iter().map(members).collect(), refused))
}

impl Worker<'_> {
    /// Makes the runs of a part.
    pub(super) async fn runs(&mut self, part: &Part, range: &Range<i64>) -> Result<(), Stopped> {
        let checkpoint = self.load().await?;
        let work = self.open(part).await?;
        let (mut rows, mut steps) = (checkpoint.rows.clone(), checkpoint.steps);
        let (planner, range, done, most) =
            (work.clone(), range.start as u64..range.end as u64, rows.clone(), self.most_together());
        let (first, count) = (range.start as i64, (range.end - range.start) as i64);
        let (members, refused) = self.on_pool(move || grouped(&planner, range, &done, most)).await?;
        rows.extend(refused);
        let mut left = members.len();
        for members in members {
            let experiment = work.experiment.clone();
            let members = Members { rows: rows.clone(), steps, ..members };
            let keep = move |number: i64, scenario: &Scenario, run: Run| {
                let simulated_s = run.report.at_s.unwrap_or(scenario.settings().duration_s);
                Ok((experiment.row(number as u64, &run), run.report.steps, simulated_s))
            };
            for (row, taken, simulated_s) in self.compute(members, &checkpoint, keep).await? {
                metrics::simulated(simulated_s, taken);
                rows.push(row);
                steps += taken;
            }
            left -= 1;
            if left > 0 {
                self.between(&rows, steps).await?;
            }
        }
        rows.sort_by_key(|row| row.index);
        let packed = self.on_pool(move || packed::pack(&rows).map_err(storage)).await?;
        let made = MadeRuns { step: part.step, first, count, packed, steps: steps as i64 };
        let computed = self.computed();
        let delivered =
            retry(self.shared, || self.shared.store.deliver_runs(self.claim, &made, self.counted, computed)).await;
        if delivered.map_err(Stopped::Unreachable)?.order == Order::Stop {
            return Err(Stopped::Lost);
        }
        self.discard().await;
        Ok(())
    }

    /// Between two groups of runs: lets go, with what is done saved, where that is asked for.
    async fn between(&mut self, rows: &[Row], steps: u64) -> Result<(), Stopped> {
        let stop = match self.go_on(steps, false).await {
            Err(Stopped::Yielded) => true,
            other => {
                other?;
                self.claim.suspect || self.must_let_go()
            }
        };
        if !stop {
            return Ok(());
        }
        let checkpoint = Checkpoint { rows: rows.to_vec(), steps, ..Checkpoint::default() };
        let bytes = self.on_pool(move || checkpoint.encode().map_err(storage)).await?;
        if self.save(bytes, steps).await? || self.shared.is_stopping() { Err(Stopped::Yielded) } else { Ok(()) }
    }

    /// Folds the rows of a step.
    pub(super) async fn fold(&mut self, part: &Part) -> Result<(), Stopped> {
        let work = self.open(part).await?;
        let store = self.shared.store.clone();
        let (beginner, mut from) = (work.clone(), 0);
        let mut gathered = self.on_pool(move || Gathered::begin(&beginner)).await?;
        loop {
            let page = self.alive(store.packed_rows(self.claim.job, part.step, from, PAGE)).await?;
            let page = page.map_err(Stopped::Unreachable)?;
            from = page.last().map_or(from, |(first, _)| first + 1);
            let whole = (page.len() as i64) < PAGE;
            let (work, packed) = (work.clone(), page.into_iter().map(|(_, rows)| rows).collect::<Vec<_>>());
            gathered = self.on_pool(move || gathered.and(&work, &packed)).await?;
            if whole {
                break;
            }
        }
        let step = part.step;
        let folded = self.on_pool(move || fold(&work.experiment, step, gathered)).await?;
        let computed = self.computed();
        let delivered = retry(self.shared, || self.shared.store.deliver_fold(self.claim, &folded, computed)).await;
        match delivered.map_err(Stopped::Unreachable)? {
            Delivered { order: Order::Stop, ended: None } => Err(Stopped::Lost),
            _ => Ok(()),
        }
    }

    /// The experiment of a part as this step finds it.
    async fn open(&mut self, part: &Part) -> Result<Arc<Work>, Stopped> {
        let (part, shared) = (part.clone(), self.shared.clone());
        self.on_pool(move || shared.experiments.open(&part).map(Arc::new)).await
    }
}
