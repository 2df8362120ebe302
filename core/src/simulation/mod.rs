//! Simulation: a state space, an integrator and a recording, advanced in slices and resumable to the same bits.
//!
//! Stepping sees only a [`StateSpace`]; [`ClosedLoop`] is the one that a robot and a scheme make. Knows nothing of scenarios.
//! A diverging run is an [`Outcome`], not an error.

#[cfg(any(target_arch = "x86_64", all(target_arch = "wasm32", target_feature = "simd128")))]
mod as_numbers;
mod closed_loop;
mod controller;
mod imperfect_loop;
mod lockstep;
mod outcome;
mod recorder;
mod run;
mod snapshot;

#[cfg(any(target_arch = "x86_64", all(target_arch = "wasm32", target_feature = "simd128")))]
pub(crate) use as_numbers::AsNumbers;
pub use closed_loop::{ClosedLoop, InitialVelocity};
pub use controller::Controller;
pub use imperfect_loop::ImperfectLoop;
pub(crate) use lockstep::{Lanes, Lockstep};
pub use outcome::{Divergence, Outcome, TRACKING_ERROR_LIMIT_RAD};
pub use run::Simulation;
pub use snapshot::{Snapshot, SnapshotError};

use crate::integrators::{Rk4, Tolerances};
use crate::recording::Columns;
use crate::scalar::Scalar;
use crate::states::Stage;
use crate::trajectories::MOST_FORESEEN;

/// A dynamical system `x' = f(t, x)` that tracks something and can be observed.
pub trait StateSpace<T: Scalar>: Send {
    /// Number of states.
    fn len(&self) -> usize;
    /// Whether there is nothing to integrate.
    fn is_empty(&self) -> bool {
        self.len() == 0
    }
    /// Number of states as [`Self::write_plain`] writes them.
    fn plain_len(&self) -> usize {
        self.len()
    }
    /// Writes a state as snapshots hold it and people read it: without what is kept for vector instructions only.
    fn write_plain(&self, x: &[T], plain: &mut [T]) {
        plain.copy_from_slice(x);
    }
    /// Writes the state from what [`Self::write_plain`] wrote.
    fn read_plain(&self, plain: &[T], x: &mut [T]) {
        x.copy_from_slice(plain);
    }
    /// [`Self::write_plain`], into a vector.
    fn plain(&self, x: &[T]) -> Vec<T> {
        let mut plain = vec![T::zero(); self.plain_len()];
        self.write_plain(x, &mut plain);
        plain
    }
    /// Writes the initial state.
    fn initialize(&self, x: &mut [T]);
    /// Says at which instants after the first start the next fixed steps will evaluate the system, [`MOST_FORESEEN`] at most.
    fn foresee(&self, _times_s: &[f64]) {}
    /// Writes `f(t, x)`: every rate, but for states that are zero and stay so, whose place in `rate` holds zero already.
    fn derivative(&self, time_s: f64, x: &[T], rate: &mut [T]);
    /// Writes `f(t, x)` at a stage of a step that is nowhere in memory. Where lanes take their steps so (`evaluates_stages`) a system has its
    /// own way; this one is right for any, and allocates.
    fn derivative_at(&self, time_s: f64, stage: &Stage<'_, T>, rate: &mut [T]) {
        self.derivative(time_s, &stage.to_vec(), rate);
    }
    /// Writes one row of a recording without its time: see [`Columns`].
    fn observe(&self, time_s: f64, x: &[T], row: &mut [T]);
    /// Both at once, with the same bits: they share nearly all of their work.
    fn observe_and_derive(&self, time_s: f64, x: &[T], row: &mut [T], rate: &mut [T]);
    /// Writes the tracking error per joint, rad.
    fn tracking_error(&self, time_s: f64, x: &[T], error: &mut [T]);
    /// The estimates within a state.
    fn theta_hat<'a>(&self, x: &'a [T]) -> &'a [T];
    /// Whether [`Self::begin_step`] does anything; such a system is for fixed steps, one run at a time.
    fn has_events(&self) -> bool {
        false
    }
    /// What changes in one instant, at the start of fixed step `step`: samples of a controller's clock, loads that come and go.
    fn begin_step(&self, _step: u64, _time_s: f64, _x: &mut [T]) {}
}

/// Whether lanes of this kind evaluate stages that are nowhere in memory: where the arrays of all their runs are larger than the first cache.
/// Four lanes are as fast either way.
const fn evaluates_stages<T: Scalar>() -> bool {
    T::LANES >= 8
}

/// How many steps are foreseen at once.
const STEPS_FORESEEN: usize = MOST_FORESEEN / 2;

/// How to integrate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Method {
    /// Fixed-step Runge-Kutta of order 4.
    Rk4,
    /// Adaptive Dormand-Prince 5(4) with dense output.
    Dopri5(Tolerances),
}

/// When fixed steps start. Their number is counted once, because it takes a division and a rounding.
#[derive(Debug, Clone, Copy)]
struct StepTimes {
    step_s: f64,
    duration_s: f64,
    steps: u64,
}

impl StepTimes {
    /// Time at which step `n` starts, s; the last step ends at the duration exactly.
    fn start_s(&self, n: u64) -> f64 {
        if n >= self.steps { self.duration_s } else { n as f64 * self.step_s }
    }

    /// Tells a system where RK4 will evaluate it, the middles and ends of steps from `n` on, unless `foreseen`, the first step that it was told nothing
    /// of, is still to come.
    fn foresee<T: Scalar>(&self, system: &dyn StateSpace<T>, n: u64, foreseen: &mut u64) {
        if n < *foreseen {
            return;
        }
        let mut times_s = [[0.0; 2]; STEPS_FORESEEN];
        for (times_s, n) in times_s.iter_mut().zip(n..) {
            let (start_s, end_s) = (self.start_s(n), self.start_s(n + 1));
            *times_s = [Rk4::<f64>::middle_s(start_s, end_s), end_s];
        }
        system.foresee(times_s.as_flattened());
        *foreseen = n + STEPS_FORESEEN as u64;
    }
}

/// How long, how fine, and how much of it to keep. Validated by the scenario.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Integration method.
    pub method: Method,
    /// Step (fixed) or largest step (adaptive), s.
    pub step_s: f64,
    /// Duration T, s.
    pub duration_s: f64,
    /// Number of samples k, at `t_i = i T / k`; a completed run records its end as one more row.
    pub samples: usize,
    /// Shape of a recorded row.
    pub columns: Columns,
}

impl Settings {
    /// Time of sample `i`, s.
    pub fn sample_time_s(&self, i: usize) -> f64 {
        i as f64 * self.duration_s / self.samples as f64
    }

    /// Number of samples due before `time_s`.
    pub fn samples_before(&self, time_s: f64) -> usize {
        // A good guess, then exact by the very comparison that recording makes.
        let mut count = ((time_s / self.duration_s * self.samples as f64) as usize).min(self.samples);
        while count > 0 && self.sample_time_s(count - 1) >= time_s {
            count -= 1;
        }
        while count < self.samples && self.sample_time_s(count) < time_s {
            count += 1;
        }
        count
    }

    /// Number of fixed steps; the last one is shorter where the step does not divide the duration.
    pub fn steps(&self) -> u64 {
        let exact = self.duration_s / self.step_s;
        // Rounding in the quotient must not add a step of nearly no length.
        (exact - 1e-9 * exact.max(1.0)).ceil().max(1.0) as u64
    }

    /// Steps after which a run is given up, whatever its method: an adaptive one may take a hundred times the steps that its
    /// longest would have made, and 100 000 in any case.
    pub fn most_steps(&self) -> u64 {
        match self.method {
            Method::Rk4 => self.steps(),
            Method::Dopri5(_) => self.steps().saturating_mul(100).max(100_000),
        }
    }

    /// The times at which fixed steps start.
    fn step_times(&self) -> StepTimes {
        StepTimes { step_s: self.step_s, duration_s: self.duration_s, steps: self.steps() }
    }

    /// Steps per sample, where steps are fixed and every sample falls on the start of one.
    pub fn steps_per_sample(&self) -> Option<u64> {
        let steps = self.steps();
        let samples = self.samples as u64;
        let covers = (steps as f64 * self.step_s - self.duration_s).abs() <= 1e-9 * self.duration_s;
        (self.method == Method::Rk4 && covers && steps.is_multiple_of(samples)).then(|| steps / samples)
    }
}
