//! One pass over a recording: what the diagnostics need of each row, worked out with the robot's own equations.
//!
//! The velocity is `q̇ = q̇_d + ė`, the acceleration follows from the forward dynamics with all that acts on the arm. Sees the true arm.

use super::gram::Blocks;
use crate::adaptation::{AnyAdaptation, CompositeLaw};
use crate::control::{AnyFeedback, LinearFeedback, LinearModel, SlidingFeedback};
use crate::dynamics::Plant;
use crate::recording::{Recording, Signal};
use crate::regressor::model_torque;
use crate::robots::{Regressor, Robot};
use crate::simulation::ImperfectLoop;
use crate::trajectories::Desired;
use nalgebra::SVector;

/// What a pass collects.
pub(super) struct Pass {
    /// Of the recorded rows, s.
    pub times_s: Vec<f64>,
    /// Along the desired motion.
    pub desired: Blocks,
    /// Along the motion; `None` with elastic joints.
    pub actual: Option<Blocks>,
    /// Row by row; empty with elastic joints.
    pub energy: Vec<EnergyRow>,
    /// Row by row: the Lyapunov function, and the part of its rate that the feedback and friction cause; empty where there is none.
    pub lyapunov: Vec<(f64, f64)>,
    /// Rows with an estimate in the projection's margins, and which parameters they were.
    pub projected: Events,
    pub projected_parameters: Vec<bool>,
    /// Rows with a torque at its limit.
    pub saturated: Events,
    /// Rows with a payload or a disturbance.
    pub loaded: Events,
}

/// How often something was so, and when first.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Events {
    pub rows: usize,
    pub first_s: Option<f64>,
}

impl Events {
    fn note(&mut self, happens: bool, time_s: f64) {
        if happens {
            self.rows += 1;
            self.first_s.get_or_insert(time_s);
        }
    }
}

/// Energies (J) and powers (W) at a row.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct EnergyRow {
    /// `½ q̇ᵀ H q̇`.
    pub kinetic: f64,
    /// `∫ g dq` from the start's position.
    pub potential: f64,
    /// `q̇ᵀ τ`.
    pub supplied: f64,
    /// `q̇ᵀ (D q̇ + F_c sgn q̇)` and what Stribeck's excess takes.
    pub dissipated: f64,
    /// `q̇ᵀ d` of the disturbance.
    pub disturbance: f64,
}

/// A row of the recording, with what follows from it.
struct Row<'a, R: Robot<N, P>, const N: usize, const P: usize> {
    time_s: f64,
    desired: Desired<f64, N>,
    position: SVector<f64, N>,
    velocity: SVector<f64, N>,
    torque: SVector<f64, N>,
    sliding: SVector<f64, N>,
    theta_hat: &'a [f64],
    geometry: R::Geometry<f64>,
    sign: SVector<f64, N>,
    arm: Plant<R, f64, N, P>,
}

impl Pass {
    pub fn over<R: Robot<N, P>, const N: usize, const P: usize>(
        system: &ImperfectLoop<R, N, P>,
        recording: &Recording,
    ) -> Self {
        let rows = recording.len();
        let is_rigid = system.elasticity.is_none();
        let mut pass = Self {
            times_s: recording.times_s().collect(),
            desired: Blocks::new(P, rows),
            actual: is_rigid.then(|| Blocks::new(P, rows)),
            energy: Vec::new(),
            lyapunov: Vec::new(),
            projected: Events::default(),
            projected_parameters: vec![false; P],
            saturated: Events::default(),
            loaded: Events::default(),
        };
        let scales = R::DATA.parameter_sizes();
        let mut before: Option<[Vec<f64>; 2]> = None;
        let mut start = None;
        for (n, numbers) in recording.rows().chunks_exact(recording.columns().width()).enumerate() {
            let row = Row::new(system, recording, numbers);
            let start = start.get_or_insert(row.position);
            let still = row.desired;
            let desired = scaled::<R, N, P>(&still.position, &still.velocity, &still.acceleration, &row.arm, &scales);
            let actual = scaled::<R, N, P>(&row.position, &row.velocity, &row.acceleration(system), &row.arm, &scales);
            if let Some([desired_before, actual_before]) = &before {
                let span_s = row.time_s - pass.times_s[n - 1];
                pass.desired.add(n - 1, span_s, desired_before, &desired);
                if let Some(blocks) = &mut pass.actual {
                    blocks.add(n - 1, span_s, actual_before, &actual);
                }
            }
            before = Some([desired, actual]);
            if is_rigid {
                pass.energy.push(row.energy(system, start));
            }
            pass.lyapunov.extend(row.lyapunov(system));
            pass.note(system, &row);
        }
        pass
    }

    fn note<R: Robot<N, P>, const N: usize, const P: usize>(
        &mut self,
        system: &ImperfectLoop<R, N, P>,
        row: &Row<'_, R, N, P>,
    ) {
        if let AnyAdaptation::Composite(law) = &system.controller.adaptation
            && let CompositeLaw::Projected { projection, .. } = &law.law
        {
            let mut any = false;
            for k in 0..P {
                if projection.correction(k, row.theta_hat[k], 1.0) != 0.0 {
                    self.projected_parameters[k] = true;
                    any = true;
                }
            }
            self.projected.note(any, row.time_s);
        }
        if let Some(actuator) = &system.actuator {
            let at_limit = (0..N).any(|joint| row.torque[joint].abs() >= actuator.limit[joint]);
            self.saturated.note(at_limit, row.time_s);
        }
        let load = &system.load;
        self.loaded.note(load.mass_kg(row.time_s) != 0.0 || load.is_disturbed(row.time_s), row.time_s);
    }
}

/// `Y(q, q̇, q̇, q̈) S`, joints by parameters, row-wise; S the diagonal of `scales`.
fn scaled<R: Robot<N, P>, const N: usize, const P: usize>(
    position: &SVector<f64, N>,
    velocity: &SVector<f64, N>,
    acceleration: &SVector<f64, N>,
    arm: &Plant<R, f64, N, P>,
    scales: &[f64],
) -> Vec<f64> {
    let sign = arm.friction_sign.of(velocity);
    let y: Regressor<f64, N, P> = R::regressor(&R::geometry(position), velocity, velocity, acceleration, &sign);
    (0..N).flat_map(|joint| (0..P).map(move |k| y[(joint, k)] * scales[k])).collect()
}

impl<'a, R: Robot<N, P>, const N: usize, const P: usize> Row<'a, R, N, P> {
    fn new(system: &ImperfectLoop<R, N, P>, recording: &Recording, numbers: &'a [f64]) -> Self {
        let columns = recording.columns();
        let signal = |signal| SVector::<f64, N>::from_column_slice(&numbers[columns.start(signal)..][..N]);
        let time_s = numbers[0];
        let desired = system.trajectory.at(time_s);
        let (position, velocity) = (signal(Signal::Position), desired.velocity + signal(Signal::ErrorRate));
        let theta = system.load.theta(&system.plant.theta, system.load.mass_kg(time_s));
        let arm = Plant::new(theta, system.plant.friction_sign);
        Self {
            time_s,
            desired,
            position,
            velocity,
            torque: signal(Signal::Torque),
            sliding: signal(Signal::SlidingVariable),
            theta_hat: &numbers[columns.start(Signal::ThetaHat)..][..P],
            geometry: R::geometry(&position),
            sign: arm.friction_sign.of(&velocity),
            arm,
        }
    }

    /// What acts on the joints beside gravity and the model's friction, N·m.
    fn applied(&self, system: &ImperfectLoop<R, N, P>) -> SVector<f64, N> {
        let disturbed = system.load.is_disturbed(self.time_s);
        system.load.torque(self.time_s, disturbed, &self.torque, &self.velocity, &self.sign)
    }

    fn acceleration(&self, system: &ImperfectLoop<R, N, P>) -> SVector<f64, N> {
        self.arm.acceleration(&self.geometry, &self.velocity, &self.sign, &self.applied(system))
    }

    /// Friction torque of the model at a velocity, N·m: what remains of the equations without motion, Coriolis and gravity.
    fn friction(&self, velocity: &SVector<f64, N>) -> SVector<f64, N> {
        let still = SVector::zeros();
        let torque = |velocity: &SVector<f64, N>, sign: &SVector<f64, N>| {
            let y = R::regressor(&self.geometry, &still, velocity, &still, sign);
            model_torque::<R, f64, N, P>(&y, self.arm.theta.as_slice())
        };
        torque(velocity, &self.arm.friction_sign.of(velocity)) - torque(&still, &still)
    }

    fn energy(&self, system: &ImperfectLoop<R, N, P>, start: &SVector<f64, N>) -> EnergyRow {
        let still = SVector::zeros();
        let (inertia, _) = R::inertia_and_bias(&self.geometry, &self.arm.theta, &still, &still);
        let stribeck = system.load.stribeck.map_or(still, |stribeck| stribeck.torque(&self.velocity, &self.sign));
        let disturbance = self.applied(system) - self.torque + stribeck;
        EnergyRow {
            kinetic: 0.5 * self.velocity.dot(&(inertia * self.velocity)),
            potential: potential(&self.arm, start, &self.position),
            supplied: self.velocity.dot(&self.torque),
            dissipated: self.velocity.dot(&(self.friction(&self.velocity) + stribeck)),
            disturbance: self.velocity.dot(&disturbance),
        }
    }

    /// The scheme's Lyapunov function and what feedback and friction alone make of its rate; see `lyapunov`.
    fn lyapunov(&self, system: &ImperfectLoop<R, N, P>) -> Option<(f64, f64)> {
        let still = SVector::zeros();
        let (inertia, _) = R::inertia_and_bias(&self.geometry, &self.arm.theta, &still, &still);
        match &system.controller.feedback {
            AnyFeedback::Sliding(feedback) => {
                let gain = system.controller.adaptation.lyapunov_gain()?;
                Some(self.lyapunov_of_sliding(feedback, &inertia, &gain))
            }
            AnyFeedback::Linear(feedback) => Some(self.lyapunov_of_linear(feedback, &inertia)),
        }
    }

    fn lyapunov_of_sliding(
        &self,
        feedback: &SlidingFeedback<f64, N>,
        inertia: &nalgebra::SMatrix<f64, N, N>,
        gain: &SVector<f64, P>,
    ) -> (f64, f64) {
        let s = &self.sliding;
        let mut value = 0.5 * s.dot(&(inertia * s));
        for k in (0..P).filter(|k| gain[*k] != 0.0) {
            let error = self.theta_hat[k] - self.arm.theta[k];
            value += 0.5 * error * error / gain[k];
        }
        let friction = self.friction(&self.velocity) - self.friction(&(self.velocity - s));
        (value, -s.dot(&(feedback.gain.component_mul(s) + friction)))
    }

    fn lyapunov_of_linear(
        &self,
        feedback: &LinearFeedback<f64, N>,
        inertia: &nalgebra::SMatrix<f64, N, N>,
    ) -> (f64, f64) {
        let (error, rate) = (self.position - self.desired.position, self.velocity - self.desired.velocity);
        let spring = 0.5 * error.dot(&feedback.k_p.component_mul(&error));
        let damping = -rate.dot(&feedback.k_d.component_mul(&rate));
        match feedback.model {
            LinearModel::Gravity => (0.5 * rate.dot(&(inertia * rate)) + spring, damping),
            LinearModel::Inverse => (0.5 * rate.dot(&rate) + spring, damping),
        }
    }
}

/// Work against gravity from one position to another, J: the integral of g along the straight line between them, by Gauss and Legendre's
/// rule with eight points. Gravity has a potential, so the way does not matter.
fn potential<R: Robot<N, P>, const N: usize, const P: usize>(
    arm: &Plant<R, f64, N, P>,
    from: &SVector<f64, N>,
    to: &SVector<f64, N>,
) -> f64 {
    /// Places and weights on [−1, 1]; each stands for two.
    const RULE: [(f64, f64); 4] = [
        (0.183_434_642_495_649_8, 0.362_683_783_378_362),
        (0.525_532_409_916_329, 0.313_706_645_877_887_3),
        (0.796_666_477_413_626_7, 0.222_381_034_453_374_48),
        (0.960_289_856_497_536_3, 0.101_228_536_290_376_26),
    ];
    let (way, still) = (to - from, SVector::zeros());
    let mut work = 0.0;
    for (place, weight) in RULE {
        for place in [place, -place] {
            let position = from + way * (0.5 + 0.5 * place);
            let (_, gravity) = R::inertia_and_bias(&R::geometry(&position), &arm.theta, &still, &still);
            work += 0.5 * weight * gravity.dot(&way);
        }
    }
    work
}
