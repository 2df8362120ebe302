//! The classical fixed-step Runge-Kutta method of order 4.

use crate::scalar::{Kernel, Scalar};

/// Work space for a state of a given length; no step allocates.
#[derive(Debug, Clone)]
pub struct Rk4<T> {
    /// k1..k4.
    slopes: [Vec<T>; 4],
    stage: Vec<T>,
}

impl<T: Scalar> Rk4<T> {
    /// Work space for `len` states.
    pub fn new(len: usize) -> Self {
        Self { slopes: std::array::from_fn(|_| vec![T::zero(); len]), stage: vec![T::zero(); len] }
    }

    /// Advances `x` from `start_s` to `end_s`: `x + h/6 (k1 + 2 k2 + 2 k3 + k4)`.
    /// `f(t, x, rate)` writes the derivative. The end is given as a time, so that consecutive steps meet in the same bits.
    pub fn step(&mut self, start_s: f64, end_s: f64, x: &mut [T], mut f: impl FnMut(f64, &[T], &mut [T])) {
        let h = end_s - start_s;
        let middle_s = start_s + 0.5 * h;
        let half = 0.5 * h;
        let Self { slopes: [k1, k2, k3, k4], stage } = self;

        f(start_s, x, k1);
        T::compiled(Reach { stage, x, h: half, k: k1 });
        f(middle_s, stage, k2);
        T::compiled(Reach { stage, x, h: half, k: k2 });
        f(middle_s, stage, k3);
        T::compiled(Reach { stage, x, h, k: k3 });
        f(end_s, stage, k4);
        T::compiled(Advance { x, h, k1, k2, k3, k4 });
    }
}

/// `stage = x + h k`.
struct Reach<'a, T> {
    stage: &'a mut [T],
    x: &'a [T],
    h: f64,
    k: &'a [T],
}

impl<T: Scalar> Kernel for Reach<'_, T> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        let Self { stage, x, h, k } = self;
        reach(stage, x, T::splat(h), k);
    }
}

/// `x += h/6 (k1 + 2 k2 + 2 k3 + k4)`.
struct Advance<'a, T> {
    x: &'a mut [T],
    h: f64,
    k1: &'a [T],
    k2: &'a [T],
    k3: &'a [T],
    k4: &'a [T],
}

impl<T: Scalar> Kernel for Advance<'_, T> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        let Self { x, h, k1, k2, k3, k4 } = self;
        let (sixth, two) = (T::splat(h / 6.0), T::splat(2.0));
        // One rounding of the state per step: where stiff dynamics hold a state at an exact equilibrium (the projection
        // does), several small increments would each be lost and leave it beside the equilibrium.
        for ((((x, k1), k2), k3), k4) in x.iter_mut().zip(k1).zip(k2).zip(k3).zip(k4) {
            *x += sixth * (*k1 + two * *k2 + two * *k3 + *k4);
        }
    }
}

#[inline(always)]
fn reach<T: Scalar>(stage: &mut [T], x: &[T], h: T, k: &[T]) {
    for ((stage, x), k) in stage.iter_mut().zip(x).zip(k) {
        *stage = *x + h * *k;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Error at t = 1 of x' = x cos t, solution exp(sin t).
    fn error(steps: u32) -> f64 {
        let h = 1.0 / f64::from(steps);
        let mut x = [1.0];
        let mut rk4 = Rk4::new(1);
        for n in 0..steps {
            let (start, end) = (f64::from(n) * h, f64::from(n + 1) * h);
            rk4.step(start, end, &mut x, |t, x, rate| rate[0] = x[0] * t.cos());
        }
        (x[0] - 1.0_f64.sin().exp()).abs()
    }

    #[test]
    fn converges_at_order_four() {
        let order = (error(20) / error(40)).log2();
        assert!((order - 4.0).abs() < 0.1, "order {order}");
    }
}
