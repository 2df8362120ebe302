//! Finite Fourier series per joint: `q_d = offset + Σ_k (a_k sin kωt + b_k cos kωt)`. Paper eq. (24) is one of them.
//!
//! One sine and cosine per instant: harmonics follow by the angle-addition theorem.

use super::Desired;
use super::motion::MOST_LANES;
use crate::packed::Packed;
use crate::scalar::Scalar;
use nalgebra::SVector;
use std::cell::Cell;

/// A Fourier trajectory for `N` joints.
#[derive(Debug, Clone, PartialEq)]
pub struct Fourier<T: Scalar, const N: usize> {
    /// Base angular frequency ω, rad/s.
    frequency_rad_s: f64,
    /// Constant part, rad.
    offset: Packed<T, N>,
    /// Amplitudes of `sin kωt` and `cos kωt` for k = 1, 2, ..., rad.
    harmonics: Vec<(Packed<T, N>, Packed<T, N>)>,
}

impl<const N: usize> Fourier<f64, N> {
    /// From angles in degrees: `sine_deg[joint][k − 1]`, `cosine_deg` likewise; rows shorter than the longest end in zeros.
    pub fn from_degrees(
        frequency_rad_s: f64,
        offset_deg: &[f64],
        sine_deg: &[Vec<f64>],
        cosine_deg: &[Vec<f64>],
    ) -> Self {
        let amplitude = |rows: &[Vec<f64>], k: usize| {
            let deg = |joint: usize| rows.get(joint).and_then(|row| row.get(k)).copied();
            Packed::of(&SVector::from_fn(|joint, _| deg(joint).map_or(0.0, f64::to_radians)))
        };
        let count = sine_deg.iter().chain(cosine_deg).map(Vec::len).max().unwrap_or(0);
        Self {
            frequency_rad_s,
            offset: Packed::of(&SVector::from_fn(|joint, _| offset_deg[joint].to_radians())),
            harmonics: (0..count).map(|k| (amplitude(sine_deg, k), amplitude(cosine_deg, k))).collect(),
        }
    }

    /// The paper's, for the arm's first three joints. Source: paper eq. (24).
    pub fn paper() -> Self {
        let sine_deg = [vec![5.0, 5.0, 2.5], vec![15.0, 3.0, 2.5], vec![10.0, 2.0, 3.0]];
        Self::from_degrees(1.0, &[0.0, 90.0, -90.0], &sine_deg, &[])
    }

    /// Whether both can be lanes of one trajectory: they turn at the same rate and have as many harmonics.
    pub fn runs_beside(&self, other: &Self) -> bool {
        self.frequency_rad_s == other.frequency_rad_s && self.harmonics.len() == other.harmonics.len()
    }
}

impl<T: Scalar, const N: usize> Fourier<T, N> {
    /// The trajectories of `T`'s lanes as one; they must run beside each other.
    pub fn side_by_side<'a>(of_lane: impl Fn(usize) -> &'a Fourier<f64, N>) -> Self {
        let vector = |of: &dyn Fn(&Fourier<f64, N>) -> Packed<f64, N>| {
            Packed::of(&SVector::from_fn(|joint, _| T::from_lanes(|lane| of(of_lane(lane)).numbers()[joint])))
        };
        let first = of_lane(0);
        Self {
            frequency_rad_s: first.frequency_rad_s,
            offset: vector(&|fourier| fourier.offset),
            harmonics: (0..first.harmonics.len())
                .map(|k| (vector(&|fourier| fourier.harmonics[k].0), vector(&|fourier| fourier.harmonics[k].1)))
                .collect(),
        }
    }

    /// Desired motion at `time_s`. Units: rad, rad/s, rad/s². Source: paper eq. (24).
    #[inline(always)]
    pub fn at(&self, time_s: f64) -> Desired<T, N> {
        self.turned_by(Scalar::sin_cos(self.frequency_rad_s * time_s))
    }

    /// Desired motion at each of several instants, with the bits of [`Self::at`]: sines of as many at once as a pack holds.
    /// Units: rad, rad/s, rad/s²; `motions` is as long as `times_s`.
    #[inline(always)]
    pub fn at_each(&self, times_s: &[f64], motions: &[Cell<Desired<T, N>>]) {
        let together = <T::Pack as Scalar>::LANES;
        for from in (0..times_s.len()).step_by(together) {
            let mut angles = [0.0; MOST_LANES];
            let count = together.min(times_s.len() - from);
            for n in 0..count {
                angles[n] = self.frequency_rad_s * times_s[from + n];
            }
            let (sin, cos) = T::Pack::from_lanes(|lane| angles[lane]).sin_cos();
            for n in 0..count {
                motions[from + n].set(self.turned_by((sin.lane(n), cos.lane(n))));
            }
        }
    }

    /// Desired motion where the base frequency has turned by an angle with this sine and cosine.
    #[inline(always)]
    fn turned_by(&self, (sin1, cos1): (f64, f64)) -> Desired<T, N> {
        let zero = Packed::repeat(T::zero());
        let (mut position, mut velocity, mut acceleration) = (self.offset, zero, zero);
        let (mut sin, mut cos) = (sin1, cos1);
        let mut rate = self.frequency_rad_s;
        for &(a, b) in &self.harmonics {
            let (s, c) = (T::splat(sin), T::splat(cos));
            let wave = a * s + b * c;
            position = position + wave;
            velocity = velocity + (a * c - b * s) * T::splat(rate);
            acceleration = acceleration - wave * T::splat(rate * rate);
            (sin, cos) = (sin * cos1 + cos * sin1, cos * cos1 - sin * sin1);
            rate += self.frequency_rad_s;
        }
        Desired { position: position.numbers(), velocity: velocity.numbers(), acceleration: acceleration.numbers() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn harmonics_and_derivatives_match_closed_form() {
        let trajectory = Fourier::<f64, 2>::from_degrees(
            0.7,
            &[10.0, -20.0],
            &[vec![5.0, 0.0, 2.5], vec![15.0]],
            &[vec![], vec![1.0, 2.0]],
        );
        for t in [0.0, 0.3, 5.1, 1000.0] {
            let d = trajectory.at(t);
            let w = 0.7;
            let q1 = 10.0 + 5.0 * f64::sin(w * t) + 2.5 * f64::sin(3.0 * w * t);
            let v2 = 15.0 * w * f64::cos(w * t) - w * f64::sin(w * t) - 4.0 * w * f64::sin(2.0 * w * t);
            let a1 = -5.0 * w * w * f64::sin(w * t) - 22.5 * w * w * f64::sin(3.0 * w * t);
            assert!((d.position[0].to_degrees() - q1).abs() < 1e-11, "{t}");
            assert!((d.velocity[1].to_degrees() - v2).abs() < 1e-11, "{t}");
            assert!((d.acceleration[0].to_degrees() - a1).abs() < 1e-11, "{t}");
        }
    }
}
