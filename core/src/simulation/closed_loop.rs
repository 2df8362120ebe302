//! The closed loop: one robot, one trajectory, and a scheme put together from its three choices.
//!
//! State vector: q, q̇, the velocity source's states, θ̂, filled up to a whole vector, the adaptation law's states. All that depends on q alone is
//! computed once per evaluation and shared by plant, controller and filter.

use super::{StateSpace, evaluates_stages};
use crate::adaptation::{AdaptationInput, AdaptationLaw};
use crate::control::{SlidingFeedback, SlidingSignals};
use crate::dynamics::Plant;
use crate::recording::write_row;
use crate::regressor::{gradient, model_torque};
use crate::robots::{Regressor, Robot};
use crate::scalar::{Kernel, Pack, Scalar};
use crate::states::{Stage, States};
use crate::trajectories::{Desired, Remembered};
use crate::velocity::{VelocityEstimate, VelocitySource};
use nalgebra::SVector;

/// How a run starts. Chosen: the paper only says where (docs/physics.md section 2).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum InitialVelocity {
    /// `q̇(0) = q̇_d(0)`.
    Desired,
    /// `q̇(0) = 0`.
    Rest,
}

/// A robot under adaptive control; `V` the velocity source, `A` the adaptation law. It begins where a page does, so that where its numbers lie
/// relative to the integrator's arrays is not left to chance ([`crate::integrators::Aligned`]).
#[derive(Debug, Clone)]
#[repr(align(4096))]
pub struct ClosedLoop<R, V, A, T: Scalar, const N: usize, const P: usize> {
    /// The arm.
    pub plant: Plant<R, T, N, P>,
    /// Where it should go.
    pub trajectory: Remembered<T, N>,
    /// First choice: where the velocity comes from.
    pub velocity_source: V,
    /// Second choice: how torque follows from errors.
    pub feedback: SlidingFeedback<T, N>,
    /// Third choice: how estimates move.
    pub adaptation: A,
    /// How the run starts.
    pub initial_velocity: InitialVelocity,
}

/// Everything between the state and the torque at one instant.
struct Evaluation<R: Robot<N, P>, B, H, T: Scalar, const N: usize, const P: usize> {
    geometry: R::Geometry<T>,
    velocity: SVector<T, N>,
    sign_velocity: SVector<T, N>,
    /// `sgn(v*)`; only filled in for laws that filter.
    sign_estimate: SVector<T, N>,
    estimate: VelocityEstimate<T, N>,
    sliding: SlidingSignals<T, N>,
    regressor: Regressor<T, N, P>,
    theta_hat: H,
    torque: SVector<T, N>,
    /// What the adaptation law has begun, where it did on the way.
    begun: Option<B>,
}

/// Where the parts of the state vector begin.
#[derive(Clone, Copy)]
struct Layout {
    velocity_source: usize,
    theta_hat: usize,
    /// End of θ̂.
    theta_end: usize,
    /// Start of the law's states: a multiple of a vector's length, so that the law's vectors never lie across two cache lines; what is skipped stays zero.
    adaptation: usize,
    len: usize,
}

impl<R, V, A, T, const N: usize, const P: usize> ClosedLoop<R, V, A, T, N, P>
where
    R: Robot<N, P>,
    V: VelocitySource<T, N>,
    A: AdaptationLaw<R, T, N, P>,
    T: Scalar,
{
    /// Whether the adaptation law begins while torques are computed: where four neighbours are worked on together. Lanes keep the
    /// processor busy anyway, and browsers order instructions themselves (docs/decisions/0021-neighbours.md).
    const BEGINS_EARLY: bool = A::FILTERS && <T::Pack as Pack<T>>::WIDTH > 1 && !cfg!(target_arch = "wasm32");

    #[inline(always)]
    fn layout(&self) -> Layout {
        let velocity_source = 2 * N;
        let theta_hat = velocity_source + self.velocity_source.states();
        let theta_end = theta_hat + P;
        let adaptation = theta_end.next_multiple_of(<T::Pack as Pack<T>>::WIDTH);
        Layout { velocity_source, theta_hat, theta_end, adaptation, len: adaptation + self.adaptation.states() }
    }

    /// `law_rate` takes what the adaptation law can write on the way; the rest is for [`Self::write_rate`].
    #[inline(always)]
    fn evaluate<X: States<T>>(
        &self,
        desired: &Desired<T, N>,
        x: X,
        law_rate: Option<&mut [T]>,
    ) -> Evaluation<R, A::Begun, X::InMemory<P>, T, N, P> {
        if T::IS_PLAIN { self.evaluate_apart(desired, x, law_rate) } else { self.evaluate_within(desired, x, law_rate) }
    }

    /// A function of its own: the compiler then knows that its arguments do not overlap, and works on numbers in pairs.
    #[inline(never)]
    fn evaluate_apart<X: States<T>>(
        &self,
        desired: &Desired<T, N>,
        x: X,
        law_rate: Option<&mut [T]>,
    ) -> Evaluation<R, A::Begun, X::InMemory<P>, T, N, P> {
        self.evaluate_within(desired, x, law_rate)
    }

    #[inline(always)]
    fn evaluate_within<X: States<T>>(
        &self,
        desired: &Desired<T, N>,
        x: X,
        law_rate: Option<&mut [T]>,
    ) -> Evaluation<R, A::Begun, X::InMemory<P>, T, N, P> {
        let layout = self.layout();
        let (position, velocity) = (x.vector::<N>(), x.after(N).vector::<N>());
        let source_states = x.after(layout.velocity_source);
        let estimate = self.velocity_source.estimate(&position, &velocity, desired, source_states);
        let sliding = self.feedback.signals(&position, &estimate.velocity, desired);
        // Tangents and sines together, because the processor works on all at once.
        let (friction_sign, angles) = (&self.plant.friction_sign, position.into());
        let ([sign_reference, sign_velocity, sign_estimate], sines) = if A::FILTERS && !V::MEASURED {
            let velocities = [&sliding.reference_velocity, &velocity, &estimate.velocity];
            friction_sign.of_each(velocities, angles, &R::TURNS)
        } else {
            let velocities = [&sliding.reference_velocity, &velocity];
            let ([reference, velocity], sines) = friction_sign.of_each(velocities, angles, &R::TURNS);
            ([reference, velocity, velocity], sines)
        };
        let geometry = R::geometry_of(&sines);
        let regressor = R::regressor(
            &geometry,
            &sliding.coriolis_velocity,
            &sliding.reference_velocity,
            &sliding.reference_acceleration,
            &sign_reference,
        );
        // Here, because the model torque waits for the regressor, and the acceleration for the torque.
        let begun = if Self::BEGINS_EARLY {
            let law = x.after(layout.adaptation);
            Some(self.adaptation.begin(&geometry, &estimate.velocity, &sign_estimate, law, law_rate))
        } else {
            None
        };
        let theta_hat = x.after(layout.theta_hat).in_memory::<P>();
        let model = model_torque::<R, T, N, P>(&regressor, theta_hat.as_ref());
        let torque = self.feedback.torque(&sliding, &model);
        Evaluation {
            geometry,
            velocity,
            sign_velocity,
            sign_estimate,
            estimate,
            sliding,
            regressor,
            theta_hat,
            torque,
            begun,
        }
    }

    /// The derivative of the state.
    #[inline(always)]
    fn write_rate<X: States<T>>(&self, now: &Evaluation<R, A::Begun, X::InMemory<P>, T, N, P>, x: X, rate: &mut [T]) {
        let layout = self.layout();
        let (x, rate) = (x.first(layout.len), &mut rate[..layout.len]);
        let acceleration = self.plant.acceleration(&now.geometry, &now.velocity, &now.sign_velocity, &now.torque);
        rate[..N].copy_from_slice(now.velocity.as_slice());
        rate[N..2 * N].copy_from_slice(acceleration.as_slice());
        self.velocity_source.derivative(&now.estimate, &mut rate[layout.velocity_source..layout.theta_hat]);

        let input = AdaptationInput::<R, T, N, P> {
            geometry: &now.geometry,
            velocity: &now.estimate.velocity,
            sign_velocity: &now.sign_estimate,
            torque: &now.torque,
            gradient: &gradient::<R, T, N, P>(&now.regressor, &now.sliding.sliding_variable),
            theta_hat: now.theta_hat.as_ref(),
        };
        let (before_law, law_rate) = rate.split_at_mut(layout.adaptation);
        let theta_hat_rate = &mut before_law[layout.theta_hat..layout.theta_end];
        let law = x.after(layout.adaptation);
        let begun = if Self::BEGINS_EARLY { now.begun } else { None };
        self.adaptation.derivative(begun, &input, law, theta_hat_rate, law_rate);
    }

    /// A row of a recording.
    #[inline(always)]
    fn write_row<X: States<T>>(
        now: &Evaluation<R, A::Begun, X::InMemory<P>, T, N, P>,
        desired: &Desired<T, N>,
        x: X,
        row: &mut [T],
    ) {
        let blocks =
            [now.sliding.error, now.velocity - desired.velocity, now.estimate.observer_error, now.torque, x.vector()];
        write_row(row, &blocks, now.theta_hat.as_ref(), &now.sliding.sliding_variable);
    }
}

impl<R, V, A, T, const N: usize, const P: usize> StateSpace<T> for ClosedLoop<R, V, A, T, N, P>
where
    R: Robot<N, P>,
    V: VelocitySource<T, N>,
    A: AdaptationLaw<R, T, N, P>,
    T: Scalar,
{
    fn len(&self) -> usize {
        self.layout().len
    }

    fn plain_len(&self) -> usize {
        self.layout().theta_end + self.adaptation.plain_states()
    }

    fn write_plain(&self, x: &[T], plain: &mut [T]) {
        let Layout { theta_end, adaptation, .. } = self.layout();
        plain[..theta_end].copy_from_slice(&x[..theta_end]);
        self.adaptation.write_plain(&x[adaptation..], &mut plain[theta_end..]);
    }

    fn read_plain(&self, plain: &[T], x: &mut [T]) {
        let Layout { theta_end, adaptation, .. } = self.layout();
        x[..theta_end].copy_from_slice(&plain[..theta_end]);
        self.adaptation.read_plain(&plain[theta_end..], &mut x[adaptation..]);
    }

    fn initialize(&self, x: &mut [T]) {
        let layout = self.layout();
        let desired = self.trajectory.at(0.0);
        let (before_law, law) = x.split_at_mut(layout.adaptation);
        let (motion, rest) = before_law.split_at_mut(2 * N);
        motion[..N].copy_from_slice(desired.position.as_slice());
        match self.initial_velocity {
            InitialVelocity::Desired => motion[N..].copy_from_slice(desired.velocity.as_slice()),
            InitialVelocity::Rest => motion[N..].fill(T::zero()),
        }
        let velocity = SVector::<T, N>::from_column_slice(&motion[N..]);
        let (source, theta_hat) = rest.split_at_mut(layout.theta_hat - layout.velocity_source);
        self.velocity_source.initialize(&desired.position, &desired, source);
        let estimate = self.velocity_source.estimate(&desired.position, &velocity, &desired, &*source);
        theta_hat.fill(T::zero());
        self.adaptation.initialize(&R::geometry(&desired.position), &estimate.velocity, law);
    }

    fn foresee(&self, times_s: &[f64]) {
        T::compiled(Foresee { trajectory: &self.trajectory, times_s });
    }

    fn derivative(&self, time_s: f64, x: &[T], rate: &mut [T]) {
        T::compiled(At { system: self, time_s, x: &x, want: Want::Rate(rate) });
    }

    fn derivative_at(&self, time_s: f64, stage: &Stage<'_, T>, rate: &mut [T]) {
        // A second copy of the computation, for those only that ask for it.
        if evaluates_stages::<T>() {
            T::compiled(At { system: self, time_s, x: stage, want: Want::Rate(rate) });
        } else {
            self.derivative(time_s, &stage.to_vec(), rate);
        }
    }

    fn observe(&self, time_s: f64, x: &[T], row: &mut [T]) {
        T::compiled(At { system: self, time_s, x: &x, want: Want::Row(row) });
    }

    fn observe_and_derive(&self, time_s: f64, x: &[T], row: &mut [T], rate: &mut [T]) {
        T::compiled(At { system: self, time_s, x: &x, want: Want::Both(row, rate) });
    }

    fn tracking_error(&self, time_s: f64, x: &[T], error: &mut [T]) {
        T::compiled(At { system: self, time_s, x: &x, want: Want::Error(error) });
    }

    fn theta_hat<'a>(&self, x: &'a [T]) -> &'a [T] {
        let layout = self.layout();
        &x[layout.theta_hat..layout.theta_end]
    }
}

/// [`Remembered::foresee`], compiled for each kind of scalar.
struct Foresee<'a, T: Scalar, const N: usize> {
    trajectory: &'a Remembered<T, N>,
    times_s: &'a [f64],
}

impl<T: Scalar, const N: usize> Kernel for Foresee<'_, T, N> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        self.trajectory.foresee(self.times_s);
    }
}

/// What is wanted of a closed loop in one state.
enum Want<'a, T> {
    Rate(&'a mut [T]),
    Row(&'a mut [T]),
    Both(&'a mut [T], &'a mut [T]),
    Error(&'a mut [T]),
}

/// A closed loop in one state: the computation that is compiled for each kind of scalar. It refers to the state, because
/// a copy of a stage reads 16 bytes at a time what was just written 8 bytes at a time, and then waits until all earlier writes are done.
struct At<'a, S, X, T> {
    system: &'a S,
    time_s: f64,
    x: &'a X,
    want: Want<'a, T>,
}

impl<R, V, A, X, T, const N: usize, const P: usize> Kernel for At<'_, ClosedLoop<R, V, A, T, N, P>, X, T>
where
    X: States<T>,
    R: Robot<N, P>,
    V: VelocitySource<T, N>,
    A: AdaptationLaw<R, T, N, P>,
    T: Scalar,
{
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Self { system, time_s, mut want, .. } = self;
        // One check here removes those of every part.
        let x = self.x.first(system.layout().len);
        let desired = system.trajectory.at(time_s);
        if let Want::Error(error) = want {
            for joint in 0..N {
                error[joint] = x.at(joint) - desired.position[joint];
            }
            return;
        }
        let Layout { adaptation, len, .. } = system.layout();
        let law_rate = if ClosedLoop::<R, V, A, T, N, P>::BEGINS_EARLY {
            match &mut want {
                Want::Rate(rate) | Want::Both(_, rate) => Some(&mut rate[adaptation..len]),
                Want::Row(_) | Want::Error(_) => None,
            }
        } else {
            None
        };
        let now = system.evaluate(&desired, x, law_rate);
        let (row, rate) = match want {
            Want::Rate(rate) => (None, Some(rate)),
            Want::Row(row) => (Some(row), None),
            Want::Both(row, rate) => (Some(row), Some(rate)),
            Want::Error(_) => (None, None),
        };
        if let Some(row) = row {
            ClosedLoop::<R, V, A, T, N, P>::write_row(&now, &desired, x, row);
        }
        if let Some(rate) = rate {
            system.write_rate(&now, x, rate);
        }
    }
}
