//! What the paper leaves unsaid or misprints, and what stands in its place. Source: docs/physics.md, which tells the grounds.

use crate::scenario::{InitialVelocityDocument, MethodDocument, ScenarioDocument};
use serde::Serialize;
use std::borrow::Cow;

/// One reading or choice that the study rests on.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Assumption {
    /// What it is about.
    pub about: &'static str,
    /// What the paper says, or that it does not.
    pub paper: &'static str,
    /// What is done here.
    pub here: Cow<'static, str>,
    /// Field of the scenario that changes it, where there is one.
    pub field: Option<&'static str>,
}

/// What does not depend on the scenario's settings.
const FIXED: &[Assumption] = &[
    Assumption {
        about: "Model of the arm",
        paper: "cites a model without printing it",
        here: Cow::Borrowed(
            "a model linear in the 18 parameters with a symmetric positive definite H over the whole workspace; which of θ1 to θ7 weighs which term is chosen (all 5040 assignments move the peak torque by less than 0.12 %)",
        ),
        field: None,
    },
    Assumption {
        about: "Back electromotive force",
        paper: "not in its viscous friction",
        here: Cow::Borrowed("not added; voltage is torque / 16.952 N·m/V"),
        field: None,
    },
    Assumption { about: "Initial estimates", paper: "not said", here: Cow::Borrowed("zero"), field: None },
    Assumption {
        about: "Initial state of the observer",
        paper: "not said",
        here: Cow::Borrowed("at the measured position, its integral at zero"),
        field: None,
    },
    Assumption {
        about: "Units of the tables",
        paper: "labelled degrees and degrees per second",
        here: Cow::Borrowed(
            "taken at their word (read in radians, the Slotine-Li row of Table 1 would be within 2.3 of ours at the default settings, that of Table 2 within 1.7 but for joint 2: 5)",
        ),
        field: None,
    },
    Assumption {
        about: "Observer gain K_d",
        paper: "not given",
        here: Cow::Borrowed(
            "diag(150, 270, 300) 1/s: calibrated to the paper's observer-error peaks, so their agreement is no evidence",
        ),
        field: Some("scheme.gains.k_d"),
    },
    Assumption {
        about: "Observer gain Λ_x",
        paper: "not given",
        here: Cow::Borrowed("diag(60, 80, 70) 1/s, the paper's Λ; it does not follow a changed Λ"),
        field: Some("scheme.gains.lambda_x"),
    },
    Assumption {
        about: "Eq. (4)",
        paper: "adaptation with a plus sign",
        here: Cow::Borrowed("minus; with the plus the loop diverges"),
        field: None,
    },
    Assumption {
        about: "Eq. (8)",
        paper: "both signs turned: its source defines the sliding variable the other way round",
        here: Cow::Borrowed("τ = −K s + Y θ̂, as in eq. (3) and (13)"),
        field: None,
    },
    Assumption {
        about: "Γ_1 Z in the equation of g",
        paper: "right only for a scalar Γ_1",
        here: Cow::Borrowed("Z θ̂', which keeps g = Z (θ̂ − θ)"),
        field: None,
    },
    Assumption {
        about: "Observed velocity",
        paper: "q̇ − Λ_z z: not computable without the sensor",
        here: Cow::Borrowed("q̂' − Λ_z z"),
        field: None,
    },
    Assumption {
        about: "Eq. (20) outside its margins",
        paper: "undefined",
        here: Cow::Borrowed("δ stays at 1"),
        field: None,
    },
    Assumption {
        about: "Coulomb friction in Y_o",
        paper: "missing from the printed expression, though θ14 to θ16 are estimated",
        here: Cow::Borrowed("included, at the reference velocity"),
        field: None,
    },
];

/// Every assumption of a study whose scenarios have the settings of `document`.
pub fn assumptions(document: &ScenarioDocument) -> Vec<Assumption> {
    let integration = &document.integration;
    let (duration_s, step_s, samples) = (integration.duration_s, integration.step_s, document.recording.samples);
    let width_rad_s = document.plant.friction.width_rad_s;
    let setting =
        |about, paper, here: String, field| Assumption { about, paper, here: here.into(), field: Some(field) };
    let mut all = vec![
        setting("Duration", "not said", format!("{duration_s} s"), "integration.duration_s"),
        setting(
            "Initial velocity",
            "not said",
            match document.initial.velocity {
                InitialVelocityDocument::Desired => "that of the desired trajectory".to_owned(),
                InitialVelocityDocument::Rest => "zero: the arm starts at rest".to_owned(),
            },
            "initial.velocity",
        ),
        setting(
            "Integrator and step",
            "not said",
            match integration.method {
                MethodDocument::Rk4 => format!("Runge-Kutta of order 4 with steps of {step_s} s"),
                MethodDocument::Dopri5 => format!("Dormand-Prince 5(4) with steps of at most {step_s} s"),
            },
            "integration",
        ),
        setting(
            "Window of the performance index",
            "3000 samples; when and how far apart is not said",
            format!("{samples} samples evenly over the whole run, from its start"),
            "recording.samples",
        ),
        setting(
            "Friction's sign",
            "a sign function; how the simulation treats the jump is not said",
            if width_rad_s == 0.0 {
                "the true sign, in the plant and in the controller".to_owned()
            } else {
                format!("tanh(v / {width_rad_s} rad/s), in the plant and in the controller")
            },
            "plant.friction.width_rad_s",
        ),
    ];
    all.extend_from_slice(FIXED);
    all
}
