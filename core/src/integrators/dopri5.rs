//! Dormand and Prince's embedded Runge-Kutta pair 5(4) with adaptive step and dense output of order 4, for checking RK4.
//!
//! Source: Dormand and Prince (1980); step control and interpolant as in Hairer, Nørsett and Wanner, *Solving Ordinary
//! Differential Equations I*, sections II.4 to II.6.

use crate::scalar::power;

/// Nodes c of the tableau.
const C: [f64; 7] = [0.0, 1.0 / 5.0, 3.0 / 10.0, 4.0 / 5.0, 8.0 / 9.0, 1.0, 1.0];
/// Rows a of the tableau; the last row is also the solution of order 5.
const A: [[f64; 6]; 7] = [
    [0.0; 6],
    [1.0 / 5.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [3.0 / 40.0, 9.0 / 40.0, 0.0, 0.0, 0.0, 0.0],
    [44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0, 0.0, 0.0, 0.0],
    [19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0, 0.0, 0.0],
    [9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0, 0.0],
    [35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0],
];
/// Difference of the solutions of order 5 and 4.
const E: [f64; 7] =
    [71.0 / 57600.0, 0.0, -71.0 / 16695.0, 71.0 / 1920.0, -17253.0 / 339_200.0, 22.0 / 525.0, -1.0 / 40.0];
/// Last coefficients of the interpolant.
const D: [f64; 7] = [
    -12_715_105_075.0 / 11_282_082_432.0,
    0.0,
    87_487_479_700.0 / 32_700_410_799.0,
    -10_690_763_975.0 / 1_880_347_072.0,
    701_980_252_875.0 / 199_316_789_632.0,
    -1_453_857_185.0 / 822_651_844.0,
    69_997_945.0 / 29_380_423.0,
];

/// Error control: a step is accepted when the root mean square of `error / (absolute + relative |x|)` is at most one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tolerances {
    /// Relative tolerance.
    pub relative: f64,
    /// Absolute tolerance, in the units of each state.
    pub absolute: f64,
}

/// The step fell below what the clock resolves: the solution is singular or the problem too stiff.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StepTooSmall;

/// Adaptive integrator; its whole memory between steps is the next step, so a run can be resumed to the same bits.
#[derive(Debug, Clone)]
pub struct Dopri5 {
    tolerances: Tolerances,
    max_step_s: f64,
    /// Step that the next attempt will use, s.
    step_s: f64,
    /// Slopes k1..k7 of the last accepted step.
    slopes: [Vec<f64>; 7],
    stage: Vec<f64>,
    start: Vec<f64>,
    start_s: f64,
    taken_s: f64,
}

impl Dopri5 {
    /// For `len` states; the step never exceeds `max_step_s` and starts there.
    pub fn new(len: usize, tolerances: Tolerances, max_step_s: f64) -> Self {
        Self {
            tolerances,
            max_step_s,
            step_s: max_step_s,
            slopes: std::array::from_fn(|_| vec![0.0; len]),
            stage: vec![0.0; len],
            start: vec![0.0; len],
            start_s: 0.0,
            taken_s: 0.0,
        }
    }

    /// Step that the next attempt will use, s.
    pub fn step_s(&self) -> f64 {
        self.step_s
    }

    /// Whether this can be the next step: positive and not above the longest.
    pub fn accepts_step(&self, step_s: f64) -> bool {
        step_s > 0.0 && step_s <= self.max_step_s
    }

    /// Takes up a run whose next step is `step_s`; steps that cannot be are ignored.
    pub fn set_step(&mut self, step_s: f64) {
        if self.accepts_step(step_s) {
            self.step_s = step_s;
        }
    }

    /// Advances `x` by one accepted step from `start_s`, not beyond `limit_s`; returns the time reached.
    pub fn step(
        &mut self,
        start_s: f64,
        limit_s: f64,
        x: &mut [f64],
        mut f: impl FnMut(f64, &[f64], &mut [f64]),
    ) -> Result<f64, StepTooSmall> {
        self.start.copy_from_slice(x);
        self.start_s = start_s;
        f(start_s, x, &mut self.slopes[0]);
        let mut rejected = false;
        loop {
            let last = start_s + self.step_s >= limit_s;
            let h = if last { limit_s - start_s } else { self.step_s };
            if !last && start_s + 0.1 * h == start_s {
                return Err(StepTooSmall);
            }
            for stage in 1..7 {
                self.blend(h, &A[stage]);
                let (done, rest) = self.slopes.split_at_mut(stage);
                debug_assert_eq!(done.len(), stage);
                f(start_s + C[stage] * h, &self.stage, &mut rest[0]);
            }
            let error = self.error_norm(h);
            // A NaN error must shrink the step like a large one.
            let factor = if error > 0.0 {
                0.9 * power(error, -0.2)
            } else if error == 0.0 {
                5.0
            } else {
                0.2
            };
            let growth = factor.clamp(0.2, if rejected { 1.0 } else { 5.0 });
            if error <= 1.0 {
                // The step that the clock cut short says nothing against the one that was planned.
                self.step_s = (h * growth).max(if last { self.step_s } else { 0.0 }).min(self.max_step_s);
                x.copy_from_slice(&self.stage);
                self.taken_s = h;
                return Ok(if last { limit_s } else { start_s + h });
            }
            rejected = true;
            self.step_s = h * growth;
            if start_s + 0.1 * self.step_s == start_s {
                return Err(StepTooSmall);
            }
        }
    }

    /// State at `time_s` inside the last accepted step, whose end state is `end`: interpolant of order 4.
    pub fn interpolate(&self, time_s: f64, end: &[f64], out: &mut [f64]) {
        let h = self.taken_s;
        let s = (time_s - self.start_s) / h;
        let r = 1.0 - s;
        for (n, out) in out.iter_mut().enumerate() {
            let k = |i: usize| self.slopes[i][n];
            let difference = end[n] - self.start[n];
            let bend = h * k(0) - difference;
            let twist = difference - h * k(6) - bend;
            let wave = h * (0..7).map(|i| D[i] * k(i)).sum::<f64>();
            *out = self.start[n] + s * (difference + r * (bend + s * (twist + r * wave)));
        }
    }

    /// `stage = start + h Σ a_i k_i`.
    fn blend(&mut self, h: f64, a: &[f64; 6]) {
        for (n, stage) in self.stage.iter_mut().enumerate() {
            let sum: f64 = (0..6).map(|i| a[i] * self.slopes[i][n]).sum();
            *stage = self.start[n] + h * sum;
        }
    }

    /// Root mean square of the scaled error; the last stage is the candidate.
    fn error_norm(&self, h: f64) -> f64 {
        let mut sum = 0.0;
        for (n, candidate) in self.stage.iter().enumerate() {
            let error = h * (0..7).map(|i| E[i] * self.slopes[i][n]).sum::<f64>();
            let size = self.start[n].abs().max(candidate.abs());
            let scaled = error / (self.tolerances.absolute + self.tolerances.relative * size);
            sum += scaled * scaled;
        }
        (sum / self.stage.len() as f64).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn exact(t: f64) -> f64 {
        t.sin().exp()
    }

    fn rhs(t: f64, x: &[f64], rate: &mut [f64]) {
        rate[0] = x[0] * t.cos();
    }

    /// Tolerances so loose that every step is accepted at its planned length.
    fn fixed(step: f64) -> Dopri5 {
        Dopri5::new(1, Tolerances { relative: 1e9, absolute: 1e9 }, step)
    }

    fn errors(steps: u32) -> (f64, f64) {
        let h = 1.0 / f64::from(steps);
        let mut dopri5 = fixed(h);
        let (mut t, mut x, mut dense) = (0.0, [1.0], 0.0_f64);
        while t < 1.0 - 0.5 * h {
            let start = t;
            t = dopri5.step(t, 2.0, &mut x, rhs).unwrap();
            let mut middle = [0.0];
            dopri5.interpolate(start + 0.3 * h, &x, &mut middle);
            dense = dense.max((middle[0] - exact(start + 0.3 * h)).abs());
        }
        ((x[0] - exact(t)).abs(), dense)
    }

    #[test]
    fn converges_at_order_five_with_dense_output_of_order_four() {
        let ((end1, dense1), (end2, dense2)) = (errors(10), errors(20));
        let (order, dense_order) = ((end1 / end2).log2(), (dense1 / dense2).log2());
        assert!((order - 5.0).abs() < 0.3, "order {order}");
        assert!(dense_order > 4.0, "dense output order {dense_order}");
    }

    #[test]
    fn meets_its_tolerance_and_the_final_time() {
        let mut dopri5 = Dopri5::new(1, Tolerances { relative: 1e-10, absolute: 1e-12 }, 0.5);
        let (mut t, mut x) = (0.0, [1.0]);
        while t < 3.0 {
            t = dopri5.step(t, 3.0, &mut x, rhs).unwrap();
        }
        assert_eq!(t, 3.0);
        assert!((x[0] - exact(3.0)).abs() < 1e-8);
    }

    #[test]
    fn reports_a_singularity_instead_of_hanging() {
        let mut dopri5 = Dopri5::new(1, Tolerances { relative: 1e-8, absolute: 1e-8 }, 0.1);
        let (mut t, mut x) = (0.0, [1.0]);
        // x' = x², solution 1/(1 − t).
        let error = loop {
            match dopri5.step(t, 2.0, &mut x, |_, x, rate| rate[0] = x[0] * x[0]) {
                Ok(reached) => t = reached,
                Err(error) => break error,
            }
        };
        assert_eq!(error, StepTooSmall);
        assert!((t - 1.0).abs() < 1e-3, "{t}");
    }
}
