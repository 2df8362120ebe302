//! Imperfections: nothing where they are zero, the right thing where they are not, and no bits lost over a pause.

use adaptarm_core::dynamics::{FrictionSign, Plant};
use adaptarm_core::integrators::{Aligned, Rk4};
use adaptarm_core::recording::Signal;
use adaptarm_core::robots::{CrsA465, Robot, payload_parameters};
use adaptarm_core::scenario::{
    AdaptationDocument, AdaptationKind, DisturbanceDocument, EffectsDocument, ElasticityDocument, MethodDocument,
    OutcomeKind, PayloadDocument, Run, SamplingDocument, Scenario, ScenarioDocument, Scheme, SchemeDocument,
    SideBySide, StribeckDocument, TrajectoryDocument, TrajectoryKind, VelocityDocument, VelocityKind,
};
use adaptarm_core::simulation::Snapshot;
use nalgebra::{SVector, Vector3};

fn short(scheme: Scheme) -> ScenarioDocument {
    let mut document = scheme.paper();
    document.integration.duration_s = 0.5;
    document.recording.samples = 100;
    document
}

fn with(scheme: Scheme, effects: EffectsDocument) -> ScenarioDocument {
    let mut document = short(scheme);
    document.effects = Some(effects);
    document
}

fn run(document: ScenarioDocument) -> Run {
    Scenario::new(document).unwrap().run()
}

fn sampled(period_s: f64, delay_s: f64) -> EffectsDocument {
    EffectsDocument { sampling: Some(SamplingDocument { period_s, delay_s }), ..Default::default() }
}

fn elastic(compliance_rad_nm: f64) -> ElasticityDocument {
    ElasticityDocument {
        compliance_rad_nm: Some(vec![compliance_rad_nm; 3]),
        damping_nms_rad: Some(vec![20.0, 60.0, 20.0]),
        motor_inertia_kgm2: vec![0.5, 3.0, 0.7],
        ..Default::default()
    }
}

/// Every imperfection there is, in a form that a sampled scheme with an observer can have.
fn everything() -> EffectsDocument {
    EffectsDocument {
        encoder_step_rad: Some(1.571e-5),
        position_noise_rad: Some(1e-5),
        torque_limit_nm: Some(vec![30.0, 60.0, 30.0]),
        voltage_limit_v: Some(24.0),
        disturbance: Some(DisturbanceDocument {
            constant_nm: Some(vec![0.5, 0.0, 0.1]),
            sine_nm: Some(vec![0.0, 1.0, 0.2]),
            frequency_rad_s: Some(7.0),
            from_s: Some(0.1),
            to_s: Some(0.3),
        }),
        payloads: Some(vec![PayloadDocument { mass_kg: 0.8, from_s: Some(0.2), to_s: Some(0.4) }]),
        stribeck: Some(StribeckDocument { excess_nm: vec![0.5, 0.4, 0.3], velocity_rad_s: 0.05 }),
        theta_hat_scale: Some(vec![0.7; 18]),
        elasticity: Some(elastic(1e-4)),
        ..sampled(0.002, 0.001)
    }
}

#[test]
fn each_imperfection_at_zero_strength_changes_no_bit() {
    let none = EffectsDocument::default;
    let nothing = [
        none(),
        sampled(0.0, 0.0),
        EffectsDocument { encoder_step_rad: Some(0.0), ..none() },
        EffectsDocument { position_noise_rad: Some(0.0), velocity_noise_rad_s: Some(0.0), ..none() },
        EffectsDocument { torque_limit_nm: Some(vec![1e6; 3]), voltage_limit_v: Some(1e5), ..none() },
        EffectsDocument {
            disturbance: Some(DisturbanceDocument { constant_nm: Some(vec![0.0; 3]), ..Default::default() }),
            ..none()
        },
        EffectsDocument { payloads: Some(vec![PayloadDocument::default()]), ..none() },
        EffectsDocument { stribeck: Some(StribeckDocument { excess_nm: vec![0.0; 3], velocity_rad_s: 0.1 }), ..none() },
        EffectsDocument { theta_hat_scale: Some(vec![0.0; 18]), ..none() },
        EffectsDocument { elasticity: Some(elastic(0.0)), ..none() },
    ];
    for scheme in Scheme::ALL {
        let ideal = run(short(scheme)).report;
        for effects in &nothing {
            let report = run(with(scheme, effects.clone())).report;
            assert_eq!(report.trajectory_hash, ideal.trajectory_hash, "{} {effects:?}", scheme.id());
            assert_ne!(report.scenario_hash, ideal.scenario_hash);
        }
        let mut own = short(scheme);
        let kind = if scheme == Scheme::Proposed { VelocityKind::Observer } else { VelocityKind::Measured };
        own.velocity = Some(VelocityDocument { kind, ..Default::default() });
        own.adaptation = Some(AdaptationDocument {
            sigma: Some(0.0),
            e_modification: Some(0.0),
            dead_zone_rad_s: Some(0.0),
            normalisation: Some(0.0),
            ..Default::default()
        });
        let report = run(own).report;
        assert_eq!(report.trajectory_hash, ideal.trajectory_hash);
        assert_eq!(report.metrics, ideal.metrics);
        let clock = run(with(scheme, sampled(0.001, 0.0))).report.trajectory_hash;
        let quiet =
            EffectsDocument { encoder_step_rad: Some(0.0), position_noise_rad: Some(0.0), ..sampled(0.001, 0.0) };
        assert_eq!(run(with(scheme, quiet)).report.trajectory_hash, clock);
        assert_ne!(clock, ideal.trajectory_hash);
    }
}

#[test]
fn each_imperfection_does_something() {
    let everything = everything();
    let clock = EffectsDocument { sampling: everything.sampling.clone(), ..Default::default() };
    let some = [
        EffectsDocument { encoder_step_rad: everything.encoder_step_rad, ..clock.clone() },
        EffectsDocument { position_noise_rad: everything.position_noise_rad, ..clock.clone() },
        EffectsDocument { torque_limit_nm: Some(vec![1.0; 3]), ..clock.clone() },
        EffectsDocument { voltage_limit_v: Some(0.1), ..clock.clone() },
        EffectsDocument { disturbance: everything.disturbance, ..clock.clone() },
        EffectsDocument { payloads: everything.payloads, ..clock.clone() },
        EffectsDocument { stribeck: everything.stribeck, ..clock.clone() },
        EffectsDocument { theta_hat_scale: everything.theta_hat_scale, ..clock.clone() },
        EffectsDocument { elasticity: everything.elasticity, ..clock.clone() },
        sampled(0.002, 0.0),
        clock,
    ];
    let mut hashes: Vec<_> =
        some.iter().map(|effects| run(with(Scheme::Proposed, effects.clone())).report.trajectory_hash).collect();
    hashes.sort();
    hashes.dedup();
    assert_eq!(hashes.len(), some.len());
}

fn end_state(document: ScenarioDocument) -> Vec<f64> {
    let scenario = Scenario::new(document).unwrap();
    let mut simulation = scenario.start();
    simulation.advance(u64::MAX);
    simulation.state()[..2 * scenario.robot().joint_count()].to_vec()
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// Zero-order hold and the controller's Euler steps are of order 1 in the period, a delay of order 1 in itself.
#[test]
fn a_sampled_controller_tends_to_the_continuous_one_at_order_one() {
    Scheme::ALL.into_iter().chain(Scheme::YARDSTICKS).for_each(|scheme| check_order(&short(scheme), 1e-4));
    let two_link = || ScenarioDocument::of_robot("two_link", SchemeDocument::SlotineLi(None));
    for kind in [VelocityKind::FilteredDifference, VelocityKind::Observer, VelocityKind::HighGain] {
        // The linear ones at a bandwidth that leaves this loop damped.
        let bandwidth_rad_s = (kind != VelocityKind::Observer).then_some(2000.0);
        let velocity = Some(VelocityDocument { kind, bandwidth_rad_s, ..Default::default() });
        check_order(&ScenarioDocument { velocity, ..two_link() }, 2.5e-5);
    }
    for kind in [AdaptationKind::LeastSquares, AdaptationKind::Concurrent, AdaptationKind::Drem] {
        let adaptation = Some(AdaptationDocument { kind, ..Default::default() });
        check_order(&ScenarioDocument { adaptation, ..two_link() }, 2.5e-5);
    }
}

/// With periods of 4, 2 and 1 integration steps.
fn check_order(document: &ScenarioDocument, step_s: f64) {
    let name = format!("{} {:?} {:?} {:?}", document.robot, document.scheme, document.velocity, document.adaptation);
    // Smooth, so that the order shows at these steps.
    let smooth = |effects: Option<EffectsDocument>| {
        let mut document = document.clone();
        document.plant.friction.width_rad_s = 1.0;
        (document.integration.step_s, document.integration.duration_s) = (step_s, 0.5);
        document.recording.samples = 50;
        document.effects = effects;
        end_state(document)
    };
    let exact = smooth(None);
    let error = |period_s, delay_s| distance(&smooth(Some(sampled(period_s, delay_s))), &exact);
    let errors = [4.0, 2.0, 1.0].map(|steps| error(steps * step_s, 0.0));
    let order = |pair: &[f64]| (pair[0] / pair[1]).log2();
    let delayed = [4.0, 2.0].map(|steps| error(steps * step_s, steps * step_s));
    println!("{name}: {errors:?}, with delay {delayed:?}");
    for pair in errors.windows(2) {
        assert!((order(pair) - 1.0).abs() < 0.25, "{name}: order {}, {errors:?}", order(pair));
    }
    assert!((order(&delayed) - 1.0).abs() < 0.3, "{name}: order {} with delay, {delayed:?}", order(&delayed));
    // On the light arm an Euler step runs ahead of the continuous controller, and a delay makes up for it.
    assert!(delayed[1] > errors[1] || document.robot != "crs_a465", "{name}: a delay does not help");
}

/// Sampling, delay, encoder, saturation, payload and disturbance of a PD controller, written down once more by hand.
#[test]
fn the_sampled_loop_is_the_one_written_by_hand() {
    let effects = EffectsDocument {
        encoder_step_rad: Some(1e-3),
        torque_limit_nm: Some(vec![6.0, 9.0, 5.0]),
        payloads: Some(vec![PayloadDocument { mass_kg: 1.5, from_s: Some(0.123), to_s: Some(0.3) }]),
        disturbance: Some(DisturbanceDocument {
            constant_nm: Some(vec![1.0, 0.0, 0.0]),
            sine_nm: Some(vec![0.0, 2.0, 0.0]),
            frequency_rad_s: Some(5.0),
            from_s: Some(0.2),
            to_s: None,
        }),
        ..sampled(0.005, 0.002)
    };
    let document = with(Scheme::Pd, effects);
    let (k_p, k_d) = (Vector3::new(950.0, 747.5, 880.0), Vector3::new(95.0, 115.0, 110.0));
    let found = end_state(document);

    let wanted = |t: f64| {
        let degrees = [(0.0, [5.0, 5.0, 2.5]), (90.0, [15.0, 3.0, 2.5]), (-90.0, [10.0, 2.0, 3.0])];
        let angle = Vector3::from_fn(|i, _| {
            let (offset, a) = degrees[i];
            (offset + (0..3).map(|k| a[k] * ((k + 1) as f64 * t).sin()).sum::<f64>()).to_radians()
        });
        let rate = Vector3::from_fn(|i, _| {
            let (_, a) = degrees[i];
            (0..3).map(|k| (k + 1) as f64 * a[k] * ((k + 1) as f64 * t).cos()).sum::<f64>().to_radians()
        });
        (angle, rate)
    };
    let theta = SVector::<f64, 18>::from_vec(CrsA465::DATA.theta());
    let per_kg = SVector::<f64, 18>::from_vec(payload_parameters(CrsA465::DATA).unwrap());
    let vector = |x: &[f64]| Vector3::new(x[0], x[1], x[2]);
    let (angle, rate) = wanted(0.0);
    let x: Vec<f64> = angle.iter().chain(&rate).copied().collect();
    let (mut held, mut coming) = (Vector3::zeros(), Vector3::zeros());
    let mut x = Aligned::from(x.as_slice());
    let mut rk4 = Rk4::new(6);
    for n in 0..500 {
        let t = f64::from(n) * 1e-3;
        if n % 5 == 2 {
            held = coming;
        }
        if n % 5 == 0 {
            let seen = vector(&x).map(|q| 1e-3 * (q / 1e-3).round());
            let (angle, rate) = wanted(t);
            coming = -k_p.component_mul(&(seen - angle)) - k_d.component_mul(&(vector(&x[3..]) - rate));
        }
        let mass = if (123..300).contains(&n) { 1.5 } else { 0.0 };
        let plant = Plant::<CrsA465, f64, 3, 18>::new(theta + per_kg * mass, FrictionSign::from_width(0.01));
        let torque = Vector3::from_fn(|i, _| held[i].clamp(-[6.0, 9.0, 5.0][i], [6.0, 9.0, 5.0][i]));
        rk4.step(t, f64::from(n + 1) * 1e-3, &mut x, |t, x, rate| {
            let (q, v) = (vector(x), vector(&x[3..]));
            let outside = if n >= 200 { Vector3::new(1.0, 2.0 * (5.0 * t).sin(), 0.0) } else { Vector3::zeros() };
            let sign = v.map(|v| (v / 0.01).tanh());
            let a = plant.acceleration(&CrsA465::geometry(&q), &v, &sign, &(torque + outside));
            rate[..3].copy_from_slice(v.as_slice());
            rate[3..].copy_from_slice(a.as_slice());
        });
    }
    assert!(distance(&found, &x) < 1e-8, "{found:?}\n{x:?}");
}

#[test]
fn a_payload_is_a_heavier_arm() {
    let mass_kg = 0.002;
    let payload = PayloadDocument { mass_kg, ..Default::default() };
    let carrying =
        run(with(Scheme::SlotineLi, EffectsDocument { payloads: Some(vec![payload]), ..Default::default() }));
    let mut heavier = short(Scheme::SlotineLi);
    let (theta, change) = (CrsA465::DATA.theta(), payload_parameters(CrsA465::DATA).unwrap());
    heavier.plant.theta_scale = Some(theta.iter().zip(change).map(|(own, more)| 1.0 + mass_kg * more / own).collect());
    let heavier = run(heavier);
    let empty = run(short(Scheme::SlotineLi));
    let apart = |a: &Run, b: &Run| distance(a.recording.rows(), b.recording.rows());
    assert!(apart(&carrying, &heavier) < 1e-9 && apart(&carrying, &empty) > 1e-4);
}

/// PD with gravity at rest under a constant push: `e = d / Kp`, whatever the arm.
#[test]
fn a_constant_disturbance_leans_on_the_feedback() {
    let mut document = Scheme::PdGravity.paper();
    document.trajectory = TrajectoryDocument {
        kind: TrajectoryKind::Fourier,
        offset_deg: Some(vec![10.0, 60.0, -40.0]),
        ..Default::default()
    };
    document.plant.friction.width_rad_s = 1.0;
    document.effects = Some(EffectsDocument {
        disturbance: Some(DisturbanceDocument { constant_nm: Some(vec![3.0, -5.0, 2.0]), ..Default::default() }),
        ..Default::default()
    });
    let run = run(document);
    for (joint, expected) in [3.0 / 950.0, -5.0 / 747.5, 2.0 / 880.0].into_iter().enumerate() {
        let error = run.recording.signal(Signal::Error, joint).next_back().unwrap();
        assert!((error - expected).abs() < 1e-9, "{error} for {expected}");
    }
}

/// What the controller begins with, joint by joint and whatever the arm.
#[test]
fn initial_estimates_are_multiples_of_the_nominal_ones() {
    let scale: Vec<f64> = (0..18).map(|k| 0.1 * f64::from(k)).collect();
    for scheme in [Scheme::SlotineLi, Scheme::TangArteaga] {
        let mut document = with(scheme, EffectsDocument { theta_hat_scale: Some(scale.clone()), ..Default::default() });
        document.plant.theta_scale = Some(vec![1.1; 18]);
        let run = run(document);
        for (k, nominal) in CrsA465::DATA.theta().into_iter().enumerate() {
            let first = run.recording.signal(Signal::ThetaHat, k).next().unwrap();
            assert!((first - scale[k] * nominal).abs() < 1e-15 * nominal.abs().max(1.0), "{} {k}", scheme.id());
        }
    }
}

#[test]
fn saturated_torques_stay_within_their_limits() {
    let effects = EffectsDocument {
        torque_limit_nm: Some(vec![2.0, 20.0, 3.0]),
        voltage_limit_v: Some(0.5),
        ..sampled(0.001, 0.0)
    };
    let run = run(with(Scheme::Proposed, effects));
    let by_voltage = 0.5 * CrsA465::DATA.torque_per_volt_nm;
    for (joint, limit) in [2.0, by_voltage, 3.0].into_iter().enumerate() {
        let peak = adaptarm_core::metrics::peak(run.recording.signal(Signal::Torque, joint));
        assert!(peak <= limit, "{peak} beyond {limit}");
    }
}

#[test]
fn noise_is_the_seeds_and_nobody_elses() {
    let noisy = |seed| {
        let mut document = with(Scheme::SlotineLi, sampled(0.001, 0.0));
        let effects = document.effects.as_mut().unwrap();
        (effects.position_noise_rad, effects.velocity_noise_rad_s) = (Some(1e-5), Some(1e-3));
        document.seed = seed;
        run(document).report.trajectory_hash
    };
    assert_eq!(noisy(3), noisy(3));
    assert_ne!(noisy(3), noisy(4));
}

#[test]
fn resumed_runs_have_the_bits_of_undisturbed_ones() {
    let stored =
        |snapshot: &Snapshot| -> Snapshot { serde_json::from_str(&serde_json::to_string(snapshot).unwrap()).unwrap() };
    for samples in [100, 77] {
        for scheme in Scheme::ALL {
            let mut document = with(scheme, everything());
            document.velocity = Some(VelocityDocument { kind: VelocityKind::HighGain, ..Default::default() });
            document.recording.samples = samples;
            let scenario = Scenario::new(document).unwrap();
            let mut simulation = scenario.start();
            for slice in [1, 2, 7, 90, 1, 33, 3].iter().cycle() {
                if simulation.advance(*slice) {
                    break;
                }
                simulation = scenario.resume(stored(&simulation.snapshot())).unwrap();
            }
            assert_eq!(scenario.finish(simulation), scenario.run());
        }
    }
}

#[test]
fn what_cannot_hold_the_arm_diverges_as_an_outcome() {
    let mut document = with(Scheme::SlotineLi, sampled(0.01, 0.01));
    document.scheme = SchemeDocument::SlotineLi(Some(adaptarm_core::scenario::SlotineLiGains {
        k_s: vec![1e5; 3],
        ..Default::default()
    }));
    let run = run(document);
    assert_eq!(run.report.outcome, OutcomeKind::Diverged);
    assert!(run.report.at_s.unwrap() < 0.5 && run.recording.rows().iter().all(|x| x.is_finite()));
    assert!(run.report.theta_hat_end.iter().chain(&run.report.q_end_rad).all(|x| x.is_finite()));
}

#[test]
fn imperfect_loops_run_by_themselves() {
    let (ideal, imperfect) = (
        Scenario::new(short(Scheme::Proposed)).unwrap(),
        Scenario::new(with(Scheme::Proposed, EffectsDocument::default())).unwrap(),
    );
    assert!(!imperfect.runs_beside(&imperfect) && !ideal.runs_beside(&imperfect) && !imperfect.runs_beside(&ideal));
    assert!(SideBySide::start(&[&imperfect], 1).is_none());
    let mut adaptive = short(Scheme::TangArteaga);
    adaptive.velocity = Some(VelocityDocument { kind: VelocityKind::FilteredDifference, ..Default::default() });
    let fixed = run(adaptive.clone());
    adaptive.integration.method = MethodDocument::Dopri5;
    let free = run(adaptive);
    let (a, b) = (&fixed.report.metrics.index_e_deg, &free.report.metrics.index_e_deg);
    assert!(distance(a, b) < 1e-4 * b[1], "{a:?} {b:?}");
}
