//! The closed loop of an arm with imperfections and any controller: two sides, and what crosses between them.
//!
//! State vector: q, q̇ | the controller's | what is held | the motors' angles and velocities, if joints are elastic. Held are, from sample
//! to sample, the torque command at the actuator, the one on its way, and the z and s of the last sample; from step to step, the
//! payload's mass and whether the disturbance acts.
//! All of it is in the state, so a paused run needs nothing else. `docs/decisions/0016-imperfect-loop.md` tells why this is not
//! [`super::ClosedLoop`], which computes the same bits where there is no imperfection.

use super::controller::{Action, Controller};
use super::{InitialVelocity, StateSpace};
use crate::dynamics::{Plant, solve_symmetric};
use crate::effects::{Actuator, Elasticity, EncoderSide, Load, SampledControl, Sensing};
use crate::recording::write_row;
use crate::robots::Robot;
use crate::trajectories::{Desired, Remembered};
use nalgebra::SVector;
use std::cell::RefCell;

/// An arm with imperfections under control.
pub struct ImperfectLoop<R, const N: usize, const P: usize> {
    /// The arm as it is without load.
    pub plant: Plant<R, f64, N, P>,
    /// Where it should go.
    pub trajectory: Remembered<f64, N>,
    /// How the run starts.
    pub initial_velocity: InitialVelocity,
    /// The other side of the boundary.
    pub controller: Controller<R, f64, N, P>,
    /// The controller's clock and period (s); `None` where it works continuously.
    pub sampling: Option<(SampledControl, f64)>,
    /// What samples show; without a clock, the truth.
    pub sensing: Sensing,
    /// Limits of the torque.
    pub actuator: Option<Actuator<f64, N>>,
    /// What else acts on the arm.
    pub load: Load<N, P>,
    /// Springs between motors and links.
    pub elasticity: Option<Elasticity<N>>,
    /// Steps between the moments that a law which remembers some looks at; `None` for other laws.
    pub record_steps: Option<u64>,
    /// Work space: the controller's derivative at a sample.
    pub work: RefCell<Vec<f64>>,
}

/// Where the parts of the state vector begin.
#[derive(Clone, Copy)]
struct Layout {
    controller: usize,
    /// Command at the actuator, command on its way, z, s.
    held: usize,
    mass: usize,
    disturbed: usize,
    /// Angles and velocities of the motors, if joints are elastic.
    motors: usize,
    len: usize,
}

impl<R: Robot<N, P>, const N: usize, const P: usize> ImperfectLoop<R, N, P> {
    #[inline(always)]
    fn layout(&self) -> Layout {
        let controller = 2 * N;
        let held = controller + self.controller.states();
        let mass = held + 4 * N;
        let motors = mass + 2;
        let len = if self.elasticity.is_some() { motors + 2 * N } else { motors };
        Layout { controller, held, mass, disturbed: mass + 1, motors, len }
    }

    #[inline(always)]
    fn act(&self, desired: &Desired<f64, N>, x: &[f64]) -> Action<R, f64, N, P> {
        let layout = self.layout();
        let (position, velocity) = self.seen(x);
        self.controller.act(&position, &velocity, desired, &x[layout.controller..layout.held])
    }

    /// Angles and velocities on the sensors' side of the springs.
    #[inline(always)]
    fn seen(&self, x: &[f64]) -> (SVector<f64, N>, SVector<f64, N>) {
        let at = match &self.elasticity {
            Some(elasticity) if elasticity.encoders == EncoderSide::Motor => self.layout().motors,
            _ => 0,
        };
        (vector(&x[at..]), vector(&x[at + N..]))
    }

    /// What the actuators give for a command.
    #[inline(always)]
    fn actuate(&self, command: &SVector<f64, N>) -> SVector<f64, N> {
        self.actuator.as_ref().map_or(*command, |actuator| actuator.torque(command))
    }

    /// The motion's derivative under a command.
    fn write_motion(&self, time_s: f64, x: &[f64], command: &SVector<f64, N>, rate: &mut [f64]) {
        let layout = self.layout();
        let velocity = vector::<N>(&x[N..]);
        let sign = self.plant.friction_sign.of(&velocity);
        let (disturbed, actuators) = (x[layout.disturbed] != 0.0, self.actuate(command));
        let theta = self.load.theta(&self.plant.theta, x[layout.mass]);
        let geometry = R::geometry(&vector(x));
        let acceleration = if let Some(elasticity) = &self.elasticity {
            let (motor, motor_velocity) = (vector(&x[layout.motors..]), vector(&x[layout.motors + N..]));
            let springs = elasticity.torque([&motor, &motor_velocity], [&vector(x), &velocity]);
            let motors = &mut rate[layout.motors..layout.len];
            motors[..N].copy_from_slice(motor_velocity.as_slice());
            motors[N..].copy_from_slice(elasticity.motor_acceleration(&actuators, &springs).as_slice());
            let torque = self.load.torque(time_s, disturbed, &springs, &velocity, &sign);
            let (inertia, bias) = R::inertia_and_bias(&geometry, &theta, &velocity, &sign);
            solve_symmetric(&elasticity.link_inertia(inertia), torque - bias)
        } else {
            let torque = self.load.torque(time_s, disturbed, &actuators, &velocity, &sign);
            let arm = Plant::<R, f64, N, P>::new(theta, self.plant.friction_sign);
            arm.acceleration(&geometry, &velocity, &sign, &torque)
        };
        rate[..N].copy_from_slice(velocity.as_slice());
        rate[N..2 * N].copy_from_slice(acceleration.as_slice());
    }

    fn write_rate(&self, time_s: f64, x: &[f64], action: Option<&Action<R, f64, N, P>>, rate: &mut [f64]) {
        let layout = self.layout();
        if let Some(action) = action {
            self.write_motion(time_s, x, &action.command, rate);
            let range = layout.controller..layout.held;
            self.controller.derivative(action, &x[range.clone()], &mut rate[range]);
        } else {
            self.write_motion(time_s, x, &vector(&x[layout.held..]), rate);
            rate[layout.controller..layout.held].fill(0.0);
        }
        rate[layout.held..layout.motors].fill(0.0);
    }

    fn write_row(&self, desired: &Desired<f64, N>, x: &[f64], action: Option<&Action<R, f64, N, P>>, row: &mut [f64]) {
        let layout = self.layout();
        let held = |n: usize| vector::<N>(&x[layout.held + n * N..]);
        let (command, z, s) = match action {
            Some(action) => (action.command, action.estimate.observer_error, action.sliding.sliding_variable),
            None => (held(0), held(2), held(3)),
        };
        let position = vector::<N>(x);
        let blocks =
            [position - desired.position, vector::<N>(&x[N..]) - desired.velocity, z, self.actuate(&command), position];
        write_row(row, &blocks, self.theta_hat(x), &s);
    }

    /// Measures, computes a command, and takes the controller's states one period on.
    fn sample(&self, number: u64, time_s: f64, (delayed, records): (bool, bool), period_s: f64, x: &mut [f64]) {
        let layout = self.layout();
        let desired = self.trajectory.at(time_s);
        let (position, velocity) = self.seen(x);
        let (position, velocity) = self.sensing.measure(number, &position, &velocity);
        let (before, held) = x.split_at_mut(layout.held);
        let states = &mut before[layout.controller..];
        let action = self.controller.act(&position, &velocity, &desired, states);
        if records {
            self.controller.record(&action, states);
        }
        let mut rate = self.work.borrow_mut();
        rate.resize(states.len(), 0.0);
        self.controller.derivative(&action, states, &mut rate);
        for (state, rate) in states.iter_mut().zip(rate.iter()) {
            *state += period_s * rate;
        }
        let at = if delayed { N } else { 0 };
        held[at..at + N].copy_from_slice(action.command.as_slice());
        held[2 * N..3 * N].copy_from_slice(action.estimate.observer_error.as_slice());
        held[3 * N..4 * N].copy_from_slice(action.sliding.sliding_variable.as_slice());
    }

    fn continuous(&self, desired: &Desired<f64, N>, x: &[f64]) -> Option<Action<R, f64, N, P>> {
        if self.sampling.is_some() { None } else { Some(self.act(desired, x)) }
    }
}

#[inline(always)]
fn vector<const N: usize>(x: &[f64]) -> SVector<f64, N> {
    SVector::from_column_slice(&x[..N])
}

impl<R: Robot<N, P>, const N: usize, const P: usize> StateSpace<f64> for ImperfectLoop<R, N, P> {
    fn len(&self) -> usize {
        self.layout().len
    }

    fn initialize(&self, x: &mut [f64]) {
        let layout = self.layout();
        let desired = self.trajectory.at(0.0);
        x.fill(0.0);
        x[..N].copy_from_slice(desired.position.as_slice());
        if self.initial_velocity == InitialVelocity::Desired {
            x[N..2 * N].copy_from_slice(desired.velocity.as_slice());
        }
        let velocity = vector::<N>(&x[N..]);
        let states = &mut x[layout.controller..layout.held];
        self.controller.initialize(&desired.position, &velocity, &desired, states);
        if self.elasticity.is_some() {
            // Springs without torque, motors as fast as their links.
            x.copy_within(..2 * N, layout.motors);
        }
    }

    fn derivative(&self, time_s: f64, x: &[f64], rate: &mut [f64]) {
        let action = self.continuous(&self.trajectory.at(time_s), x);
        self.write_rate(time_s, x, action.as_ref(), rate);
    }

    fn observe(&self, time_s: f64, x: &[f64], row: &mut [f64]) {
        let desired = self.trajectory.at(time_s);
        self.write_row(&desired, x, self.continuous(&desired, x).as_ref(), row);
    }

    fn observe_and_derive(&self, time_s: f64, x: &[f64], row: &mut [f64], rate: &mut [f64]) {
        let desired = self.trajectory.at(time_s);
        let action = self.continuous(&desired, x);
        self.write_row(&desired, x, action.as_ref(), row);
        self.write_rate(time_s, x, action.as_ref(), rate);
    }

    fn tracking_error(&self, time_s: f64, x: &[f64], error: &mut [f64]) {
        let desired = self.trajectory.at(time_s);
        error.copy_from_slice((vector::<N>(x) - desired.position).as_slice());
    }

    fn theta_hat<'a>(&self, x: &'a [f64]) -> &'a [f64] {
        let start = self.layout().controller + self.controller.theta_hat();
        &x[start..start + P]
    }

    fn begin_step(&self, step: u64, time_s: f64, x: &mut [f64]) {
        let layout = self.layout();
        x[layout.mass] = self.load.mass_kg(time_s);
        x[layout.disturbed] = f64::from(u8::from(self.load.is_disturbed(time_s)));
        let records = self.record_steps.is_some_and(|steps| step.is_multiple_of(steps));
        let Some((clock, period_s)) = self.sampling else {
            if records {
                let action = self.act(&self.trajectory.at(time_s), x);
                self.controller.record(&action, &mut x[layout.controller..layout.held]);
            }
            return;
        };
        let tick = clock.tick(step);
        if tick.arrives {
            x.copy_within(layout.held + N..layout.held + 2 * N, layout.held);
        }
        if let Some(number) = tick.sample {
            self.sample(number, time_s, (clock.delay_steps > 0, records), period_s, x);
        }
    }

    fn has_events(&self) -> bool {
        let loads = !self.load.payloads.is_empty() || self.load.disturbance.is_some();
        loads || self.sampling.is_some() || self.record_steps.is_some()
    }
}
