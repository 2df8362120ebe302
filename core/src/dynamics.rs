//! Rigid-body dynamics of any robot: friction's sign, inverse and forward dynamics, and the small linear solve.
//!
//! The equations of motion themselves belong to the robot (`robots/`); this file says what is done with them.

use crate::robots::Robot;
use crate::scalar::Scalar;
use nalgebra::{SMatrix, SVector};
use std::marker::PhantomData;

/// Coulomb friction's sign, regularised as `tanh(v / width)`; `width` in rad/s, zero for the true sign.
/// Chosen: the paper does not say how its simulation treats the jump (docs/physics.md section 1).
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FrictionSign<T> {
    /// `sgn(v)` with `sgn(0) = 0`.
    True,
    /// `tanh(v · inverse_width)`.
    Tanh {
        /// Reciprocal of the width, s/rad.
        inverse_width: T,
    },
}

impl<T: Scalar> FrictionSign<T> {
    /// From a width in rad/s; zero means the true sign.
    pub fn from_width(width_rad_s: f64) -> Self {
        Self::from_widths(|_| width_rad_s)
    }

    /// From each lane's width in rad/s: all zero, or none.
    pub fn from_widths(width_rad_s: impl Fn(usize) -> f64) -> Self {
        if width_rad_s(0) == 0.0 {
            Self::True
        } else {
            Self::Tanh { inverse_width: T::from_lanes(|lane| 1.0 / width_rad_s(lane)) }
        }
    }

    /// `sgn(v)` per joint, as regularised.
    #[inline(always)]
    pub fn of<const N: usize>(&self, v: &SVector<T, N>) -> SVector<T, N> {
        let ([sign], []) = self.of_each([v], [], &[]);
        sign
    }

    /// `sgn(v)` of several velocities, and sine and cosine of those angles (rad) that are `wanted`: side by side, where the machine can.
    #[inline(always)]
    pub fn of_each<const N: usize, const K: usize, const A: usize>(
        &self,
        v: [&SVector<T, N>; K],
        angles: [T; A],
        wanted: &[bool; A],
    ) -> ([SVector<T, N>; K], [(T, T); A]) {
        // Joint by joint: a joint's velocities are alike, and their tangents ±1 together, so that none of them is computed.
        let mut sign = [[T::zero(); K]; N];
        for k in 0..K {
            for i in 0..N {
                sign[i][k] = match *self {
                    Self::True => v[k][i].sign(),
                    Self::Tanh { inverse_width } => v[k][i] * inverse_width,
                };
            }
        }
        let sines = match self {
            Self::Tanh { .. } => T::tanh_and_sin_cos(sign.as_flattened_mut(), angles, wanted),
            Self::True => T::tanh_and_sin_cos(&mut [], angles, wanted),
        };
        let mut vectors = [SVector::<T, N>::zeros(); K];
        for k in 0..K {
            for i in 0..N {
                vectors[k][i] = sign[i][k];
            }
        }
        (vectors, sines)
    }
}

/// A robot with known parameters θ, to be driven by torques: the plant of paper eq. (1).
#[derive(Debug, Clone, Copy)]
pub struct Plant<R, T, const N: usize, const P: usize> {
    /// True parameters, SI units.
    pub theta: SVector<T, P>,
    /// How friction's sign is treated, in the plant and in the controller's model alike.
    pub friction_sign: FrictionSign<T>,
    robot: PhantomData<R>,
}

impl<R, T, const N: usize, const P: usize> Plant<R, T, N, P>
where
    R: Robot<N, P>,
    T: Scalar,
{
    /// A plant with parameters `theta`.
    pub fn new(theta: SVector<T, P>, friction_sign: FrictionSign<T>) -> Self {
        Self { theta, friction_sign, robot: PhantomData }
    }

    /// Forward dynamics `q̈ = H(q)⁻¹ (τ − C(q, q̇) q̇ − D q̇ − F_c sgn(q̇) − g(q))`, rad/s². Source: paper eq. (1).
    #[inline(always)]
    pub fn acceleration(
        &self,
        geometry: &R::Geometry<T>,
        velocity: &SVector<T, N>,
        sign_velocity: &SVector<T, N>,
        torque: &SVector<T, N>,
    ) -> SVector<T, N> {
        let (inertia, bias) = R::inertia_and_bias(geometry, &self.theta, velocity, sign_velocity);
        factorize(&inertia, &R::INERTIA_LIVE).solve(torque - bias)
    }

    /// Inverse dynamics `τ = H(q) q̈ + C(q, q̇) q̇ + D q̇ + F_c sgn(q̇) + g(q)`, N·m. Source: paper eq. (1).
    pub fn torque(
        &self,
        geometry: &R::Geometry<T>,
        velocity: &SVector<T, N>,
        acceleration: &SVector<T, N>,
    ) -> SVector<T, N> {
        let sign = self.friction_sign.of(velocity);
        let (inertia, bias) = R::inertia_and_bias(geometry, &self.theta, velocity, &sign);
        inertia * acceleration + bias
    }
}

/// Whether the inertia matrix is positive definite all over the workspace for parameters `theta`, as far as 2000 well-spread
/// configurations tell, also after `less` (kg·m²) is taken off its diagonal: the pivots of `L D Lᵀ` are positive. Source: paper property 2.1.
pub fn has_positive_inertia<R: Robot<N, P>, const N: usize, const P: usize>(
    theta: &SVector<f64, P>,
    less: &SVector<f64, N>,
) -> bool {
    const CONFIGURATIONS: u32 = 2000;
    // Multiples of irrational numbers fill the torus evenly.
    const STRIDES: [f64; 6] =
        [0.819_172_513, 0.671_043_606, 0.549_700_478, 0.450_299_522, 0.368_872_763, 0.302_169_483];
    (0..CONFIGURATIONS).all(|n| {
        let q = SVector::<f64, N>::from_fn(|i, _| {
            let turns = f64::from(n) * STRIDES[i % STRIDES.len()];
            (turns - turns.floor()) * std::f64::consts::TAU
        });
        let still = SVector::<f64, N>::zeros();
        let (inertia, _) = R::inertia_and_bias(&R::geometry(&q), theta, &still, &still);
        factorize(&(inertia - SMatrix::from_diagonal(less)), &R::INERTIA_LIVE).pivots.iter().all(|pivot| *pivot > 0.0)
    })
}

/// `A = L D Lᵀ`.
pub(crate) struct Factors<T, const N: usize> {
    /// L below its unit diagonal; the rest is left over from A.
    lower: SMatrix<T, N, N>,
    /// Diagonal of D; all positive exactly where A is positive definite.
    pub pivots: SVector<T, N>,
    inverse_pivots: SVector<T, N>,
    /// Which entries of L can differ from zero.
    live: &'static [[bool; N]; N],
}

/// Factors a symmetric matrix: no square root, no pivoting. `live` says which entries of L can differ from zero; the others
/// cost nothing, and nobody waits for them.
#[inline(always)]
pub(crate) fn factorize<T: Scalar, const N: usize>(
    a: &SMatrix<T, N, N>,
    live: &'static [[bool; N]; N],
) -> Factors<T, N> {
    let mut lower = *a;
    let mut pivots = SVector::<T, N>::zeros();
    let mut inverse_pivots = SVector::<T, N>::zeros();
    for j in 0..N {
        pivots[j] = a[(j, j)];
        for k in 0..j {
            if live[j][k] {
                let ld = lower[(j, k)] * pivots[k];
                pivots[j] -= lower[(j, k)] * ld;
            }
        }
        inverse_pivots[j] = T::one() / pivots[j];
        for i in j + 1..N {
            if live[i][j] {
                let mut sum = a[(i, j)];
                for k in 0..j {
                    if live[i][k] && live[j][k] {
                        sum -= lower[(i, k)] * lower[(j, k)] * pivots[k];
                    }
                }
                lower[(i, j)] = sum * inverse_pivots[j];
            }
        }
    }
    Factors { lower, pivots, inverse_pivots, live }
}

/// Solves `A x = b` for symmetric positive definite `A` by `L D Lᵀ`: no failure path
/// (an indefinite `A` gives large or non-finite numbers, which the simulation reports as divergence).
#[inline(always)]
pub fn solve_symmetric<T: Scalar, const N: usize>(a: &SMatrix<T, N, N>, b: SVector<T, N>) -> SVector<T, N> {
    factorize(a, &[[true; N]; N]).solve(b)
}

impl<T: Scalar, const N: usize> Factors<T, N> {
    /// Solves `A x = b`.
    #[inline(always)]
    pub fn solve(&self, b: SVector<T, N>) -> SVector<T, N> {
        let Self { lower: l, inverse_pivots, live, .. } = self;
        let mut x = b;
        for i in 0..N {
            for k in 0..i {
                if live[i][k] {
                    let known = x[k];
                    x[i] -= l[(i, k)] * known;
                }
            }
        }
        for i in (0..N).rev() {
            x[i] *= inverse_pivots[i];
            for k in i + 1..N {
                if live[k][i] {
                    let known = x[k];
                    x[i] -= l[(k, i)] * known;
                }
            }
        }
        x
    }
}
