//! Jobs over the wire.

use crate::document::brief;
use crate::jobs::{Job, JobKind, JobState, STUDY_LIMITS, Study, StudyError, StudyResult};
use adaptarm_core::scenario::{Problem, Report, ScenarioDocument, ScenarioError};
use jiff::Timestamp;
use serde::{Deserialize, Serialize};
use uuid::Uuid;

/// A request for a job.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct JobRequest {
    /// What to compute.
    pub kind: JobKind,
    /// Of what; its form depends on the kind.
    pub spec: StudySpec,
    /// A name for people.
    #[serde(default)]
    pub label: Option<String>,
}

/// A study as its owner writes it.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StudySpec {
    /// The scenarios.
    pub scenarios: Vec<ScenarioDocument>,
}

impl JobRequest {
    /// Checks everything in it.
    pub fn check(self) -> Result<(Study, Option<String>), StudyError> {
        if let Some(label) = &self.label {
            let (found, most) = (label.chars().count(), STUDY_LIMITS.label_chars);
            if found > most {
                return Err(ScenarioError::new("/label", Problem::TooMany { found, most, what: "characters" }).into());
            }
        }
        Ok((Study::new(self.spec.scenarios, "/spec/scenarios")?, self.label))
    }
}

/// A job as its owner reads it.
#[derive(Debug, Clone, Serialize)]
pub struct JobView {
    /// Identifier.
    pub id: Uuid,
    /// What it computes.
    pub kind: JobKind,
    /// Where it stands.
    pub state: JobState,
    /// Share done, 0 to 1.
    pub progress: f64,
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
    /// Why it has no result.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
    /// Where to go from here.
    pub links: JobLinks,
}

/// Addresses about a job; those that would answer nothing useful now are left out.
#[derive(Debug, Clone, Serialize)]
pub struct JobLinks {
    /// The job itself.
    #[serde(rename = "self")]
    pub this: String,
    /// Its result.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub result: Option<String>,
    /// Its samples.
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
        let (succeeded, open) = (job.state == JobState::Succeeded, !job.state.is_final());
        let links = JobLinks {
            result: succeeded.then(|| format!("{this}/result")),
            series: succeeded.then(|| format!("{this}/result/series?scenario=0")),
            cancel: open.then(|| format!("{this}/cancel")),
            this,
        };
        let Job { id, kind, label, state, progress, reason, created_at, started_at, finished_at } = job;
        let reason = reason.as_deref().map(brief);
        Self { id, kind, state, progress, label, created_at, started_at, finished_at, reason, links }
    }
}

/// A study's result.
#[derive(Debug, Clone, Serialize)]
pub struct StudyResultView<'a> {
    /// `adaptarm.study/1`.
    pub format: &'static str,
    /// One report per scenario, in the order of the spec.
    pub reports: &'a [Report],
}

impl<'a> From<&'a StudyResult> for StudyResultView<'a> {
    fn from(result: &'a StudyResult) -> Self {
        Self { format: "adaptarm.study/1", reports: &result.reports }
    }
}
