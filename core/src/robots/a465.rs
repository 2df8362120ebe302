//! CRS A465, first three joints: the coefficient table of docs/physics.md section 1 and the rows that use it.
//!
//! Angles: q2 = 90° is the upper arm vertical, q3 is relative, `[0, 90, −90]°` is upper arm up, forearm horizontal.
//! `c2 = cos q2`, `s23 = sin(q2 + q3)` and so on. The paper cites a model it does not print; the assignment of θ1..θ7 to
//! terms is an assumption, listed in the replication report.

use super::structure::{count_entries, count_pairs, list_entries, list_pairs, pattern_to_live};
use super::{INERTIA, Parameter, Regressor, Robot, RobotData, RobotKind, TORQUE, VISCOUS};
use crate::scalar::Scalar;
use crate::sum::Sum;
use nalgebra::{SMatrix, SVector};
use std::f64::consts::{FRAC_PI_2, PI};

/// Joints of the arm that the study controls.
const N: usize = 3;
/// Parameters of its model.
const P: usize = 18;

/// The CRS A465's first three joints.
#[derive(Debug, Clone, Copy)]
pub struct CrsA465;

/// Coefficients of the inertia parameters θ1..θ10 at one configuration; docs/physics.md section 1, table.
/// `α = ½ ∂H11/∂q2`, `β = ½ ∂H11/∂q3`, `γ = ½ ∂H22/∂q3`, one of each per parameter; only entries that vary are held.
#[derive(Debug, Clone, Copy)]
pub struct Geometry<T> {
    c2: T,
    c23: T,
    h1: T,
    alpha_beta1: T,
    h3: T,
    alpha3: T,
    h4: T,
    alpha4: T,
    h5: T,
    alpha5: T,
    beta5: T,
    h22_5: T,
    h23_5: T,
    gamma5: T,
    h6: T,
    alpha_beta6: T,
    h7: T,
    alpha7: T,
    beta7: T,
    h22_7: T,
    h23_7: T,
    gamma7: T,
}

/// How a motion enters the inertia rows. Every inertia column of Y, of the momentum and of `−∂T/∂q` is the same linear
/// form in the coefficients h, α, β, h22, h23, h33, γ; only these factors differ. `None` has no part in the motion.
#[derive(Clone, Copy)]
struct Factors<T> {
    h: Option<T>,
    alpha: Option<T>,
    beta: Option<T>,
    second: Option<T>,
    third: Option<T>,
    /// Of −α in row 2, of −β in row 3.
    centrifugal: Option<T>,
    gamma2: Option<T>,
    gamma3: Option<T>,
}

/// Coefficients times factors, added in their order; only those that have a part cost anything.
#[inline(always)]
fn weighed<T: Scalar, const K: usize>(terms: [(T, Option<T>); K]) -> T {
    let mut sum = Sum::EMPTY;
    for n in 0..K {
        if let (coefficient, Some(factor)) = terms[n] {
            sum = sum.plus(coefficient * factor);
        }
    }
    sum.total(T::zero())
}

impl<T: Scalar> Factors<T> {
    const NONE: Self = Self {
        h: None,
        alpha: None,
        beta: None,
        second: None,
        third: None,
        centrifugal: None,
        gamma2: None,
        gamma3: None,
    };

    /// Of `H(q) a + C(q, u) v`.
    #[inline(always)]
    fn newton_euler(u: &SVector<T, N>, v: &SVector<T, N>, a: &SVector<T, N>) -> Self {
        Self { h: Some(a[0]), second: Some(a[1]), third: Some(a[2]), ..Self::coriolis(u, v) }
    }

    /// Of `C(q, u) v`.
    #[inline(always)]
    fn coriolis(u: &SVector<T, N>, v: &SVector<T, N>) -> Self {
        Self {
            alpha: Some(u[1] * v[0] + u[0] * v[1]),
            beta: Some(u[2] * v[0] + u[0] * v[2]),
            centrifugal: Some(-(u[0] * v[0])),
            gamma2: Some(u[2] * v[1] + (u[1] + u[2]) * v[2]),
            gamma3: Some(-(u[1] * v[1])),
            ..Self::NONE
        }
    }

    /// Of the momentum `H(q) v`.
    #[inline(always)]
    fn momentum(v: &SVector<T, N>) -> Self {
        Self { h: Some(v[0]), second: Some(v[1]), third: Some(v[2]), ..Self::NONE }
    }

    /// Of `−∂T/∂q`, `T = ½ vᵀ H(q) v`.
    #[inline(always)]
    fn kinetic_gradient(v: &SVector<T, N>) -> Self {
        Self { centrifugal: Some(-(v[0] * v[0])), gamma3: Some(-(v[1] * v[1] + v[1] * v[2])), ..Self::NONE }
    }

    #[inline(always)]
    fn row1(&self, h: T, alpha: T, beta: T) -> T {
        weighed([(h, self.h), (alpha, self.alpha), (beta, self.beta)])
    }

    #[inline(always)]
    fn row2(&self, h22: T, h23: T, alpha: T, gamma: T) -> T {
        weighed([(h22, self.second), (h23, self.third), (alpha, self.centrifugal), (gamma, self.gamma2)])
    }

    #[inline(always)]
    fn row3(&self, h23: T, beta: T, gamma: T) -> T {
        weighed([(h23, self.second), (beta, self.centrifugal), (gamma, self.gamma3)])
    }

    /// What one coefficient adds, turned by the waist's speed.
    #[inline(always)]
    fn turned(&self, coefficient: T) -> T {
        weighed([(coefficient, self.centrifugal)])
    }

    /// The ten inertia columns.
    #[inline(always)]
    fn inertia_columns(&self, g: &Geometry<T>) -> Regressor<T, N, P> {
        let zero = T::zero();
        let mut y = Regressor::<T, N, P>::zeros();
        y[(0, 0)] = self.row1(g.h1, g.alpha_beta1, g.alpha_beta1);
        y[(0, 2)] = weighed([(g.h3, self.h), (g.alpha3, self.alpha)]);
        y[(0, 3)] = weighed([(g.h4, self.h), (g.alpha4, self.alpha)]);
        y[(0, 4)] = self.row1(g.h5, g.alpha5, g.beta5);
        y[(0, 5)] = self.row1(g.h6, g.alpha_beta6, g.alpha_beta6);
        y[(0, 6)] = self.row1(g.h7, g.alpha7, g.beta7);
        y[(0, 7)] = self.h.unwrap_or(zero);
        y[(1, 0)] = self.turned(g.alpha_beta1);
        y[(1, 1)] = self.third.unwrap_or(zero);
        y[(1, 2)] = self.turned(g.alpha3);
        y[(1, 3)] = self.turned(g.alpha4);
        y[(1, 4)] = self.row2(g.h22_5, g.h23_5, g.alpha5, g.gamma5);
        y[(1, 5)] = self.turned(g.alpha_beta6);
        y[(1, 6)] = self.row2(g.h22_7, g.h23_7, g.alpha7, g.gamma7);
        y[(1, 8)] = self.second.unwrap_or(zero);
        y[(2, 0)] = self.turned(g.alpha_beta1);
        y[(2, 1)] = self.second.unwrap_or(zero);
        y[(2, 4)] = self.row3(g.h23_5, g.beta5, g.gamma5);
        y[(2, 5)] = self.turned(g.alpha_beta6);
        y[(2, 6)] = self.row3(g.h23_7, g.beta7, g.gamma7);
        y[(2, 9)] = self.third.unwrap_or(zero);
        y
    }
}

/// Adds viscous friction, Coulomb friction and gravity: θ11..θ18.
#[inline(always)]
fn add_friction_and_gravity<T: Scalar>(
    y: &mut Regressor<T, N, P>,
    g: &Geometry<T>,
    v: &SVector<T, N>,
    sign_v: &SVector<T, N>,
) {
    for i in 0..N {
        y[(i, 10 + i)] = v[i];
        y[(i, 13 + i)] = sign_v[i];
    }
    y[(1, 16)] = g.c2;
    y[(1, 17)] = g.c23;
    y[(2, 17)] = g.c23;
}

/// Pattern of the regressor: `#` may differ from zero. Columns θ1..θ18.
const PATTERN: [&[u8; P]; N] = [b"#.######..#..#....", b"#######.#..#..#.##", b"##..###..#..#..#.#"];

const LIVE: [[bool; P]; N] = pattern_to_live(&PATTERN);

/// The same of the momentum: neither centrifugal terms nor friction nor gravity.
const MOMENTUM_PATTERN: [&[u8; P]; N] = [b"#.######..........", b".#..#.#.#.........", b".#..#.#..#........"];

impl Robot<N, P> for CrsA465 {
    type Geometry<T: Scalar> = Geometry<T>;

    const LIVE: [[bool; P]; N] = LIVE;
    const MOMENTUM_LIVE: [[bool; P]; N] = pattern_to_live(&MOMENTUM_PATTERN);
    const INERTIA_LIVE: [[bool; N]; N] = pattern_to_live(&[b"#..", b".##", b".##"]);
    const ENTRIES: &'static [(usize, usize)] = &list_entries::<N, P, { count_entries(&LIVE) }>(&LIVE);
    const PAIRS: &'static [(usize, usize)] = &list_pairs::<N, P, { count_pairs(&LIVE) }>(&LIVE);
    const TURNS: [bool; N] = [false, true, true];
    const DATA: &'static RobotData = &DATA;

    #[inline(always)]
    fn geometry_of<T: Scalar>(&[_, (s2, c2), (s3, c3)]: &[(T, T); N]) -> Geometry<T> {
        let c23 = c2 * c3 - s2 * s3;
        let s23 = s2 * c3 + c2 * s3;
        let two = T::splat(2.0);
        Geometry {
            c2,
            c23,
            h1: c23 * c23,
            alpha_beta1: -s23 * c23,
            h3: two * s2 * c2,
            alpha3: c2 * c2 - s2 * s2,
            h4: c2 * c2,
            alpha4: -s2 * c2,
            h5: two * c2 * c23,
            alpha5: -(s2 * c23 + c2 * s23),
            beta5: -c2 * s23,
            h22_5: two * c3,
            h23_5: c3,
            gamma5: -s3,
            h6: two * s23 * c23,
            alpha_beta6: c23 * c23 - s23 * s23,
            h7: two * c2 * s23,
            alpha7: c2 * c23 - s2 * s23,
            beta7: c2 * c23,
            h22_7: two * s3,
            h23_7: s3,
            gamma7: c3,
        }
    }

    #[inline(always)]
    fn regressor<T: Scalar>(
        geometry: &Geometry<T>,
        u: &SVector<T, N>,
        v: &SVector<T, N>,
        a: &SVector<T, N>,
        sign_v: &SVector<T, N>,
    ) -> Regressor<T, N, P> {
        let mut y = Factors::newton_euler(u, v, a).inertia_columns(geometry);
        add_friction_and_gravity(&mut y, geometry, v, sign_v);
        y
    }

    #[inline(always)]
    fn momentum_regressor<T: Scalar>(geometry: &Geometry<T>, v: &SVector<T, N>) -> Regressor<T, N, P> {
        Factors::momentum(v).inertia_columns(geometry)
    }

    #[inline(always)]
    fn balance_regressor<T: Scalar>(
        geometry: &Geometry<T>,
        v: &SVector<T, N>,
        sign_v: &SVector<T, N>,
    ) -> Regressor<T, N, P> {
        let mut y = Factors::kinetic_gradient(v).inertia_columns(geometry);
        add_friction_and_gravity(&mut y, geometry, v, sign_v);
        y
    }

    #[inline(always)]
    fn inertia_and_bias<T: Scalar>(
        g: &Geometry<T>,
        th: &SVector<T, P>,
        v: &SVector<T, N>,
        sign_v: &SVector<T, N>,
    ) -> (SMatrix<T, N, N>, SVector<T, N>) {
        let zero = T::zero();
        // The columns weighed by θ: one column with every coefficient.
        let h11 = th[7] + th[0] * g.h1 + th[2] * g.h3 + th[3] * g.h4 + th[4] * g.h5 + th[5] * g.h6 + th[6] * g.h7;
        let shared = th[0] * g.alpha_beta1 + th[5] * g.alpha_beta6;
        let alpha = shared + th[2] * g.alpha3 + th[3] * g.alpha4 + th[4] * g.alpha5 + th[6] * g.alpha7;
        let beta = shared + th[4] * g.beta5 + th[6] * g.beta7;
        let h22 = th[8] + th[4] * g.h22_5 + th[6] * g.h22_7;
        let h23 = th[1] + th[4] * g.h23_5 + th[6] * g.h23_7;
        let h33 = th[9];
        let gamma = th[4] * g.gamma5 + th[6] * g.gamma7;
        let inertia = SMatrix::<T, N, N>::new(h11, zero, zero, zero, h22, h23, zero, h23, h33);

        let coriolis = Factors::coriolis(v, v);
        let forearm = th[17] * g.c23;
        let mut bias = SVector::<T, N>::new(
            coriolis.row1(h11, alpha, beta),
            coriolis.row2(h22, h23, alpha, gamma) + th[16] * g.c2 + forearm,
            coriolis.row3(h23, beta, gamma) + forearm,
        );
        for i in 0..N {
            bias[i] += th[10 + i] * v[i] + th[13 + i] * sign_v[i];
        }
        (inertia, bias)
    }
}

const fn parameter(
    symbol: &'static str,
    unit: &'static str,
    meaning: &'static str,
    value: f64,
    inertial: bool,
) -> Parameter {
    Parameter { symbol, unit, meaning, value, inertial }
}

/// Source: paper sections 2.1 and 4.1; lengths and limits from public descriptions of the arm.
static DATA: RobotData = RobotData {
    kind: RobotKind::CrsA465,
    id: "crs_a465",
    name: "CRS A465, first three joints",
    joints: &["waist", "shoulder", "elbow"],
    parameters: &[
        parameter("θ1", INERTIA, "inertia, weighs cos²(q2+q3) in H11", 0.0055, true),
        parameter("θ2", INERTIA, "inertia, coupling of joints 2 and 3", 0.008, true),
        parameter("θ3", INERTIA, "inertia, weighs sin 2q2 in H11", 0.0024, true),
        parameter("θ4", INERTIA, "inertia, weighs cos² q2 in H11", 0.0118, true),
        parameter("θ5", INERTIA, "inertia, first moment along the forearm", 0.0041, true),
        parameter("θ6", INERTIA, "inertia, weighs sin 2(q2+q3) in H11", 9e-4, true),
        parameter("θ7", INERTIA, "inertia, first moment across the forearm", 7e-4, true),
        parameter("θ8", INERTIA, "inertia about joint 1, constant part", 2.0007, true),
        parameter("θ9", INERTIA, "inertia about joint 2, constant part", 11.80, true),
        parameter("θ10", INERTIA, "inertia about joint 3", 2.80, true),
        parameter("θ11", VISCOUS, "viscous friction, joint 1", 25.0, false),
        parameter("θ12", VISCOUS, "viscous friction, joint 2", 35.0, false),
        parameter("θ13", VISCOUS, "viscous friction, joint 3", 36.0, false),
        parameter("θ14", TORQUE, "Coulomb friction, joint 1", 0.20, false),
        parameter("θ15", TORQUE, "Coulomb friction, joint 2", 2.50, false),
        parameter("θ16", TORQUE, "Coulomb friction, joint 3", 2.50, false),
        parameter("θ17", TORQUE, "gravity, upper arm", 22.0, false),
        parameter("θ18", TORQUE, "gravity, forearm", 11.0, false),
    ],
    // r Ka / Ra = 100 × 0.1424 / 0.84
    torque_per_volt_nm: 100.0 * 0.1424 / 0.84,
    supply_v: 24.0,
    joint_limit_rad: &[175.0 * PI / 180.0, 90.0 * PI / 180.0, 110.0 * PI / 180.0],
    joint_zero_rad: &[0.0, FRAC_PI_2, 0.0],
    effort_limit_nm: &[39.5, 66.08, 39.5],
    link_lengths_m: [0.3302, 0.3048, 0.3302, 0.0762],
};
