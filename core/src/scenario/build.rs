//! From a checked document to the closed loop it describes: the three schemes as points in one space.

use super::document::{
    InitialVelocityDocument, MethodDocument, ScenarioDocument, SchemeDocument, TrajectoryDocument, TrajectoryKind,
};
use super::gains::{ProposedGains, SlotineLiGains, TangArteagaGains};
use crate::adaptation::{
    AdaptationLaw, CompositeAdaptation, CompositeLaw, FilteredRegressor, GradientAdaptation, PredictionMemory,
    Projection,
};
use crate::control::{CoriolisVelocity, SlidingFeedback};
use crate::decomposition::TorqueParts;
use crate::dynamics::{self, FrictionSign, Plant};
use crate::integrators::Tolerances;
use crate::recording::{Columns, Recording};
use crate::robots::{CrsA465, Robot, RobotData};
use crate::scalar::Scalar;
use crate::simulation::{ClosedLoop, InitialVelocity, Method, Settings, StateSpace};
use crate::trajectories::{Fourier, Remembered};
use crate::velocity::{Measured, ModelFreeObserver, VelocitySource};
use nalgebra::SVector;

/// The closed loop that a resolved document describes, for robot `R`.
///
/// The document has been resolved for `R`: gains are filled in and have `N` or `P` entries.
pub(super) fn closed_loop<R: Robot<N, P>, T: Scalar, const N: usize, const P: usize>(
    document: &ScenarioDocument,
) -> Box<dyn StateSpace<T>> {
    match &document.scheme {
        SchemeDocument::SlotineLi(gains) => slotine_li::<R, T, N, P>(document, &gains.clone().unwrap_or_default()),
        SchemeDocument::TangArteaga(gains) => tang_arteaga::<R, T, N, P>(document, &gains.clone().unwrap_or_default()),
        SchemeDocument::Proposed(gains) => proposed::<R, T, N, P>(document, &gains.clone().unwrap_or_default()),
    }
}

/// Slotine and Li: measured velocity, gradient adaptation. Source: paper eq. (3) to (7).
fn slotine_li<R: Robot<N, P>, T: Scalar, const N: usize, const P: usize>(
    document: &ScenarioDocument,
    gains: &SlotineLiGains,
) -> Box<dyn StateSpace<T>> {
    let feedback = feedback(&gains.k_s, &gains.lambda, CoriolisVelocity::Estimated);
    let adaptation = GradientAdaptation { gain: vector::<T, P>(&gains.gamma_adapt) };
    assemble::<R, _, _, T, N, P>(document, measured(document), feedback, adaptation)
}

/// Tang and Arteaga: measured velocity, composite adaptation. Source: paper eq. (8) to (12).
fn tang_arteaga<R: Robot<N, P>, T: Scalar, const N: usize, const P: usize>(
    document: &ScenarioDocument,
    gains: &TangArteagaGains,
) -> Box<dyn StateSpace<T>> {
    let feedback = feedback(&gains.k_s, &gains.lambda, CoriolisVelocity::Estimated);
    let adaptation = CompositeAdaptation::<R, T, N, P> {
        filter: FilteredRegressor::new(T::splat(gains.filter_rad_s)),
        memory: PredictionMemory::new(T::splat(gains.gamma), T::splat(gains.forgetting)),
        law: CompositeLaw::Additive { gain: vector(&gains.gamma_adapt), memory_gain: T::splat(gains.delta) },
    };
    assemble::<R, _, _, T, N, P>(document, measured(document), feedback, adaptation)
}

/// Proposed: observed velocity, composite adaptation with projection. Source: paper eq. (13) to (23).
fn proposed<R: Robot<N, P>, T: Scalar, const N: usize, const P: usize>(
    document: &ScenarioDocument,
    gains: &ProposedGains,
) -> Box<dyn StateSpace<T>> {
    let observer = ModelFreeObserver {
        lambda_z: vector(&gains.lambda_z),
        lambda_x: vector(&gains.lambda_x),
        k_d: vector(&gains.k_d),
    };
    let feedback = feedback(&gains.k_v, &gains.lambda, CoriolisVelocity::Reference);
    let bounds = &gains.projection;
    let nominal = |factor: f64| SVector::<T, P>::from_fn(|k, _| T::splat(factor * R::DATA.parameters[k].value));
    let projection = Projection {
        strength: T::splat(gains.rho),
        lower: SVector::zeros(),
        lower_margin: SVector::from_element(T::splat(bounds.lower_margin)),
        upper: nominal(bounds.upper_factor),
        upper_margin: nominal(bounds.upper_hard_factor - bounds.upper_factor),
    };
    let adaptation = CompositeAdaptation::<R, T, N, P> {
        filter: FilteredRegressor::new(T::splat(gains.filter_rad_s)),
        memory: PredictionMemory::new(T::splat(gains.gamma), T::splat(gains.forgetting)),
        law: CompositeLaw::Projected {
            gain: vector(&gains.gamma_adapt),
            memory_gain: T::splat(gains.beta),
            projection,
        },
    };
    assemble::<R, _, _, T, N, P>(document, observer, feedback, adaptation)
}

fn measured<T: Scalar, const N: usize>(document: &ScenarioDocument) -> Measured<T, N> {
    Measured { start: trajectory(&document.trajectory).at(0.0).position }
}

fn feedback<T: Scalar, const N: usize>(
    gain: &[f64],
    lambda: &[f64],
    coriolis_velocity: CoriolisVelocity,
) -> SlidingFeedback<T, N> {
    SlidingFeedback { gain: vector(gain), lambda: vector(lambda), coriolis_velocity }
}

fn assemble<R, V, A, T, const N: usize, const P: usize>(
    document: &ScenarioDocument,
    velocity_source: V,
    feedback: SlidingFeedback<T, N>,
    adaptation: A,
) -> Box<dyn StateSpace<T>>
where
    R: Robot<N, P>,
    V: VelocitySource<T, N> + 'static,
    A: AdaptationLaw<R, T, N, P> + 'static,
    T: Scalar,
{
    let theta = theta(document, R::DATA);
    Box::new(ClosedLoop::<R, V, A, T, N, P> {
        plant: Plant::new(vector(&theta), FrictionSign::from_width(document.plant.friction.width_rad_s)),
        trajectory: Remembered::new(trajectory(&document.trajectory)),
        velocity_source,
        feedback,
        adaptation,
        initial_velocity: match document.initial.velocity {
            InitialVelocityDocument::Desired => InitialVelocity::Desired,
            InitialVelocityDocument::Rest => InitialVelocity::Rest,
        },
    })
}

/// True parameters of the simulated arm: the robot's, scaled.
pub(super) fn theta(document: &ScenarioDocument, robot: &RobotData) -> Vec<f64> {
    let mut theta = robot.theta();
    if let Some(scale) = &document.plant.theta_scale {
        theta.iter_mut().zip(scale).for_each(|(theta, scale)| *theta *= scale);
    }
    theta
}

/// A recording's torques, split by the arm that the document describes.
pub(super) fn torque_parts(document: &ScenarioDocument, robot: &RobotData, recording: &Recording) -> TorqueParts {
    // The one robot so far, as in `Scenario::closed_loop`.
    let theta = vector(&theta(document, robot));
    let plant = Plant::<CrsA465, f64, 3, 18>::new(theta, FrictionSign::from_width(document.plant.friction.width_rad_s));
    TorqueParts::of(&plant, &trajectory(&document.trajectory), recording)
}

/// Whether an arm with these parameters can exist.
pub(super) fn has_positive_inertia(theta: &[f64]) -> bool {
    // The one robot so far, as in `Scenario::closed_loop`.
    dynamics::has_positive_inertia::<CrsA465, 3, 18>(&vector(theta))
}

/// Source: paper eq. (24) for the paper's own.
fn trajectory<T: Scalar, const N: usize>(document: &TrajectoryDocument) -> Fourier<T, N> {
    match document.kind {
        TrajectoryKind::Paper => Fourier::from_degrees(
            1.0,
            &[0.0, 90.0, -90.0],
            &[vec![5.0, 5.0, 2.5], vec![15.0, 3.0, 2.5], vec![10.0, 2.0, 3.0]],
            &[],
        ),
        TrajectoryKind::Fourier => Fourier::from_degrees(
            document.frequency_rad_s.unwrap_or(1.0),
            document.offset_deg.as_deref().unwrap_or_default(),
            document.sine_deg.as_deref().unwrap_or_default(),
            document.cosine_deg.as_deref().unwrap_or_default(),
        ),
    }
}

/// How long, how fine, what to keep.
pub(super) fn settings(document: &ScenarioDocument, robot: &RobotData) -> Settings {
    let integration = &document.integration;
    Settings {
        method: match integration.method {
            MethodDocument::Rk4 => Method::Rk4,
            MethodDocument::Dopri5 => Method::Dopri5(Tolerances {
                relative: integration.relative_tolerance.unwrap_or_default(),
                absolute: integration.absolute_tolerance.unwrap_or_default(),
            }),
        },
        step_s: integration.step_s,
        duration_s: integration.duration_s,
        samples: document.recording.samples,
        columns: Columns { joints: robot.joint_count(), parameters: robot.parameter_count() },
    }
}

fn vector<T: Scalar, const L: usize>(numbers: &[f64]) -> SVector<T, L> {
    SVector::from_fn(|i, _| T::splat(numbers[i]))
}
