//! Advancing a run: steps, samples at their exact times, divergence, pause and resume.

use super::recorder::Recorder;
use super::{Divergence, Method, Outcome, Settings, Snapshot, SnapshotError, StateSpace, TRACKING_ERROR_LIMIT_RAD};
use crate::integrators::{Dopri5, Rk4};
use crate::recording::Recording;

/// The integrator of a run, with its work space.
enum Stepper {
    /// Every sample falls on the start of a step: `every` steps from one to the next.
    Rk4OnGrid { rk4: Rk4<f64>, every: u64 },
    /// Samples fall inside steps: the state before the step and the slopes at its ends serve to interpolate.
    Rk4 { rk4: Rk4<f64>, before: Vec<f64>, slopes: [Vec<f64>; 2] },
    /// The integrator interpolates.
    Dopri5(Box<Dopri5>),
}

/// A run under way.
pub struct Simulation {
    identity: String,
    system: Box<dyn StateSpace<f64>>,
    settings: Settings,
    stepper: Stepper,
    state: Vec<f64>,
    /// Work space for the tracking error.
    error: Vec<f64>,
    step: u64,
    time_s: f64,
    evaluations: u64,
    recorder: Recorder,
    outcome: Option<Outcome>,
}

impl Simulation {
    /// A run at its start. `identity` names what is simulated in snapshots.
    pub fn new(identity: String, system: Box<dyn StateSpace<f64>>, settings: Settings) -> Self {
        let len = system.len();
        let stepper = match settings.method {
            Method::Rk4 => match settings.steps_per_sample() {
                Some(every) => Stepper::Rk4OnGrid { rk4: Rk4::new(len), every },
                None => Stepper::Rk4 {
                    rk4: Rk4::new(len),
                    before: vec![0.0; len],
                    slopes: [vec![0.0; len], vec![0.0; len]],
                },
            },
            Method::Dopri5(tolerances) => {
                Stepper::Dopri5(Box::new(Dopri5::new(len, tolerances, settings.step_s.min(settings.duration_s))))
            }
        };
        let mut state = vec![0.0; len];
        system.initialize(&mut state);
        Self {
            identity,
            system,
            settings,
            stepper,
            state,
            error: vec![0.0; settings.columns.joints],
            step: 0,
            time_s: 0.0,
            evaluations: 0,
            recorder: Recorder::new(settings, len),
            outcome: None,
        }
    }

    /// A run where `snapshot` left it. Gives the same bits as a run that never paused.
    pub fn resume(
        identity: String,
        system: Box<dyn StateSpace<f64>>,
        settings: Settings,
        snapshot: Snapshot,
    ) -> Result<Self, SnapshotError> {
        if snapshot.identity != identity {
            return Err(SnapshotError::OtherScenario { expected: identity, found: snapshot.identity });
        }
        let mut run = Self::new(identity, system, settings);
        let (len, width) = (run.state.len(), settings.columns.width());
        let shape = |what, expected, found| Err(SnapshotError::Shape { what, expected, found });
        if snapshot.state.len() != len {
            return shape("state", len, snapshot.state.len());
        }
        if !snapshot.rows.len().is_multiple_of(width) || snapshot.rows.len() > width * (settings.samples + 1) {
            return shape("rows", width, snapshot.rows.len());
        }
        run.step = snapshot.step;
        run.time_s = snapshot.time_s;
        run.evaluations = snapshot.evaluations;
        run.state = snapshot.state;
        run.recorder.recording = Recording::from_rows(settings.columns, snapshot.rows);
        run.outcome = snapshot.outcome;
        if let Stepper::Dopri5(dopri5) = &mut run.stepper {
            dopri5.step_s = snapshot.next_step_s;
        }
        Ok(run)
    }

    /// The run as it stands.
    pub fn snapshot(&self) -> Snapshot {
        Snapshot {
            identity: self.identity.clone(),
            step: self.step,
            time_s: self.time_s,
            next_step_s: match &self.stepper {
                Stepper::Rk4OnGrid { .. } | Stepper::Rk4 { .. } => self.settings.step_s,
                Stepper::Dopri5(dopri5) => dopri5.step_s,
            },
            evaluations: self.evaluations,
            state: self.state.clone(),
            rows: self.recorder.recording.rows().to_vec(),
            outcome: self.outcome,
        }
    }

    /// Takes at most `max_steps` steps; true once the run has ended.
    pub fn advance(&mut self, max_steps: u64) -> bool {
        for _ in 0..max_steps {
            if self.outcome.is_some() {
                break;
            }
            self.outcome = match self.take_step() {
                Err(reason) => Some(Outcome::Diverged { at_s: self.time_s, reason }),
                Ok(()) if self.time_s >= self.settings.duration_s => Some(Outcome::Completed),
                Ok(()) => None,
            };
        }
        self.outcome.is_some()
    }

    /// How it ended; `None` while it is under way.
    pub fn outcome(&self) -> Option<Outcome> {
        self.outcome
    }

    /// Share of the duration simulated, 0 to 1.
    pub fn progress(&self) -> f64 {
        if self.outcome.is_some() { 1.0 } else { self.time_s / self.settings.duration_s }
    }

    /// Time reached, s.
    pub fn time_s(&self) -> f64 {
        self.time_s
    }

    /// Steps taken.
    pub fn steps(&self) -> u64 {
        self.step
    }

    /// Evaluations of the right-hand side so far.
    pub fn evaluations(&self) -> u64 {
        self.evaluations
    }

    /// State vector; joint angles (rad) come first.
    pub fn state(&self) -> &[f64] {
        &self.state
    }

    /// Estimates θ̂ now.
    pub fn theta_hat(&self) -> &[f64] {
        self.system.theta_hat(&self.state)
    }

    /// What has been recorded.
    pub fn recording(&self) -> &Recording {
        &self.recorder.recording
    }

    /// Gives the recording away.
    pub fn into_recording(self) -> Recording {
        self.recorder.recording
    }

    /// One step, its samples, and the check that it led somewhere sensible.
    fn take_step(&mut self) -> Result<(), Divergence> {
        let (start_s, duration_s) = (self.time_s, self.settings.duration_s);
        if self.step >= self.settings.most_steps() {
            return Err(Divergence::TooManySteps(self.step));
        }
        let Self { system, stepper, state, recorder, evaluations, .. } = self;
        let system = &**system;
        let rhs = |t: f64, x: &[f64], rate: &mut [f64]| system.derivative(t, x, rate);
        let end_s = match stepper {
            Stepper::Rk4OnGrid { rk4, every } => {
                let end_s = self.settings.step_time_s(self.step + 1);
                if self.step.is_multiple_of(*every) {
                    recorder.record(system, start_s, state)?;
                }
                rk4.step(start_s, end_s, state, rhs);
                *evaluations += 4;
                end_s
            }
            Stepper::Rk4 { rk4, before, slopes } => {
                let end_s = self.settings.step_time_s(self.step + 1);
                before.copy_from_slice(state);
                rk4.step(start_s, end_s, state, rhs);
                *evaluations += 4;
                if recorder.is_due_before(end_s) {
                    rhs(start_s, before, &mut slopes[0]);
                    rhs(end_s, state, &mut slopes[1]);
                    *evaluations += 2;
                    recorder.record_before(system, end_s, |t, x| {
                        hermite((t - start_s) / (end_s - start_s), end_s - start_s, [before, state], slopes, x);
                    })?;
                }
                end_s
            }
            Stepper::Dopri5(dopri5) => {
                let counted = |t: f64, x: &[f64], rate: &mut [f64]| {
                    *evaluations += 1;
                    rhs(t, x, rate);
                };
                let reached = dopri5.step(start_s, duration_s, state, counted);
                let end_s = reached.map_err(|_| Divergence::StepTooSmall)?;
                recorder.record_before(system, end_s, |t, x| dopri5.interpolate(t, state, x))?;
                end_s
            }
        };
        self.step += 1;
        self.time_s = end_s;
        check(system, end_s, state, &mut self.error)?;
        if end_s >= duration_s {
            if !state.iter().all(|x| x.is_finite()) {
                return Err(Divergence::NotFinite);
            }
            recorder.record(system, end_s, state)?;
        }
        Ok(())
    }
}

/// Whether the run is still near its trajectory. A NaN anywhere reaches the joint angles within a step, so they are enough.
fn check(system: &dyn StateSpace<f64>, time_s: f64, x: &[f64], error: &mut [f64]) -> Result<(), Divergence> {
    system.tracking_error(time_s, x, error);
    for (joint, e) in error.iter().enumerate() {
        if !e.is_finite() {
            return Err(Divergence::NotFinite);
        }
        if e.abs() > TRACKING_ERROR_LIMIT_RAD {
            return Err(Divergence::TrackingError(joint + 1));
        }
    }
    Ok(())
}

/// Cubic Hermite interpolation at the fraction `s` of a step of length `h`, between its ends.
fn hermite(s: f64, h: f64, ends: [&[f64]; 2], slopes: &[Vec<f64>; 2], out: &mut [f64]) {
    let r = 1.0 - s;
    for (n, out) in out.iter_mut().enumerate() {
        let (x0, x1) = (ends[0][n], ends[1][n]);
        let difference = x1 - x0;
        let bend = h * slopes[0][n] - difference;
        let twist = difference - h * slopes[1][n];
        *out = x0 + s * (difference + r * (r * bend + s * twist));
    }
}
