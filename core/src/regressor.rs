//! Products with a regressor over its live entries only: the model torque `Y θ` and the gradient `Yᵀ s`.

use crate::robots::{Regressor, Robot};
use crate::scalar::Scalar;
use crate::unroll::unrolled;
use nalgebra::SVector;

/// Model torque `Y θ`, N·m. `theta` holds the `P` parameters. Source: paper eq. (2).
#[inline(always)]
pub fn model_torque<R, T, const N: usize, const P: usize>(y: &Regressor<T, N, P>, theta: &[T]) -> SVector<T, N>
where
    R: Robot<N, P>,
    T: Scalar,
{
    let mut torque = SVector::<T, N>::zeros();
    let theta = &theta[..P];
    unrolled!(R::ENTRIES.len(), n => {
        let (i, k) = R::ENTRIES[n];
        torque[i] += y[(i, k)] * theta[k];
    });
    torque
}

/// Gradient `Yᵀ s` that every adaptation law here descends along. Source: paper eq. (4), (9), (14).
#[inline(always)]
pub fn gradient<R, T, const N: usize, const P: usize>(y: &Regressor<T, N, P>, s: &SVector<T, N>) -> SVector<T, P>
where
    R: Robot<N, P>,
    T: Scalar,
{
    let mut gradient = SVector::<T, P>::zeros();
    unrolled!(R::ENTRIES.len(), n => {
        let (i, k) = R::ENTRIES[n];
        // The compiler may not drop a zero that a sum starts from.
        let mut is_first = true;
        for row in 0..i {
            is_first &= !R::LIVE[row][k];
        }
        let term = y[(i, k)] * s[i];
        gradient[k] = if is_first { term } else { gradient[k] + term };
    });
    gradient
}
