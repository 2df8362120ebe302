//! What the paper leaves unsaid or misprints, and what stands in its place. Source: PHYSICS.md, which tells the grounds.

use serde::Serialize;

/// One reading or choice that the study rests on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Assumption {
    /// What it is about.
    pub about: &'static str,
    /// What the paper says, or that it does not.
    pub paper: &'static str,
    /// What is done here.
    pub here: &'static str,
    /// Field of the scenario that changes it, where there is one.
    pub field: Option<&'static str>,
}

/// Every assumption of the default study.
pub const ASSUMPTIONS: &[Assumption] = &[
    Assumption {
        about: "Model of the arm",
        paper: "cites a model without printing it",
        here: "a model linear in the 18 parameters with a symmetric positive definite H over the whole workspace; which of θ1 to θ7 weighs which term is chosen (all 5040 assignments move the peak torque by less than 0.12 %)",
        field: None,
    },
    Assumption {
        about: "Friction's sign",
        paper: "a sign function; how the simulation treats the jump is not said",
        here: "tanh(v / 0.01 rad/s), in the plant and in the controller",
        field: Some("plant.friction.width_rad_s"),
    },
    Assumption {
        about: "Back electromotive force",
        paper: "not in its viscous friction",
        here: "not added; voltage is torque / 16.952 N·m/V",
        field: None,
    },
    Assumption {
        about: "Initial velocity",
        paper: "not said",
        here: "that of the desired trajectory",
        field: Some("initial.velocity"),
    },
    Assumption { about: "Initial estimates", paper: "not said", here: "zero", field: None },
    Assumption {
        about: "Initial state of the observer",
        paper: "not said",
        here: "at the measured position, its integral at zero",
        field: None,
    },
    Assumption { about: "Duration", paper: "not said", here: "12 s", field: Some("integration.duration_s") },
    Assumption {
        about: "Integrator and step",
        paper: "not said",
        here: "Runge-Kutta of order 4 with 1 ms",
        field: Some("integration"),
    },
    Assumption {
        about: "Window of the performance index",
        paper: "3000 samples; when and how far apart is not said",
        here: "3000 samples evenly over the whole run, from its start",
        field: Some("recording.samples"),
    },
    Assumption {
        about: "Units of the tables",
        paper: "labelled degrees and degrees per second",
        here: "taken at their word (in radians the Slotine-Li rows would agree within about 2)",
        field: None,
    },
    Assumption {
        about: "Observer gain K_d",
        paper: "not given",
        here: "diag(150, 270, 300) 1/s: calibrated to the paper's observer-error peaks, so their agreement is no evidence",
        field: Some("scheme.gains.k_d"),
    },
    Assumption {
        about: "Observer gain Λ_x",
        paper: "not given",
        here: "diag(60, 80, 70) 1/s, the paper's Λ; it does not follow a changed Λ",
        field: Some("scheme.gains.lambda_x"),
    },
    Assumption {
        about: "Eq. (4)",
        paper: "adaptation with a plus sign",
        here: "minus; with the plus the loop diverges",
        field: None,
    },
    Assumption {
        about: "Eq. (8)",
        paper: "both signs turned: its source defines the sliding variable the other way round",
        here: "τ = −K s + Y θ̂, as in eq. (3) and (13)",
        field: None,
    },
    Assumption {
        about: "Γ_1 Z in the equation of g",
        paper: "right only for a scalar Γ_1",
        here: "Z θ̂', which keeps g = Z (θ̂ − θ)",
        field: None,
    },
    Assumption {
        about: "Observed velocity",
        paper: "q̇ − Λ_z z: not computable without the sensor",
        here: "q̂' − Λ_z z",
        field: None,
    },
    Assumption { about: "Eq. (20) outside its margins", paper: "undefined", here: "δ stays at 1", field: None },
    Assumption {
        about: "Coulomb friction in Y_o",
        paper: "missing from the printed expression, though θ14 to θ16 are estimated",
        here: "included, at the reference velocity",
        field: None,
    },
];
