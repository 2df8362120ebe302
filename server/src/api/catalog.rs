//! What exists, over the wire: robots, schemes with their gains, presets, limits.

use crate::config::Limits as JobLimits;
use adaptarm_core::robots::RobotData;
use adaptarm_core::scenario::{
    GainInfo, LIMITS, Limits, Preset, ProjectionBounds, Scenario, ScenarioDocument, ScenarioError, Scheme,
};
use serde::Serialize;
use serde_json::Value;

/// A preset.
#[derive(Debug, Clone, Serialize)]
pub struct PresetView {
    /// Identifier, title, description.
    #[serde(flatten)]
    pub preset: &'static Preset,
    /// Its scenario with everything filled in.
    pub document: ScenarioDocument,
}

impl PresetView {
    /// A preset with its scenario.
    pub fn new(preset: &'static Preset) -> Result<Self, ScenarioError> {
        Ok(Self { preset, document: Scenario::new(preset.document())?.document().clone() })
    }
}

/// A robot.
#[derive(Debug, Clone, Serialize)]
pub struct RobotView {
    id: &'static str,
    name: &'static str,
    joints: &'static [&'static str],
    joint_limit_rad: &'static [f64],
    joint_zero_rad: &'static [f64],
    effort_limit_nm: &'static [f64],
    link_lengths_m: &'static [f64],
    torque_per_volt_nm: f64,
    supply_v: f64,
    parameters: Vec<ParameterView>,
}

#[derive(Debug, Clone, Serialize)]
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
#[derive(Debug, Clone, Serialize)]
pub struct SchemeView {
    id: &'static str,
    name: &'static str,
    gains: Vec<GainView>,
    groups: Vec<GainGroup>,
}

/// Gains that a scenario holds one level deeper, below their group's name.
#[derive(Debug, Clone, Serialize)]
struct GainGroup {
    name: &'static str,
    gains: Vec<GainView>,
}

/// A gain, with the paper's value.
#[derive(Debug, Clone, Serialize)]
struct GainView {
    #[serde(flatten)]
    info: GainInfo,
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
#[derive(Debug, Clone, Serialize)]
pub struct LimitsView<'a> {
    /// On one scenario.
    pub scenario: Limits,
    /// On one job, one user, one request.
    pub jobs: &'a JobLimits,
    /// Longest label, characters.
    pub label_chars: usize,
    /// Smallest and largest priority.
    pub priorities: [i64; 2],
}

impl<'a> LimitsView<'a> {
    /// The limits of a server with these settings.
    pub fn new(jobs: &'a JobLimits) -> Self {
        Self { scenario: LIMITS, jobs, label_chars: super::jobs::LABEL_CHARS, priorities: super::jobs::PRIORITIES }
    }
}
