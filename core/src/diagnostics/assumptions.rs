//! What the schemes' guarantees assume, and which of it a run does not have. Guarantees and assumptions: docs/schemes.md.

use super::pass::{Events, Pass};
use crate::adaptation::{AnyAdaptation, CompositeLaw};
use crate::control::{AnyFeedback, LinearModel};
use crate::robots::Robot;
use crate::simulation::ImperfectLoop;
use crate::velocity::AnySource;
use nalgebra::SVector;
use serde::Serialize;

/// An assumption that does not hold.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Violation {
    /// Which: an identifier.
    pub assumption: String,
    /// What is wrong, for people.
    pub meaning: String,
    /// Parameters concerned, by symbol.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub parameters: Vec<String>,
    /// Share of the recorded rows for which it is so; absent where it is so throughout.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub share: Option<f64>,
    /// Since when, s; absent where it is so throughout.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub first_s: Option<f64>,
}

struct List {
    rows: usize,
    violations: Vec<Violation>,
}

impl List {
    fn add(&mut self, assumption: &str, meaning: &str, parameters: Vec<String>, events: Option<Events>) {
        self.violations.push(Violation {
            assumption: assumption.to_owned(),
            meaning: meaning.to_owned(),
            parameters,
            share: events.map(|events| events.rows as f64 / self.rows.max(1) as f64),
            first_s: events.and_then(|events| events.first_s),
        });
    }

    fn throughout(&mut self, holds: bool, assumption: &str, meaning: &str) {
        if !holds {
            self.add(assumption, meaning, Vec::new(), None);
        }
    }

    fn at_times(&mut self, events: Events, assumption: &str, meaning: &str, parameters: Vec<String>) {
        if events.rows > 0 {
            self.add(assumption, meaning, parameters, Some(events));
        }
    }
}

/// Symbols of the parameters for which `concerned` holds.
fn symbols<R: Robot<N, P>, const N: usize, const P: usize>(concerned: impl Fn(usize) -> bool) -> Vec<String> {
    (0..P).filter(|k| concerned(*k)).map(|k| R::DATA.parameters[k].symbol.to_owned()).collect()
}

/// All that this run does not have.
pub(super) fn violations<R: Robot<N, P>, const N: usize, const P: usize>(
    system: &ImperfectLoop<R, N, P>,
    pass: &Pass,
) -> Vec<Violation> {
    let mut list = List { rows: pass.times_s.len(), violations: Vec::new() };
    let controller = &system.controller;
    list.throughout(
        matches!(controller.velocity_source, AnySource::Measured(_)),
        "exact_velocity",
        "the velocity is not measured: an observer's or a filter's error drives the loop too",
    );
    list.throughout(system.sampling.is_none(), "continuous_controller", "the controller is sampled, its torque held");
    list.throughout(
        system.sensing.encoder_step == 0.0 && system.sensing.position_noise == 0.0 && system.sensing.velocity_noise == 0.0,
        "exact_measurement",
        "encoders count or sensors are noisy",
    );
    list.throughout(system.elasticity.is_none(), "rigid_joints", "joints are elastic: motors and links move apart");
    list.throughout(system.load.stribeck.is_none(), "modelled_friction", "friction has a part that the model lacks");
    list.at_times(pass.saturated, "unlimited_torque", "a torque is at its limit", Vec::new());
    list.at_times(pass.loaded, "constant_parameters", "a payload or a disturbance acts", Vec::new());
    match &controller.feedback {
        AnyFeedback::Sliding(feedback) => {
            let positive = |gains: &SVector<f64, N>| gains.iter().all(|gain| *gain > 0.0);
            let meaning = "a feedback gain or a Λ is zero";
            list.throughout(positive(&feedback.gain) && positive(&feedback.lambda), "positive_gains", meaning);
            adaptation(system, pass, &mut list);
        }
        AnyFeedback::Linear(feedback) => {
            let exact = controller.theta_hat_start == system.plant.theta;
            let meaning = match feedback.model {
                LinearModel::Gravity => "gravity is compensated with other parameters than the arm's, or not at all",
                LinearModel::Inverse => "the model's parameters are not the arm's",
            };
            list.throughout(exact, "exact_model", meaning);
            let is_inverse = feedback.model == LinearModel::Inverse;
            list.throughout(is_inverse, "desired_rest", "its guarantee is for a desired position at rest");
        }
    }
    list.violations
}

fn adaptation<R: Robot<N, P>, const N: usize, const P: usize>(
    system: &ImperfectLoop<R, N, P>,
    pass: &Pass,
    list: &mut List,
) {
    let law = &system.controller.adaptation;
    if let Some(gain) = law.lyapunov_gain() {
        let frozen = symbols::<R, N, P>(|k| gain[k] == 0.0);
        if !frozen.is_empty() {
            list.add("positive_gains", "parameters with zero adaptation gain keep their error", frozen, None);
        }
        if let AnyAdaptation::Composite(law) = law
            && let CompositeLaw::Additive { memory_gain, .. } = law.law
        {
            let scalar = gain.iter().all(|one| *one == gain[0]);
            let meaning = "Γ is not a multiple of the identity: the remembered prediction error may raise V";
            list.throughout(scalar || memory_gain == 0.0, "scalar_adaptation_gain", meaning);
        }
    }
    if let AnyAdaptation::Composite(law) = law
        && let CompositeLaw::Projected { projection, .. } = &law.law
    {
        let theta = &system.plant.theta;
        let outside = symbols::<R, N, P>(|k| theta[k] < projection.lower[k] || theta[k] > projection.upper[k]);
        if !outside.is_empty() {
            list.add("truth_within_bounds", "true parameters outside the projection's bounds", outside, None);
        }
        let inside = symbols::<R, N, P>(|k| pass.projected_parameters[k]);
        list.at_times(pass.projected, "projection_at_rest", "the projection is at work", inside);
    }
    if let Some(modification) = &system.controller.modification {
        let leaks = modification.sigma.is_some() || modification.e_modification.is_some();
        list.throughout(!leaks, "no_leakage", "σ- or e-modification pulls estimates to zero, so V may rise");
        let changed = modification.dead_zone.is_some() || modification.normalisation.is_some();
        list.throughout(!changed, "plain_gradient", "a dead zone or normalisation keeps adaptation from cancelling Yθ̃");
    }
}
