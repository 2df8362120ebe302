//! A system in plain states, for integrators that weigh every state: padding and numbers kept twice would count as states.

use super::StateSpace;
use std::cell::RefCell;

/// The same system, with states as [`StateSpace::write_plain`] writes them.
pub(super) struct Plain {
    system: Box<dyn StateSpace<f64>>,
    /// Work space for a state and its derivative.
    work: RefCell<[Vec<f64>; 2]>,
}

impl Plain {
    pub fn new(system: Box<dyn StateSpace<f64>>) -> Self {
        let zeros = || vec![0.0; system.len()];
        Self { work: RefCell::new([zeros(), zeros()]), system }
    }

    /// What `with` makes of the system's own state; a derivative that it leaves is written to `rate`.
    fn at(&self, x: &[f64], rate: Option<&mut [f64]>, with: impl FnOnce(&[f64], &mut [f64])) {
        let [state, slope] = &mut *self.work.borrow_mut();
        self.system.read_plain(x, state);
        with(state, slope);
        if let Some(rate) = rate {
            self.system.write_plain(slope, rate);
        }
    }
}

impl StateSpace<f64> for Plain {
    fn len(&self) -> usize {
        self.system.plain_len()
    }

    fn initialize(&self, x: &mut [f64]) {
        let [state, _] = &mut *self.work.borrow_mut();
        self.system.initialize(state);
        self.system.write_plain(state, x);
    }

    fn derivative(&self, time_s: f64, x: &[f64], rate: &mut [f64]) {
        self.at(x, Some(rate), |x, rate| self.system.derivative(time_s, x, rate));
    }

    fn observe(&self, time_s: f64, x: &[f64], row: &mut [f64]) {
        self.at(x, None, |x, _| self.system.observe(time_s, x, row));
    }

    fn observe_and_derive(&self, time_s: f64, x: &[f64], row: &mut [f64], rate: &mut [f64]) {
        self.at(x, Some(rate), |x, rate| self.system.observe_and_derive(time_s, x, row, rate));
    }

    fn tracking_error(&self, time_s: f64, x: &[f64], error: &mut [f64]) {
        self.at(x, None, |x, _| self.system.tracking_error(time_s, x, error));
    }

    fn theta_hat<'a>(&self, x: &'a [f64]) -> &'a [f64] {
        // What comes before an adaptation law's states is plain already.
        self.system.theta_hat(x)
    }
}
