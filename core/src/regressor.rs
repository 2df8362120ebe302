//! Products with a regressor over its live entries only: the model torque `Y θ` and the gradient `Yᵀ s`.

use crate::robots::{Regressor, Robot};
use crate::scalar::Scalar;
use crate::sum::Sum;
use crate::unroll::unrolled;
use nalgebra::SVector;

/// Model torque `Y θ`, N·m. `theta` holds the `P` parameters. Source: paper eq. (2).
#[inline(always)]
pub fn model_torque<R, T, const N: usize, const P: usize>(y: &Regressor<T, N, P>, theta: &[T]) -> SVector<T, N>
where
    R: Robot<N, P>,
    T: Scalar,
{
    let mut torque = [Sum::EMPTY; N];
    let theta = &theta[..P];
    unrolled!(R::ENTRIES.len(), n => {
        let (i, k) = R::ENTRIES[n];
        torque[i] = torque[i].plus(y[(i, k)] * theta[k]);
    });
    totals(&torque)
}

/// Gradient `Yᵀ s` that every adaptation law here descends along. Source: paper eq. (4), (9), (14).
#[inline(always)]
pub fn gradient<R, T, const N: usize, const P: usize>(y: &Regressor<T, N, P>, s: &SVector<T, N>) -> SVector<T, P>
where
    R: Robot<N, P>,
    T: Scalar,
{
    let mut gradient = [Sum::EMPTY; P];
    unrolled!(R::ENTRIES.len(), n => {
        let (i, k) = R::ENTRIES[n];
        gradient[k] = gradient[k].plus(y[(i, k)] * s[i]);
    });
    totals(&gradient)
}

#[inline(always)]
fn totals<T: Scalar, const K: usize>(sums: &[Sum<T>; K]) -> SVector<T, K> {
    let mut totals = SVector::<T, K>::zeros();
    for k in 0..K {
        totals[k] = sums[k].total(T::zero());
    }
    totals
}
