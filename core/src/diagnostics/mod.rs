//! Diagnostics of a run: is the motion rich enough to learn from, does the Lyapunov function fall, where does the energy go.
//!
//! Computed from a recording and the scenario that gave it, after the simulation: they cost nothing while it runs and change no
//! bit. Integrals are trapezoids over the samples, so their errors shrink with the square of the distance between samples.

mod assumptions;
mod energy;
mod excitation;
mod gram;
mod lyapunov;
mod parameter_error;
mod pass;

pub use assumptions::Violation;
pub use energy::EnergySummary;
pub use excitation::{Combination, Meter, Term};
pub use lyapunov::LyapunovSummary;
pub use parameter_error::{ErrorNorms, ParameterErrorSummary};

use crate::metrics::{TAIL_SHARE, settling_time_s, sign_changes, total_variation, ultimate_bound};
use crate::recording::{Recording, Signal};
use crate::robots::Robot;
use crate::simulation::ImperfectLoop;
use pass::Pass;
use serde::Serialize;

/// What the samples of a run tell. Every number is finite.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Diagnostics {
    /// `adaptarm.diagnostics/1`.
    pub format: String,
    /// Excitation along the desired motion.
    pub desired_excitation: Option<Meter>,
    /// Excitation along the motion itself; absent with elastic joints, whose acceleration is not recorded.
    pub actual_excitation: Option<Meter>,
    /// Lyapunov function of the scheme; absent where it needs what is not recorded (least squares) or there is none.
    pub lyapunov: Option<LyapunovSummary>,
    /// What the scheme's guarantees assume and this run does not have.
    pub violations: Vec<Violation>,
    /// Parameter error, split by the excitation of the motion; absent for schemes that do not adapt.
    pub parameter_error: Option<ParameterErrorSummary>,
    /// Where the run ends up, per joint.
    pub bounds: Bounds,
    /// Energy; absent with elastic joints.
    pub energy: Option<EnergySummary>,
    /// How restless the torques are, per joint.
    pub chatter: Chatter,
}

/// Bounds that the errors stay within in the last quarter of the run, and since when they do; per joint.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Bounds {
    /// Largest `|e|` in the last quarter, deg.
    pub e_deg: Vec<f64>,
    /// Largest `|ė|` in the last quarter, deg/s.
    pub de_deg_s: Vec<f64>,
    /// Time from which on `|e|` stays within its bound, s.
    pub settling_e_s: Vec<Option<f64>>,
    /// Time from which on `|ė|` stays within its bound, s.
    pub settling_de_s: Vec<Option<f64>>,
}

/// Restlessness of the torques, per joint, as far as the samples show it.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Chatter {
    /// Total variation `Σ |τ_{i+1} − τ_i|` per second, N·m/s.
    pub tau_variation_nm_s: Vec<f64>,
    /// Changes of the torque's sign per second, 1/s.
    pub tau_sign_changes_per_s: Vec<f64>,
    /// Changes of the sign of the torque's increments per second, 1/s.
    pub tau_reversals_per_s: Vec<f64>,
}

/// Curves of the diagnostics, one number per recorded row; not a number where there is none.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Trace {
    values: Vec<[f64; TRACED]>,
}

/// A curve of the diagnostics.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Traced {
    /// Smallest eigenvalue of the window's Gram matrix along the motion, N²·m².
    ActualExcitation,
    /// The same along the desired motion.
    DesiredExcitation,
    /// Lyapunov function V.
    Lyapunov,
    /// Its rate, 1/s times its unit.
    LyapunovRate,
    /// Norm of the relative parameter error's excited part.
    ExcitedError,
    /// Norm of its unexcited part.
    UnexcitedError,
    /// Kinetic energy, J.
    Kinetic,
    /// Potential energy above the start's, J.
    Potential,
    /// Work of the actuators so far, J.
    Supplied,
    /// Work lost to friction so far, J.
    Dissipated,
}

/// Number of curves.
const TRACED: usize = 10;

impl Trace {
    /// Value of a curve at a recorded row.
    pub fn at(&self, traced: Traced, row: usize) -> f64 {
        self.values[row][traced as usize]
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.values.len()
    }

    /// Whether there is no row.
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    fn with_rows(rows: usize) -> Self {
        Self { values: vec![[f64::NAN; TRACED]; rows] }
    }

    fn set(&mut self, traced: Traced, row: usize, value: f64) {
        self.values[row][traced as usize] = value;
    }
}

/// Diagnostics of a recording of `system`, of whose rows the first `samples` are samples; numbers, and curves.
pub(crate) fn diagnose<R: Robot<N, P>, const N: usize, const P: usize>(
    system: &ImperfectLoop<R, N, P>,
    recording: &Recording,
    samples: usize,
) -> (Diagnostics, Trace) {
    let pass = Pass::over(system, recording);
    let mut trace = Trace::with_rows(recording.len());
    let robot = R::DATA;
    let mut meter = |blocks: Option<&gram::Blocks>, traced| {
        blocks.map(|blocks| excitation::measure(blocks, robot, &mut |row, value| trace.set(traced, row, value)))
    };
    let desired_excitation = meter(Some(&pass.desired), Traced::DesiredExcitation).flatten();
    let actual_excitation = meter(pass.actual.as_ref(), Traced::ActualExcitation).flatten();
    let whole = pass.actual.as_ref().unwrap_or(&pass.desired).whole();
    let adapts = system.controller.adapts();
    let parameter_error = whole
        .filter(|_| adapts)
        .map(|gram| parameter_error::split(&gram, system.plant.theta.as_slice(), robot, recording, &mut trace));
    let lyapunov = lyapunov::summarise(&pass, &mut trace);
    let energy = energy::summarise(&pass, &mut trace);
    let violations = assumptions::violations(system, &pass);
    let diagnostics = Diagnostics {
        format: "adaptarm.diagnostics/1".to_owned(),
        desired_excitation,
        actual_excitation,
        lyapunov,
        violations,
        parameter_error,
        bounds: bounds(recording, samples),
        energy,
        chatter: chatter(recording, samples),
    };
    (diagnostics, trace)
}

fn bounds(recording: &Recording, samples: usize) -> Bounds {
    let joints = 0..recording.columns().joints;
    let bound = |signal: Signal| {
        joints.clone().map(move |joint| ultimate_bound(recording.signal(signal, joint).take(samples), TAIL_SHARE))
    };
    let settling = |signal| {
        let settled = |(joint, bound): (usize, f64)| {
            settling_time_s(recording.times_s(), recording.signal(signal, joint).take(samples), bound)
        };
        joints.clone().zip(bound(signal)).map(settled).collect()
    };
    Bounds {
        e_deg: bound(Signal::Error).map(f64::to_degrees).collect(),
        de_deg_s: bound(Signal::ErrorRate).map(f64::to_degrees).collect(),
        settling_e_s: settling(Signal::Error),
        settling_de_s: settling(Signal::ErrorRate),
    }
}

fn chatter(recording: &Recording, samples: usize) -> Chatter {
    let joints = 0..recording.columns().joints;
    let times = || recording.times_s().take(samples);
    let seconds = times().next_back().unwrap_or(0.0) - times().next().unwrap_or(0.0);
    let torque = |joint| recording.signal(Signal::Torque, joint).take(samples);
    let per_second = |number: &dyn Fn(usize) -> f64| {
        joints.clone().map(|joint| if seconds > 0.0 { number(joint) / seconds } else { 0.0 }).collect()
    };
    Chatter {
        tau_variation_nm_s: per_second(&|joint| total_variation(torque(joint))),
        tau_sign_changes_per_s: per_second(&|joint| sign_changes(torque(joint)) as f64),
        tau_reversals_per_s: per_second(&|joint| {
            let increments = torque(joint).zip(torque(joint).skip(1)).map(|(a, b)| b - a);
            sign_changes(increments) as f64
        }),
    }
}
