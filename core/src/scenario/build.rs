//! From a checked document to the closed loop it describes: the three schemes as points in one space.

use super::build_trajectory::trajectory;
use super::document::{InitialVelocityDocument, MethodDocument, ScenarioDocument, SchemeDocument};
use super::gains::{ProposedGains, SlotineLiGains, TangArteagaGains};
use crate::adaptation::{
    AdaptationLaw, CompositeAdaptation, CompositeLaw, FilteredRegressor, GradientAdaptation, PredictionMemory,
    Projection,
};
use crate::control::{CoriolisVelocity, SlidingFeedback};
use crate::decomposition::TorqueParts;
use crate::dynamics::{self, FrictionSign, Plant};
use crate::integrators::Tolerances;
#[cfg(any(target_arch = "x86_64", all(target_arch = "wasm32", target_feature = "simd128")))]
use crate::lanes::Neighbour;
use crate::recording::{Columns, Recording};
use crate::robots::{Robot, RobotData, for_robot};
use crate::scalar::Scalar;
#[cfg(any(target_arch = "x86_64", all(target_arch = "wasm32", target_feature = "simd128")))]
use crate::simulation::AsNumbers;
use crate::simulation::{ClosedLoop, InitialVelocity, Method, Settings, StateSpace};
use crate::trajectories::Remembered;
use crate::velocity::{Measured, ModelFreeObserver, VelocitySource};
use nalgebra::SVector;

/// What the lanes of a scalar take their numbers from, one per lane; lanes behind the last repeat it.
pub(super) struct Lanes<'a, D>(pub(super) &'a [D]);

impl<D> Lanes<'_, D> {
    fn of(&self, lane: usize) -> &D {
        &self.0[lane.min(self.0.len() - 1)]
    }

    fn scalar<T: Scalar>(&self, number: impl Fn(&D) -> f64) -> T {
        T::from_lanes(|lane| number(self.of(lane)))
    }

    fn vector<T: Scalar, const L: usize>(&self, numbers: impl Fn(&D) -> &[f64]) -> SVector<T, L> {
        SVector::from_fn(|i, _| self.scalar(|of| numbers(of)[i]))
    }
}

/// The closed loop that resolved documents describe, for robot `R`: one document per lane, which may differ in numbers only
/// (see [`super::Scenario::runs_beside`]).
///
/// The documents have been resolved for `R`: gains are filled in and have `N` or `P` entries.
pub(super) fn closed_loop<R: Robot<N, P>, T: Scalar, const N: usize, const P: usize>(
    documents: &[&ScenarioDocument],
) -> Box<dyn StateSpace<T>> {
    /// The gains of each document, all of one scheme.
    macro_rules! gains {
        ($scheme:ident) => {
            documents
                .iter()
                .filter_map(|document| match &document.scheme {
                    SchemeDocument::$scheme(gains) => Some(gains.clone().unwrap_or_default()),
                    _ => None,
                })
                .collect::<Vec<_>>()
        };
    }
    match &documents[0].scheme {
        SchemeDocument::SlotineLi(_) => {
            let (feedback, adaptation) = slotine_li::<T, N, P>(&Lanes(&gains!(SlotineLi)));
            assemble::<R, _, _, T, N, P>(documents, measured::<R, T, N, P>(documents), feedback, adaptation)
        }
        SchemeDocument::TangArteaga(_) => {
            let (feedback, adaptation) = tang_arteaga::<R, T, N, P>(&Lanes(&gains!(TangArteaga)));
            assemble::<R, _, _, T, N, P>(documents, measured::<R, T, N, P>(documents), feedback, adaptation)
        }
        SchemeDocument::Proposed(_) => {
            let (observer, feedback, adaptation) = proposed::<R, T, N, P>(&Lanes(&gains!(Proposed)));
            assemble::<R, _, _, T, N, P>(documents, observer, feedback, adaptation)
        }
        SchemeDocument::Pd(_) | SchemeDocument::PdGravity(_) | SchemeDocument::ComputedTorque(_) => {
            unreachable!("what is beyond the paper is built by `beyond`, and never in lanes")
        }
    }
}

/// The closed loop of one document alone, in the kind of number that this machine is fastest with.
pub(super) fn closed_loop_alone<R: Robot<N, P>, const N: usize, const P: usize>(
    document: &ScenarioDocument,
) -> Box<dyn StateSpace<f64>> {
    // The adaptive integrator weighs every state, so for it nothing may be kept twice or as padding.
    #[cfg(any(target_arch = "x86_64", all(target_arch = "wasm32", target_feature = "simd128")))]
    if document.integration.method == MethodDocument::Rk4 && Neighbour::is_here() {
        return Box::new(AsNumbers(closed_loop::<R, Neighbour, N, P>(&[document])));
    }
    closed_loop::<R, f64, N, P>(&[document])
}

/// Slotine and Li: measured velocity, gradient adaptation. Source: paper eq. (3) to (7).
pub(super) fn slotine_li<T: Scalar, const N: usize, const P: usize>(
    gains: &Lanes<SlotineLiGains>,
) -> (SlidingFeedback<T, N>, GradientAdaptation<T, P>) {
    let feedback = SlidingFeedback {
        gain: gains.vector(|gains| &gains.k_s),
        lambda: gains.vector(|gains| &gains.lambda),
        coriolis_velocity: CoriolisVelocity::Estimated,
    };
    let adaptation = GradientAdaptation { gain: gains.vector::<T, P>(|gains| &gains.gamma_adapt) };
    (feedback, adaptation)
}

/// Tang and Arteaga: measured velocity, composite adaptation. Source: paper eq. (8) to (12).
pub(super) fn tang_arteaga<R: Robot<N, P>, T: Scalar, const N: usize, const P: usize>(
    gains: &Lanes<TangArteagaGains>,
) -> (SlidingFeedback<T, N>, CompositeAdaptation<R, T, N, P>) {
    let feedback = SlidingFeedback {
        gain: gains.vector(|gains| &gains.k_s),
        lambda: gains.vector(|gains| &gains.lambda),
        coriolis_velocity: CoriolisVelocity::Estimated,
    };
    let adaptation = CompositeAdaptation::<R, T, N, P> {
        filter: FilteredRegressor::new(gains.scalar(|gains| gains.filter_rad_s)),
        memory: PredictionMemory::new(gains.scalar(|gains| gains.gamma), gains.scalar(|gains| gains.forgetting)),
        law: CompositeLaw::Additive {
            gain: gains.vector(|gains| &gains.gamma_adapt),
            memory_gain: gains.scalar(|gains| gains.delta),
        },
    };
    (feedback, adaptation)
}

/// Proposed: observed velocity, composite adaptation with projection. Source: paper eq. (13) to (23).
pub(super) fn proposed<R: Robot<N, P>, T: Scalar, const N: usize, const P: usize>(
    gains: &Lanes<ProposedGains>,
) -> (ModelFreeObserver<T, N>, SlidingFeedback<T, N>, CompositeAdaptation<R, T, N, P>) {
    let observer = ModelFreeObserver {
        lambda_z: gains.vector(|gains| &gains.lambda_z),
        lambda_x: gains.vector(|gains| &gains.lambda_x),
        k_d: gains.vector(|gains| &gains.k_d),
    };
    let feedback = SlidingFeedback {
        gain: gains.vector(|gains| &gains.k_v),
        lambda: gains.vector(|gains| &gains.lambda),
        coriolis_velocity: CoriolisVelocity::Reference,
    };
    let projection = Projection::around(
        |k| R::DATA.parameters[k].value,
        gains.scalar(|gains| gains.rho),
        gains.scalar(|gains| gains.projection.lower_margin),
        [gains.scalar(|gains| gains.projection.upper_factor), gains.scalar(|gains| gains.projection.upper_hard_factor)],
    );
    let adaptation = CompositeAdaptation::<R, T, N, P> {
        filter: FilteredRegressor::new(gains.scalar(|gains| gains.filter_rad_s)),
        memory: PredictionMemory::new(gains.scalar(|gains| gains.gamma), gains.scalar(|gains| gains.forgetting)),
        law: CompositeLaw::Projected {
            gain: gains.vector(|gains| &gains.gamma_adapt),
            memory_gain: gains.scalar(|gains| gains.beta),
            projection,
        },
    };
    (observer, feedback, adaptation)
}

pub(super) fn measured<R: Robot<N, P>, T: Scalar, const N: usize, const P: usize>(
    documents: &[&ScenarioDocument],
) -> Measured<T, N> {
    Measured { start: trajectory::<R, T, N, P>(documents).at(0.0).position }
}

fn assemble<R, V, A, T, const N: usize, const P: usize>(
    documents: &[&ScenarioDocument],
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
    let thetas: Vec<_> = documents.iter().map(|document| theta(document, R::DATA)).collect();
    Box::new(ClosedLoop::<R, V, A, T, N, P> {
        plant: Plant::new(Lanes(&thetas).vector(|theta| theta), friction_sign(documents)),
        trajectory: Remembered::new(trajectory::<R, T, N, P>(documents)),
        velocity_source,
        feedback,
        adaptation,
        initial_velocity: match documents[0].initial.velocity {
            InitialVelocityDocument::Desired => InitialVelocity::Desired,
            InitialVelocityDocument::Rest => InitialVelocity::Rest,
        },
    })
}

pub(super) fn friction_sign<T: Scalar>(documents: &[&ScenarioDocument]) -> FrictionSign<T> {
    FrictionSign::from_widths(|lane| Lanes(documents).of(lane).plant.friction.width_rad_s)
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
    let theta = theta(document, robot);
    for_robot!(robot, R, N, P => {
        let plant = Plant::<R, f64, N, P>::new(SVector::from_column_slice(&theta), friction_sign(&[document]));
        TorqueParts::of(&plant, &trajectory::<R, f64, N, P>(&[document]), recording)
    })
}

/// Whether an arm with these parameters can exist, also with `less` (kg·m² per joint) taken off its inertia.
pub(super) fn has_positive_inertia(robot: &RobotData, theta: &[f64], less: Option<&[f64]>) -> bool {
    for_robot!(robot, R, N, P => {
        let less = less.map_or_else(SVector::zeros, SVector::from_column_slice);
        dynamics::has_positive_inertia::<R, N, P>(&SVector::from_column_slice(theta), &less)
    })
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
