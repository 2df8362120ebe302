//! Schemes beyond the paper: yardsticks against closed forms, least squares against the batch solution, any velocity
//! source for any scheme, and refusals of what has no meaning.

use adaptarm_core::adaptation::{AdaptationInput, AdaptationLaw, FilteredRegressor, LeastSquaresAdaptation};
use adaptarm_core::dynamics::{FrictionSign, Plant};
use adaptarm_core::integrators::{Aligned, Rk4};
use adaptarm_core::metrics::peak;
use adaptarm_core::recording::Signal;
use adaptarm_core::robots::{CrsA465, Regressor, Robot};
use adaptarm_core::scenario::{
    AdaptationDocument, AdaptationKind, ComputedTorqueGains, EffectsDocument, InitialVelocityDocument, ModelParameters,
    OutcomeKind, Run, SamplingDocument, Scenario, Scheme, SchemeDocument, VelocityDocument, VelocityKind,
};
use nalgebra::{SMatrix, SVector, Vector3};

/// From rest, with the true parameters of an arm that is not the nominal one: `e(t) = ė(0) t e^{−ωt}`, joint by joint.
#[test]
fn computed_torque_makes_the_error_a_linear_oscillator() {
    let mut document = Scheme::ComputedTorque.paper();
    document.scheme = SchemeDocument::ComputedTorque(Some(ComputedTorqueGains {
        parameters: ModelParameters::True,
        ..Default::default()
    }));
    document.plant.theta_scale = Some((0..18).map(|k| 1.0 + 0.01 * f64::from(k)).collect());
    document.initial.velocity = InitialVelocityDocument::Rest;
    document.integration.duration_s = 2.0;
    document.recording.samples = 200;
    let run = Scenario::new(document.clone()).unwrap().run();
    for joint in 0..3 {
        let rate = run.recording.signal(Signal::ErrorRate, joint).next().unwrap();
        assert!(rate.abs() > 0.1);
        for (t, e) in run.recording.times_s().zip(run.recording.signal(Signal::Error, joint)) {
            let expected = rate * t * (-10.0 * t).exp();
            assert!((e - expected).abs() < 1e-8, "joint {joint} at {t} s: {e} for {expected}");
        }
    }
    document.scheme = SchemeDocument::ComputedTorque(None);
    let nominal = Scenario::new(document).unwrap().run();
    let last = |run: &Run| run.recording.signal(Signal::Error, 1).next_back().unwrap().abs();
    assert!(last(&nominal) > 1e-4 && last(&run) < 1e-8, "{} {}", last(&nominal), last(&run));
    assert_eq!(nominal.report.theta_hat_end, CrsA465::DATA.theta());
}

#[test]
fn every_yardstick_tracks_and_more_knowledge_tracks_better() {
    let index = |scheme: Scheme| {
        let report = Scenario::new(scheme.paper()).unwrap().run().report;
        assert_eq!((report.outcome, report.scheme.as_str()), (OutcomeKind::Completed, scheme.id()));
        report.metrics.index_e_deg[1]
    };
    let [pd, pd_gravity, computed_torque] = Scheme::YARDSTICKS.map(index);
    assert!(computed_torque < 1e-6 && computed_torque < pd_gravity && pd_gravity < pd && pd < 5.0);
}

/// Recursive and batch least squares along one motion, `J = P⁻¹` and `b = J θ̂`: `J' = γ YfᵀYf − λ J`, `b' = γ Yfᵀτf − λ b`, with old data
/// fading at `λ = λ0 (1 − tr J⁻¹ / k0)`, or not at all.
#[test]
fn least_squares_is_the_batch_solution() {
    [0.0, 3.0].into_iter().for_each(check_batch);
}

fn check_batch(forgetting: f64) {
    type Law = LeastSquaresAdaptation<CrsA465, f64, 3, 18>;
    const FILTER: usize = FilteredRegressor::<CrsA465, f64, 3, 18>::STATES;
    let (p0, theta_start, weight) = (0.5, 0.3, 2.0);
    let law = Law {
        filter: FilteredRegressor::new(15.0),
        initial_gain: SVector::repeat(p0),
        weight,
        forgetting,
        gain_limit: 20.0,
    };
    let theta = SVector::<f64, 18>::from_vec(CrsA465::DATA.theta());
    let plant = Plant::<CrsA465, f64, 3, 18>::new(theta, FrictionSign::from_width(0.1));
    let torque_at = |t: f64| Vector3::new(8.0 * (3.0 * t).sin(), 22.0 + 9.0 * (2.0 * t).cos(), 11.0 * (4.0 * t).cos());
    let vector = |x: &[f64]| Vector3::new(x[0], x[1], x[2]);
    let law_states = AdaptationLaw::<CrsA465, f64, 3, 18>::states(&law);
    let (estimates, states) = (6, 24);
    let (information, correlation) = (24 + law_states, 24 + law_states + 324);
    let mut x = vec![0.0; correlation + 18];
    x[..6].copy_from_slice(&[0.1, 1.4, -1.2, 0.3, -0.2, 0.4]);
    x[estimates..states].fill(theta_start);
    let (q, v) = (vector(&x), vector(&x[3..]));
    law.initialize(&CrsA465::geometry(&q), &v, &mut x[states..information]);
    for k in 0..18 {
        x[information + 19 * k] = 1.0 / p0;
        x[correlation + k] = theta_start / p0;
    }
    let mut x = Aligned::from(x.as_slice());
    let mut rk4 = Rk4::new(x.len());
    let rhs = |t: f64, x: &[f64], rate: &mut [f64]| {
        let (geometry, velocity, torque) = (CrsA465::geometry(&vector(x)), vector(&x[3..]), torque_at(t));
        let sign = plant.friction_sign.of(&velocity);
        let acceleration = plant.acceleration(&geometry, &velocity, &sign, &torque);
        rate[..3].copy_from_slice(velocity.as_slice());
        rate[3..6].copy_from_slice(acceleration.as_slice());
        let input = AdaptationInput::<CrsA465, f64, 3, 18> {
            geometry: &geometry,
            velocity: &velocity,
            sign_velocity: &sign,
            torque: &torque,
            gradient: &SVector::zeros(),
            theta_hat: &x[estimates..states],
        };
        let (estimates_rate, rest) = rate[estimates..].split_at_mut(18);
        law.derivative(None, &input, &x[states..information], estimates_rate, &mut rest[..law_states]);
        let (y, tau): (Regressor<f64, 3, 18>, _) =
            law.filter.advance(&geometry, &velocity, &sign, &torque, &x[states..], &mut vec![0.0; FILTER]);
        let known = SMatrix::<f64, 18, 18>::from_column_slice(&x[information..correlation]);
        let sum = SVector::<f64, 18>::from_column_slice(&x[correlation..]);
        let fading = forgetting * (1.0 - known.try_inverse().unwrap().trace() / 20.0);
        rate[information..correlation].copy_from_slice((y.transpose() * y * weight - known * fading).as_slice());
        rate[correlation..].copy_from_slice((y.transpose() * tau * weight - sum * fading).as_slice());
    };
    for n in 0..3000 {
        rk4.step(f64::from(n) * 5e-4, f64::from(n + 1) * 5e-4, &mut x, rhs);
    }
    let batch = SMatrix::<f64, 18, 18>::from_column_slice(&x[information..correlation]).try_inverse().unwrap();
    let gain = Law::gain(&x[states..information]);
    assert!((gain - batch).amax() < 1e-9, "{}", (gain - batch).amax());
    let fades = forgetting > 0.0;
    assert!(fades || batch.diagonal().min() < 0.5 * p0, "data weigh more than the prior: {}", batch.diagonal());
    let sum = SVector::<f64, 18>::from_column_slice(&x[correlation..]);
    let (solved, found) = (batch * sum, SVector::<f64, 18>::from_column_slice(&x[estimates..states]));
    assert!((solved - found).amax() < 1e-8, "{}", (solved - found).amax());
    assert!((found - SVector::repeat(theta_start)).amax() > 0.5);
}

/// Without excitation gains would grow for ever; the limit on the trace holds them. `(tr P)' = λ0 (1 − tr P / k0) tr P` is the logistic
/// equation, and P keeps its shape.
#[test]
fn forgetting_without_excitation_is_bounded() {
    type Law = LeastSquaresAdaptation<CrsA465, f64, 3, 18>;
    let law = Law {
        filter: FilteredRegressor::new(15.0),
        initial_gain: SVector::from_fn(|k, _| k as f64),
        weight: 0.0,
        forgetting: 5.0,
        gain_limit: 3.0 * 153.0,
    };
    let zero = Vector3::zeros();
    let geometry = CrsA465::geometry(&zero);
    let mut x = vec![0.0; AdaptationLaw::<CrsA465, f64, 3, 18>::states(&law)];
    law.initialize(&geometry, &zero, &mut x);
    let mut x = Aligned::from(x.as_slice());
    let mut rk4 = Rk4::new(x.len());
    for n in 0..5000 {
        rk4.step(f64::from(n) * 1e-3, f64::from(n + 1) * 1e-3, &mut x, |_, x, rate| {
            let input = AdaptationInput::<CrsA465, f64, 3, 18> {
                geometry: &geometry,
                velocity: &zero,
                sign_velocity: &zero,
                torque: &zero,
                gradient: &SVector::zeros(),
                theta_hat: &[0.0; 18],
            };
            law.derivative(None, &input, x, &mut [0.0; 18], rate);
        });
        let (gain, t) = (Law::gain(&x), f64::from(n + 1) * 1e-3);
        let expected = 3.0 / (1.0 + 2.0 * (-5.0 * t).exp());
        for k in 0..18 {
            assert!((gain[(k, k)] - k as f64 * expected).abs() < 1e-9 * (1.0 + k as f64), "{t} s, {k}: {gain}");
        }
    }
    let trace = Law::gain(&x).trace();
    assert!((trace - 3.0 * 153.0).abs() < 1e-6 * trace, "{trace}");
}

/// The comparison that the paper leaves out: all three without a velocity sensor, also sampled, with the real encoder.
#[test]
fn every_scheme_tracks_without_a_velocity_sensor() {
    for scheme in Scheme::ALL {
        for kind in [VelocityKind::FilteredDifference, VelocityKind::Observer, VelocityKind::HighGain] {
            for effects in [
                None,
                Some(EffectsDocument {
                    sampling: Some(SamplingDocument { period_s: 0.001, delay_s: 0.0 }),
                    encoder_step_rad: Some(1.571e-5),
                    ..Default::default()
                }),
            ] {
                let mut document = scheme.paper();
                document.integration.duration_s = 3.0;
                document.recording.samples = 300;
                document.velocity = Some(VelocityDocument { kind, ..Default::default() });
                document.effects = effects;
                let run = Scenario::new(document.clone()).unwrap().run();
                let told = format!("{} with {kind:?}, {:?}: {:?}", scheme.id(), document.effects, run.report.reason);
                assert_eq!(run.report.outcome, OutcomeKind::Completed, "{told}");
                let worst = (0..3).map(|joint| peak(run.recording.signal(Signal::Error, joint))).fold(0.0, f64::max);
                assert!(worst.to_degrees() < 10.0, "{told} {worst} rad");
                assert_eq!(run.report.metrics.z_peak_deg.is_some(), kind != VelocityKind::FilteredDifference);
            }
        }
    }
}

#[test]
fn modified_and_least_squares_adaptation_track() {
    let modified = |adaptation: AdaptationDocument| {
        let mut document = Scheme::SlotineLi.paper();
        document.integration.duration_s = 6.0;
        document.recording.samples = 600;
        document.adaptation = Some(adaptation);
        let report = Scenario::new(document).unwrap().run().report;
        assert_eq!(report.outcome, OutcomeKind::Completed, "{:?}", report.reason);
        (report.metrics.index_e_deg[1], report.theta_hat_end)
    };
    let none = modified(AdaptationDocument::default());
    let size = |theta: &[f64]| theta.iter().map(|x| x * x).sum::<f64>().sqrt();
    for adaptation in [
        AdaptationDocument { sigma: Some(0.01), ..Default::default() },
        AdaptationDocument { e_modification: Some(0.1), ..Default::default() },
        AdaptationDocument { normalisation: Some(0.1), ..Default::default() },
        AdaptationDocument { dead_zone_rad_s: Some(0.01), ..Default::default() },
    ] {
        let (index, theta) = modified(adaptation.clone());
        assert!(index < 5.0 * none.0 && size(&theta) < size(&none.1), "{adaptation:?}: {index} for {}", none.0);
    }
    let (index, _) = modified(AdaptationDocument { kind: AdaptationKind::LeastSquares, ..Default::default() });
    assert!(index < none.0, "{index} for {}", none.0);
}

fn refusal(fields: &str, scheme: &str) -> String {
    let text = format!(r#"{{"format":"adaptarm.scenario/1","scheme":{{"kind":"{scheme}"}},{fields}}}"#);
    let error = Scenario::read(&mut serde_json::Deserializer::from_str(&text)).expect_err(&text);
    format!("{} {error}", error.pointer())
}

#[test]
fn refusals_name_field_value_and_range() {
    for (scheme, fields, pointer, message) in [
        ("slotine_li", r#""velocity":{"kind":"tacho"}"#, "/velocity/kind", "unknown variant `tacho`"),
        (
            "slotine_li",
            r#""velocity":{"kind":"measured","bandwidth_rad_s":3}"#,
            "/velocity/bandwidth_rad_s",
            "belongs to",
        ),
        ("slotine_li", r#""velocity":{"kind":"high_gain","k_d":[1,2,3]}"#, "/velocity/k_d", "belongs to kind observer"),
        ("slotine_li", r#""velocity":{"kind":"high_gain","bandwidth_rad_s":0}"#, "/velocity/bandwidth_rad_s", "0.1 to"),
        ("slotine_li", r#""velocity":{"kind":"observer","k_d":[1,2]}"#, "/velocity/k_d", "2 numbers where 3"),
        ("slotine_li", r#""velocity":{"bandwidth_rad_s":9}"#, "/velocity", "missing field `kind`"),
        ("slotine_li", r#""adaptation":{"sigma":-1}"#, "/adaptation/sigma", "-1 is outside"),
        (
            "slotine_li",
            r#""adaptation":{"weight":1}"#,
            "/adaptation/weight",
            "belongs to kinds least_squares, concurrent",
        ),
        ("pd", r#""adaptation":{"sigma":1}"#, "/adaptation", "does not adapt"),
        ("pd", r#""effects":{"theta_hat_scale":[1]}"#, "/effects/theta_hat_scale", "does not adapt"),
        ("proposed", r#""effects":{"wind":1}"#, "/effects/wind", "unknown field `wind`"),
        ("proposed", r#""effects":{"encoder_step_rad":1e-5}"#, "/effects/encoder_step_rad", "give effects.sampling"),
        (
            "proposed",
            r#""effects":{"position_noise_rad":1e-5,"sampling":{"period_s":0}}"#,
            "/effects/position_noise_rad",
            "needs samples",
        ),
        (
            "proposed",
            r#""effects":{"velocity_noise_rad_s":1,"sampling":{"period_s":0.001}}"#,
            "/effects/velocity_noise_rad_s",
            "needs a velocity sensor",
        ),
        (
            "proposed",
            r#""effects":{"sampling":{"period_s":0.0015}}"#,
            "/effects/sampling/period_s",
            "1.5 integration steps of 0.001 s",
        ),
        (
            "proposed",
            r#""effects":{"sampling":{"period_s":0.0005}}"#,
            "/effects/sampling/period_s",
            "0.5 integration steps",
        ),
        ("proposed", r#""effects":{"sampling":{"period_s":2}}"#, "/effects/sampling/period_s", "or 0 for a continuous"),
        (
            "proposed",
            r#""effects":{"sampling":{"period_s":0.001,"delay_s":0.002}}"#,
            "/effects/sampling/delay_s",
            "at most the period",
        ),
        (
            "proposed",
            r#""effects":{"sampling":{"period_s":0.001}},"integration":{"method":"dopri5"}"#,
            "/integration/method",
            "need fixed steps",
        ),
        ("proposed", r#""effects":{"torque_limit_nm":[1,2]}"#, "/effects/torque_limit_nm", "2 numbers where 3"),
        (
            "proposed",
            r#""effects":{"payloads":[{"mass_kg":1},{"mass_kg":-1}]}"#,
            "/effects/payloads/1/mass_kg",
            "0 to 100 kg",
        ),
        (
            "proposed",
            r#""effects":{"payloads":[{"mass_kg":1,"from_s":3,"to_s":2}]}"#,
            "/effects/payloads/0/to_s",
            "before from_s",
        ),
        (
            "proposed",
            r#""effects":{"stribeck":{"excess_nm":[1,1,1],"velocity_rad_s":0}}"#,
            "/effects/stribeck/velocity_rad_s",
            "0.0001 to",
        ),
        (
            "proposed",
            r#""effects":{"disturbance":{"constant_nm":[1,1,1e9]}}"#,
            "/effects/disturbance/constant_nm/2",
            "outside",
        ),
        ("computed_torque", r#""effects":{"theta_hat_scale":null},"adaptation":{}"#, "/adaptation", "does not adapt"),
    ] {
        let said = refusal(fields, scheme);
        assert!(said.starts_with(&format!("{pointer} ")) && said.contains(message), "{fields}\n  said: {said}");
    }
}

#[test]
fn a_canonical_form_reads_back_as_itself() {
    let text = r#"{"format":"adaptarm.scenario/1","scheme":{"kind":"tang_arteaga"},"velocity":{"kind":"observer"},
        "adaptation":{"kind":"least_squares","sigma":0.1},"effects":{"sampling":{"period_s":0.002,"delay_s":0.001},
        "payloads":[{"mass_kg":1}],"disturbance":{"sine_nm":[1,2,3]}}}"#;
    let scenario = Scenario::read(&mut serde_json::Deserializer::from_str(text)).unwrap();
    let written = serde_json::to_string(scenario.document()).unwrap();
    let again = Scenario::read(&mut serde_json::Deserializer::from_str(&written)).unwrap();
    assert_eq!((again.hash(), &again), (scenario.hash(), &scenario));
    assert!(written.contains(r#""k_d":[150.0,270.0,300.0]"#) && written.contains(r#""gain_limit":2.0"#));
    for scheme in Scheme::YARDSTICKS {
        let scenario = Scenario::new(scheme.paper()).unwrap();
        let written = serde_json::to_string(scenario.document()).unwrap();
        assert_eq!(Scenario::read(&mut serde_json::Deserializer::from_str(&written)).unwrap(), scenario);
    }
}
