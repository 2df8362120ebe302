//! A random Fourier series with a chosen level of excitation: the root mean square of each joint's desired velocity.
//!
//! Harmonic k has amplitude `u / k` with u uniform in [0.5, 1] and a uniform phase, so that every harmonic moves about as
//! fast as the others; then the whole is scaled. By Parseval `v_rms² = ½ Σ (kω)² A_k²` over a period, exactly.

use super::Fourier;
use crate::random::unit;
use crate::scalar::Scalar;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use std::f64::consts::TAU;

/// The stream of a seed's numbers that trajectories take.
const STREAM: u64 = 0x7472_616a;

/// A series of `harmonics` multiples of `frequency_rad_s` about `offset_deg`, at `rms_deg_s` in each joint.
pub fn random_fourier<const N: usize>(
    seed: u64,
    frequency_rad_s: f64,
    harmonics: usize,
    offset_deg: &[f64],
    rms_deg_s: f64,
) -> Fourier<f64, N> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream(STREAM);
    let (mut sine_deg, mut cosine_deg) = (Vec::with_capacity(N), Vec::with_capacity(N));
    for _ in 0..N {
        let mut waves = Vec::with_capacity(harmonics);
        let mut square = 0.0;
        for k in 1..=harmonics {
            let speed = 0.5 + 0.5 * unit(&mut random);
            let (sin, cos) = Scalar::sin_cos(TAU * unit(&mut random));
            square += 0.5 * (speed * frequency_rad_s) * (speed * frequency_rad_s);
            waves.push((speed / k as f64 * cos, speed / k as f64 * sin));
        }
        let scale = rms_deg_s / square.sqrt();
        sine_deg.push(waves.iter().map(|(sine, _)| scale * sine).collect());
        cosine_deg.push(waves.iter().map(|(_, cosine)| scale * cosine).collect());
    }
    Fourier::from_degrees(frequency_rad_s, offset_deg, &sine_deg, &cosine_deg)
}
