//! A controller that runs on a clock: sample, compute, hold.
//!
//! At `t_k = k T` the controller reads a measurement and computes the command u_k. From `t_k + d` on, the actuator holds u_k until the
//! next command arrives (zero-order hold, computation delay d, `0 ≤ d ≤ T`); before the first, the torque is zero. The controller's
//! states advance by one explicit Euler step per sample, `x_{k+1} = x_k + T f(x_k, y_k, t_k)`, which is what its program would do;
//! the arm is integrated in between with finer steps. All of it tends to the continuous loop as T → 0, with an error of order T + d.

/// The clock, in integration steps: both are whole numbers of them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SampledControl {
    /// Steps per period.
    pub steps_per_period: u64,
    /// Steps from a sample to its torque; at most a period's.
    pub delay_steps: u64,
}

/// What happens at the start of a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Tick {
    /// The command computed last arrives at the actuator, before anything else.
    pub arrives: bool,
    /// A sample is taken: its number.
    pub sample: Option<u64>,
}

impl SampledControl {
    /// What happens at the start of step `step`.
    pub fn tick(self, step: u64) -> Tick {
        let sample = step.is_multiple_of(self.steps_per_period).then(|| step / self.steps_per_period);
        let arrives = self.delay_steps > 0
            && step >= self.delay_steps
            && (step - self.delay_steps).is_multiple_of(self.steps_per_period);
        Tick { arrives, sample }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn commands_arrive_a_delay_after_their_samples() {
        for (period, delay) in [(1, 0), (1, 1), (5, 0), (5, 2), (5, 5)] {
            let clock = SampledControl { steps_per_period: period, delay_steps: delay };
            let ticks: Vec<_> = (0..40).map(|step| (step, clock.tick(step))).collect();
            let samples: Vec<_> =
                ticks.iter().filter(|(_, tick)| tick.sample.is_some()).map(|(step, _)| *step).collect();
            assert!(samples.iter().enumerate().all(|(k, step)| *step == k as u64 * period));
            let arrivals: Vec<_> = ticks.iter().filter(|(_, tick)| tick.arrives).map(|(step, _)| *step).collect();
            let expected: Vec<_> = samples.iter().map(|step| step + delay).filter(|step| *step < 40).collect();
            assert_eq!(arrivals, if delay == 0 { Vec::new() } else { expected });
        }
    }
}
