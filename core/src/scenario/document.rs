//! The scenario document `adaptarm.scenario/1`, as it is written and read. Fields are stable: add, never rename.
//!
//! Only shapes and defaults live here; what is allowed is decided in `validate`. Every field but `format` and `scheme`
//! may be left out and means what the paper does, or what docs/physics.md chose where the paper is silent.

use super::beyond::{AdaptationDocument, EffectsDocument, IntegralDocument, SignsDocument, VelocityDocument};
use super::gains::{ComputedTorqueGains, PdGains, PdGravityGains, ProposedGains, SlotineLiGains, TangArteagaGains};
pub use super::trajectory_document::{ElbowDocument, TrajectoryDocument, TrajectoryKind};
use serde::{Deserialize, Serialize};

/// The format that this version reads and writes.
pub const FORMAT: &str = "adaptarm.scenario/1";

/// A scenario as written.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = super::schema::scenario))]
#[serde(deny_unknown_fields)]
pub struct ScenarioDocument {
    /// `adaptarm.scenario/1`.
    pub format: String,
    /// Robot, by its identifier.
    #[serde(default = "default_robot")]
    pub robot: String,
    /// How the simulated arm differs from the nominal one.
    #[serde(default)]
    pub plant: PlantDocument,
    /// Where the arm should go; the robot's own trajectory when left out.
    #[serde(default = "TrajectoryDocument::of_robot")]
    pub trajectory: TrajectoryDocument,
    /// Which controller.
    pub scheme: SchemeDocument,
    /// Velocity source in place of the scheme's own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub velocity: Option<VelocityDocument>,
    /// Changes to the scheme's adaptation.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub adaptation: Option<AdaptationDocument>,
    /// Integral action beside the scheme's law.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub integral: Option<IntegralDocument>,
    /// Signs of the scheme's terms, to see what a misprint does.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub signs: Option<SignsDocument>,
    /// Imperfections of arm, sensors and computer.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub effects: Option<EffectsDocument>,
    /// How the run starts.
    #[serde(default)]
    pub initial: InitialDocument,
    /// How to integrate.
    #[serde(default)]
    pub integration: IntegrationDocument,
    /// What to keep.
    #[serde(default)]
    pub recording: RecordingDocument,
    /// Seed of everything random in the run.
    #[serde(default)]
    pub seed: u64,
}

pub(super) fn default_robot() -> String {
    "crs_a465".to_owned()
}

/// The simulated arm.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = super::schema::plant))]
#[serde(deny_unknown_fields, default)]
pub struct PlantDocument {
    /// Factor on each true parameter, one per parameter; all 1 when left out. The controller does not know of it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub theta_scale: Option<Vec<f64>>,
    /// How friction's sign is treated.
    pub friction: FrictionDocument,
}

/// Regularisation of friction's sign.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = super::schema::friction))]
#[serde(deny_unknown_fields, default)]
pub struct FrictionDocument {
    /// Shape.
    pub kind: FrictionKind,
    /// Width, rad/s; 0 means the true sign.
    pub width_rad_s: f64,
}

/// Shape of friction's regularised sign.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum FrictionKind {
    /// `tanh(v / width)`.
    #[default]
    Tanh,
}

impl Default for FrictionDocument {
    fn default() -> Self {
        Self { kind: FrictionKind::Tanh, width_rad_s: 0.01 }
    }
}

/// A control scheme with its gains; gains left out are the robot's own: the paper's for the A465.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = super::schema::scheme))]
#[serde(tag = "kind", content = "gains", rename_all = "snake_case", deny_unknown_fields)]
pub enum SchemeDocument {
    /// The proposed scheme, without velocity sensor. Source: paper section 3.3.
    Proposed(Option<ProposedGains>),
    /// Tang and Arteaga (1994). Source: paper section 3.2.
    TangArteaga(Option<TangArteagaGains>),
    /// Slotine and Li (1987). Source: paper section 3.1.
    SlotineLi(Option<SlotineLiGains>),
    /// Yardstick: PD.
    Pd(Option<PdGains>),
    /// Yardstick: PD with gravity. Source: Takegaki and Arimoto (1981).
    PdGravity(Option<PdGravityGains>),
    /// Yardstick: computed torque. Source: Luh, Walker and Paul (1980).
    ComputedTorque(Option<ComputedTorqueGains>),
}

/// How a run starts.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
pub struct InitialDocument {
    /// Joint velocity at the start.
    pub velocity: InitialVelocityDocument,
}

/// Joint velocity at the start.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum InitialVelocityDocument {
    /// The desired trajectory's.
    #[default]
    Desired,
    /// Zero.
    Rest,
}

/// Integration method.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum MethodDocument {
    /// Fixed-step Runge-Kutta of order 4.
    #[default]
    Rk4,
    /// Adaptive Dormand-Prince 5(4) with dense output; `step_s` is its largest step.
    Dopri5,
}

/// How to integrate.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = super::schema::integration))]
#[serde(deny_unknown_fields, default)]
pub struct IntegrationDocument {
    /// Method.
    pub method: MethodDocument,
    /// Step, s.
    pub step_s: f64,
    /// Duration, s.
    pub duration_s: f64,
    /// Relative tolerance of an adaptive method.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub relative_tolerance: Option<f64>,
    /// Absolute tolerance of an adaptive method.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub absolute_tolerance: Option<f64>,
}

impl Default for IntegrationDocument {
    fn default() -> Self {
        Self {
            method: MethodDocument::Rk4,
            step_s: 0.001,
            duration_s: 12.0,
            relative_tolerance: None,
            absolute_tolerance: None,
        }
    }
}

/// What to keep of a run.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = super::schema::recording))]
#[serde(deny_unknown_fields, default)]
pub struct RecordingDocument {
    /// Number of samples k, evenly spaced from the start. Source: paper section 4.3 (k = 3000).
    pub samples: usize,
}

impl Default for RecordingDocument {
    fn default() -> Self {
        Self { samples: 3000 }
    }
}

impl ScenarioDocument {
    /// A robot under a scheme, along the robot's own trajectory.
    pub fn of_robot(robot: &str, scheme: SchemeDocument) -> Self {
        let trajectory = TrajectoryDocument::of_robot();
        Self { robot: robot.to_owned(), trajectory, ..Self::paper(scheme) }
    }

    /// The paper's scenario for a scheme with its own gains.
    pub fn paper(scheme: SchemeDocument) -> Self {
        Self {
            format: FORMAT.to_owned(),
            robot: default_robot(),
            plant: PlantDocument::default(),
            trajectory: TrajectoryDocument::default(),
            scheme,
            velocity: None,
            adaptation: None,
            integral: None,
            signs: None,
            effects: None,
            initial: InitialDocument::default(),
            integration: IntegrationDocument::default(),
            recording: RecordingDocument::default(),
            seed: 0,
        }
    }
}
