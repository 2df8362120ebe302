//! Memory of past prediction errors, with exponential forgetting: w and Z of paper eq. (16) to (18).
//!
//! `ε = Yf θ̂ − τf`, `Z' = −λ Z + γ Yfᵀ Yf`, `w' = −λ w + γ Yfᵀ ε + Z θ̂'`, both zero at the start, which keeps
//! `w = Z (θ̂ − θ)` as long as `τf = Yf θ`. Tang and Arteaga's g is the same w (their eq. prints `Γ1 Z`, right only for a
//! scalar Γ1). Z is symmetric; only its upper triangle's live entries are kept.

use crate::regressor::{gradient, model_torque};
use crate::robots::{Regressor, Robot};
use crate::scalar::Scalar;
use crate::unroll::unrolled;
use nalgebra::SVector;
use std::marker::PhantomData;

/// The memory; its states are w, then the live upper triangle of Z.
#[derive(Debug, Clone, Copy)]
pub struct PredictionMemory<R, T, const N: usize, const P: usize> {
    /// Gain γ of new errors.
    pub gain: T,
    /// Forgetting rate λ, 1/s.
    pub forgetting: T,
    robot: PhantomData<R>,
}

impl<R: Robot<N, P>, T: Scalar, const N: usize, const P: usize> PredictionMemory<R, T, N, P> {
    /// A memory with gain γ and forgetting rate λ (1/s).
    pub fn new(gain: T, forgetting: T) -> Self {
        Self { gain, forgetting, robot: PhantomData }
    }

    /// Number of states.
    pub const STATES: usize = P + R::PAIRS.len();

    /// Writes `w'` and `Z'`, given `Yf`, `τf`, θ̂ and its rate. Source: paper eq. (16) to (18).
    #[inline(always)]
    pub fn derivative(
        &self,
        filtered: &Regressor<T, N, P>,
        filtered_torque: &SVector<T, N>,
        theta_hat: &[T],
        theta_hat_rate: &[T],
        states: &[T],
        rate: &mut [T],
    ) {
        let prediction_error = model_torque::<R, T, N, P>(filtered, theta_hat) - filtered_torque;
        let correlation = gradient::<R, T, N, P>(filtered, &prediction_error);
        let (w, z) = states[..Self::STATES].split_at(P);
        let (w_rate, z_rate) = rate[..Self::STATES].split_at_mut(P);
        let theta_hat_rate = &theta_hat_rate[..P];
        for k in 0..P {
            w_rate[k] = self.gain * correlation[k] - self.forgetting * w[k];
        }
        unrolled!(R::PAIRS.len(), n => {
            let (i, j) = R::PAIRS[n];
            let mut product = T::zero();
            let mut is_first = true;
            for row in 0..N {
                if R::LIVE[row][i] && R::LIVE[row][j] {
                    let term = filtered[(row, i)] * filtered[(row, j)];
                    product = if is_first { term } else { product + term };
                    is_first = false;
                }
            }
            z_rate[n] = self.gain * product - self.forgetting * z[n];
            w_rate[i] += z[n] * theta_hat_rate[j];
            if i != j {
                w_rate[j] += z[n] * theta_hat_rate[i];
            }
        });
    }
}
