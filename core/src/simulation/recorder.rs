//! Taking samples of a run at their exact times.

use super::{Divergence, Settings, StateSpace};
use crate::recording::Recording;

/// The recording of a run and where its next sample is due.
pub(super) struct Recorder {
    settings: Settings,
    pub recording: Recording,
    /// Work space for a state inside a step.
    sample: Vec<f64>,
}

impl Recorder {
    /// Nothing recorded yet, for a system of `len` states.
    pub fn new(settings: Settings, len: usize) -> Self {
        // One row more than samples: the end of the run.
        let recording = Recording::with_capacity(settings.columns, settings.samples + 1);
        Self { settings, recording, sample: vec![0.0; len] }
    }

    /// Records the next sample (or the end) from the state at `time_s`.
    pub fn record(&mut self, system: &dyn StateSpace<f64>, time_s: f64, x: &[f64]) -> Result<(), Divergence> {
        self.record_row(|row| system.observe(time_s, x, row))
    }

    /// Records the next sample (or the end) as `observe` writes it.
    pub fn record_row(&mut self, observe: impl FnOnce(&mut [f64])) -> Result<(), Divergence> {
        self.recording.push(self.label_s(), observe).map_err(|_| Divergence::NotFinite)
    }

    /// Records the next sample (or the end), a row whose numbers are finite.
    pub fn record_finite(&mut self, row: &[f64]) {
        self.recording.push_finite(self.label_s(), row);
    }

    /// Time of the next sample.
    fn label_s(&self) -> f64 {
        self.settings.sample_time_s(self.recording.len())
    }

    /// Whether a sample is due before `end_s`.
    pub fn is_due_before(&self, end_s: f64) -> bool {
        let taken = self.recording.len();
        taken < self.settings.samples && self.settings.sample_time_s(taken) < end_s
    }

    /// Records every sample due before `end_s`; `state_at` gives the state inside the step.
    pub fn record_before(
        &mut self,
        system: &dyn StateSpace<f64>,
        end_s: f64,
        mut state_at: impl FnMut(f64, &mut [f64]),
    ) -> Result<(), Divergence> {
        let mut sample = std::mem::take(&mut self.sample);
        let mut recorded = Ok(());
        while recorded.is_ok() && self.is_due_before(end_s) {
            let time_s = self.settings.sample_time_s(self.recording.len());
            state_at(time_s, &mut sample);
            recorded = self.record(system, time_s, &sample);
        }
        self.sample = sample;
        recorded
    }
}
