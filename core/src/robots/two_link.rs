//! The planar two-link arm of Slotine and Li, *Applied Nonlinear Control* (1991), section 9.2, in a vertical plane.
//!
//! q1 is the first link's angle above the horizontal, q2 the second's relative to it. θ1..θ4 are the book's a1..a4. Friction
//! and gravity are added here: with their factors in `theta_scale` at zero it is the book's arm, horizontal and smooth.
//! `c1 = cos q1`, `s12 = sin(q1 + q2)` and so on.

use super::structure::{count_entries, count_pairs, list_entries, list_pairs, pattern_to_live};
use super::{INERTIA, Parameter, Regressor, Robot, RobotData, RobotKind, TORQUE, VISCOUS};
use crate::scalar::Scalar;
use nalgebra::{SMatrix, SVector};
use std::f64::consts::PI;

/// Joints.
const N: usize = 2;
/// Parameters.
const P: usize = 11;

/// The two-link arm.
#[derive(Debug, Clone, Copy)]
pub struct TwoLink;

/// What the dynamics need to know of the angles.
#[derive(Debug, Clone, Copy)]
pub struct Geometry<T> {
    c1: T,
    c2: T,
    s2: T,
    c12: T,
    s12: T,
}

/// How a motion enters the inertia columns: the same linear form in c2 and s2 serves Y, the momentum and `−∂T/∂q`.
struct Factors<T> {
    first: T,
    second: T,
    /// Weighs `−h` in row 1, `h = θ3 s2 − θ4 c2`.
    cross: T,
    /// Weighs `h` in row 2.
    square: T,
}

impl<T: Scalar> Factors<T> {
    /// Of `H(q) a + C(q, u) v`, `C = [−h u2, −h (u1 + u2); h u1, 0]`. Source: Slotine and Li, eq. (9.26) onwards.
    #[inline(always)]
    fn newton_euler(u: &SVector<T, N>, v: &SVector<T, N>, a: &SVector<T, N>) -> Self {
        Self { first: a[0], second: a[1], cross: u[1] * v[0] + u[0] * v[1] + u[1] * v[1], square: u[0] * v[0] }
    }

    /// Of the momentum `H(q) v`.
    #[inline(always)]
    fn momentum(v: &SVector<T, N>) -> Self {
        Self { first: v[0], second: v[1], cross: T::zero(), square: T::zero() }
    }

    /// Of `−∂T/∂q`, `T = ½ vᵀ H(q) v`: its second entry is `h (v1² + v1 v2)`.
    #[inline(always)]
    fn kinetic_gradient(v: &SVector<T, N>) -> Self {
        let zero = T::zero();
        Self { first: zero, second: zero, cross: zero, square: v[0] * v[0] + v[0] * v[1] }
    }

    /// The four inertia columns.
    #[inline(always)]
    fn inertia_columns(&self, g: &Geometry<T>) -> Regressor<T, N, P> {
        let mut y = Regressor::<T, N, P>::zeros();
        let coupled = self.first + self.first + self.second;
        y[(0, 0)] = self.first;
        y[(0, 1)] = self.second;
        y[(0, 2)] = g.c2 * coupled - g.s2 * self.cross;
        y[(0, 3)] = g.s2 * coupled + g.c2 * self.cross;
        y[(1, 1)] = self.first + self.second;
        y[(1, 2)] = g.c2 * self.first + g.s2 * self.square;
        y[(1, 3)] = g.s2 * self.first - g.c2 * self.square;
        y
    }
}

/// Adds viscous friction, Coulomb friction and gravity: θ5..θ11.
#[inline(always)]
fn add_friction_and_gravity<T: Scalar>(
    y: &mut Regressor<T, N, P>,
    g: &Geometry<T>,
    v: &SVector<T, N>,
    sign_v: &SVector<T, N>,
) {
    for i in 0..N {
        y[(i, 4 + i)] = v[i];
        y[(i, 6 + i)] = sign_v[i];
        y[(i, 9)] = g.c12;
        y[(i, 10)] = g.s12;
    }
    y[(0, 8)] = g.c1;
}

const LIVE: [[bool; P]; N] = pattern_to_live(&[b"#####.#.###", b".###.#.#.##"]);

impl Robot<N, P> for TwoLink {
    type Geometry<T: Scalar> = Geometry<T>;

    const LIVE: [[bool; P]; N] = LIVE;
    const ENTRIES: &'static [(usize, usize)] = &list_entries::<N, P, { count_entries(&LIVE) }>(&LIVE);
    const PAIRS: &'static [(usize, usize)] = &list_pairs::<N, P, { count_pairs(&LIVE) }>(&LIVE);
    const DATA: &'static RobotData = &DATA;

    #[inline(always)]
    fn geometry_of<T: Scalar>(&[(s1, c1), (s2, c2)]: &[(T, T); N]) -> Geometry<T> {
        Geometry { c1, c2, s2, c12: c1 * c2 - s1 * s2, s12: s1 * c2 + c1 * s2 }
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
        let bend = th[2] * g.c2 + th[3] * g.s2;
        let h12 = th[1] + bend;
        let inertia = SMatrix::<T, N, N>::new(th[0] + bend + bend, h12, h12, th[1]);
        let h = th[2] * g.s2 - th[3] * g.c2;
        let outer = th[9] * g.c12 + th[10] * g.s12;
        let mut bias = SVector::<T, N>::new(
            th[8] * g.c1 + outer - h * (v[1] * v[0] + v[0] * v[1] + v[1] * v[1]),
            outer + h * (v[0] * v[0]),
        );
        for i in 0..N {
            bias[i] += th[4 + i] * v[i] + th[6 + i] * sign_v[i];
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

const SQRT_3: f64 = 1.732_050_807_568_877_2;

/// `m1 = 1 kg`, `l1 = 1 m`, `lc1 = 0.5 m`, `I1 = 0.12 kg·m²`, `me = 2 kg`, `lce = 0.6 m`, `Ie = 0.25 kg·m²`, `δe = 30°`, which
/// turns the second body's centre back: it is at `q1 + q2 − δe`.
/// Source: Slotine and Li, example 9.1 and 9.2. Gravity follows from the same numbers with g = 9.81 m/s²; friction, the
/// second link's length, the post it stands on, limits and motors are chosen, for the book has none.
static DATA: RobotData = RobotData {
    kind: RobotKind::TwoLink,
    id: "two_link",
    name: "Two-link planar arm",
    joints: &["shoulder", "elbow"],
    parameters: &[
        parameter("θ1", INERTIA, "inertia about joint 1, constant part", 3.34, true),
        parameter("θ2", INERTIA, "inertia about joint 2", 0.97, true),
        parameter("θ3", INERTIA, "inertia, first moment along the second link", 0.6 * SQRT_3, true),
        parameter("θ4", INERTIA, "inertia, first moment across the second link", 0.6, true),
        parameter("θ5", VISCOUS, "viscous friction, joint 1", 2.0, false),
        parameter("θ6", VISCOUS, "viscous friction, joint 2", 1.0, false),
        parameter("θ7", TORQUE, "Coulomb friction, joint 1", 1.0, false),
        parameter("θ8", TORQUE, "Coulomb friction, joint 2", 0.5, false),
        parameter("θ9", TORQUE, "gravity, first link with the second at its end", 2.5 * 9.81, false),
        parameter("θ10", TORQUE, "gravity along the second link", 0.6 * SQRT_3 * 9.81, false),
        parameter("θ11", TORQUE, "gravity across the second link", 0.6 * 9.81, false),
    ],
    torque_per_volt_nm: 20.0,
    supply_v: 24.0,
    joint_limit_rad: &[PI, 160.0 * PI / 180.0],
    joint_zero_rad: &[0.0, 0.0],
    effort_limit_nm: &[400.0, 150.0],
    link_lengths_m: [0.5, 1.0, 1.0, 0.0],
};
