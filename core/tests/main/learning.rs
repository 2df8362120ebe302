//! Laws that learn without persistent excitation, or parameter by parameter: what their theory promises, read off runs.

use adaptarm_core::adaptation::{AdaptationInput, AdaptationLaw, ConcurrentLearning, FilteredRegressor};
use adaptarm_core::dynamics::FrictionSign;
use adaptarm_core::recording::Signal;
use adaptarm_core::robots::{Robot, TwoLink, robot};
use adaptarm_core::scenario::{
    AdaptationDocument, AdaptationKind, EffectsDocument, OutcomeKind, Run, SamplingDocument, Scenario,
    ScenarioDocument, SchemeDocument, TrajectoryDocument, TrajectoryKind,
};
use nalgebra::{DMatrix, DVector, SVector, Vector2};

fn document(robot: &str, adaptation: Option<AdaptationDocument>, duration_s: f64) -> ScenarioDocument {
    let mut document = ScenarioDocument::of_robot(robot, SchemeDocument::SlotineLi(None));
    (document.integration.duration_s, document.recording.samples) = (duration_s, 400);
    document.adaptation = adaptation;
    document
}

fn run(document: ScenarioDocument) -> Run {
    let run = Scenario::new(document).unwrap().run();
    assert_eq!(run.report.outcome, OutcomeKind::Completed, "{:?}", run.report.reason);
    run
}

/// Relative parameter errors at the end.
fn errors(run: &Run, id: &str) -> Vec<f64> {
    let sizes = robot(id).unwrap().parameter_sizes();
    let report = &run.report;
    let pairs = report.theta_hat_end.iter().zip(&report.theta_true);
    pairs.zip(sizes).map(|((estimate, truth), size)| (estimate - truth) / size).collect()
}

fn norm(errors: &[f64]) -> f64 {
    errors.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// A few moves, then rest: no excitation any more.
fn moves_then_rest(points: &[&[f64]]) -> TrajectoryDocument {
    TrajectoryDocument {
        kind: TrajectoryKind::MinimumJerk,
        points_deg: Some(points.iter().map(|point| point.to_vec()).collect()),
        move_s: Some(0.6),
        dwell_s: Some(0.05),
        ..TrajectoryDocument::of_robot()
    }
}

/// After the last move nothing is excited any more. What the gradient law does not know by then it hardly learns; concurrent learning goes
/// on until it knows everything. An independent program gives the two-link arm 0.0028 after 14 s, and with a weight of 10 no solution:
/// Γ γ Yf² is then beyond what steps of 1 ms can follow.
#[test]
fn concurrent_learning_needs_no_persistent_excitation() {
    let ways: [(&str, &[&[f64]], f64); 2] = [
        ("pendulum", &[&[60.0], &[-40.0], &[80.0], &[20.0], &[-60.0], &[30.0]], 10.0),
        (
            "two_link",
            &[
                &[0.0, 0.0],
                &[60.0, 30.0],
                &[-30.0, 90.0],
                &[40.0, -60.0],
                &[90.0, 40.0],
                &[10.0, 80.0],
                &[-20.0, -40.0],
            ],
            3.0,
        ),
    ];
    for (id, points, weight) in ways {
        let learned = |adaptation: Option<AdaptationDocument>, duration_s| {
            let mut document = document(id, adaptation, duration_s);
            document.trajectory = moves_then_rest(points);
            norm(&errors(&run(document), id))
        };
        let concurrent = AdaptationDocument {
            kind: AdaptationKind::Concurrent,
            weight: Some(weight),
            record_every_s: Some(0.02),
            stack: Some(40),
            ..Default::default()
        };
        let gradient = learned(None, 20.0);
        let stack = [7.0, 20.0].map(|duration_s| learned(Some(concurrent.clone()), duration_s));
        println!("{id}: gradient {gradient}, concurrent {stack:?}");
        assert!(gradient > 0.3, "{id}: {gradient}");
        assert!(stack[1] < 0.01 && stack[1] < 0.2 * stack[0], "{id}: {stack:?}");
    }
}

/// The law by itself, against matrices: `−Γ (g + γ/n Σ Yᵀ (Y θ̂ − τ))`; and its filter's output is that of the filter's own step.
#[test]
fn concurrent_learning_is_its_equation() {
    type Law = ConcurrentLearning<TwoLink, f64, 2, 11>;
    const FILTER: usize = FilteredRegressor::<TwoLink, f64, 2, 11>::STATES;
    let law = Law {
        filter: FilteredRegressor::new(15.0),
        gain: SVector::from_fn(|k, _| 0.5 + k as f64),
        weight: 3.0,
        capacity: 5,
        scale: SVector::repeat(1.0),
    };
    let mut states = vec![0.0; AdaptationLaw::<TwoLink, f64, 2, 11>::states(&law)];
    let mut moments = Vec::new();
    let at = |n: usize| {
        let x = n as f64;
        (TwoLink::geometry(&Vector2::new(0.3 * x, 1.0 - 0.4 * x)), Vector2::new(1.0 - 0.2 * x, 0.5 * x - 1.0))
    };
    law.initialize(&at(0).0, &at(0).1, &mut states);
    for n in 1..4 {
        for (k, state) in states[..FILTER].iter_mut().enumerate() {
            *state += ((n * 7 + k * 3) % 11) as f64 * 0.1 - 0.5;
        }
        let (geometry, velocity) = at(n);
        law.record(&geometry, &velocity, &mut states);
        assert_eq!(Law::recorded(states.as_slice()), n);
        let sign = FrictionSign::True.of(&velocity);
        let torque = Vector2::zeros();
        moments.push(law.filter.advance(&geometry, &velocity, &sign, &torque, states.as_slice(), &mut [0.0; FILTER]));
    }
    let (geometry, velocity) = at(5);
    let gradient = SVector::<f64, 11>::from_fn(|k, _| 0.1 * k as f64 - 0.3);
    let theta_hat: Vec<f64> = (0..11).map(|k| 1.0 - 0.1 * f64::from(k)).collect();
    let input = AdaptationInput::<TwoLink, f64, 2, 11> {
        geometry: &geometry,
        velocity: &velocity,
        sign_velocity: &velocity,
        torque: &Vector2::zeros(),
        gradient: &gradient,
        theta_hat: &theta_hat,
    };
    let (mut rate, mut states_rate) = ([0.0; 11], vec![9.0; states.len()]);
    law.derivative(None, &input, states.as_slice(), &mut rate, &mut states_rate);
    assert!(states_rate[FILTER..].iter().all(|rate| *rate == 0.0), "what is recorded rests");
    let mut drive = DVector::from_column_slice(gradient.as_slice());
    for (y, tau) in &moments {
        let y = DMatrix::from_fn(2, 11, |i, k| y[(i, k)]);
        let error = &y * DVector::from_column_slice(&theta_hat) - DVector::from_column_slice(tau.as_slice());
        drive += y.transpose() * error;
    }
    for k in 0..11 {
        let plain = gradient[k];
        let expected = -(0.5 + k as f64) * (plain + (drive[k] - plain) * 3.0 / 3.0);
        assert!((rate[k] - expected).abs() < 1e-12 * (1.0 + expected.abs()), "{k}: {} for {expected}", rate[k]);
    }
}

/// Mixing gives each parameter an equation of its own: every error falls from sample to sample, and none ever rises.
#[test]
fn with_drem_every_parameter_error_falls_by_itself() {
    for (id, floor, bound) in [("pendulum", 1e-3, 1e-3), ("two_link", 1e-4, 1e-2)] {
        let drem =
            AdaptationDocument { kind: AdaptationKind::Drem, excitation_floor: Some(floor), ..Default::default() };
        let run = run(document(id, Some(drem), 10.0));
        let left = norm(&errors(&run, id));
        println!("{id}: {left}");
        assert!(left < bound, "{id}: {left}");
        for (k, truth) in run.report.theta_true.iter().enumerate() {
            let mut before = f64::INFINITY;
            for estimate in run.recording.signal(Signal::ThetaHat, k) {
                let error = (estimate - truth).abs();
                assert!(error <= before + 1e-6 * truth.abs(), "{id}, θ{}: {error} after {before}", k + 1);
                before = error;
            }
        }
    }
}

/// `θ̃_i' = −r Δ²/(φ^{2P} + Δ²) θ̃_i`: one factor for all, which falls no faster than `e^{−rt}`.
#[test]
fn drem_makes_all_parameter_errors_fall_by_one_factor() {
    let rate = 0.7;
    let drem = AdaptationDocument {
        kind: AdaptationKind::Drem,
        rate_per_s: Some(rate),
        excitation_floor: Some(3e-3),
        ..Default::default()
    };
    let mut document = document("pendulum", Some(drem), 10.0);
    // Smooth, so that the filter integrates exactly enough.
    document.plant.friction.width_rad_s = 0.5;
    document.integration.step_s = 2e-4;
    let run = run(document);
    let left = |k: usize| -> Vec<f64> {
        let truth = run.report.theta_true[k];
        let errors: Vec<_> = run.recording.signal(Signal::ThetaHat, k).map(|estimate| estimate - truth).collect();
        errors.iter().map(|error| error / errors[0]).collect()
    };
    let first = left(0);
    for k in 1..4 {
        let apart = left(k).iter().zip(&first).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        println!("θ{}: {apart}", k + 1);
        assert!(apart < 1e-3, "θ{}: {apart}", k + 1);
    }
    for (t, share) in run.recording.times_s().zip(&first) {
        assert!(*share >= (-rate * t).exp() - 1e-3, "{t} s: {share}");
    }
    let end = first[first.len() - 1];
    assert!(end < 0.1, "{end}");
}

/// A stack is part of the state: a run of a sampled controller that was paused goes on with the same bits.
#[test]
fn a_stack_survives_a_pause() {
    let mut document = document(
        "two_link",
        Some(AdaptationDocument {
            kind: AdaptationKind::Concurrent,
            stack: Some(6),
            record_every_s: Some(0.004),
            ..Default::default()
        }),
        0.4,
    );
    document.effects = Some(EffectsDocument {
        sampling: Some(SamplingDocument { period_s: 0.002, delay_s: 0.0 }),
        ..Default::default()
    });
    let scenario = Scenario::new(document).unwrap();
    let whole = scenario.run();
    let mut simulation = scenario.start();
    for _ in 0..7 {
        simulation.advance(37);
        simulation = scenario.resume(simulation.snapshot()).unwrap();
    }
    simulation.advance(u64::MAX);
    assert_eq!(scenario.finish(simulation), whole);
}
