//! A system over numbers that are worked on together with their neighbours, as one over plain numbers.

use super::StateSpace;
use crate::lanes::Neighbour;

/// The system, whose states are read and written as plain numbers.
pub(crate) struct AsNumbers(pub Box<dyn StateSpace<Neighbour>>);

impl StateSpace<f64> for AsNumbers {
    fn len(&self) -> usize {
        self.0.len()
    }
    fn plain_len(&self) -> usize {
        self.0.plain_len()
    }
    fn write_plain(&self, x: &[f64], plain: &mut [f64]) {
        self.0.write_plain(Neighbour::of(x), Neighbour::of_mut(plain));
    }
    fn read_plain(&self, plain: &[f64], x: &mut [f64]) {
        self.0.read_plain(Neighbour::of(plain), Neighbour::of_mut(x));
    }
    fn initialize(&self, x: &mut [f64]) {
        self.0.initialize(Neighbour::of_mut(x));
    }
    fn foresee(&self, times_s: &[f64]) {
        self.0.foresee(times_s);
    }
    fn derivative(&self, time_s: f64, x: &[f64], rate: &mut [f64]) {
        self.0.derivative(time_s, Neighbour::of(x), Neighbour::of_mut(rate));
    }
    fn observe(&self, time_s: f64, x: &[f64], row: &mut [f64]) {
        self.0.observe(time_s, Neighbour::of(x), Neighbour::of_mut(row));
    }
    fn observe_and_derive(&self, time_s: f64, x: &[f64], row: &mut [f64], rate: &mut [f64]) {
        self.0.observe_and_derive(time_s, Neighbour::of(x), Neighbour::of_mut(row), Neighbour::of_mut(rate));
    }
    fn tracking_error(&self, time_s: f64, x: &[f64], error: &mut [f64]) {
        self.0.tracking_error(time_s, Neighbour::of(x), Neighbour::of_mut(error));
    }
    fn theta_hat<'a>(&self, x: &'a [f64]) -> &'a [f64] {
        Neighbour::plain(self.0.theta_hat(Neighbour::of(x)))
    }
}
