//! The classical fixed-step Runge-Kutta method of order 4 once more, with stages that are never in memory.
//!
//! For many runs side by side, whose arrays do not fit the first cache: what evaluates a stage computes it where it reads it, and waits for
//! the caches while it has other work. Bit for bit the sums of [`super::Rk4`] (docs/decisions/0015-lanes.md).

use super::{Aligned, Rk4};
use crate::scalar::{Kernel, Scalar};
use crate::states::Stage;

/// Work space for a state of a given length; no step allocates.
#[derive(Debug)]
pub struct Rk4Slopes<T> {
    /// k1 to k4; after a step, the state before it stands in the place of k4.
    slopes: [Aligned<T>; 4],
}

impl<T: Scalar> Rk4Slopes<T> {
    /// Work space for `len` states.
    pub fn new(len: usize) -> Self {
        // The state, with which the last changes places after each step, begins where a page does.
        Self { slopes: [1, 2, 3, 4].map(|n| Aligned::apart(T::zero(), len, n)) }
    }

    /// Where the caller puts the first slope of the next step.
    pub fn first_slope(&mut self) -> &mut [T] {
        &mut self.slopes[0]
    }

    /// The state before the last step.
    pub fn before(&self) -> &[T] {
        &self.slopes[3]
    }

    /// [`Rk4::step_from_slope`]; `f(t, stage, rate)` writes the derivative.
    pub fn step_from_slope(
        &mut self,
        start_s: f64,
        end_s: f64,
        x: &mut Aligned<T>,
        mut f: impl FnMut(f64, &Stage<'_, T>, &mut [T]),
    ) -> T {
        let (h, middle_s) = (end_s - start_s, Rk4::<T>::middle_s(start_s, end_s));
        let half = 0.5 * h;
        let [k1, k2, k3, k4] = &mut self.slopes;
        f(middle_s, &Stage { x, h: half, slope: k1 }, k2);
        f(middle_s, &Stage { x, h: half, slope: k2 }, k3);
        f(end_s, &Stage { x, h, slope: k3 }, k4);
        let finite = T::compiled(End { x, h, slopes: [k1, k2, k3], place: k4 });
        std::mem::swap(x, k4);
        finite
    }
}

/// `x + h/6 (k1 + 2 k2 + 2 k3 + k4)` in the place of k4; gives zero where every state is finite.
struct End<'a, T> {
    x: &'a [T],
    h: f64,
    slopes: [&'a [T]; 3],
    place: &'a mut [T],
}

impl<T: Scalar> Kernel for End<'_, T> {
    type Output = T;
    const LOOPS_OVER_NUMBERS: bool = true;

    #[inline(always)]
    fn run(self) -> T {
        let len = self.x.len();
        let (x, [k1, k2, k3], place) = (self.x, self.slopes.map(|slope| &slope[..len]), &mut self.place[..len]);
        let (sixth, two) = (T::splat(self.h / 6.0), T::splat(2.0));
        let mut finite = T::zero();
        // Backwards: the last states are those that the last evaluation left in the first cache.
        for i in (0..len).rev() {
            let mut sum = k1[i];
            sum += two * k2[i];
            sum += two * k3[i];
            let end = x[i] + sixth * (sum + place[i]);
            // Zero times a number that is not finite is no number. One sum is enough: it waits less than the caches take.
            finite += end * T::zero();
            place[i] = end;
        }
        finite
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::states::States;

    #[test]
    fn has_the_bits_of_stages_in_memory() {
        let len = 9;
        let rate = |t: f64, x: f64, next: f64, n: usize| x * (t * f64::from(n as u32 + 1)).cos() - 0.1 * x * next;
        let mut x = Aligned::repeat(1.1, len);
        let mut y = Aligned::repeat(1.1, len);
        let (mut rk4, mut slopes) = (Rk4::new(len), Rk4Slopes::new(len));
        for step in 0..200 {
            let (start, end) = (f64::from(step) * 0.03, f64::from(step + 1) * 0.03);
            let before = y.to_vec();
            let found = rk4
                .step(start, end, &mut x, |t, x, k| (0..len).for_each(|n| k[n] = rate(t, x[n], x[(n + 1) % len], n)));
            (0..len).for_each(|n| slopes.first_slope()[n] = rate(start, y[n], y[(n + 1) % len], n));
            let f = |t: f64, stage: &Stage<'_, f64>, k: &mut [f64]| {
                (0..len).for_each(|n| k[n] = rate(t, stage.at(n), stage.at((n + 1) % len), n));
            };
            assert_eq!(slopes.step_from_slope(start, end, &mut y, f), found);
            assert!(x.iter().zip(y.iter()).all(|(x, y)| x.to_bits() == y.to_bits()));
            assert_eq!(slopes.before(), before);
        }
    }

    #[test]
    fn tells_what_is_not_finite() {
        for (n, bad) in (0..5).flat_map(|n| [(n, f64::NAN), (n, f64::NEG_INFINITY)]) {
            for slope in 0..4 {
                let mut x = Aligned::repeat(1.0, 5);
                let mut rk4 = Rk4Slopes::new(5);
                rk4.first_slope()[n] = if slope == 0 { bad } else { 0.0 };
                let mut evaluated = 0;
                let finite = rk4.step_from_slope(0.0, 1.0, &mut x, |_, _, rate| {
                    evaluated += 1;
                    rate[n] = if slope == evaluated { bad } else { 0.0 };
                });
                assert!(finite.is_nan(), "k{}", slope + 1);
            }
        }
    }
}
