//! Integration laws on the real closed loops: order of convergence, two integrators agreeing, and what must stay
//! invariant along a run.

use adaptarm_core::adaptation::FilteredRegressor;
use adaptarm_core::dynamics::{FrictionSign, Plant};
use adaptarm_core::integrators::{Aligned, Rk4};
use adaptarm_core::regressor::model_torque;
use adaptarm_core::robots::{CrsA465, Robot};
use adaptarm_core::scenario::{FrictionDocument, MethodDocument, Scenario, ScenarioDocument, Scheme, SchemeDocument};
use nalgebra::{SMatrix, SVector, Vector3};

/// A smooth problem, so that the order shows at the steps used: wide friction, a short run.
fn smooth(scheme: Scheme, step_s: f64) -> ScenarioDocument {
    let mut document = scheme.paper();
    document.plant.friction = FrictionDocument { width_rad_s: 1.0, ..FrictionDocument::default() };
    document.integration.duration_s = 0.5;
    document.integration.step_s = step_s;
    document.recording.samples = 50;
    document
}

fn end_state(document: ScenarioDocument) -> Vec<f64> {
    let mut simulation = Scenario::new(document).unwrap().start();
    simulation.advance(u64::MAX);
    simulation.state()[..6].to_vec()
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

#[test]
fn closed_loops_converge_at_order_four() {
    // The proposed scheme's projection has corners, at which no method keeps its order.
    for scheme in [Scheme::SlotineLi, Scheme::TangArteaga] {
        let exact = end_state(smooth(scheme, 1e-4));
        let error = |step_s| distance(&end_state(smooth(scheme, step_s)), &exact);
        let order = (error(2e-3) / error(1e-3)).log2();
        assert!((order - 4.0).abs() < 0.4, "{scheme:?}: order {order}");
    }
}

#[test]
fn both_integrators_agree_on_every_scheme() {
    for scheme in Scheme::ALL {
        let mut adaptive = smooth(scheme, 0.01);
        adaptive.integration.method = MethodDocument::Dopri5;
        let run = Scenario::new(adaptive).unwrap().run();
        let fixed = Scenario::new(smooth(scheme, 1e-4)).unwrap().run();
        let (a, b) = (&run.report.metrics, &fixed.report.metrics);
        // Samples come from dense output on one side and from steps on the other.
        assert!(distance(&a.index_e_deg, &b.index_e_deg) < 1e-7 * b.index_e_deg[1], "{scheme:?}: {a:?} {b:?}");
        assert!(distance(&a.index_de_deg_s, &b.index_de_deg_s) < 1e-6 * b.index_de_deg_s[1], "{scheme:?}");
        assert_eq!(run.report.samples, fixed.report.samples);
    }
}

#[test]
fn samples_inside_steps_agree_with_samples_on_steps() {
    for scheme in [Scheme::SlotineLi, Scheme::TangArteaga] {
        let on = Scenario::new(smooth(scheme, 1e-4)).unwrap().run();
        // 0.5 s / 50 samples = 10 ms is no multiple of this step, which does not divide the duration either.
        let inside = Scenario::new(smooth(scheme, 1.7e-4)).unwrap().run();
        assert_eq!(on.recording.len(), inside.recording.len());
        let difference = distance(on.recording.rows(), inside.recording.rows());
        assert!(difference < 1e-6, "{scheme:?}: {difference}");
        assert!(on.recording.times_s().eq(inside.recording.times_s()));
    }
}

/// `Yf θ = τf` along a motion under arbitrary torque, for the true θ: estimates play no part.
#[test]
fn filtered_regressor_times_theta_is_filtered_torque() {
    type Filter = FilteredRegressor<CrsA465, f64, 3, 18>;
    let theta = SVector::<f64, 18>::from_vec(CrsA465::DATA.theta());
    let plant = Plant::<CrsA465, f64, 3, 18>::new(theta, FrictionSign::from_width(0.1));
    let filter = Filter::new(15.0);
    let torque_at = |t: f64| Vector3::new(8.0 * (3.0 * t).sin(), 22.0 + 9.0 * (2.0 * t).cos(), 11.0 * (4.0 * t).cos());
    let vector = |x: &[f64]| Vector3::new(x[0], x[1], x[2]);

    let mut x = vec![0.0; 6 + Filter::STATES];
    x[..6].copy_from_slice(&[0.1, 1.4, -1.2, 0.3, -0.2, 0.4]);
    filter.initialize(&CrsA465::geometry(&vector(&x)), &vector(&x[3..]), &mut x[6..]);
    let mut filtered_torques = Vec::new();
    let mut rhs = |t: f64, x: &[f64], rate: &mut [f64]| {
        let (geometry, velocity, torque) = (CrsA465::geometry(&vector(x)), vector(&x[3..]), torque_at(t));
        let sign = plant.friction_sign.of(&velocity);
        let acceleration = plant.acceleration(&geometry, &velocity, &sign, &torque);
        rate[..3].copy_from_slice(velocity.as_slice());
        rate[3..6].copy_from_slice(acceleration.as_slice());
        let (y, tau_f) = filter.advance(&geometry, &velocity, &sign, &torque, &x[6..], &mut rate[6..]);
        filtered_torques.push((model_torque::<CrsA465, f64, 3, 18>(&y, theta.as_slice()), tau_f));
    };
    let mut x = Aligned::from(x.as_slice());
    let mut rk4 = Rk4::new(x.len());
    for n in 0..2000 {
        rk4.step(f64::from(n) * 1e-3, f64::from(n + 1) * 1e-3, &mut x, &mut rhs);
    }
    let worst = filtered_torques.iter().map(|(model, torque)| (model - torque).amax()).fold(0.0, f64::max);
    let size = filtered_torques.iter().map(|(_, torque)| torque.amax()).fold(0.0, f64::max);
    assert!(size > 10.0);
    assert!(worst < 1e-6, "{worst} of {size}");
}

/// `w = Z (θ̂ − θ)` along a whole run of Tang and Arteaga's scheme: the memory is what its equations say it is.
#[test]
fn memory_remembers_the_parameter_error() {
    let mut document = Scheme::TangArteaga.paper();
    document.integration.duration_s = 3.0;
    let mut simulation = Scenario::new(document).unwrap().start();
    simulation.advance(u64::MAX);
    let x = simulation.state();
    let (theta_hat, rest) = x[6..].split_at(18);
    let (w, packed) = rest[FilteredRegressor::<CrsA465, f64, 3, 18>::STATES..].split_at(18);
    let mut z = SMatrix::<f64, 18, 18>::zeros();
    for (value, &(i, j)) in packed.iter().zip(CrsA465::PAIRS) {
        z[(i, j)] = *value;
        z[(j, i)] = *value;
    }
    let error = SVector::<f64, 18>::from_fn(|k, _| theta_hat[k] - CrsA465::DATA.parameters[k].value);
    let (remembered, w) = (z * error, SVector::<f64, 18>::from_column_slice(w));
    assert!(w.amax() > 1e-3);
    assert!((remembered - w).amax() < 1e-6 * w.amax(), "{}", (remembered - w).amax() / w.amax());
}

/// Without torque and friction the arm swings at constant energy.
#[test]
fn a_free_arm_keeps_its_energy() {
    let theta =
        SVector::<f64, 18>::from_fn(|k, _| if (10..16).contains(&k) { 0.0 } else { CrsA465::DATA.parameters[k].value });
    let plant = Plant::<CrsA465, f64, 3, 18>::new(theta, FrictionSign::True);
    let energy = |x: &[f64]| {
        let (q, v) = (Vector3::new(x[0], x[1], x[2]), Vector3::new(x[3], x[4], x[5]));
        let (h, _) = CrsA465::inertia_and_bias(&CrsA465::geometry(&q), &theta, &v, &Vector3::zeros());
        0.5 * v.dot(&(h * v)) + theta[16] * q[1].sin() + theta[17] * (q[1] + q[2]).sin()
    };
    let mut x = Aligned::from([0.0, 0.5, -0.3, 0.8, 0.0, 0.5].as_slice());
    let start = energy(&x);
    let mut rk4 = Rk4::new(6);
    for n in 0..5000 {
        rk4.step(f64::from(n) * 1e-3, f64::from(n + 1) * 1e-3, &mut x, |_, x, rate| {
            let (q, v) = (Vector3::new(x[0], x[1], x[2]), Vector3::new(x[3], x[4], x[5]));
            let a = plant.acceleration(&CrsA465::geometry(&q), &v, &Vector3::zeros(), &Vector3::zeros());
            rate[..3].copy_from_slice(v.as_slice());
            rate[3..].copy_from_slice(a.as_slice());
        });
    }
    assert!((energy(&x) - start).abs() < 1e-9 * start.abs().max(1.0), "{} {start}", energy(&x));
}

/// However a run diverges, what it leaves is finite and within the limit, on the grid of samples and off it.
#[test]
fn what_precedes_a_divergence_is_sane() {
    use adaptarm_core::recording::Signal;
    for samples in [20, 3000] {
        for method in [MethodDocument::Rk4, MethodDocument::Dopri5] {
            let mut document = Scheme::TangArteaga.paper();
            document.integration.step_s = 0.05;
            document.integration.duration_s = 1.0;
            document.integration.method = method;
            document.recording.samples = samples;
            let run = Scenario::new(document).unwrap().run();
            assert_eq!(run.report.at_s.is_some(), method == MethodDocument::Rk4);
            for joint in 0..3 {
                let peak = adaptarm_core::metrics::peak(run.recording.signal(Signal::Error, joint));
                assert!(peak <= adaptarm_core::simulation::TRACKING_ERROR_LIMIT_RAD, "{peak}");
            }
            assert!(run.report.theta_hat_end.iter().chain(&run.report.q_end_rad).all(|x| x.is_finite()));
            let again: adaptarm_core::scenario::Report =
                serde_json::from_str(&serde_json::to_string(&run.report).unwrap()).unwrap();
            assert_eq!(again, run.report);
        }
    }
}

/// Gains that cannot work end in a divergence with time and reason, and keep what was recorded before.
#[test]
fn an_unstable_loop_diverges_as_an_outcome() {
    let mut document = Scheme::TangArteaga.paper();
    document.scheme = SchemeDocument::TangArteaga(Some(adaptarm_core::scenario::TangArteagaGains {
        k_s: vec![1e5; 3],
        ..Default::default()
    }));
    let run = Scenario::new(document).unwrap().run();
    let at_s = run.report.at_s.unwrap();
    assert!(at_s > 0.0 && at_s < 1.0, "{at_s}");
    assert!(run.report.reason.is_some());
    assert!(run.recording.times_s().all(|t| t < at_s));
    assert!(run.recording.rows().iter().all(|x| x.is_finite()));
}

/// Tolerances that rounding makes unreachable end the run instead of keeping the machine busy for ever.
#[test]
fn hopeless_tolerances_end_as_an_outcome() {
    let mut document = Scheme::Proposed.paper();
    document.integration = adaptarm_core::scenario::IntegrationDocument {
        method: MethodDocument::Dopri5,
        step_s: 0.1,
        duration_s: 12.0,
        relative_tolerance: Some(1e-14),
        absolute_tolerance: Some(1e-14),
    };
    document.recording.samples = 10;
    let report = Scenario::new(document).unwrap().run().report;
    assert!(report.reason.unwrap().contains("steps"), "{:?}", report.at_s);
    assert!(report.steps <= 100_000);
}
