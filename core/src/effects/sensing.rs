//! What the controller sees of the joints: angles counted by encoders, noise on angles and velocities.
//!
//! `y = Δ round((q + n_q) / Δ)`, `v = q̇ + n_v`, with n white, normal and independent, drawn anew at every sample. One stream of
//! ChaCha8 per run, named by the scenario's seed; a sample's place in it follows from its number, so a resumed run
//! draws what an undisturbed one would.

use crate::random::unit;
use crate::scalar::{Scalar, logarithm};
use nalgebra::SVector;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

/// Sensors of a run; zeros are perfect ones.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Sensing {
    /// Angle between two encoder counts Δ, rad.
    pub encoder_step: f64,
    /// Standard deviation of the angles' noise, rad.
    pub position_noise: f64,
    /// Standard deviation of the velocity sensors' noise, rad/s.
    pub velocity_noise: f64,
    /// Names the stream.
    pub seed: u64,
}

/// Random words kept for each sample: four per joint and kind of noise would do for eight joints.
const WORDS_PER_SAMPLE: u128 = 64;

impl Sensing {
    /// Angles (rad) and velocities (rad/s) as measured at sample `sample`.
    pub fn measure<const N: usize>(
        &self,
        sample: u64,
        position: &SVector<f64, N>,
        velocity: &SVector<f64, N>,
    ) -> (SVector<f64, N>, SVector<f64, N>) {
        let (mut position, mut velocity) = (*position, *velocity);
        if self.position_noise != 0.0 || self.velocity_noise != 0.0 {
            let mut stream = ChaCha8Rng::seed_from_u64(self.seed);
            stream.set_word_pos(u128::from(sample) * WORDS_PER_SAMPLE);
            for i in 0..N {
                // One pair per joint, whichever noise is asked for: switching one on does not change the other.
                let (first, second) = normal_pair(&mut stream);
                if self.position_noise != 0.0 {
                    position[i] += self.position_noise * first;
                }
                if self.velocity_noise != 0.0 {
                    velocity[i] += self.velocity_noise * second;
                }
            }
        }
        if self.encoder_step != 0.0 {
            for i in 0..N {
                position[i] = self.encoder_step * (position[i] / self.encoder_step).round();
            }
        }
        (position, velocity)
    }
}

/// Two independent numbers of the normal distribution. Source: Box and Muller (1958).
fn normal_pair(stream: &mut ChaCha8Rng) -> (f64, f64) {
    // In (0, 1], so that the logarithm is finite.
    let radius = (-2.0 * logarithm(1.0 - unit(stream))).sqrt();
    let (sin, cos) = Scalar::sin_cos(std::f64::consts::TAU * unit(stream));
    (radius * cos, radius * sin)
}

#[cfg(test)]
mod tests {
    use super::*;

    const NOISY: Sensing = Sensing { encoder_step: 0.0, position_noise: 0.5, velocity_noise: 2.0, seed: 7 };

    #[test]
    fn noise_has_the_moments_of_a_normal_distribution() {
        let (q, v) = (SVector::from([1.0, -2.0, 0.0]), SVector::from([3.0, 0.0, 1.0]));
        let count = 40_000;
        let (mut sums, mut cross, mut tail) = ([[0.0; 2]; 2], 0.0, 0);
        for sample in 0..count {
            let (y, w) = NOISY.measure(sample, &q, &v);
            let (a, b) = ((y - q)[1] / 0.5, (w - v)[1] / 2.0);
            sums[0][0] += a;
            sums[0][1] += a * a;
            sums[1][0] += b;
            sums[1][1] += b * b;
            cross += a * b;
            tail += usize::from(a.abs() > 1.959_964);
        }
        let n = count as f64;
        for [sum, square] in sums {
            assert!((sum / n).abs() < 0.02 && (square / n - 1.0).abs() < 0.03, "{sum} {square}");
        }
        assert!((cross / n).abs() < 0.02);
        assert!((tail as f64 / n - 0.05).abs() < 0.005, "{tail}");
    }

    #[test]
    fn a_sample_is_drawn_from_its_number_and_the_seed_alone() {
        let (q, v) = (SVector::from([0.0; 3]), SVector::from([0.0; 3]));
        let draw = |sensing: Sensing, sample| sensing.measure(sample, &q, &v);
        assert_eq!(draw(NOISY, 5), draw(NOISY, 5));
        assert_ne!(draw(NOISY, 5), draw(NOISY, 6));
        assert_ne!(draw(NOISY, 5), draw(Sensing { seed: 8, ..NOISY }, 5));
        let (position, _) = draw(Sensing { velocity_noise: 0.0, ..NOISY }, 5);
        assert_eq!(position, draw(NOISY, 5).0, "one kind of noise must not depend on the other");
    }

    #[test]
    fn an_encoder_is_off_by_half_a_count_at_most() {
        let encoder = Sensing { encoder_step: 1.5e-5, ..Sensing::default() };
        for n in 0..1000 {
            let q = f64::from(n) * 0.001_234_567 - 0.5;
            let (y, v) = encoder.measure(0, &SVector::from([q]), &SVector::from([q]));
            assert!((y[0] - q).abs() <= 0.5 * 1.5e-5 * (1.0 + 1e-9) && v[0] == q);
            let counts = y[0] / 1.5e-5;
            assert!((counts - counts.round()).abs() < 1e-9);
        }
    }
}
