//! A controller on its side of the boundary: velocity source, feedback law and adaptation law, put together when the program runs.
//!
//! It sees a measurement and the desired motion, and gives a torque command. Knows nothing of the arm's true state. States: the
//! velocity source's, θ̂, the adaptation law's, `∫ e dt`.

use crate::adaptation::{AdaptationInput, AdaptationLaw, AnyAdaptation, Modification};
use crate::control::{AnyFeedback, SlidingSignals};
use crate::dynamics::FrictionSign;
use crate::regressor::{gradient, model_torque};
use crate::robots::{Regressor, Robot};
use crate::scalar::Scalar;
use crate::trajectories::Desired;
use crate::velocity::{AnySource, VelocityEstimate, VelocitySource};
use nalgebra::SVector;

/// A controller for robot `R`.
#[derive(Debug, Clone)]
pub struct Controller<R, T, const N: usize, const P: usize> {
    /// Where the velocity comes from.
    pub velocity_source: AnySource<T, N>,
    /// How torque follows from errors.
    pub feedback: AnyFeedback<T, N>,
    /// How estimates move.
    pub adaptation: AnyAdaptation<R, T, N, P>,
    /// What keeps them bounded; `None` for the law as it is.
    pub modification: Option<Modification<T>>,
    /// The model's sign of friction.
    pub friction_sign: FrictionSign<T>,
    /// θ̂(0).
    pub theta_hat_start: SVector<T, P>,
    /// `K_i` of integral action `−K_i ∫ e dt`, N·m/(rad·s).
    pub integral: Option<SVector<T, N>>,
    /// Factor on the model's torque; 1, or −1 for a misprinted sign.
    pub model_sign: T,
    /// Factor on the estimates' rate; likewise.
    pub adaptation_sign: T,
}

/// What a controller makes of one measurement.
pub(super) struct Action<R: Robot<N, P>, T: Scalar, const N: usize, const P: usize> {
    geometry: R::Geometry<T>,
    sign_estimate: SVector<T, N>,
    pub estimate: VelocityEstimate<T, N>,
    pub sliding: SlidingSignals<T, N>,
    regressor: Regressor<T, N, P>,
    /// The command u, N·m.
    pub command: SVector<T, N>,
}

impl<R: Robot<N, P>, T: Scalar, const N: usize, const P: usize> Controller<R, T, N, P> {
    /// Whether its estimates move.
    pub(crate) fn adapts(&self) -> bool {
        !matches!(self.adaptation, AnyAdaptation::None)
    }

    /// Number of states.
    pub(super) fn states(&self) -> usize {
        self.theta_hat() + P + self.adaptation.states() + if self.integral.is_some() { N } else { 0 }
    }

    /// Where θ̂ begins among the states.
    #[inline(always)]
    pub(super) fn theta_hat(&self) -> usize {
        self.velocity_source.states()
    }

    /// Writes the states for a start at `position` (rad), moving at `velocity` (rad/s).
    pub(super) fn initialize(
        &self,
        position: &SVector<T, N>,
        velocity: &SVector<T, N>,
        desired: &Desired<T, N>,
        states: &mut [T],
    ) {
        let (source, rest) = states.split_at_mut(self.theta_hat());
        self.velocity_source.initialize(position, desired, source);
        let estimate = self.velocity_source.estimate(position, velocity, desired, &*source);
        let (theta_hat, law) = rest.split_at_mut(P);
        theta_hat.copy_from_slice(self.theta_hat_start.as_slice());
        let (law, integral) = law.split_at_mut(self.adaptation.states());
        self.adaptation.initialize(&R::geometry(position), &estimate.velocity, law);
        integral.fill(T::zero());
    }

    /// The command for a measurement: angles (rad) and, for sources that measure it, velocity (rad/s).
    #[inline(always)]
    pub(super) fn act(
        &self,
        position: &SVector<T, N>,
        velocity: &SVector<T, N>,
        desired: &Desired<T, N>,
        states: &[T],
    ) -> Action<R, T, N, P> {
        let (source, rest) = states.split_at(self.theta_hat());
        let geometry = R::geometry(position);
        let estimate = self.velocity_source.estimate(position, velocity, desired, source);
        let sliding = self.feedback.signals(position, &estimate.velocity, desired);
        let ([sign_reference, sign_estimate], []) =
            self.friction_sign.of_each([&sliding.reference_velocity, &estimate.velocity], [], &[]);
        let regressor = R::regressor(
            &geometry,
            &sliding.coriolis_velocity,
            &sliding.reference_velocity,
            &sliding.reference_acceleration,
            &sign_reference,
        );
        let model = model_torque::<R, T, N, P>(&regressor, &rest[..P]) * self.model_sign;
        let mut command = self.feedback.torque(&sliding, &model);
        if let Some(gain) = &self.integral {
            let integral = SVector::from_column_slice(&rest[P + self.adaptation.states()..]);
            command -= gain.component_mul(&integral);
        }
        Action { geometry, sign_estimate, estimate, sliding, regressor, command }
    }

    /// Lets a law that remembers moments look at this one.
    pub(super) fn record(&self, action: &Action<R, T, N, P>, states: &mut [T]) {
        if let AnyAdaptation::Concurrent(law) = &self.adaptation {
            let law_at = self.theta_hat() + P;
            law.record(&action.geometry, &action.estimate.velocity, &mut states[law_at..]);
        }
    }

    /// The states' derivative at the instant of an action.
    #[inline(always)]
    pub(super) fn derivative(&self, action: &Action<R, T, N, P>, states: &[T], rate: &mut [T]) {
        let theta_hat_at = self.theta_hat();
        let (source_rate, rest_rate) = rate.split_at_mut(theta_hat_at);
        self.velocity_source.derivative(&action.estimate, source_rate);
        let (theta_hat, law) = states[theta_hat_at..].split_at(P);
        let s = &action.sliding.sliding_variable;
        let gradient = match &self.modification {
            Some(modification) => modification.gradient::<R, N, P>(&action.regressor, s, theta_hat),
            None => gradient::<R, T, N, P>(&action.regressor, s),
        };
        let input = AdaptationInput::<R, T, N, P> {
            geometry: &action.geometry,
            velocity: &action.estimate.velocity,
            sign_velocity: &action.sign_estimate,
            torque: &action.command,
            gradient: &gradient,
            theta_hat,
        };
        let (theta_hat_rate, law_rate) = rest_rate.split_at_mut(P);
        let (law_rate, integral_rate) = law_rate.split_at_mut(self.adaptation.states());
        self.adaptation.derivative(None, &input, &law[..law_rate.len()], theta_hat_rate, law_rate);
        for rate in theta_hat_rate {
            *rate *= self.adaptation_sign;
        }
        integral_rate.copy_from_slice(&action.sliding.error.as_slice()[..integral_rate.len()]);
    }
}
