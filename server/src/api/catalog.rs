//! What exists, over the wire: robots, schemes with their gains, presets, limits.

use super::jobs::{LABEL_CHARS, PRIORITIES};
use crate::config::Limits as JobLimits;
use adaptarm_core::experiments::{EXPERIMENT_LIMITS, ExperimentLimits};
use adaptarm_core::robots::RobotData;
use adaptarm_core::scenario::{
    GainInfo, LIMITS, Limits, Preset, ProjectionBounds, Scenario, ScenarioDocument, ScenarioError, Scheme,
};
use serde::Serialize;
use serde_json::Value;

/// An experiment to begin with.
#[derive(Debug, Clone, Serialize, utoipa::ToSchema)]
pub struct ExampleView {
    /// Identifier.
    pub id: &'static str,
    /// Its title.
    pub title: String,
    /// Its document, as the manual has it.
    #[schema(value_type = crate::openapi::Experiment)]
    pub experiment: Value,
}

/// The manual's experiments.
const EXAMPLES: [(&str, &str); 5] = [
    ("gains", include_str!("../../../docs/experiments/gains.json")),
    ("sensitivity", include_str!("../../../docs/experiments/sensitivity.json")),
    ("robustness", include_str!("../../../docs/experiments/robustness.json")),
    ("schemes", include_str!("../../../docs/experiments/schemes.json")),
    ("tuning", include_str!("../../../docs/experiments/tuning.json")),
];

/// The manual's experiments.
pub fn examples() -> Result<Vec<ExampleView>, serde_json::Error> {
    let view = |&(id, text): &(&'static str, &str)| {
        let experiment: Value = serde_json::from_str(text)?;
        let title = experiment["title"].as_str().unwrap_or(id).to_owned();
        Ok(ExampleView { id, title, experiment })
    };
    EXAMPLES.iter().map(view).collect()
}

/// A preset.
#[derive(Debug, Clone, Serialize, utoipa::ToSchema)]
pub struct PresetView {
    /// Identifier, title, description.
    #[serde(flatten)]
    #[schema(value_type = crate::openapi::PresetNames)]
    pub preset: &'static Preset,
    /// Its scenario with everything filled in.
    #[schema(value_type = crate::openapi::Scenario)]
    pub document: ScenarioDocument,
}

impl PresetView {
    /// A preset with its scenario.
    pub fn new(preset: &'static Preset) -> Result<Self, ScenarioError> {
        Ok(Self { preset, document: Scenario::new(preset.document())?.document().clone() })
    }
}

/// A robot.
#[derive(Debug, Clone, Serialize, utoipa::ToSchema)]
pub struct RobotView {
    id: &'static str,
    name: &'static str,
    joints: &'static [&'static str],
    joint_limit_rad: &'static [f64],
    joint_zero_rad: &'static [f64],
    effort_limit_nm: &'static [f64],
    link_lengths_m: [f64; 4],
    torque_per_volt_nm: f64,
    supply_v: f64,
    parameters: Vec<ParameterView>,
}

#[derive(Debug, Clone, Serialize, utoipa::ToSchema)]
struct ParameterView {
    symbol: &'static str,
    unit: &'static str,
    meaning: &'static str,
    value: f64,
    inertial: bool,
}

impl From<&RobotData> for RobotView {
    fn from(robot: &RobotData) -> Self {
        let parameters = robot.parameters.iter().map(|parameter| ParameterView {
            symbol: parameter.symbol,
            unit: parameter.unit,
            meaning: parameter.meaning,
            value: parameter.value,
            inertial: parameter.inertial,
        });
        Self {
            id: robot.id,
            name: robot.name,
            joints: robot.joints,
            joint_limit_rad: robot.joint_limit_rad,
            joint_zero_rad: robot.joint_zero_rad,
            effort_limit_nm: robot.effort_limit_nm,
            link_lengths_m: robot.link_lengths_m,
            torque_per_volt_nm: robot.torque_per_volt_nm,
            supply_v: robot.supply_v,
            parameters: parameters.collect(),
        }
    }
}

/// A scheme with all that a form needs.
#[derive(Debug, Clone, Serialize, utoipa::ToSchema)]
pub struct SchemeView {
    id: &'static str,
    name: &'static str,
    gains: Vec<GainView>,
    groups: Vec<GainGroup>,
}

/// Gains that a scenario holds one level deeper, below their group's name.
#[derive(Debug, Clone, Serialize, utoipa::ToSchema)]
struct GainGroup {
    name: &'static str,
    gains: Vec<GainView>,
}

/// A gain, with the paper's value.
#[derive(Debug, Clone, Serialize, utoipa::ToSchema)]
struct GainView {
    #[serde(flatten)]
    #[schema(value_type = crate::openapi::Gain)]
    info: GainInfo,
    /// The paper's value: a number, or one per joint or parameter.
    default: Value,
}

impl SchemeView {
    /// A scheme with the paper's gains.
    pub fn new(scheme: Scheme) -> Result<Self, ScenarioError> {
        let paper = Scenario::new(scheme.paper())?;
        // Strings and numbers always become a value.
        let defaults = serde_json::to_value(&paper.document().scheme).unwrap_or_default()["gains"].take();
        let view = |table: &[GainInfo], defaults: &Value| {
            table.iter().map(|info| GainView { info: *info, default: defaults[info.name].clone() }).collect()
        };
        let groups = match &defaults["projection"] {
            Value::Null => Vec::new(),
            bounds => vec![GainGroup { name: "projection", gains: view(ProjectionBounds::TABLE, bounds) }],
        };
        Ok(Self { id: scheme.id(), name: scheme.name(), gains: view(scheme.gains(), &defaults), groups })
    }
}

/// Every limit on what can be asked.
#[derive(Debug, Clone, Copy, Serialize, utoipa::ToSchema)]
pub struct LimitsView {
    /// On one scenario.
    #[schema(value_type = crate::openapi::ScenarioLimits)]
    pub scenario: Limits,
    /// On one experiment.
    #[schema(value_type = crate::openapi::ExperimentLimits)]
    pub experiment: ExperimentLimits,
    /// On one job.
    pub job: JobLimitsView,
    /// On all jobs of one user together.
    pub user: UserLimitsView,
    /// On a request's body, bytes.
    pub request_bytes: usize,
    /// On `Prefer: wait`, s.
    pub wait_s: u64,
}

/// Limits on one job.
#[derive(Debug, Clone, Copy, Serialize, utoipa::ToSchema)]
pub struct JobLimitsView {
    /// Most scenarios.
    pub scenarios: usize,
    /// Most integration steps of all scenarios together.
    pub steps: u64,
    /// Most samples of all scenarios together.
    pub samples: u64,
    /// Longest computing time, s.
    pub compute_s: u64,
    /// Longest label, characters.
    pub label_chars: usize,
    /// Smallest and largest priority.
    pub priority: [i64; 2],
}

/// Limits on all jobs of one user together.
#[derive(Debug, Clone, Copy, Serialize, utoipa::ToSchema)]
pub struct UserLimitsView {
    /// Most jobs waiting or running.
    pub unfinished_jobs: u64,
    /// Most integration steps waiting or under way.
    pub queued_steps: u64,
    /// Most stored results, bytes.
    pub stored_bytes: u64,
}

impl From<&JobLimits> for LimitsView {
    fn from(limits: &JobLimits) -> Self {
        Self {
            scenario: LIMITS,
            experiment: EXPERIMENT_LIMITS,
            job: JobLimitsView {
                scenarios: limits.scenarios_per_job,
                steps: limits.steps_per_job,
                samples: limits.samples_per_job,
                compute_s: limits.compute_s_per_job,
                label_chars: LABEL_CHARS,
                priority: PRIORITIES,
            },
            user: UserLimitsView {
                unfinished_jobs: limits.unfinished_jobs_per_user,
                queued_steps: limits.queued_steps_per_user,
                stored_bytes: limits.stored_bytes_per_user,
            },
            request_bytes: limits.request_bytes,
            wait_s: limits.wait_s,
        }
    }
}
