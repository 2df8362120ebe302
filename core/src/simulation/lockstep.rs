//! Runs in lockstep: as many as a scalar has lanes, step by step together, each with the bits that it has alone.
//!
//! For fixed steps whose samples fall on them. A run that diverges ends for itself; its lane computes on, unheard. What it
//! leaves are [`Snapshot`]s, as if each run had been alone in a [`super::Simulation`].

use super::recorder::Recorder;
use super::run::exceeded_joint;
use super::{
    Divergence, Outcome, Settings, Snapshot, StateSpace, StepTimes, TRACKING_ERROR_LIMIT_RAD, evaluates_stages,
};
use crate::integrators::{Aligned, Rk4, Rk4Slopes};
use crate::recording::Recording;
use crate::scalar::{Kernel, Scalar, zero_where_finite};

/// Lanes under way, whatever their scalar.
pub(crate) trait Lockstep: Send {
    /// Takes at most `max_steps` steps; true once every run has ended.
    fn advance(&mut self, max_steps: u64) -> bool;
    /// Steps taken.
    fn step(&self) -> u64;
    /// Steps taken with all runs together.
    fn steps_of_all(&self) -> u64;
    /// Each run as it stands.
    fn snapshots(self: Box<Self>) -> Vec<Snapshot>;
}

/// Runs side by side, one per lane.
pub(crate) struct Lanes<T: Scalar> {
    system: Box<dyn StateSpace<T>>,
    settings: Settings,
    step_times: StepTimes,
    rk4: Stepper<T>,
    /// Steps from one sample to the next.
    every: u64,
    state: Aligned<T>,
    row: Vec<T>,
    /// The row, lane by lane.
    rows: Vec<f64>,
    error: Vec<T>,
    step: u64,
    /// See [`StepTimes::foresee`].
    foreseen: u64,
    time_s: f64,
    /// Of the runs that were asked for; lanes behind the last are not heard.
    runs: Vec<LaneRun>,
}

/// Where stages are: in memory, or computed where they are read. Both have the same bits.
enum Stepper<T> {
    InMemory(Rk4<T>),
    Computed(Rk4Slopes<T>),
}

impl<T: Scalar> Stepper<T> {
    fn new(len: usize) -> Self {
        if evaluates_stages::<T>() { Self::Computed(Rk4Slopes::new(len)) } else { Self::InMemory(Rk4::new(len)) }
    }

    fn first_slope(&mut self) -> &mut [T] {
        match self {
            Self::InMemory(rk4) => rk4.first_slope(),
            Self::Computed(rk4) => rk4.first_slope(),
        }
    }

    /// The state before the last step.
    fn before(&self) -> &[T] {
        match self {
            Self::InMemory(rk4) => rk4.before(),
            Self::Computed(rk4) => rk4.before(),
        }
    }

    /// See [`Rk4::step_from_slope`].
    fn step_from_slope(&mut self, system: &dyn StateSpace<T>, start_s: f64, end_s: f64, x: &mut Aligned<T>) -> T {
        match self {
            Self::InMemory(rk4) => rk4.step_from_slope(start_s, end_s, x, |t, x, rate| system.derivative(t, x, rate)),
            Self::Computed(rk4) => {
                rk4.step_from_slope(start_s, end_s, x, |t, stage, rate| system.derivative_at(t, stage, rate))
            }
        }
    }
}

/// One run among the lanes.
struct LaneRun {
    identity: String,
    recorder: Recorder,
    end: Option<End>,
}

/// How a run ended, and where.
struct End {
    outcome: Outcome,
    step: u64,
    time_s: f64,
    state: Vec<f64>,
}

impl<T: Scalar> Lanes<T> {
    /// Runs at their start, `identities` naming them; `None` where samples do not fall on steps.
    pub fn new(identities: Vec<String>, system: Box<dyn StateSpace<T>>, settings: Settings) -> Option<Self> {
        let every = settings.steps_per_sample()?;
        let len = system.len();
        let width = settings.columns.width() - 1;
        let zeros = |len| vec![T::zero(); len];
        let mut state = Aligned::repeat(T::zero(), len);
        system.initialize(&mut state);
        let run = |identity| LaneRun { identity, recorder: Recorder::new(settings, 0), end: None };
        Some(Self {
            system,
            settings,
            step_times: settings.step_times(),
            rk4: Stepper::new(len),
            every,
            state,
            row: zeros(width),
            rows: vec![0.0; width * T::LANES],
            error: zeros(settings.columns.joints),
            step: 0,
            foreseen: 0,
            time_s: 0.0,
            runs: identities.into_iter().map(run).collect(),
        })
    }

    /// Runs where these snapshots left them: those that have not ended at the same step. `None` where they are not, or all
    /// have ended. The snapshots must be of runs of this system, with these settings.
    pub fn resume(system: Box<dyn StateSpace<T>>, settings: Settings, snapshots: Vec<Snapshot>) -> Option<Self> {
        let first = snapshots.iter().position(|snapshot| snapshot.outcome.is_none())?;
        let (step, time_s) = (snapshots[first].step, snapshots[first].time_s);
        if snapshots.iter().any(|snapshot| snapshot.outcome.is_none() && snapshot.step != step) {
            return None;
        }
        let identities = snapshots.iter().map(|snapshot| snapshot.identity.clone()).collect();
        let mut lanes = Self::new(identities, system, settings)?;
        // Lanes that nobody hears any more compute what the first does.
        let source =
            |lane: usize| if snapshots.get(lane).is_some_and(|it| it.outcome.is_none()) { lane } else { first };
        for (n, state) in lanes.state.iter_mut().enumerate() {
            *state = T::from_lanes(|lane| snapshots[source(lane)].state[n]);
        }
        (lanes.step, lanes.time_s) = (step, time_s);
        for (run, Snapshot { step, time_s, state, rows, outcome, .. }) in lanes.runs.iter_mut().zip(snapshots) {
            run.recorder.recording = Recording::from_rows(settings.columns, rows)?;
            run.end = outcome.map(|outcome| End { outcome, step, time_s, state });
        }
        Some(lanes)
    }

    fn take_step(&mut self) {
        let slope = self.rk4.first_slope();
        if self.step.is_multiple_of(self.every) {
            // A sample's evaluation gives the first slope of its step too.
            self.system.observe_and_derive(self.time_s, &self.state, &mut self.row, slope);
            self.record_row(false);
        } else {
            self.system.derivative(self.time_s, &self.state, slope);
        }
        let (system, end_s) = (&*self.system, self.step_times.start_s(self.step + 1));
        self.step_times.foresee(system, self.step, &mut self.foreseen);
        let finite = self.rk4.step_from_slope(system, self.time_s, end_s, &mut self.state);
        self.time_s = end_s;
        self.step += 1;
        self.check(finite);
        if self.time_s >= self.settings.duration_s {
            self.system.observe(self.time_s, &self.state, &mut self.row);
            self.record_row(true);
            for lane in 0..self.runs.len() {
                if self.runs[lane].end.is_none() {
                    self.end(lane, Outcome::Completed, false);
                }
            }
        }
    }

    /// Ends the runs whose state is not finite or too far from its trajectory.
    fn check(&mut self, finite: T) {
        self.system.tracking_error(self.time_s, &self.state, &mut self.error);
        if !T::compiled(IsAnyLost { finite, error: &self.error }) {
            return;
        }
        for lane in 0..self.runs.len() {
            let reason = if finite.lane(lane).is_finite() {
                exceeded_joint(self.error.iter().map(|e| e.lane(lane))).map(Divergence::TrackingError)
            } else {
                Some(Divergence::NotFinite)
            };
            if let Some(reason) = reason.filter(|_| self.runs[lane].end.is_none()) {
                self.end(lane, Outcome::Diverged { at_s: self.time_s, reason }, true);
            }
        }
    }

    /// Records a row for every run that has not ended; one that is not finite ends its run. `stepped` says whether the row
    /// belongs to the step just made, which then counts as the one that diverged.
    fn record_row(&mut self, stepped: bool) {
        let finite = T::compiled(ByLane { row: &self.row, rows: &mut self.rows });
        let width = self.row.len();
        for lane in 0..self.runs.len() {
            let run = &mut self.runs[lane];
            if run.end.is_some() {
                continue;
            }
            if finite.lane(lane) == 0.0 {
                run.recorder.record_finite(&self.rows[lane * width..][..width]);
            } else {
                let reason = Divergence::NotFinite;
                self.end(lane, Outcome::Diverged { at_s: self.time_s, reason }, stepped);
            }
        }
    }

    /// Ends a run, in its state now or before the last step.
    fn end(&mut self, lane: usize, outcome: Outcome, before: bool) {
        let state = lane_of(if before { self.rk4.before() } else { &self.state }, lane);
        self.runs[lane].end = Some(End { outcome, step: self.step, time_s: self.time_s, state });
    }
}

/// Whether any lane's state is not finite or too far from its trajectory.
struct IsAnyLost<'a, T> {
    finite: T,
    error: &'a [T],
}

impl<T: Scalar> Kernel for IsAnyLost<'_, T> {
    type Output = bool;

    #[inline(always)]
    fn run(self) -> bool {
        let (zero, one, limit) = (T::zero(), T::one(), T::splat(TRACKING_ERROR_LIMIT_RAD));
        let mut lost = T::select(self.finite.less_than(one), zero, one);
        for joint in 0..self.error.len() {
            lost = T::select(limit.less_than(self.error[joint].abs()), one, lost);
        }
        T::any(zero.less_than(lost))
    }
}

/// A row of all lanes as one row per lane; gives zero where its numbers are finite.
struct ByLane<'a, T> {
    row: &'a [T],
    rows: &'a mut [f64],
}

impl<T: Scalar> Kernel for ByLane<'_, T> {
    type Output = T;

    #[inline(always)]
    fn run(self) -> T {
        let (row, width) = (self.row, self.row.len());
        let rows = &mut self.rows[..width * T::LANES];
        for n in 0..width {
            for lane in 0..T::LANES {
                rows[lane * width + n] = row[n].lane(lane);
            }
        }
        zero_where_finite(row)
    }
}

fn lane_of<T: Scalar>(x: &[T], lane: usize) -> Vec<f64> {
    x.iter().map(|x| x.lane(lane)).collect()
}

impl<T: Scalar> Lockstep for Lanes<T> {
    fn advance(&mut self, max_steps: u64) -> bool {
        for _ in 0..max_steps {
            if self.runs.iter().all(|run| run.end.is_some()) {
                return true;
            }
            self.take_step();
        }
        self.runs.iter().all(|run| run.end.is_some())
    }

    fn step(&self) -> u64 {
        self.step
    }

    fn steps_of_all(&self) -> u64 {
        self.runs.iter().map(|run| run.end.as_ref().map_or(self.step, |end| end.step)).sum()
    }

    fn snapshots(self: Box<Self>) -> Vec<Snapshot> {
        let Self { runs, settings, step, time_s, state, .. } = *self;
        let evaluations_per_step = 4;
        let snapshot = |(lane, run): (usize, LaneRun)| {
            let (outcome, step, time_s, state) = match run.end {
                Some(End { outcome, step, time_s, state }) => (Some(outcome), step, time_s, state),
                None => (None, step, time_s, lane_of(&state, lane)),
            };
            Snapshot {
                format: Snapshot::FORMAT.to_owned(),
                core_version: crate::VERSION.to_owned(),
                identity: run.identity,
                step,
                time_s,
                next_step_s: settings.step_s,
                evaluations: evaluations_per_step * step,
                state,
                rows: run.recorder.recording.into_rows(),
                outcome,
            }
        };
        runs.into_iter().enumerate().map(snapshot).collect()
    }
}
