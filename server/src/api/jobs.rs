//! Jobs over the wire.

use crate::config::Limits;
use crate::document::{DocumentError, brief, parse};
use crate::jobs::{ExperimentJob, Job, JobKind, JobState, NewWork, Study, StudyError};
use crate::webhooks::{Policy, Webhook};
use adaptarm_core::experiments::ExperimentDocument;
use adaptarm_core::scenario::{Problem, Scenario, ScenarioDocument, ScenarioError};
use jiff::Timestamp;
use serde::{Deserialize, Serialize};
use uuid::Uuid;

/// Longest label, characters.
pub const LABEL_CHARS: usize = 200;

/// Allowed priorities.
pub const PRIORITIES: [i64; 2] = [-10, 10];

/// A request for a job, as the kind of it wants it.
#[derive(Debug, Clone)]
pub enum JobRequest {
    /// Scenarios.
    Study(Envelope<StudySpec>),
    /// An experiment.
    Experiment(Box<Envelope<ExperimentDocument>>),
}

/// The kind of a request, by which the rest is read.
#[derive(Debug, Clone, Copy, Deserialize)]
struct Head {
    kind: JobKind,
}

/// A request whose `spec` is an `S`.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Envelope<S> {
    kind: JobKind,
    spec: S,
    #[serde(default)]
    priority: i64,
    #[serde(default)]
    label: Option<String>,
    #[serde(default)]
    webhook: Option<Webhook>,
}

/// The form of a request in the description of the API.
#[derive(Debug, utoipa::ToSchema)]
#[schema(as = JobRequest)]
#[serde(deny_unknown_fields)]
pub struct JobRequestForm {
    /// What to compute.
    pub kind: JobKind,
    /// Of what: scenarios for a `study`, an experiment of this kind for any other.
    pub spec: SpecForm,
    /// Among your own jobs, larger ones go first; -10 to 10.
    #[serde(default)]
    #[schema(minimum = -10, maximum = 10, default = 0)]
    pub priority: i64,
    /// A name for people.
    #[serde(default)]
    #[schema(max_length = 200, pattern = r"^[^\u0000-\u001f\u007f-\u009f]*$")]
    pub label: Option<String>,
    /// Whom to tell of every change of its state.
    #[serde(default)]
    pub webhook: Option<Webhook>,
}

/// What a request may be about.
#[derive(Debug, utoipa::ToSchema)]
#[serde(untagged)]
#[schema(as = JobSpec)]
pub enum SpecForm {
    /// For a `study`.
    Study(StudySpec),
    /// For a `sweep`, `monte_carlo`, `compare` or `tuning`.
    Experiment(crate::openapi::Experiment),
}

/// A study as its owner writes it.
#[derive(Debug, Clone, Deserialize, utoipa::ToSchema)]
#[serde(deny_unknown_fields)]
pub struct StudySpec {
    /// The scenarios.
    #[schema(value_type = Vec<crate::openapi::Scenario>, min_items = 1, max_items = 10_000)]
    pub scenarios: Vec<ScenarioDocument>,
}

/// Whether a job may have this label, or one may look for it.
pub(super) fn check_label(label: &str) -> Result<(), Problem> {
    let (found, most) = (label.chars().count(), LABEL_CHARS);
    if found > most {
        return Err(Problem::TooMany { found, most, what: "characters" });
    }
    if label.contains(char::is_control) {
        return Err(Problem::Malformed {
            message: "a label has no control characters, such as line breaks".to_owned(),
        });
    }
    Ok(())
}

/// A request in which everything has been checked.
#[derive(Debug)]
pub struct CheckedRequest {
    /// What to compute.
    pub work: CheckedWork,
    /// Its kind.
    pub kind: JobKind,
    /// Among its owner's jobs, larger ones go first.
    pub priority: i64,
    /// A name for people.
    pub label: Option<String>,
    /// Whom to tell.
    pub webhook: Option<Webhook>,
}

/// What a checked request asks for.
#[derive(Debug)]
pub enum CheckedWork {
    /// Scenarios.
    Study(Study),
    /// An experiment.
    Experiment(Box<ExperimentJob>),
}

impl CheckedWork {
    /// As a new job holds it. Takes a while for many scenarios: not for an async task.
    pub fn into_new_work(self) -> NewWork {
        match self {
            Self::Study(study) => NewWork::Study(study.into_new_scenarios()),
            Self::Experiment(experiment) => NewWork::Experiment(Box::new(experiment.into_new_experiment())),
        }
    }
}

impl CheckedRequest {
    /// Hash of all that is asked for; how it was written makes no difference.
    pub fn hash(&self) -> String {
        let content: Vec<_> = match &self.work {
            CheckedWork::Study(study) => study.scenarios().iter().map(Scenario::hash).collect(),
            CheckedWork::Experiment(experiment) => vec![experiment.hash()],
        };
        let canonical = (self.kind, self.priority, &self.label, &self.webhook, content);
        // Strings and numbers always become JSON.
        let text = serde_json::to_vec(&canonical).unwrap_or_default();
        blake3::hash(&text).to_hex().to_string()
    }
}

impl JobRequest {
    /// Reads a request: first its kind, then everything in the form of that kind.
    pub fn read(bytes: &[u8]) -> Result<Self, DocumentError> {
        let Head { kind } = parse(bytes)?;
        Ok(if kind.is_experiment() { Self::Experiment(Box::new(parse(bytes)?)) } else { Self::Study(parse(bytes)?) })
    }

    /// Checks everything in it. Takes a while for many scenarios: not for an async task.
    pub fn check(self, limits: &Limits, receivers: &Policy) -> Result<CheckedRequest, StudyError> {
        match self {
            Self::Study(request) => {
                let work =
                    |spec: StudySpec, _| Ok(CheckedWork::Study(Study::new(spec.scenarios, "/spec/scenarios", limits)?));
                request.check(receivers, work)
            }
            Self::Experiment(request) => {
                let work = |spec, kind| {
                    Ok(CheckedWork::Experiment(Box::new(ExperimentJob::new(spec, kind, "/spec", limits)?)))
                };
                request.check(receivers, work)
            }
        }
    }
}

impl<S> Envelope<S> {
    fn check(
        self,
        receivers: &Policy,
        work: impl FnOnce(S, JobKind) -> Result<CheckedWork, StudyError>,
    ) -> Result<CheckedRequest, StudyError> {
        let Self { kind, spec, priority, label, webhook } = self;
        if let Some(label) = &label {
            check_label(label).map_err(|problem| ScenarioError::new("/label", problem))?;
        }
        let [min, max] = PRIORITIES;
        if !(min..=max).contains(&priority) {
            let (value, [min, max]) = (priority as f64, PRIORITIES.map(|limit| limit as f64));
            return Err(ScenarioError::new("/priority", Problem::OutOfRange { value, min, max, unit: "" }).into());
        }
        if let Some(webhook) = &webhook {
            webhook.check("/webhook", receivers)?;
        }
        Ok(CheckedRequest { work: work(spec, kind)?, kind, priority, label, webhook })
    }
}

/// A job as its owner reads it.
#[derive(Debug, Clone, Serialize, utoipa::ToSchema)]
pub struct JobView {
    /// Identifier.
    pub id: Uuid,
    /// What it computes.
    pub kind: JobKind,
    /// Where it stands.
    pub state: JobState,
    /// Share done, 0 to 1.
    pub progress: f64,
    /// Among your own jobs, larger ones go first.
    pub priority: i64,
    /// Its owner's name for it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub label: Option<String>,
    /// When it was accepted.
    pub created_at: Timestamp,
    /// When work on it began.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub started_at: Option<Timestamp>,
    /// When it ended.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub finished_at: Option<Timestamp>,
    /// Why it failed or was canceled.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
    /// Most often that any part of it was taken up: more than 1 where work was interrupted or let others have their turn.
    pub attempts: i64,
    /// Whether it was answered from results of earlier jobs, without computing anything.
    pub cached: bool,
    /// How many scenarios it has: of an experiment its runs, of a tuning the candidates that it may try.
    pub scenarios: i64,
    /// How many of them have a result.
    pub scenarios_done: i64,
    /// Where to go from here.
    pub links: JobLinks,
}

/// Addresses about a job; those that would answer nothing useful now are left out.
#[derive(Debug, Clone, Serialize, utoipa::ToSchema)]
pub struct JobLinks {
    /// The job itself.
    #[serde(rename = "self")]
    pub this: String,
    /// What happens to it, as it happens.
    pub events: String,
    /// Its result, whole or as far as it came.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub result: Option<String>,
    /// Its first scenario's samples.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub series: Option<String>,
    /// Stops it, by POST.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cancel: Option<String>,
}

/// Address of a job.
pub fn location(id: Uuid) -> String {
    format!("/api/v1/jobs/{id}")
}

impl From<Job> for JobView {
    fn from(job: Job) -> Self {
        let this = location(job.id);
        let (succeeded, ended) = (job.state == JobState::Succeeded, job.state.is_final());
        let links = JobLinks {
            events: format!("{this}/events"),
            // An experiment says what it knows at any time.
            result: (ended || job.kind.is_experiment()).then(|| format!("{this}/result")),
            series: (succeeded && !job.kind.is_experiment()).then(|| format!("{this}/result/series?scenario=0")),
            cancel: (!ended).then(|| format!("{this}/cancel")),
            this,
        };
        Self {
            id: job.id,
            kind: job.kind,
            state: job.state,
            progress: job.progress(),
            priority: job.priority,
            label: job.label,
            created_at: job.created_at,
            started_at: job.started_at,
            finished_at: job.finished_at,
            reason: job.reason.as_deref().map(brief),
            attempts: job.attempts,
            cached: job.cached,
            scenarios: job.scenarios,
            scenarios_done: job.scenarios_done,
            links,
        }
    }
}

/// A page of jobs, newest first.
#[derive(Debug, Clone, Serialize, utoipa::ToSchema)]
pub struct JobsView {
    /// The jobs.
    pub jobs: Vec<JobView>,
    /// Where the next page begins, if there is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub next_cursor: Option<String>,
}
