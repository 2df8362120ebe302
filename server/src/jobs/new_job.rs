//! A job that is asked for, everything checked: whose it is, whom to tell, and what to compute.

use super::JobKind;
use super::plan::{self, Shard};
use crate::webhooks::Webhook;
use adaptarm_core::scenario::Scenario;

/// A scenario of a new job.
#[derive(Debug, Clone, PartialEq)]
pub struct NewScenario {
    /// Hash of its canonical form.
    pub hash: String,
    /// Its canonical form as JSON.
    pub document: String,
    /// Integration steps.
    pub steps: u64,
    /// Expected computing time, µs.
    pub cost_us: f64,
}

impl NewScenario {
    /// A scenario as a job holds it.
    pub fn of(scenario: &Scenario) -> Self {
        Self {
            hash: scenario.hash(),
            // Strings, numbers and lists always become JSON.
            document: serde_json::to_string(scenario.document()).unwrap_or_default(),
            steps: scenario.settings().steps(),
            cost_us: plan::cost_us(scenario),
        }
    }
}

/// A job that is asked for.
#[derive(Debug)]
pub struct NewJob {
    /// Whose.
    pub owner: String,
    /// What it computes.
    pub kind: JobKind,
    /// Its owner's name for it.
    pub label: Option<String>,
    /// Among its owner's jobs, larger ones go first.
    pub priority: i64,
    /// Whom to tell.
    pub webhook: Option<Webhook>,
    /// The request's own name, and a hash of all it asks for.
    pub idempotency: Option<(String, String)>,
    /// What to compute.
    pub work: NewWork,
}

/// What a new job computes.
#[derive(Debug)]
pub enum NewWork {
    /// Scenarios.
    Study(Vec<NewScenario>),
    /// An experiment.
    Experiment(Box<NewExperiment>),
}

/// An experiment of a new job.
#[derive(Debug)]
pub struct NewExperiment {
    /// Hash of its canonical form.
    pub hash: String,
    /// Its canonical form as JSON.
    pub document: String,
    /// What its progress is counted in: runs, or candidates.
    pub count: u64,
    /// Integration steps of all runs.
    pub steps: u64,
    /// Runs of its first step.
    pub planned: u64,
    /// Those, cut into parts.
    pub shards: Vec<Shard>,
}

impl NewWork {
    /// The scenarios; an experiment has none.
    pub fn scenarios(&self) -> &[NewScenario] {
        match self {
            Self::Study(scenarios) => scenarios,
            Self::Experiment(_) => &[],
        }
    }

    /// What progress is counted in: how many there are.
    pub fn count(&self) -> u64 {
        match self {
            Self::Study(scenarios) => scenarios.len() as u64,
            Self::Experiment(experiment) => experiment.count,
        }
    }

    /// Integration steps.
    pub fn steps(&self) -> u64 {
        match self {
            Self::Study(scenarios) => scenarios.iter().map(|scenario| scenario.steps).sum(),
            Self::Experiment(experiment) => experiment.steps,
        }
    }
}

impl NewJob {
    /// A study of these scenarios, with nothing else said about it.
    pub fn study(owner: &str, scenarios: Vec<NewScenario>) -> Self {
        Self {
            owner: owner.to_owned(),
            kind: JobKind::Study,
            label: None,
            priority: 0,
            webhook: None,
            idempotency: None,
            work: NewWork::Study(scenarios),
        }
    }
}
