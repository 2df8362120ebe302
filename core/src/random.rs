//! Random numbers as more than one part of the core draws them.

use rand_chacha::rand_core::RngCore;

/// A number of [0, 1): the upper 53 bits, so every multiple of 2⁻⁵³ is as likely.
pub(crate) fn unit(generator: &mut impl RngCore) -> f64 {
    const STEP: f64 = 1.0 / (1_u64 << 53) as f64;
    (generator.next_u64() >> 11) as f64 * STEP
}
