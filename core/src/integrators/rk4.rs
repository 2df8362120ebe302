//! The classical fixed-step Runge-Kutta method of order 4.

use super::Aligned;
use crate::scalar::{Kernel, Scalar, zero_where_finite};

/// Work space for a state of a given length; no step allocates.
///
/// Four arrays are all that a step touches, the state among them: several runs side by side should fit the first cache.
#[derive(Debug)]
pub struct Rk4<T> {
    /// k1, then k1 + 2 k2, then k1 + 2 k2 + 2 k3.
    sum: Aligned<T>,
    /// Stage 2, then k3, then stage 4.
    one: Aligned<T>,
    /// k2, then stage 3, then k4, then the end; after a step, which the caller's state changes places with, the state before it.
    other: Aligned<T>,
}

impl<T: Scalar> Rk4<T> {
    /// Work space for `len` states.
    pub fn new(len: usize) -> Self {
        // The state, with which the last changes places after each step, begins where a page does.
        let zeros = |n| Aligned::apart(T::zero(), len, n);
        Self { sum: zeros(1), one: zeros(2), other: zeros(3) }
    }

    /// The instant between a step's ends at which it evaluates twice.
    pub fn middle_s(start_s: f64, end_s: f64) -> f64 {
        start_s + 0.5 * (end_s - start_s)
    }

    /// Where a caller who knows the first slope of the next step may put it; see [`Self::step_from_slope`].
    pub fn first_slope(&mut self) -> &mut [T] {
        &mut self.sum
    }

    /// The state before the last step.
    pub fn before(&self) -> &[T] {
        &self.other
    }

    /// The same, to be written where something happens between steps.
    pub fn before_mut(&mut self) -> &mut [T] {
        &mut self.other
    }

    /// Advances `x` from `start_s` to `end_s`: `x + h/6 (k1 + 2 k2 + 2 k3 + k4)`; `f(t, x, rate)` writes the derivative, all of it: a rate
    /// that it leaves out is what stood in that place, which is zero only where the state is.
    /// The end is given as a time, so that consecutive steps meet in the same bits. Gives zero where every state is finite.
    pub fn step(&mut self, start_s: f64, end_s: f64, x: &mut Aligned<T>, mut f: impl FnMut(f64, &[T], &mut [T])) -> T {
        f(start_s, x, &mut self.sum);
        self.step_from_slope(start_s, end_s, x, f)
    }

    /// [`Self::step`], with k1 in [`Self::first_slope`] already.
    pub fn step_from_slope(
        &mut self,
        start_s: f64,
        end_s: f64,
        x: &mut Aligned<T>,
        mut f: impl FnMut(f64, &[T], &mut [T]),
    ) -> T {
        let (h, middle_s) = (end_s - start_s, Self::middle_s(start_s, end_s));
        let Self { sum, one, other } = self;
        T::compiled(FirstStage { out: one, x, h: 0.5 * h, slope: sum });
        f(middle_s, one, other);
        T::compiled(NextStage { place: other, sum, x, h: 0.5 * h });
        f(middle_s, other, one);
        T::compiled(NextStage { place: one, sum, x, h });
        f(end_s, one, other);
        let finite = T::compiled(End { place: other, x, h, sum });
        std::mem::swap(x, other);
        finite
    }
}

/// `stage = x + h k`.
struct FirstStage<'a, T> {
    out: &'a mut [T],
    x: &'a [T],
    h: f64,
    slope: &'a [T],
}

impl<T: Scalar> Kernel for FirstStage<'_, T> {
    type Output = ();
    const LOOPS_OVER_NUMBERS: bool = true;

    #[inline(always)]
    fn run(self) {
        stage(self.out, self.x, T::splat(self.h), self.slope);
    }
}

/// `sum += 2 k`, and the stage `x + h k` in the place of the slope k.
struct NextStage<'a, T> {
    place: &'a mut [T],
    sum: &'a mut [T],
    x: &'a [T],
    h: f64,
}

impl<T: Scalar> Kernel for NextStage<'_, T> {
    type Output = ();
    const LOOPS_OVER_NUMBERS: bool = true;

    #[inline(always)]
    fn run(self) {
        next_stage(self.place, self.sum, self.x, T::splat(self.h));
    }
}

/// `x + h/6 (k1 + 2 k2 + 2 k3 + k4)` in the place of k4.
struct End<'a, T> {
    place: &'a mut [T],
    x: &'a [T],
    h: f64,
    sum: &'a [T],
}

impl<T: Scalar> Kernel for End<'_, T> {
    type Output = T;
    const LOOPS_OVER_NUMBERS: bool = true;

    #[inline(always)]
    fn run(self) -> T {
        end(self.place, self.x, T::splat(self.h / 6.0), self.sum);
        zero_where_finite(self.place)
    }
}

// Functions of their own, because the compiler knows of arguments that they do not overlap, and of a structure's fields it does
// not: without, it works on one number at a time.

#[inline(always)]
fn stage<T: Scalar>(out: &mut [T], x: &[T], h: T, slope: &[T]) {
    let len = out.len();
    let (x, slope) = (&x[..len], &slope[..len]);
    for i in 0..len {
        out[i] = x[i] + h * slope[i];
    }
}

#[inline(always)]
fn next_stage<T: Scalar>(place: &mut [T], sum: &mut [T], x: &[T], h: T) {
    let (len, two) = (place.len(), T::splat(2.0));
    let (sum, x) = (&mut sum[..len], &x[..len]);
    for i in 0..len {
        let slope = place[i];
        sum[i] += two * slope;
        place[i] = x[i] + h * slope;
    }
}

#[inline(always)]
fn end<T: Scalar>(place: &mut [T], x: &[T], sixth: T, sum: &[T]) {
    let len = place.len();
    let (x, sum) = (&x[..len], &sum[..len]);
    // One rounding of the state per step: where stiff dynamics hold a state at an exact equilibrium (the projection does),
    // several small increments would each be lost and leave it beside the equilibrium.
    for i in 0..len {
        place[i] = x[i] + sixth * (sum[i] + place[i]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Error at t = 1 of x' = x cos t, solution exp(sin t).
    fn error(steps: u32) -> f64 {
        let h = 1.0 / f64::from(steps);
        let mut x = Aligned::repeat(1.0, 1);
        let mut rk4 = Rk4::new(1);
        for n in 0..steps {
            let (start, end) = (f64::from(n) * h, f64::from(n + 1) * h);
            let before = x.to_vec();
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
    fn what_is_zero_and_never_moves_stays_zero() {
        let mut x = Aligned::repeat(0.0, 2);
        x[0] = 1.0;
        let mut rk4 = Rk4::new(2);
        for n in 0..5 {
            rk4.step(f64::from(n), f64::from(n + 1), &mut x, |_, x, rate| rate[0] = -x[0]);
            assert_eq!(x[1].to_bits(), 0);
        }
    }

    #[test]
    fn tells_what_is_not_finite() {
        for bad in [f64::NAN, f64::INFINITY] {
            for n in 0..11 {
                let mut x = Aligned::repeat(1.0, 11);
                let finite = Rk4::new(11).step(0.0, 1.0, &mut x, |_, _, rate| {
                    rate.fill(0.0);
                    rate[n] = bad;
                });
                assert!(finite.is_nan());
            }
        }
    }
}
