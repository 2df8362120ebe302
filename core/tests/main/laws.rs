//! Laws of mechanics on random states, for every robot: they hold for any correct model, whatever the numbers.
//!
//! Derivatives along a motion come from dual numbers, so the identities are exact up to rounding. Each robot is compared with
//! an independent derivation: its inertia matrix and its potential from another source, the rest by Lagrange's equations.

use crate::dual::Dual;
use adaptarm_core::dynamics::{FrictionSign, Plant, solve_symmetric};
use adaptarm_core::regressor::{gradient, model_torque};
use adaptarm_core::robots::{CrsA465, Pendulum, Robot, TwoLink};
use adaptarm_core::scalar::Scalar;
use nalgebra::{Matrix3, SMatrix, SVector, Vector3};
use proptest::prelude::*;
use std::f64::consts::PI;

/// A robot told again, independently.
pub trait Told<const N: usize, const P: usize>: Robot<N, P> {
    /// Index of the first viscous friction; Coulomb friction follows it, N of each.
    const FRICTION: usize;
    /// Inertia matrix.
    fn inertia(q: [Dual; N]) -> [[Dual; N]; N];
    /// Potential energy.
    fn potential(q: [Dual; N]) -> Dual;

    fn theta() -> SVector<f64, P> {
        SVector::from_vec(Self::DATA.theta())
    }
}

/// H as docs/physics.md section 1 prints it, the potential `θ17 sin q2 + θ18 sin(q2 + q3)`.
impl Told<3, 18> for CrsA465 {
    const FRICTION: usize = 10;

    fn inertia(q: [Dual; 3]) -> [[Dual; 3]; 3] {
        let (s, th) = (Dual::splat, Self::theta());
        let c2 = q[1].sin_cos().1;
        let (s3, c3) = q[2].sin_cos();
        let (s23, c23) = (q[1] + q[2]).sin_cos();
        let sin_2q2 = (q[1] + q[1]).sin_cos().0;
        let sin_2q23 = (q[1] + q[2] + q[1] + q[2]).sin_cos().0;
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

    fn potential(q: [Dual; 3]) -> Dual {
        let th = Self::theta();
        Dual::splat(th[16]) * q[1].sin_cos().0 + Dual::splat(th[17]) * (q[1] + q[2]).sin_cos().0
    }
}

/// From masses, lengths and moments of inertia: `H = Σ m JᵀJ + I ωωᵀ` over both bodies' centres, heights for the potential.
/// Source of the numbers: Slotine and Li, *Applied Nonlinear Control*, section 9.2.
impl Told<2, 11> for TwoLink {
    const FRICTION: usize = 4;

    fn inertia(q: [Dual; 2]) -> [[Dual; 2]; 2] {
        let n = Dual::splat;
        let (m1, lc1, i1, l1) = (1.0, 0.5, 0.12, 1.0);
        let (me, lce, ie, de) = (2.0, 0.6, 0.25, PI / 6.0);
        let (s1, c1) = q[0].sin_cos();
        let (se, ce) = (q[0] + q[1] - n(de)).sin_cos();
        // Columns of each centre's Jacobian.
        let first = [[-s1 * n(lc1), c1 * n(lc1)], [n(0.0); 2]];
        let outer = [-se * n(lce), ce * n(lce)];
        let second = [[outer[0] - s1 * n(l1), outer[1] + c1 * n(l1)], outer];
        let dot = |a: [Dual; 2], b: [Dual; 2]| a[0] * b[0] + a[1] * b[1];
        std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                let turning = ie + if (i, j) == (0, 0) { i1 } else { 0.0 };
                n(m1) * dot(first[i], first[j]) + n(me) * dot(second[i], second[j]) + n(turning)
            })
        })
    }

    fn potential(q: [Dual; 2]) -> Dual {
        let n = Dual::splat;
        let (s1, se) = (q[0].sin_cos().0, (q[0] + q[1] - n(PI / 6.0)).sin_cos().0);
        n(9.81) * (n(1.0 * 0.5) * s1 + n(2.0) * (s1 + n(0.6) * se))
    }
}

/// A bob of 1 kg at 0.5 m.
impl Told<1, 4> for Pendulum {
    const FRICTION: usize = 1;

    fn inertia(_q: [Dual; 1]) -> [[Dual; 1]; 1] {
        [[Dual::splat(1.0 * 0.5 * 0.5)]]
    }

    fn potential(q: [Dual; 1]) -> Dual {
        -Dual::splat(1.0 * 9.81 * 0.5) * q[0].sin_cos().1
    }
}

/// Torque by Lagrange's equations: Christoffel symbols of the independent H, the gradient of the potential, friction.
fn independent_torque<R: Told<N, P>, const N: usize, const P: usize>(
    q: &SVector<f64, N>,
    v: &SVector<f64, N>,
    a: &SVector<f64, N>,
) -> SVector<f64, N> {
    let along = |k: usize| std::array::from_fn(|i| Dual::new(q[i], f64::from(u8::from(i == k))));
    // dh[k][i][j] = ∂H_ij / ∂q_k
    let dh: Vec<_> = (0..N).map(|k| R::inertia(along(k)).map(|row| row.map(|x| x.slope))).collect();
    let h = R::inertia(along(N)).map(|row| row.map(|x| x.value));
    let th = R::theta();
    SVector::from_fn(|i, _| {
        let mut torque =
            R::potential(along(i)).slope + th[R::FRICTION + i] * v[i] + th[R::FRICTION + N + i] * (v[i] / 0.01).tanh();
        for j in 0..N {
            torque += h[i][j] * a[j];
            for k in 0..N {
                torque += 0.5 * (dh[k][i][j] + dh[j][i][k] - dh[i][j][k]) * v[j] * v[k];
            }
        }
        torque
    })
}

fn vectors<const N: usize>(limit: f64) -> impl Strategy<Value = SVector<f64, N>> {
    prop::collection::vec(-limit..limit, N).prop_map(SVector::from_vec)
}

fn inertia<R: Told<N, P>, T: Scalar, const N: usize, const P: usize>(q: &SVector<T, N>) -> SMatrix<T, N, N> {
    let still = SVector::zeros();
    R::inertia_and_bias(&R::geometry(q), &R::theta().map(T::splat), &still, &still).0
}

/// `Ḣ` along `q̇ = v`.
fn inertia_rate<R: Told<N, P>, const N: usize, const P: usize>(
    q: &SVector<f64, N>,
    v: &SVector<f64, N>,
) -> SMatrix<f64, N, N> {
    inertia::<R, Dual, N, P>(&SVector::from_fn(|i, _| Dual::new(q[i], v[i]))).map(|h| h.slope)
}

/// `C(q, u) v`: the regressor's torque without acceleration, less friction and gravity.
fn coriolis<R: Told<N, P>, const N: usize, const P: usize>(
    q: &SVector<f64, N>,
    u: &SVector<f64, N>,
    v: &SVector<f64, N>,
) -> SVector<f64, N> {
    let y = R::regressor(&R::geometry(q), u, v, &SVector::zeros(), &SVector::zeros());
    let mut theta = R::theta();
    theta.as_mut_slice()[R::FRICTION..].fill(0.0);
    model_torque::<R, f64, N, P>(&y, theta.as_slice())
}

fn close<const N: usize>(a: &SVector<f64, N>, b: &SVector<f64, N>, relative: f64) -> bool {
    (a - b).amax() <= relative * (1.0 + a.amax().max(b.amax()))
}

macro_rules! laws {
    ($module:ident, $robot:ident, $n:literal, $p:literal, live $entries:literal, pairs $pairs:literal) => {
        mod $module {
            use super::*;
            type R = $robot;
            const N: usize = $n;
            const P: usize = $p;

            proptest! {
                #[test]
                fn inertia_is_symmetric_positive_definite(q in vectors::<N>(PI)) {
                    let h = inertia::<R, f64, N, P>(&q);
                    prop_assert_eq!(h, h.transpose());
                    prop_assert!(h.symmetric_eigenvalues().min() > 0.1);
                }

                #[test]
                fn inertia_rate_less_twice_coriolis_is_skew(q in vectors::<N>(PI), v in vectors::<N>(3.0), x in vectors::<N>(1.0)) {
                    let rate = inertia_rate::<R, N, P>(&q, &v);
                    let form = x.dot(&(rate * x)) - 2.0 * x.dot(&coriolis::<R, N, P>(&q, &v, &x));
                    prop_assert!(form.abs() < 1e-12, "{}", form);
                }

                #[test]
                fn coriolis_is_symmetric_in_its_velocities(q in vectors::<N>(PI), u in vectors::<N>(3.0), v in vectors::<N>(3.0)) {
                    prop_assert!(close(&coriolis::<R, N, P>(&q, &u, &v), &coriolis::<R, N, P>(&q, &v, &u), 1e-13));
                }

                #[test]
                fn regressor_times_theta_is_inverse_dynamics(q in vectors::<N>(PI), v in vectors::<N>(3.0), a in vectors::<N>(20.0)) {
                    let sign = FrictionSign::from_width(0.01).of(&v);
                    let y = R::regressor(&R::geometry(&q), &v, &v, &a, &sign);
                    let torque = model_torque::<R, f64, N, P>(&y, R::theta().as_slice());
                    let plant = Plant::<R, f64, N, P>::new(R::theta(), FrictionSign::from_width(0.01));
                    prop_assert!(close(&torque, &plant.torque(&R::geometry(&q), &v, &a), 1e-13));
                    prop_assert!(close(&torque, &independent_torque::<R, N, P>(&q, &v, &a), 1e-12));
                }

                #[test]
                fn regressor_products_agree_with_dense_ones(
                    q in vectors::<N>(PI), u in vectors::<N>(3.0), v in vectors::<N>(3.0), a in vectors::<N>(20.0),
                    s in vectors::<N>(1.0), th in vectors::<P>(10.0),
                ) {
                    let y = R::regressor(&R::geometry(&q), &u, &v, &a, &FrictionSign::True.of(&v));
                    prop_assert!(close(&model_torque::<R, f64, N, P>(&y, th.as_slice()), &(y * th), 1e-13));
                    prop_assert!((gradient::<R, f64, N, P>(&y, &s) - y.transpose() * s).amax() < 1e-12);
                }

                #[test]
                fn forward_after_inverse_dynamics_is_the_identity(q in vectors::<N>(PI), v in vectors::<N>(3.0), a in vectors::<N>(20.0)) {
                    let plant = Plant::<R, f64, N, P>::new(R::theta(), FrictionSign::from_width(0.01));
                    let geometry = R::geometry(&q);
                    let torque = plant.torque(&geometry, &v, &a);
                    let sign = plant.friction_sign.of(&v);
                    prop_assert!(close(&plant.acceleration(&geometry, &v, &sign, &torque), &a, 1e-12));
                }

                /// Power in = rate of kinetic and potential energy + friction's losses.
                #[test]
                fn energy_balances(q in vectors::<N>(PI), v in vectors::<N>(3.0), a in vectors::<N>(20.0)) {
                    let th = R::theta();
                    let plant = Plant::<R, f64, N, P>::new(th, FrictionSign::from_width(0.01));
                    let power = v.dot(&plant.torque(&R::geometry(&q), &v, &a));
                    let rate = inertia_rate::<R, N, P>(&q, &v);
                    let kinetic = v.dot(&(inertia::<R, f64, N, P>(&q) * a)) + 0.5 * v.dot(&(rate * v));
                    let potential = R::potential(std::array::from_fn(|i| Dual::new(q[i], v[i]))).slope;
                    let friction = |i: usize| th[R::FRICTION + i] * v[i] + th[R::FRICTION + N + i] * (v[i] / 0.01_f64).tanh();
                    let losses: f64 = (0..N).map(|i| v[i] * friction(i)).sum();
                    prop_assert!(losses >= 0.0);
                    let sum = kinetic + potential + losses;
                    prop_assert!((power - sum).abs() < 1e-10, "{} {}", power, sum);
                }

                /// `d/dt (P θ) + B θ = τ` along a motion: what the filter rests on.
                #[test]
                fn momentum_balances(q in vectors::<N>(PI), v in vectors::<N>(3.0), a in vectors::<N>(20.0)) {
                    let motion = SVector::from_fn(|i, _| Dual::new(q[i], v[i]));
                    let velocity = SVector::from_fn(|i, _| Dual::new(v[i], a[i]));
                    let sign = FrictionSign::from_width(0.01).of(&v);
                    let momentum = R::momentum_regressor(&R::geometry(&motion), &velocity);
                    let balance = R::balance_regressor(&R::geometry(&q), &v, &sign) * R::theta();
                    let torque = momentum.map(|p| p.slope) * R::theta() + balance;
                    prop_assert!(close(&torque, &independent_torque::<R, N, P>(&q, &v, &a), 1e-12));
                }

                #[test]
                fn dead_entries_of_regressors_and_inertia_are_zero(
                    q in vectors::<N>(PI), u in vectors::<N>(3.0), v in vectors::<N>(3.0), a in vectors::<N>(20.0),
                ) {
                    let (g, sign) = (R::geometry(&q), FrictionSign::True.of(&v));
                    let regressors = [
                        (R::LIVE, R::regressor(&g, &u, &v, &a, &sign)),
                        (R::MOMENTUM_LIVE, R::momentum_regressor(&g, &v)),
                        (R::LIVE, R::balance_regressor(&g, &v, &sign)),
                    ];
                    for (live, y) in regressors {
                        for row in 0..N {
                            for column in 0..P {
                                prop_assert!(live[row][column] || y[(row, column)] == 0.0, "{} {}", row, column);
                            }
                        }
                    }
                    let (inertia, _) = R::inertia_and_bias(&g, &R::theta(), &v, &sign);
                    for row in 0..N {
                        for column in 0..N {
                            prop_assert!(R::INERTIA_LIVE[row][column] || inertia[(row, column)] == 0.0, "{} {}", row, column);
                        }
                    }
                }
            }

            #[test]
            fn every_live_entry_is_needed() {
                let q = SVector::<f64, N>::from_fn(|i, _| [0.3, 0.7, -1.1][i]);
                let u = SVector::<f64, N>::from_fn(|i, _| [0.4, -0.6, 0.9][i]);
                let a = SVector::<f64, N>::from_fn(|i, _| [1.0, 2.0, 3.0][i]);
                let y = R::regressor(&R::geometry(&q), &u, &(2.0 * u), &a, &u);
                assert!(R::ENTRIES.iter().all(|entry| y[*entry] != 0.0));
                assert_eq!((R::ENTRIES.len(), R::PAIRS.len()), ($entries, $pairs));
            }

            #[test]
            fn regressor_has_full_rank() {
                let mut stacked = nalgebra::DMatrix::<f64>::zeros(N * 40, P);
                for n in 0..40 {
                    let t = 0.37 * n as f64;
                    let waves = |amplitudes: [f64; 3], rates: [f64; 3]| {
                        SVector::<f64, N>::from_fn(|i, _| amplitudes[i] * (rates[i] * t + i as f64).sin())
                    };
                    let q = waves([1.0, 2.0, 2.0], [1.0, 1.3, 0.7]);
                    let v = waves([1.0, 1.0, 1.0], [1.1, 2.3, 1.7]);
                    let a = waves([10.0, 10.0, 10.0], [2.9, 0.9, 1.9]);
                    let y = R::regressor(&R::geometry(&q), &v, &v, &a, &FrictionSign::True.of(&v));
                    stacked.view_mut((N * n, 0), (N, P)).copy_from(&y);
                }
                assert_eq!(stacked.rank(1e-6), P);
            }
        }
    };
}

laws!(crs_a465, CrsA465, 3, 18, live 30, pairs 126);
laws!(two_link, TwoLink, 2, 11, live 16, pairs 58);
laws!(pendulum, Pendulum, 1, 4, live 4, pairs 10);

proptest! {
    #[test]
    fn the_a465s_inertia_has_known_bounds(q in vectors::<3>(PI)) {
        let eigenvalues = inertia::<CrsA465, f64, 3, 18>(&q).symmetric_eigenvalues();
        prop_assert!(eigenvalues.min() >= 1.99 && eigenvalues.max() <= 11.82, "{}", eigenvalues);
    }

    #[test]
    fn linear_solve_agrees_with_the_library(q in vectors::<3>(PI), b in vectors::<3>(100.0), off in -0.9..0.9_f64) {
        // A full matrix, which the A465's block structure would not exercise.
        let mut h: Matrix3<f64> = inertia::<CrsA465, f64, 3, 18>(&q);
        h[(0, 1)] = off; h[(1, 0)] = off; h[(0, 2)] = -off; h[(2, 0)] = -off;
        let solution: Vector3<f64> = h.cholesky().unwrap().solve(&b);
        prop_assert!(close(&solve_symmetric(&h, b), &solution, 1e-12));
    }
}
