//! Scenarios: one document that says everything a run depends on, checked once, hashed, and run.
//!
//! `ScenarioDocument` is what people write; [`Scenario`] is what has been checked and cannot be wrong any more: after it
//! the physics cannot fail except by diverging. Reads any serde format and knows no JSON text.

mod beyond;
mod build;
mod build_trajectory;
mod document;
mod error;
mod gains;
mod group;
mod presets;
mod report;
mod robot_defaults;
#[cfg(feature = "schema")]
mod schema;
mod side_by_side;
mod trajectory_document;
mod tree;
mod validate;
mod validate_trajectory;

pub use beyond::{
    AdaptationDocument, AdaptationKind, DisturbanceDocument, EffectsDocument, ElasticityDocument, EncodersDocument,
    IntegralDocument, PayloadDocument, SamplingDocument, SignsDocument, StribeckDocument, VelocityDocument,
    VelocityKind,
};
pub use document::{
    ElbowDocument, FORMAT, FrictionDocument, FrictionKind, InitialDocument, InitialVelocityDocument,
    IntegrationDocument, MethodDocument, PlantDocument, RecordingDocument, ScenarioDocument, SchemeDocument,
    TrajectoryDocument, TrajectoryKind,
};
pub use error::{Problem, ScenarioError, in_plain_words};
pub use gains::{
    ComputedTorqueGains, GainInfo, GainSet, GainShape, ModelParameters, PdGains, PdGravityGains, ProjectionBounds,
    ProposedGains, SlotineLiGains, TangArteagaGains,
};
pub use group::{Group, groups, run_each};
pub use presets::{PRESETS, Preset, preset};
pub use report::{OutcomeKind, Report};
pub use side_by_side::SideBySide;
pub(crate) use validate::check_steps;
pub use validate::{LIMITS, Limits};

use crate::decomposition::TorqueParts;
use crate::diagnostics::{Diagnostics, Trace, diagnose};
use crate::metrics::Metrics;
use crate::recording::Recording;
use crate::robots::{RobotData, for_robot};
use crate::simulation::{Settings, Simulation, Snapshot, SnapshotError, StateSpace};
use serde::{Deserialize, Deserializer};
use std::ops::ControlFlow;
use tree::{Tree, TreeDeserializer};

/// A control scheme: the study's, and yardsticks to hold beside them (docs/schemes.md).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Scheme {
    /// The proposed scheme, without velocity sensor. Source: paper section 3.3.
    Proposed,
    /// Tang and Arteaga (1994). Source: paper section 3.2.
    TangArteaga,
    /// Slotine and Li (1987). Source: paper section 3.1.
    SlotineLi,
    /// PD, without a model.
    Pd,
    /// PD with gravity.
    PdGravity,
    /// Computed torque.
    ComputedTorque,
}

impl Scheme {
    /// The study's schemes, in the order of the paper's tables.
    pub const ALL: [Self; 3] = [Self::Proposed, Self::TangArteaga, Self::SlotineLi];

    /// Schemes that do not adapt.
    pub const YARDSTICKS: [Self; 3] = [Self::Pd, Self::PdGravity, Self::ComputedTorque];

    /// Identifier in scenarios.
    pub const fn id(self) -> &'static str {
        match self {
            Self::Proposed => "proposed",
            Self::TangArteaga => "tang_arteaga",
            Self::SlotineLi => "slotine_li",
            Self::Pd => "pd",
            Self::PdGravity => "pd_gravity",
            Self::ComputedTorque => "computed_torque",
        }
    }

    /// Name for people.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Proposed => "Proposed",
            Self::TangArteaga => "Tang and Arteaga",
            Self::SlotineLi => "Slotine and Li",
            Self::Pd => "PD",
            Self::PdGravity => "PD with gravity",
            Self::ComputedTorque => "Computed torque",
        }
    }

    /// Its gains, without those of a group such as the projection's bounds.
    pub const fn gains(self) -> &'static [GainInfo] {
        match self {
            Self::Proposed => ProposedGains::TABLE,
            Self::TangArteaga => TangArteagaGains::TABLE,
            Self::SlotineLi => SlotineLiGains::TABLE,
            Self::Pd => PdGains::TABLE,
            Self::PdGravity => PdGravityGains::TABLE,
            Self::ComputedTorque => ComputedTorqueGains::TABLE,
        }
    }

    /// The paper's scenario with the scheme's default gains: the paper's, where it is one of its own.
    pub fn paper(self) -> ScenarioDocument {
        ScenarioDocument::paper(match self {
            Self::Proposed => SchemeDocument::Proposed(None),
            Self::TangArteaga => SchemeDocument::TangArteaga(None),
            Self::SlotineLi => SchemeDocument::SlotineLi(None),
            Self::Pd => SchemeDocument::Pd(None),
            Self::PdGravity => SchemeDocument::PdGravity(None),
            Self::ComputedTorque => SchemeDocument::ComputedTorque(None),
        })
    }
}

/// A scenario that has been checked. Holds the document with everything filled in.
#[derive(Debug, Clone, PartialEq)]
pub struct Scenario {
    document: ScenarioDocument,
    robot: &'static RobotData,
}

/// A finished run.
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    /// The report on it.
    pub report: Report,
    /// All samples.
    pub recording: Recording,
}

/// Why a document could not be read: the reader's own error and where, or what is wrong with what was read.
#[derive(Debug, thiserror::Error)]
pub enum ReadError<E: std::error::Error> {
    /// The reader failed.
    #[error("{}", ScenarioError::new(pointer.clone(), Problem::Malformed { message: in_plain_words(&source.to_string()) }))]
    Document {
        /// JSON pointer to where it failed.
        pointer: String,
        /// Its error.
        source: E,
    },
    /// The document is readable but not allowed.
    #[error(transparent)]
    Invalid(#[from] ScenarioError),
}

impl<E: std::error::Error> ReadError<E> {
    /// JSON pointer to the offending field.
    pub fn pointer(&self) -> &str {
        match self {
            Self::Document { pointer, .. } => pointer,
            Self::Invalid(error) => &error.pointer,
        }
    }
}

/// Reads any document through any serde format; an error knows where in the document it arose.
///
/// A struct is read from a map only, and the order of fields makes no difference.
pub fn read_document<'de, T, D>(deserializer: D) -> Result<T, ReadError<D::Error>>
where
    T: for<'a> Deserialize<'a>,
    D: Deserializer<'de>,
    D::Error: serde::de::Error,
{
    let tree: Tree = serde_path_to_error::deserialize(deserializer).map_err(at_its_place)?;
    serde_path_to_error::deserialize(TreeDeserializer::new(tree)).map_err(at_its_place)
}

/// More of a pointer than this says nothing to anyone; only hostile documents are deeper.
const DEEPEST_POINTER: usize = 16;

fn at_its_place<E: std::error::Error>(error: serde_path_to_error::Error<E>) -> ReadError<E> {
    let mut pointer = String::new();
    for segment in error.path().iter().take(DEEPEST_POINTER) {
        use serde_path_to_error::Segment;
        match segment {
            Segment::Seq { index } => pointer.extend(["/", &index.to_string()]),
            // RFC 6901: these two characters have a meaning in a pointer.
            Segment::Map { key } => pointer.extend(["/", &key.replace('~', "~0").replace('/', "~1")]),
            Segment::Enum { .. } | Segment::Unknown => {}
        }
    }
    ReadError::Document { pointer, source: error.into_inner() }
}

impl Scenario {
    /// Checks a document and fills in what it leaves out.
    pub fn new(document: ScenarioDocument) -> Result<Self, ScenarioError> {
        let (document, robot) = validate::resolve(document)?;
        let scenario = Self { document, robot };
        let theta = scenario.theta();
        if theta != robot.theta() && !build::has_positive_inertia(robot, &theta, None) {
            let message =
                "gives an inertia matrix that is not positive definite everywhere: no such arm exists".to_owned();
            return Err(ScenarioError::new("/plant/theta_scale", Problem::Conflict { message }));
        }
        let elasticity = scenario.document.effects.as_ref().and_then(|effects| effects.elasticity.as_ref());
        if let Some(motors) = elasticity.map(|elasticity| &elasticity.motor_inertia_kgm2)
            && !build::has_positive_inertia(robot, &theta, Some(motors))
        {
            let message =
                "is more than the arm's inertia everywhere allows: nothing would be left of the links".to_owned();
            return Err(ScenarioError::new("/effects/elasticity/motor_inertia_kgm2", Problem::Conflict { message }));
        }
        Ok(scenario)
    }

    /// Reads and checks a document.
    pub fn read<'de, D>(deserializer: D) -> Result<Self, ReadError<D::Error>>
    where
        D: Deserializer<'de>,
        D::Error: serde::de::Error,
    {
        Ok(Self::new(read_document(deserializer)?)?)
    }

    /// The document with everything filled in: the canonical form.
    pub fn document(&self) -> &ScenarioDocument {
        &self.document
    }

    /// The robot.
    pub fn robot(&self) -> &'static RobotData {
        self.robot
    }

    /// The scheme.
    pub fn scheme(&self) -> Scheme {
        match self.document.scheme {
            SchemeDocument::Proposed(_) => Scheme::Proposed,
            SchemeDocument::TangArteaga(_) => Scheme::TangArteaga,
            SchemeDocument::SlotineLi(_) => Scheme::SlotineLi,
            SchemeDocument::Pd(_) => Scheme::Pd,
            SchemeDocument::PdGravity(_) => Scheme::PdGravity,
            SchemeDocument::ComputedTorque(_) => Scheme::ComputedTorque,
        }
    }

    /// Whether an observer supplies the velocity, so that z means its error.
    pub fn has_observer(&self) -> bool {
        matches!(beyond::velocity_kind(&self.document), VelocityKind::Observer | VelocityKind::HighGain)
    }

    /// Hash of the canonical form (its CBOR encoding): equal hashes mean equal scenarios, however they were written.
    pub fn hash(&self) -> String {
        let mut bytes = Vec::new();
        // A document holds only strings, numbers and lists, and a vector takes whatever is written.
        if ciborium::into_writer(&self.document, &mut bytes).is_err() {
            unreachable!("a scenario document always encodes");
        }
        blake3::hash(&bytes).to_hex().to_string()
    }

    /// True parameters of the simulated arm, SI units: the robot's, scaled as the plant says.
    pub fn theta(&self) -> Vec<f64> {
        build::theta(&self.document, self.robot)
    }

    /// The torques of a recording of this scenario, split into what they are spent on.
    pub fn torque_parts(&self, recording: &Recording) -> TorqueParts {
        build::torque_parts(&self.document, self.robot, recording)
    }

    /// What a recording of this scenario tells about excitation, stability, energy: numbers, and curves over its rows.
    pub fn diagnose(&self, recording: &Recording) -> (Diagnostics, Trace) {
        let samples = self.settings().samples;
        for_robot!(self.robot, R, N, P => {
            diagnose(&beyond::build::imperfect_loop::<R, N, P>(&self.document), recording, samples)
        })
    }

    /// How long, how fine, what is kept.
    pub fn settings(&self) -> Settings {
        build::settings(&self.document, self.robot)
    }

    /// The closed loop as a state space.
    pub fn closed_loop(&self) -> Box<dyn StateSpace<f64>> {
        for_robot!(self.robot, R, N, P => {
            if beyond::is_beyond(&self.document) {
                beyond::build::closed_loop::<R, N, P>(&self.document)
            } else {
                build::closed_loop_alone::<R, N, P>(&self.document)
            }
        })
    }

    /// A run at its start.
    pub fn start(&self) -> Simulation {
        Simulation::new(self.hash(), self.closed_loop(), self.settings())
    }

    /// A run where a snapshot left it.
    pub fn resume(&self, snapshot: Snapshot) -> Result<Simulation, SnapshotError> {
        Simulation::resume(self.hash(), self.closed_loop(), self.settings(), snapshot)
    }

    /// Runs to the end.
    pub fn run(&self) -> Run {
        let mut simulation = self.start();
        simulation.advance(u64::MAX);
        self.finish(simulation)
    }

    /// Runs to the end, `steps` at a time; between slices `go_on` may look at the run and break it off. `None` if it did.
    pub fn run_in_slices(&self, steps: u64, go_on: &mut dyn FnMut(&Simulation) -> ControlFlow<()>) -> Option<Run> {
        let mut simulation = self.start();
        while !simulation.advance(steps) {
            if go_on(&simulation).is_break() {
                return None;
            }
        }
        Some(self.finish(simulation))
    }

    /// The report on a run of this scenario, with its recording. A run that has not ended is reported as far as it came.
    pub fn finish(&self, simulation: Simulation) -> Run {
        let settings = self.settings();
        let (outcome, at_s, reason) = report::describe(simulation.outcome());
        let recording = simulation.recording();
        let observed = self.has_observer();
        let interval_s = settings.duration_s / settings.samples as f64;
        let report = Report {
            format: Report::FORMAT.to_owned(),
            core_version: crate::VERSION.to_owned(),
            robot: self.robot.id.to_owned(),
            scheme: self.scheme().id().to_owned(),
            scenario_hash: self.hash(),
            trajectory_hash: recording.hash(),
            outcome,
            at_s,
            reason: reason.map(|reason| reason.to_string()),
            metrics: Metrics::of(recording, settings.samples, self.robot, observed, interval_s),
            theta_true: self.theta(),
            theta_hat_end: simulation.theta_hat().to_vec(),
            q_end_rad: simulation.state()[..self.robot.joint_count()].to_vec(),
            samples: recording.len().min(settings.samples),
            steps: simulation.steps(),
            evaluations: simulation.evaluations(),
        };
        Run { report, recording: simulation.into_recording() }
    }
}
