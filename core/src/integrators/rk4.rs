//! The classical fixed-step Runge-Kutta method of order 4.

use crate::scalar::{Kernel, Scalar};

/// Work space for a state of a given length; no step allocates.
///
/// Four arrays are all that a step touches, the state among them: several runs side by side should fit the first cache.
#[derive(Debug, Clone)]
pub struct Rk4<T> {
    /// k1, then k1 + 2 k2, then k1 + 2 k2 + 2 k3.
    sum: Vec<T>,
    /// The last slope: k2, k3, k4.
    slope: Vec<T>,
    /// The state at a stage; after a step, what the state was before it.
    stage: Vec<T>,
}

impl<T: Scalar> Rk4<T> {
    /// Work space for `len` states.
    pub fn new(len: usize) -> Self {
        let zeros = || vec![T::zero(); len];
        Self { sum: zeros(), slope: zeros(), stage: zeros() }
    }

    /// Where a caller who knows the first slope of the next step may put it; see [`Self::step_from_slope`].
    pub fn first_slope(&mut self) -> &mut [T] {
        &mut self.sum
    }

    /// The state before the last step.
    pub fn before(&self) -> &[T] {
        &self.stage
    }

    /// Advances `x` from `start_s` to `end_s`: `x + h/6 (k1 + 2 k2 + 2 k3 + k4)`; `f(t, x, rate)` writes the derivative.
    /// The end is given as a time, so that consecutive steps meet in the same bits. Gives zero where every state is finite.
    pub fn step(&mut self, start_s: f64, end_s: f64, x: &mut Vec<T>, mut f: impl FnMut(f64, &[T], &mut [T])) -> T {
        f(start_s, x, &mut self.sum);
        self.step_from_slope(start_s, end_s, x, f)
    }

    /// [`Self::step`], with k1 in [`Self::first_slope`] already.
    pub fn step_from_slope(
        &mut self,
        start_s: f64,
        end_s: f64,
        x: &mut Vec<T>,
        mut f: impl FnMut(f64, &[T], &mut [T]),
    ) -> T {
        let h = end_s - start_s;
        let middle_s = start_s + 0.5 * h;
        let Self { sum, slope, stage } = self;
        T::compiled(Stage { out: stage, x, h: 0.5 * h, slope: sum });
        f(middle_s, stage, slope);
        T::compiled(NextStage { out: stage, sum, x, h: 0.5 * h, slope });
        f(middle_s, stage, slope);
        T::compiled(NextStage { out: stage, sum, x, h, slope });
        f(end_s, stage, slope);
        let finite = T::compiled(End { out: stage, x, h, sum, slope });
        std::mem::swap(x, stage);
        finite
    }
}

/// `stage = x + h k`.
struct Stage<'a, T> {
    out: &'a mut [T],
    x: &'a [T],
    h: f64,
    slope: &'a [T],
}

impl<T: Scalar> Kernel for Stage<'_, T> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let h = T::splat(self.h);
        for ((stage, x), k) in self.out.iter_mut().zip(self.x).zip(self.slope) {
            *stage = *x + h * *k;
        }
    }
}

/// `sum += 2 k`, `stage = x + h k`.
struct NextStage<'a, T> {
    out: &'a mut [T],
    sum: &'a mut [T],
    x: &'a [T],
    h: f64,
    slope: &'a [T],
}

impl<T: Scalar> Kernel for NextStage<'_, T> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let (h, two) = (T::splat(self.h), T::splat(2.0));
        for (((stage, sum), x), k) in self.out.iter_mut().zip(self.sum).zip(self.x).zip(self.slope) {
            *sum += two * *k;
            *stage = *x + h * *k;
        }
    }
}

/// `end = x + h/6 (k1 + 2 k2 + 2 k3 + k4)`.
struct End<'a, T> {
    out: &'a mut [T],
    x: &'a [T],
    h: f64,
    sum: &'a [T],
    slope: &'a [T],
}

impl<T: Scalar> Kernel for End<'_, T> {
    type Output = T;

    #[inline(always)]
    fn run(self) -> T {
        let (sixth, zero) = (T::splat(self.h / 6.0), T::zero());
        // Zero times a number that is not finite is no number; four sums side by side have less to wait for.
        let mut zeros = [zero; 4];
        for (n, (((end, x), sum), k)) in self.out.iter_mut().zip(self.x).zip(self.sum).zip(self.slope).enumerate() {
            // One rounding of the state per step: where stiff dynamics hold a state at an exact equilibrium (the projection
            // does), several small increments would each be lost and leave it beside the equilibrium.
            *end = *x + sixth * (*sum + *k);
            zeros[n % 4] += *end * zero;
        }
        (zeros[0] + zeros[1]) + (zeros[2] + zeros[3])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Error at t = 1 of x' = x cos t, solution exp(sin t).
    fn error(steps: u32) -> f64 {
        let h = 1.0 / f64::from(steps);
        let mut x = vec![1.0];
        let mut rk4 = Rk4::new(1);
        for n in 0..steps {
            let (start, end) = (f64::from(n) * h, f64::from(n + 1) * h);
            let before = x.clone();
            assert_eq!(rk4.step(start, end, &mut x, |t, x, rate| rate[0] = x[0] * t.cos()), 0.0);
            assert_eq!(rk4.before(), before);
        }
        (x[0] - 1.0_f64.sin().exp()).abs()
    }

    #[test]
    fn converges_at_order_four() {
        let order = (error(20) / error(40)).log2();
        assert!((order - 4.0).abs() < 0.1, "order {order}");
    }

    #[test]
    fn tells_what_is_not_finite() {
        for bad in [f64::NAN, f64::INFINITY] {
            for n in 0..6 {
                let mut x = vec![1.0; 6];
                let finite = Rk4::new(6).step(0.0, 1.0, &mut x, |_, _, rate| {
                    rate.fill(0.0);
                    rate[n] = bad;
                });
                assert!(finite.is_nan());
            }
        }
    }
}
