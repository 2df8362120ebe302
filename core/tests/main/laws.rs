//! Laws of mechanics on random states: they hold for any correct model, whatever the numbers.
//!
//! Derivatives along a motion come from dual numbers, so the identities are exact up to rounding.

use crate::dual::Dual;
use adaptarm_core::dynamics::{FrictionSign, Plant, solve_symmetric};
use adaptarm_core::regressor::{gradient, model_torque};
use adaptarm_core::robots::{CrsA465, Robot};
use adaptarm_core::scalar::Scalar;
use nalgebra::{Matrix3, SMatrix, SVector, Vector3};
use proptest::prelude::*;
use std::f64::consts::PI;

type Arm = CrsA465;
type Theta = SVector<f64, 18>;

fn theta() -> Theta {
    Theta::from_vec(Arm::DATA.theta())
}

fn angles() -> impl Strategy<Value = Vector3<f64>> {
    prop::array::uniform3(-PI..PI).prop_map(Vector3::from)
}

fn vectors(limit: f64) -> impl Strategy<Value = Vector3<f64>> {
    prop::array::uniform3(-limit..limit).prop_map(Vector3::from)
}

/// H(q) and bias at velocity v; `T` lets q be a motion.
fn inertia_and_bias<T: Scalar>(q: &SVector<T, 3>, v: &SVector<T, 3>) -> (SMatrix<T, 3, 3>, SVector<T, 3>) {
    let theta = theta().map(T::splat);
    let sign = FrictionSign::from_width(0.01).of(v);
    Arm::inertia_and_bias(&Arm::geometry(q), &theta, v, &sign)
}

fn inertia(q: &Vector3<f64>) -> Matrix3<f64> {
    inertia_and_bias(q, &Vector3::zeros()).0
}

/// `Ḣ` along `q̇ = v`.
fn inertia_rate(q: &Vector3<f64>, v: &Vector3<f64>) -> Matrix3<f64> {
    let motion = SVector::from_fn(|i, _| Dual::new(q[i], v[i]));
    inertia_and_bias(&motion, &SVector::from_element(Dual::splat(0.0))).0.map(|h| h.slope)
}

/// `C(q, u) v`: the regressor's torque without acceleration, less friction and gravity.
fn coriolis(q: &Vector3<f64>, u: &Vector3<f64>, v: &Vector3<f64>) -> Vector3<f64> {
    let y = Arm::regressor(&Arm::geometry(q), u, v, &Vector3::zeros(), &Vector3::zeros());
    let mut theta = theta();
    theta.as_mut_slice()[10..].fill(0.0);
    model_torque::<Arm, f64, 3, 18>(&y, theta.as_slice())
}

/// An independent model: H as docs/physics.md section 1 prints it, C from Christoffel symbols of its partial derivatives,
/// gravity from the potential `θ17 sin q2 + θ18 sin(q2 + q3)`.
fn independent_torque(q: &Vector3<f64>, v: &Vector3<f64>, a: &Vector3<f64>) -> Vector3<f64> {
    fn h(q: [Dual; 3], th: &Theta) -> [[Dual; 3]; 3] {
        let s = Dual::splat;
        let (s2, c2) = q[1].sin_cos();
        let (s3, c3) = q[2].sin_cos();
        let (s23, c23) = (q[1] + q[2]).sin_cos();
        let sin_2q2 = (q[1] + q[1]).sin_cos().0;
        let sin_2q23 = (q[1] + q[2] + q[1] + q[2]).sin_cos().0;
        let _ = s2;
        let h11 = s(th[7])
            + s(th[0]) * c23 * c23
            + s(th[3]) * c2 * c2
            + s(2.0 * th[4]) * c2 * c23
            + s(th[2]) * sin_2q2
            + s(th[5]) * sin_2q23
            + s(2.0 * th[6]) * c2 * s23;
        let h22 = s(th[8]) + s(2.0 * th[4]) * c3 + s(2.0 * th[6]) * s3;
        let h23 = s(th[1]) + s(th[4]) * c3 + s(th[6]) * s3;
        let zero = s(0.0);
        [[h11, zero, zero], [zero, h22, h23], [zero, h23, s(th[9])]]
    }
    let th = theta();
    // dh[k][i][j] = ∂H_ij / ∂q_k
    let dh: Vec<_> = (0..3)
        .map(|k| {
            h(std::array::from_fn(|i| Dual::new(q[i], f64::from(u8::from(i == k)))), &th).map(|r| r.map(|x| x.slope))
        })
        .collect();
    let h = h(std::array::from_fn(|i| Dual::splat(q[i])), &th).map(|row| row.map(|x| x.value));
    let g = [0.0, th[16] * q[1].cos() + th[17] * (q[1] + q[2]).cos(), th[17] * (q[1] + q[2]).cos()];
    Vector3::from_fn(|i, _| {
        let mut torque = g[i] + th[10 + i] * v[i] + th[13 + i] * (v[i] / 0.01).tanh();
        for j in 0..3 {
            torque += h[i][j] * a[j];
            for k in 0..3 {
                torque += 0.5 * (dh[k][i][j] + dh[j][i][k] - dh[i][j][k]) * v[j] * v[k];
            }
        }
        torque
    })
}

fn close(a: &Vector3<f64>, b: &Vector3<f64>, relative: f64) -> bool {
    (a - b).amax() <= relative * (1.0 + a.amax().max(b.amax()))
}

proptest! {
    #[test]
    fn inertia_is_symmetric_positive_definite(q in angles()) {
        let h = inertia(&q);
        prop_assert_eq!(h, h.transpose());
        let eigenvalues = h.symmetric_eigenvalues();
        prop_assert!(eigenvalues.min() >= 1.99 && eigenvalues.max() <= 11.82, "{}", eigenvalues);
    }

    #[test]
    fn inertia_rate_less_twice_coriolis_is_skew(q in angles(), v in vectors(3.0), x in vectors(1.0)) {
        let form = x.dot(&(inertia_rate(&q, &v) * x)) - 2.0 * x.dot(&coriolis(&q, &v, &x));
        prop_assert!(form.abs() < 1e-12, "{}", form);
    }

    #[test]
    fn coriolis_is_symmetric_in_its_velocities(q in angles(), u in vectors(3.0), v in vectors(3.0)) {
        prop_assert!(close(&coriolis(&q, &u, &v), &coriolis(&q, &v, &u), 1e-13));
    }

    #[test]
    fn regressor_times_theta_is_inverse_dynamics(q in angles(), v in vectors(3.0), a in vectors(20.0)) {
        let sign = FrictionSign::from_width(0.01).of(&v);
        let y = Arm::regressor(&Arm::geometry(&q), &v, &v, &a, &sign);
        let torque = model_torque::<Arm, f64, 3, 18>(&y, theta().as_slice());
        let plant = Plant::<Arm, f64, 3, 18>::new(theta(), FrictionSign::from_width(0.01));
        prop_assert!(close(&torque, &plant.torque(&Arm::geometry(&q), &v, &a), 1e-13));
        prop_assert!(close(&torque, &independent_torque(&q, &v, &a), 1e-12));
    }

    #[test]
    fn regressor_products_agree_with_dense_ones(
        q in angles(), u in vectors(3.0), v in vectors(3.0), a in vectors(20.0), s in vectors(1.0),
        th in prop::array::uniform18(-10.0..10.0_f64),
    ) {
        let y = Arm::regressor(&Arm::geometry(&q), &u, &v, &a, &FrictionSign::True.of(&v));
        let th = Theta::from(th);
        prop_assert!(close(&model_torque::<Arm, f64, 3, 18>(&y, th.as_slice()), &(y * th), 1e-13));
        let difference = gradient::<Arm, f64, 3, 18>(&y, &s) - y.transpose() * s;
        prop_assert!(difference.amax() < 1e-12);
    }

    #[test]
    fn forward_after_inverse_dynamics_is_the_identity(q in angles(), v in vectors(3.0), a in vectors(20.0)) {
        let plant = Plant::<Arm, f64, 3, 18>::new(theta(), FrictionSign::from_width(0.01));
        let geometry = Arm::geometry(&q);
        let torque = plant.torque(&geometry, &v, &a);
        let sign = plant.friction_sign.of(&v);
        prop_assert!(close(&plant.acceleration(&geometry, &v, &sign, &torque), &a, 1e-12));
    }

    #[test]
    fn linear_solve_agrees_with_the_library(q in angles(), b in vectors(100.0), off in -0.9..0.9_f64) {
        // A full matrix, which the A465's block structure would not exercise.
        let mut h = inertia(&q);
        h[(0, 1)] = off; h[(1, 0)] = off; h[(0, 2)] = -off; h[(2, 0)] = -off;
        prop_assert!(close(&solve_symmetric(&h, b), &(h.cholesky().unwrap().solve(&b)), 1e-12));
    }

    /// Power in = rate of kinetic and potential energy + friction's losses.
    #[test]
    fn energy_balances(q in angles(), v in vectors(3.0), a in vectors(20.0)) {
        let th = theta();
        let plant = Plant::<Arm, f64, 3, 18>::new(th, FrictionSign::from_width(0.01));
        let power = v.dot(&plant.torque(&Arm::geometry(&q), &v, &a));
        let kinetic = v.dot(&(inertia(&q) * a)) + 0.5 * v.dot(&(inertia_rate(&q, &v) * v));
        let potential = th[16] * q[1].cos() * v[1] + th[17] * (q[1] + q[2]).cos() * (v[1] + v[2]);
        let losses: f64 = (0..3).map(|i| v[i] * (th[10 + i] * v[i] + th[13 + i] * (v[i] / 0.01).tanh())).sum();
        prop_assert!(losses >= 0.0);
        prop_assert!((power - kinetic - potential - losses).abs() < 1e-10, "{} {}", power, kinetic + potential + losses);
    }

    /// `d/dt (P θ) + B θ = τ` along a motion: what the filter rests on.
    #[test]
    fn momentum_balances(q in angles(), v in vectors(3.0), a in vectors(20.0)) {
        let motion = SVector::from_fn(|i, _| Dual::new(q[i], v[i]));
        let velocity = SVector::from_fn(|i, _| Dual::new(v[i], a[i]));
        let sign = FrictionSign::from_width(0.01).of(&v);
        let momentum_rate = Arm::momentum_regressor(&Arm::geometry(&motion), &velocity).map(|p| p.slope) * theta();
        let balance = Arm::balance_regressor(&Arm::geometry(&q), &v, &sign) * theta();
        prop_assert!(close(&(momentum_rate + balance), &independent_torque(&q, &v, &a), 1e-12));
    }

    #[test]
    fn dead_entries_of_the_regressors_are_zero(q in angles(), u in vectors(3.0), v in vectors(3.0), a in vectors(20.0)) {
        let (g, sign) = (Arm::geometry(&q), FrictionSign::True.of(&v));
        for y in [
            Arm::regressor(&g, &u, &v, &a, &sign),
            Arm::momentum_regressor(&g, &v),
            Arm::balance_regressor(&g, &v, &sign),
        ] {
            for row in 0..3 {
                for column in 0..18 {
                    prop_assert!(Arm::LIVE[row][column] || y[(row, column)] == 0.0, "{} {}", row, column);
                }
            }
        }
    }
}

#[test]
fn every_live_entry_is_needed() {
    let (q, u) = (Vector3::new(0.3, 0.7, -1.1), Vector3::new(0.4, -0.6, 0.9));
    let y = Arm::regressor(&Arm::geometry(&q), &u, &(2.0 * u), &Vector3::new(1.0, 2.0, 3.0), &u);
    assert!(Arm::ENTRIES.iter().all(|entry| y[*entry] != 0.0));
    assert_eq!((Arm::ENTRIES.len(), Arm::PAIRS.len()), (30, 126));
}

#[test]
fn regressor_has_full_rank() {
    let mut stacked = nalgebra::DMatrix::<f64>::zeros(3 * 40, 18);
    for n in 0..40 {
        let t = 0.37 * f64::from(n);
        let q = Vector3::new(t.sin(), 2.0 * (1.3 * t).cos(), 2.0 * (0.7 * t).sin());
        let v = Vector3::new((1.1 * t).cos(), (2.3 * t).sin(), (1.7 * t).cos());
        let a = Vector3::new((2.9 * t).sin(), (0.9 * t).cos(), (1.9 * t).sin()) * 10.0;
        let y = Arm::regressor(&Arm::geometry(&q), &v, &v, &a, &FrictionSign::True.of(&v));
        stacked.view_mut((3 * n as usize, 0), (3, 18)).copy_from(&y);
    }
    assert_eq!(stacked.rank(1e-6), 18);
}
