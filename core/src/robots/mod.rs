//! What a robot arm is to this crate: its geometry, its dynamics linear in the parameters, and its data.
//!
//! A robot states its regressor once; the controller, the plant and the filters all read the same equations.
//! `N` joints, `P` parameters. Each robot also states which regressor entries can ever differ from zero, so that nothing
//! else is stored, integrated or multiplied.

mod a465;
mod inverse_kinematics;
mod kinematics;
mod payload;
mod pendulum;
mod structure;
mod symmetric;
mod two_link;

pub use a465::CrsA465;
pub use inverse_kinematics::Bend;
pub use kinematics::{ArmPoints, Kinematics, Point, distance_m};
pub use payload::payload_parameters;
pub use pendulum::Pendulum;
pub use structure::{count_entries, count_pairs, list_entries, list_pairs, pattern_to_live};
pub use symmetric::{NONE, SymmetricLayout};
pub use two_link::TwoLink;

use crate::scalar::Scalar;
use nalgebra::{SMatrix, SVector};

/// Regressor: `N` joint torques by `P` parameters; N·m per unit of each parameter.
pub type Regressor<T, const N: usize, const P: usize> = SMatrix<T, N, P>;

/// A serial arm with `N` joints whose dynamics are linear in `P` parameters θ:
/// `H(q) q̈ + C(q, q̇) q̇ + D q̇ + F_c sgn(q̇) + g(q) = Y θ = τ`. Source: paper eq. (1), (2).
pub trait Robot<const N: usize, const P: usize>: Send + Sync + 'static {
    /// Everything that depends on the joint angles alone; computed once per state and shared by plant, controller, filter.
    type Geometry<T: Scalar>: Copy + Send + Sync;

    /// Which entries of the regressor can differ from zero.
    const LIVE: [[bool; P]; N];
    /// Which of these are live in the momentum's regressor.
    const MOMENTUM_LIVE: [[bool; P]; N] = Self::LIVE;
    /// Which entries of the inertia matrix can differ from zero, and so those of L in `H = L D Lᵀ`.
    const INERTIA_LIVE: [[bool; N]; N] = [[true; N]; N];
    /// The live entries as (row, column), row by row.
    const ENTRIES: &'static [(usize, usize)];
    /// Pairs `i <= j` of parameters that share a row: the upper triangle of `YᵀY` that can differ from zero.
    const PAIRS: &'static [(usize, usize)];
    /// Names, units, data for people and limits.
    const DATA: &'static RobotData;

    /// Joints on whose angles the geometry depends.
    const TURNS: [bool; N] = [true; N];

    /// Geometry at joint angles `q` (rad).
    #[inline(always)]
    fn geometry<T: Scalar>(q: &SVector<T, N>) -> Self::Geometry<T> {
        Self::geometry_of(&T::tanh_and_sin_cos(&mut [], (*q).into(), &Self::TURNS))
    }
    /// Geometry, given `(sin q_i, cos q_i)` of each joint that counts ([`Self::TURNS`]).
    fn geometry_of<T: Scalar>(sines: &[(T, T); N]) -> Self::Geometry<T>;

    /// Regressor `Y(q, u, v, a)` with `Y θ = H(q) a + C(q, u) v + D v + F_c sgn(v) + g(q)`.
    /// `sign_v` is `sgn(v)`, regularised as the caller wishes. Units: rad/s, rad/s²; N·m per unit of θ. Source: paper eq. (2).
    fn regressor<T: Scalar>(
        geometry: &Self::Geometry<T>,
        u: &SVector<T, N>,
        v: &SVector<T, N>,
        a: &SVector<T, N>,
        sign_v: &SVector<T, N>,
    ) -> Regressor<T, N, P>;

    /// Regressor of the momentum: `P(q, v) θ = H(q) v`. N·m·s per unit of θ.
    fn momentum_regressor<T: Scalar>(geometry: &Self::Geometry<T>, v: &SVector<T, N>) -> Regressor<T, N, P>;

    /// Regressor of what changes the momentum beside τ, sign turned: `B(q, v) θ = −∂T/∂q + D v + F_c sgn(v) + g(q)`,
    /// `T = ½ vᵀ H v`; so that `d/dt (P θ) + B θ = τ` along any motion. N·m per unit of θ.
    fn balance_regressor<T: Scalar>(
        geometry: &Self::Geometry<T>,
        v: &SVector<T, N>,
        sign_v: &SVector<T, N>,
    ) -> Regressor<T, N, P>;

    /// Inertia matrix `H(q)` (kg·m²) and everything else that θ weighs at velocity `v`:
    /// `b = C(q, v) v + D v + F_c sgn(v) + g(q)` (N·m), without passing through a regressor.
    fn inertia_and_bias<T: Scalar>(
        geometry: &Self::Geometry<T>,
        theta: &SVector<T, P>,
        v: &SVector<T, N>,
        sign_v: &SVector<T, N>,
    ) -> (SMatrix<T, N, N>, SVector<T, N>);
}

/// One entry of a robot's parameter vector.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Parameter {
    /// Name as printed: `θ1`.
    pub symbol: &'static str,
    /// SI unit.
    pub unit: &'static str,
    /// What it stands for.
    pub meaning: &'static str,
    /// The nominal value: the paper's true one for the A465.
    pub value: f64,
    /// Whether it enters the inertia matrix, which must stay positive.
    pub inertial: bool,
}

const INERTIA: &str = "kg·m²";
const VISCOUS: &str = "N·m·s";
const TORQUE: &str = "N·m";

/// Which robot: the compiler names every place that must know all of them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RobotKind {
    /// [`CrsA465`].
    CrsA465,
    /// [`TwoLink`].
    TwoLink,
    /// [`Pendulum`].
    Pendulum,
}

/// A robot's facts for people, pictures and limits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RobotData {
    /// Which robot.
    pub kind: RobotKind,
    /// Identifier in scenarios: `crs_a465`.
    pub id: &'static str,
    /// Full name.
    pub name: &'static str,
    /// Joint names, base to tip; their number is the number of joints.
    pub joints: &'static [&'static str],
    /// The parameter vector.
    pub parameters: &'static [Parameter],
    /// Torque per motor volt, N·m/V: gear ratio × torque constant / armature resistance. Source: paper section 2.1.
    pub torque_per_volt_nm: f64,
    /// Motor supply, V (a replacement controller's; unverified).
    pub supply_v: f64,
    /// Joint limits about the maker's zero, rad.
    pub joint_limit_rad: &'static [f64],
    /// Joint angle at the maker's zero (arm straight up), rad.
    pub joint_zero_rad: &'static [f64],
    /// Joint effort limit, N·m (one public description; unverified).
    pub effort_limit_nm: &'static [f64],
    /// Base to shoulder, shoulder to elbow, elbow to wrist, wrist to flange, m.
    pub link_lengths_m: [f64; 4],
}

impl RobotData {
    /// Motor voltage for a joint torque, V: `v = τ Ra / (r Ka)`. Source: paper eq. (1), section 2.1.
    pub fn voltage_v(&self, torque_nm: f64) -> f64 {
        torque_nm / self.torque_per_volt_nm
    }

    /// Number of joints.
    pub fn joint_count(&self) -> usize {
        self.joints.len()
    }

    /// Number of parameters.
    pub fn parameter_count(&self) -> usize {
        self.parameters.len()
    }

    /// Sizes in which parameters are compared: their nominal magnitudes, or 1 where those are zero.
    pub fn parameter_sizes(&self) -> Vec<f64> {
        self.parameters.iter().map(|p| if p.value == 0.0 { 1.0 } else { p.value.abs() }).collect()
    }

    /// The parameter vector's true values.
    pub fn theta(&self) -> Vec<f64> {
        self.parameters.iter().map(|p| p.value).collect()
    }
}

/// Every robot that a scenario can name.
pub const ROBOTS: &[&RobotData] =
    &[<CrsA465 as Robot<3, 18>>::DATA, <TwoLink as Robot<2, 11>>::DATA, <Pendulum as Robot<1, 4>>::DATA];

/// `for_robot!(data, R, N, P => expression)` evaluates the expression with the type, the number of joints and the number of
/// parameters of the robot that `data` describes.
macro_rules! for_robot {
    (@as $type:ident, $joints:literal, $parameters:literal, $robot:ident, $n:ident, $p:ident, $body:expr) => {{
        #[allow(dead_code, reason = "not every expression needs all three")]
        type $robot = $crate::robots::$type;
        #[allow(dead_code, reason = "as above")]
        const $n: usize = $joints;
        #[allow(dead_code, reason = "as above")]
        const $p: usize = $parameters;
        $body
    }};
    ($data:expr, $robot:ident, $n:ident, $p:ident => $body:expr) => {
        match $data.kind {
            $crate::robots::RobotKind::CrsA465 => for_robot!(@as CrsA465, 3, 18, $robot, $n, $p, $body),
            $crate::robots::RobotKind::TwoLink => for_robot!(@as TwoLink, 2, 11, $robot, $n, $p, $body),
            $crate::robots::RobotKind::Pendulum => for_robot!(@as Pendulum, 1, 4, $robot, $n, $p, $body),
        }
    };
}
pub(crate) use for_robot;

/// The robot that a scenario calls `id`.
pub fn robot(id: &str) -> Option<&'static RobotData> {
    ROBOTS.iter().copied().find(|robot| robot.id == id)
}
