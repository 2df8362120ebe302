//! Advancing a run: steps, samples at their exact times, divergence, pause and resume.

use super::recorder::Recorder;
use super::{
    Divergence, Method, Outcome, Settings, Snapshot, SnapshotError, StateSpace, StepTimes, TRACKING_ERROR_LIMIT_RAD,
};
use crate::integrators::{Aligned, Dopri5, Rk4};
use crate::recording::Recording;
use crate::scalar::are_finite;

/// The integrator of a run, with its work space.
enum Stepper {
    /// Every sample falls on the start of a step: `every` steps from one to the next. What is computed for a sample is the
    /// step's first slope too.
    Rk4OnGrid { rk4: Rk4<f64>, every: u64 },
    /// Samples fall inside steps: the slopes at the ends of a step serve to interpolate.
    Rk4 { rk4: Rk4<f64>, slopes: [Vec<f64>; 2] },
    /// The integrator interpolates; `before` is the state before the last step.
    Dopri5 { dopri5: Box<Dopri5>, before: Vec<f64> },
}

impl Stepper {
    /// State before the last step; where a run that diverges ends up.
    fn before(&self) -> &[f64] {
        match self {
            Self::Rk4OnGrid { rk4, .. } | Self::Rk4 { rk4, .. } => rk4.before(),
            Self::Dopri5 { before, .. } => before,
        }
    }

    /// Where it is kept.
    fn before_mut(&mut self) -> &mut [f64] {
        match self {
            Self::Rk4OnGrid { rk4, .. } | Self::Rk4 { rk4, .. } => rk4.before_mut(),
            Self::Dopri5 { before, .. } => before,
        }
    }
}

/// A run under way.
pub struct Simulation {
    identity: String,
    system: Box<dyn StateSpace<f64>>,
    settings: Settings,
    step_times: StepTimes,
    most_steps: u64,
    stepper: Stepper,
    state: Aligned<f64>,
    /// Work space for the tracking error.
    error: Vec<f64>,
    step: u64,
    /// See [`StepTimes::foresee`].
    foreseen: u64,
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
                None => Stepper::Rk4 { rk4: Rk4::new(len), slopes: [vec![0.0; len], vec![0.0; len]] },
            },
            Method::Dopri5(tolerances) => {
                let dopri5 = Dopri5::new(len, tolerances, settings.step_s.min(settings.duration_s));
                Stepper::Dopri5 { dopri5: Box::new(dopri5), before: vec![0.0; len] }
            }
        };
        let mut state = Aligned::repeat(0.0, len);
        system.initialize(&mut state);
        Self {
            identity,
            system,
            settings,
            step_times: settings.step_times(),
            most_steps: settings.most_steps(),
            stepper,
            state,
            error: vec![0.0; settings.columns.joints],
            step: 0,
            foreseen: 0,
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
        run.examine(&snapshot)?;
        run.step = snapshot.step;
        run.time_s = snapshot.time_s;
        run.evaluations = snapshot.evaluations;
        run.system.read_plain(&snapshot.state, &mut run.state);
        let (expected, found) = (settings.columns.width(), snapshot.rows.len());
        run.recorder.recording = Recording::from_rows(settings.columns, snapshot.rows).ok_or(SnapshotError::Shape {
            what: "rows",
            expected,
            found,
        })?;
        run.outcome = snapshot.outcome;
        if let Stepper::Dopri5 { dopri5, .. } = &mut run.stepper {
            dopri5.set_step(snapshot.next_step_s);
        }
        Ok(run)
    }

    /// Whether a snapshot can have come from this run: shapes, finite numbers, and a time, step and number of rows that belong
    /// together. A damaged one would end as `completed` with wrong numbers, or never.
    fn examine(&self, snapshot: &Snapshot) -> Result<(), SnapshotError> {
        let shape = |what, expected, found| Err(SnapshotError::Shape { what, expected, found });
        let inconsistent = |what| Err(SnapshotError::Inconsistent(what));
        let (settings, width) = (&self.settings, self.settings.columns.width());
        if snapshot.format != Snapshot::FORMAT || snapshot.core_version != crate::VERSION {
            let found = format!("{} of core {}", snapshot.format, snapshot.core_version);
            return Err(SnapshotError::OtherVersion { found });
        }
        if snapshot.state.len() != self.system.plain_len() {
            return shape("state", self.system.plain_len(), snapshot.state.len());
        }
        if !(are_finite(&snapshot.state) && are_finite(&snapshot.rows)) {
            return inconsistent("numbers that are not finite");
        }
        let time_belongs = match &self.stepper {
            Stepper::Rk4OnGrid { .. } | Stepper::Rk4 { .. } => {
                snapshot.step <= self.step_times.steps && snapshot.time_s == self.step_times.start_s(snapshot.step)
            }
            Stepper::Dopri5 { dopri5, .. } => {
                (0.0..=settings.duration_s).contains(&snapshot.time_s) && dopri5.accepts_step(snapshot.next_step_s)
            }
        };
        if !time_belongs {
            return inconsistent("time and step");
        }
        let due = match &self.stepper {
            Stepper::Rk4OnGrid { every, .. } => snapshot.step.div_ceil(*every) as usize,
            _ => settings.samples_before(snapshot.time_s),
        };
        let rows = snapshot.rows.len() / width;
        let rows_belong = match snapshot.outcome {
            None => rows == due,
            Some(Outcome::Completed) => rows == due + 1,
            // The step that diverged keeps no samples.
            Some(Outcome::Diverged { .. }) => rows <= due,
        };
        if rows_belong { Ok(()) } else { inconsistent("time and number of rows") }
    }

    /// The run as it stands.
    pub fn snapshot(&self) -> Snapshot {
        Snapshot {
            format: Snapshot::FORMAT.to_owned(),
            core_version: crate::VERSION.to_owned(),
            identity: self.identity.clone(),
            step: self.step,
            time_s: self.time_s,
            next_step_s: match &self.stepper {
                Stepper::Rk4OnGrid { .. } | Stepper::Rk4 { .. } => self.settings.step_s,
                Stepper::Dopri5 { dopri5, .. } => dopri5.step_s(),
            },
            evaluations: self.evaluations,
            state: self.state(),
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

    /// State vector, as snapshots hold it; joint angles (rad) come first.
    pub fn state(&self) -> Vec<f64> {
        self.system.plain(&self.state)
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

    /// One step, the check that it led somewhere sensible, and the samples on the way. A step that did not leaves no trace
    /// but its time: the state stays the last good one.
    fn take_step(&mut self) -> Result<(), Divergence> {
        if self.step >= self.most_steps {
            return Err(Divergence::TooManySteps(self.step));
        }
        self.begin_step()?;
        let is_sampled = self.sample_on_grid()?;
        let start_s = self.time_s;
        let (end_s, is_finite) = self.integrate(start_s, is_sampled)?;
        self.time_s = end_s;
        self.step += 1;
        self.check(is_finite)
            .and_then(|()| self.sample(start_s, self.time_s))
            .inspect_err(|_| self.state.copy_from_slice(self.stepper.before()))
    }

    /// Lets happen what happens in one instant; what would leave numbers that are not finite leaves no trace.
    fn begin_step(&mut self) -> Result<(), Divergence> {
        if !self.system.has_events() {
            return Ok(());
        }
        self.stepper.before_mut().copy_from_slice(&self.state);
        self.system.begin_step(self.step, self.time_s, &mut self.state);
        if are_finite(&self.state) {
            return Ok(());
        }
        self.state.copy_from_slice(self.stepper.before());
        Err(Divergence::NotFinite)
    }

    /// Takes the sample that falls on the start of this step, if one does; its evaluation is the step's first slope too.
    fn sample_on_grid(&mut self) -> Result<bool, Divergence> {
        match &mut self.stepper {
            Stepper::Rk4OnGrid { rk4, every } if self.step.is_multiple_of(*every) => {
                let (system, time_s, state, slope) = (&*self.system, self.time_s, &self.state, rk4.first_slope());
                self.recorder.record_row(|row| system.observe_and_derive(time_s, state, row, slope))?;
                Ok(true)
            }
            _ => Ok(false),
        }
    }

    /// Moves the state on from `start_s`; gives the time reached and whether the state is finite. `knows_slope`: the
    /// integrator has the first slope already.
    fn integrate(&mut self, start_s: f64, knows_slope: bool) -> Result<(f64, bool), Divergence> {
        let (system, evaluations) = (&*self.system, &mut self.evaluations);
        let counted = |t: f64, x: &[f64], rate: &mut [f64]| {
            *evaluations += 1;
            system.derivative(t, x, rate);
        };
        let end_s = self.step_times.start_s(self.step + 1);
        match &mut self.stepper {
            Stepper::Rk4OnGrid { rk4, .. } | Stepper::Rk4 { rk4, .. } => {
                self.step_times.foresee(system, self.step, &mut self.foreseen);
                let finite = if knows_slope {
                    let finite = rk4.step_from_slope(start_s, end_s, &mut self.state, counted);
                    *evaluations += 1;
                    finite
                } else {
                    rk4.step(start_s, end_s, &mut self.state, counted)
                };
                Ok((end_s, finite == 0.0))
            }
            Stepper::Dopri5 { dopri5, before } => {
                before.copy_from_slice(&self.state);
                dopri5
                    .step(start_s, self.settings.duration_s, &mut self.state, counted)
                    .map(|time_s| (time_s, are_finite(&self.state)))
                    .map_err(|_| Divergence::StepTooSmall)
            }
        }
    }

    /// Whether the state is finite and near its trajectory.
    fn check(&mut self, is_finite: bool) -> Result<(), Divergence> {
        if !is_finite {
            return Err(Divergence::NotFinite);
        }
        self.system.tracking_error(self.time_s, &self.state, &mut self.error);
        exceeded_joint(self.error.iter().copied()).map_or(Ok(()), |joint| Err(Divergence::TrackingError(joint)))
    }

    /// Takes the samples inside the step just made, and the end of the run.
    fn sample(&mut self, start_s: f64, end_s: f64) -> Result<(), Divergence> {
        let (system, state, recorder) = (&*self.system, &self.state, &mut self.recorder);
        match &mut self.stepper {
            Stepper::Rk4OnGrid { .. } => {}
            Stepper::Rk4 { rk4, slopes } => {
                let before = rk4.before();
                if recorder.is_due_before(end_s) {
                    system.derivative(start_s, before, &mut slopes[0]);
                    system.derivative(end_s, state, &mut slopes[1]);
                    self.evaluations += 2;
                    recorder.record_before(system, end_s, |t, x| {
                        hermite((t - start_s) / (end_s - start_s), end_s - start_s, [before, state], slopes, x);
                    })?;
                }
            }
            Stepper::Dopri5 { dopri5, .. } => {
                recorder.record_before(system, end_s, |t, x| dopri5.interpolate(t, state, x))?;
            }
        }
        if end_s >= self.settings.duration_s { recorder.record(system, end_s, state) } else { Ok(()) }
    }
}

/// The first joint (1 is the first) whose tracking error is beyond what counts as tracking.
pub(super) fn exceeded_joint(error_rad: impl Iterator<Item = f64>) -> Option<usize> {
    error_rad.enumerate().find(|(_, e)| e.abs() > TRACKING_ERROR_LIMIT_RAD).map(|(joint, _)| joint + 1)
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
