//! One driven joint: a pendulum with inertia, viscous and Coulomb friction, and gravity; for first lessons.
//!
//! `θ1 q̈ + θ2 q̇ + θ3 sgn(q̇) + θ4 sin q = τ`; q = 0 hangs straight down. Without friction and torque its period is
//! `4 √(θ1/θ4) K(sin(q0/2))`, K the complete elliptic integral of the first kind.

use super::structure::{count_entries, count_pairs, list_entries, list_pairs, pattern_to_live};
use super::{INERTIA, Parameter, Regressor, Robot, RobotData, RobotKind, TORQUE, VISCOUS};
use crate::scalar::Scalar;
use nalgebra::{SMatrix, SVector};
use std::f64::consts::PI;

/// Joints.
const N: usize = 1;
/// Parameters.
const P: usize = 4;

/// The pendulum.
#[derive(Debug, Clone, Copy)]
pub struct Pendulum;

/// What the dynamics need to know of the angle.
#[derive(Debug, Clone, Copy)]
pub struct Geometry<T> {
    sin: T,
}

const LIVE: [[bool; P]; N] = pattern_to_live(&[b"####"]);

impl Robot<N, P> for Pendulum {
    type Geometry<T: Scalar> = Geometry<T>;

    const LIVE: [[bool; P]; N] = LIVE;
    const ENTRIES: &'static [(usize, usize)] = &list_entries::<N, P, { count_entries(&LIVE) }>(&LIVE);
    const PAIRS: &'static [(usize, usize)] = &list_pairs::<N, P, { count_pairs(&LIVE) }>(&LIVE);
    const DATA: &'static RobotData = &DATA;

    #[inline(always)]
    fn geometry_of<T: Scalar>(&[(sin, _)]: &[(T, T); N]) -> Geometry<T> {
        Geometry { sin }
    }

    #[inline(always)]
    fn regressor<T: Scalar>(
        geometry: &Geometry<T>,
        _u: &SVector<T, N>,
        v: &SVector<T, N>,
        a: &SVector<T, N>,
        sign_v: &SVector<T, N>,
    ) -> Regressor<T, N, P> {
        Regressor::<T, N, P>::new(a[0], v[0], sign_v[0], geometry.sin)
    }

    #[inline(always)]
    fn momentum_regressor<T: Scalar>(_geometry: &Geometry<T>, v: &SVector<T, N>) -> Regressor<T, N, P> {
        let zero = T::zero();
        Regressor::<T, N, P>::new(v[0], zero, zero, zero)
    }

    #[inline(always)]
    fn balance_regressor<T: Scalar>(
        geometry: &Geometry<T>,
        v: &SVector<T, N>,
        sign_v: &SVector<T, N>,
    ) -> Regressor<T, N, P> {
        Regressor::<T, N, P>::new(T::zero(), v[0], sign_v[0], geometry.sin)
    }

    #[inline(always)]
    fn inertia_and_bias<T: Scalar>(
        g: &Geometry<T>,
        th: &SVector<T, P>,
        v: &SVector<T, N>,
        sign_v: &SVector<T, N>,
    ) -> (SMatrix<T, N, N>, SVector<T, N>) {
        let bias = th[1] * v[0] + th[2] * sign_v[0] + th[3] * g.sin;
        (SMatrix::<T, N, N>::new(th[0]), SVector::<T, N>::new(bias))
    }
}

/// A bob of 1 kg at 0.5 m, with g = 9.81 m/s². All numbers are chosen.
static DATA: RobotData = RobotData {
    kind: RobotKind::Pendulum,
    id: "pendulum",
    name: "Pendulum",
    joints: &["pivot"],
    parameters: &[
        Parameter { symbol: "θ1", unit: INERTIA, meaning: "inertia about the pivot", value: 0.25, inertial: true },
        Parameter { symbol: "θ2", unit: VISCOUS, meaning: "viscous friction", value: 0.1, inertial: false },
        Parameter { symbol: "θ3", unit: TORQUE, meaning: "Coulomb friction", value: 0.2, inertial: false },
        Parameter { symbol: "θ4", unit: TORQUE, meaning: "gravity", value: 0.5 * 9.81, inertial: false },
    ],
    torque_per_volt_nm: 1.0,
    supply_v: 24.0,
    joint_limit_rad: &[PI],
    joint_zero_rad: &[0.0],
    effort_limit_nm: &[12.0],
    link_lengths_m: [0.6, 0.5, 0.0, 0.0],
};
