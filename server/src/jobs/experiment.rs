//! The job kinds `sweep`, `monte_carlo`, `compare`, `tuning` and `replication`: an experiment document within this server's limits, what its
//! parts are, and what their rows come to. Everything that is computed here is the core's.

use super::compute::Failure;
use super::plan::{self, Shard};
use super::study::check_total;
use super::{Folded, JobKind, NewExperiment, NextStep, Part, StudyError};
use crate::config::Limits;
use crate::document::parse;
use crate::experiment::RowFile;
use crate::metrics::FailureReason;
use crate::packed;
use adaptarm_core::VERSION;
use adaptarm_core::experiments::replication::ReplicationSummary;
use adaptarm_core::experiments::{
    Experiment, ExperimentDocument, ExperimentKind, PlannedRun, Results, Row, Summary, Tuning, TuningSummary,
};
use adaptarm_core::scenario::{Problem, ScenarioError};
use serde::Serialize;
use serde_json::{Value, json};
use std::ops::Range;
use std::sync::{Arc, Mutex, PoisonError};

/// Groups that a partial summary tells of at most: events are for those who watch, the summary has all.
const TOLD_GROUPS: usize = 64;

/// Metrics that it tells of.
const TOLD_METRICS: [&str; 4] = ["index_e_deg", "index_de_deg_s", "tau_peak_nm", "settling_e_s"];

/// The job that does such an experiment.
fn job_kind(kind: ExperimentKind) -> JobKind {
    match kind {
        ExperimentKind::Sweep => JobKind::Sweep,
        ExperimentKind::MonteCarlo => JobKind::MonteCarlo,
        ExperimentKind::Compare => JobKind::Compare,
        ExperimentKind::Tuning => JobKind::Tuning,
        ExperimentKind::Replication => JobKind::Replication,
    }
}

/// An experiment that this server may be asked for.
#[derive(Debug, Clone, PartialEq)]
pub struct ExperimentJob {
    experiment: Experiment,
    steps: u64,
}

impl ExperimentJob {
    /// Checks a document that a request for a job of this kind holds at `pointer`. Takes a while: not for an async task.
    pub fn new(
        document: ExperimentDocument,
        kind: JobKind,
        pointer: &str,
        limits: &Limits,
    ) -> Result<Self, StudyError> {
        let found = job_kind(document.kind);
        if found != kind {
            let message = format!("is {}, but the job's kind is {}", found.id(), kind.id());
            return Err(ScenarioError::new(format!("{pointer}/kind"), Problem::Conflict { message }).into());
        }
        let experiment = Experiment::new(document).map_err(|error| error.within(pointer))?;
        let steps = experiment.steps();
        check_total(pointer, "integration steps", steps, limits.steps_per_job)?;
        Ok(Self { experiment, steps })
    }

    /// Hash of what is asked.
    pub fn hash(&self) -> String {
        self.experiment.hash()
    }

    /// As a new job holds it.
    pub fn into_new_experiment(self) -> NewExperiment {
        let experiment = self.experiment;
        let (count, planned) = match experiment.tuning() {
            Some(tuning) => (tuning.progress(&experiment).1, tuning.plan(&experiment).len() as u64),
            None => (experiment.most_runs(), experiment.most_runs()),
        };
        NewExperiment {
            hash: experiment.hash(),
            // Strings, numbers and lists always become JSON.
            document: serde_json::to_string(experiment.document()).unwrap_or_default(),
            count,
            steps: self.steps,
            planned,
            shards: shards(&experiment, planned),
        }
    }
}

/// The next runs of an experiment, cut into parts.
fn shards(experiment: &Experiment, runs: u64) -> Vec<Shard> {
    // Where the step varies, runs may be longer than the bases say.
    let steps = (experiment.steps() / experiment.most_runs().max(1)) as f64;
    let cost_us =
        experiment.base_scenarios().map(|base| plan::cost_us(base).max(steps * plan::step_cost_us(base.scheme())));
    let cost_us = cost_us.fold(0.0, f64::max);
    plan::plan_runs(runs, experiment.base_scenarios().len() as u64, cost_us, experiment.columns().names().len())
}

/// An experiment with where its search stands: what is needed to plan the runs of a step.
#[derive(Debug, Clone)]
pub(super) struct Work {
    pub(super) experiment: Arc<Experiment>,
    tuning: Option<Tuning>,
}

impl Work {
    /// Runs of this step.
    pub(super) fn plan(&self, range: Range<u64>) -> Result<Vec<PlannedRun>, Failure> {
        let Some(tuning) = &self.tuning else { return Ok(self.experiment.plan(range)) };
        let planned = tuning.plan(&self.experiment);
        let runs = planned.get(range.start as usize..range.end as usize);
        runs.map(<[PlannedRun]>::to_vec).ok_or_else(|| {
            (FailureReason::Document, format!("runs {range:?} of a step that has only {}", planned.len()))
        })
    }
}

/// The experiment that was worked on last: its parts come one after another, and reading it anew takes as long as a short run.
#[derive(Debug, Default)]
pub(super) struct Opened(Mutex<Option<(String, Arc<Experiment>)>>);

impl Opened {
    /// A part's experiment as its step finds it.
    pub(super) fn open(&self, part: &Part) -> Result<Work, Failure> {
        if part.core_version != VERSION {
            let reason = format!(
                "core {} began this experiment and this is core {VERSION}; rows of both would not belong together: submit it again",
                part.core_version
            );
            return Err((FailureReason::Document, reason));
        }
        let experiment = self.experiment(&part.hash, &part.document)?;
        let tuning = match &part.state {
            None => experiment.tuning(),
            Some(state) => Some(read_search(&experiment, state)?),
        };
        Ok(Work { experiment, tuning })
    }

    fn experiment(&self, hash: &str, document: &str) -> Result<Arc<Experiment>, Failure> {
        let mut last = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, experiment)) = last.as_ref().filter(|(known, _)| known == hash) {
            return Ok(experiment.clone());
        }
        let experiment = Arc::new(read_experiment(document)?);
        *last = Some((hash.to_owned(), experiment.clone()));
        Ok(experiment)
    }
}

/// A stored experiment.
pub fn read_experiment(document: &str) -> Result<Experiment, Failure> {
    let failed = |error: &dyn std::fmt::Display| (FailureReason::Document, format!("the experiment: {error}"));
    let document = parse(document.as_bytes()).map_err(|error| failed(&error))?;
    Experiment::new(document).map_err(|error| failed(&error))
}

/// A stored search.
pub fn read_search(experiment: &Experiment, state: &[u8]) -> Result<Tuning, Failure> {
    let damaged = |why: &str| (FailureReason::Storage, format!("the stored search cannot be used: {why}"));
    let tuning: Tuning = packed::unpack(state).map_err(|error| damaged(&error.to_string()))?;
    if tuning.belongs_to(experiment) { Ok(tuning) } else { Err(damaged("it belongs to something else")) }
}

/// Stored rows.
fn read_rows(packed: &[u8]) -> Result<Vec<Row>, Failure> {
    packed::unpack(packed).map_err(|error| (FailureReason::Storage, format!("stored rows are damaged: {error}")))
}

/// An experiment's results as the tables' packed rows fill them; on disk, for there may be very many.
pub fn begin_results(experiment: &Experiment) -> Result<Results, Failure> {
    let file = RowFile::unnamed(experiment).map_err(|error| (FailureReason::Storage, format!("{error:#}")))?;
    Results::kept_in(file).map_err(storage)
}

/// Takes in packed rows.
pub fn take_in(experiment: &Experiment, results: &mut Results, packed: &[Vec<u8>]) -> Result<(), Failure> {
    for part in packed {
        for row in read_rows(part)? {
            results.insert(experiment, row).map_err(storage)?;
        }
    }
    Ok(())
}

fn storage(error: impl std::fmt::Display) -> Failure {
    (FailureReason::Storage, error.to_string())
}

/// The rows of a step while they are gathered, with what they are told to.
#[derive(Debug)]
pub(super) enum Gathered {
    /// Of an experiment that is laid out.
    Results(Results),
    /// Of a generation of a tuning, whose size has a limit.
    Generation(Box<Tuning>, Vec<Row>),
}

impl Gathered {
    /// None yet.
    pub(super) fn begin(work: &Work) -> Result<Self, Failure> {
        match &work.tuning {
            None => begin_results(&work.experiment).map(Self::Results),
            Some(tuning) => Ok(Self::Generation(Box::new(tuning.clone()), Vec::new())),
        }
    }

    /// With these packed rows.
    pub(super) fn and(mut self, work: &Work, packed: &[Vec<u8>]) -> Result<Self, Failure> {
        match &mut self {
            Self::Results(results) => take_in(&work.experiment, results, packed)?,
            Self::Generation(_, rows) => {
                for part in packed {
                    rows.extend(read_rows(part)?);
                }
            }
        }
        Ok(self)
    }
}

/// What the rows of a step come to. May take seconds where there are very many.
pub(super) fn fold(experiment: &Experiment, step: i64, gathered: Gathered) -> Result<Folded, Failure> {
    match gathered {
        Gathered::Generation(tuning, rows) => learn(experiment, *tuning, step, rows),
        Gathered::Results(results) => sum_up(experiment, step, &results),
    }
}

/// A summary as it is kept: as the command line prints it.
fn text(summary: &impl Serialize) -> String {
    // Strings, numbers and lists always become JSON.
    serde_json::to_string_pretty(summary).unwrap_or_default() + "\n"
}

fn sum_up(experiment: &Experiment, step: i64, results: &Results) -> Result<Folded, Failure> {
    let (digest, summary) = if let Some(summary) = ReplicationSummary::of(experiment, results).map_err(storage)? {
        (digest_of_replication(&summary), text(&summary))
    } else {
        let summary = Summary::of(experiment, results).map_err(storage)?;
        (digest(&summary), text(&summary))
    };
    let complete = Some(results.len() as u64) == experiment.runs();
    Ok(Folded {
        step,
        rows: results.len() as i64,
        digest: digest.to_string(),
        summary,
        state: None,
        candidates: None,
        next: if complete { NextStep::End } else { NextStep::Rest },
    })
}

/// The numbers that those who follow want to see.
fn digest(summary: &Summary) -> Value {
    let told = |metric: &str| TOLD_METRICS.contains(&metric);
    let groups = summary.groups.iter().take(TOLD_GROUPS).map(|group| {
        let metrics = group.metrics.iter().filter(|metric| told(&metric.metric)).map(|metric| {
            let (mean, interval) = (metric.statistics.mean, metric.statistics.mean_interval);
            json!({ "metric": metric.metric, "mean": mean, "mean_interval": interval })
        });
        json!({
            "base": group.base, "condition": group.condition, "completed": group.completed, "refused": group.refused,
            "diverged": group.diverged.as_ref().map_or(0, |share| share.count), "metrics": metrics.collect::<Vec<_>>(),
        })
    });
    let rankings: Vec<_> = summary.rankings.iter().filter(|ranking| told(&ranking.metric)).collect();
    json!({
        "runs": summary.runs, "done": summary.done, "confidence": summary.confidence,
        "groups": groups.collect::<Vec<_>>(), "rankings": rankings,
    })
}

fn digest_of_replication(summary: &ReplicationSummary) -> Value {
    json!({
        "runs": summary.runs, "done": summary.done, "readings": summary.readings, "complete": summary.complete,
        "best": summary.best.first(),
    })
}

fn learn(experiment: &Experiment, mut tuning: Tuning, step: i64, rows: Vec<Row>) -> Result<Folded, Failure> {
    let count = rows.len() as i64;
    tuning.tell(experiment, rows).map_err(|error| (FailureReason::Document, error.to_string()))?;
    let summary = tuning.summary(experiment);
    let planned = tuning.plan(experiment).len() as u64;
    let storage = |error| (FailureReason::Storage, format!("the search cannot be stored: {error}"));
    Ok(Folded {
        step,
        rows: count,
        digest: digest_of_tuning(&summary).to_string(),
        summary: text(&summary),
        state: Some(packed::pack(&tuning).map_err(storage)?),
        candidates: Some(summary.candidates as i64),
        next: if tuning.is_done() {
            NextStep::End
        } else {
            NextStep::Step(planned as i64, shards(experiment, planned))
        },
    })
}

fn digest_of_tuning(summary: &TuningSummary) -> Value {
    json!({
        "candidates": summary.candidates, "runs": summary.runs, "generations": summary.history.len(),
        "start": summary.start.as_ref().map(|start| start.objective),
        "best": summary.best.as_ref().map(|best| best.objective),
        "last": summary.history.last(),
    })
}
