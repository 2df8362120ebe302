//! Integral action and signs of terms: nothing at zero strength, the right thing otherwise, no bits lost over a pause.

use adaptarm_core::recording::Signal;
use adaptarm_core::scenario::{
    DisturbanceDocument, EffectsDocument, InitialVelocityDocument, IntegralDocument, OutcomeKind, PdGains, Run,
    Scenario, ScenarioDocument, Scheme, SchemeDocument, SignsDocument, SlotineLiGains, TrajectoryDocument,
    TrajectoryKind,
};

fn run(document: ScenarioDocument) -> Run {
    Scenario::new(document).unwrap().run()
}

fn short(scheme: Scheme) -> ScenarioDocument {
    let mut document = scheme.paper();
    document.integration.duration_s = 0.5;
    document.recording.samples = 100;
    document
}

/// A pendulum that is held at 60°, by PD and what else there is.
fn held(scheme: SchemeDocument) -> ScenarioDocument {
    let mut document = ScenarioDocument::of_robot("pendulum", scheme);
    document.trajectory =
        TrajectoryDocument { kind: TrajectoryKind::Fourier, offset_deg: Some(vec![60.0]), ..Default::default() };
    document
}

#[test]
fn at_zero_strength_no_bit_changes() {
    for scheme in Scheme::ALL {
        let ideal = run(short(scheme)).report.trajectory_hash;
        let mut none = short(scheme);
        none.integral = Some(IntegralDocument { k_i: vec![0.0; 3] });
        none.signs =
            Some(SignsDocument { feedback: Some(1.0), reference: Some(1.0), model: Some(1.0), adaptation: Some(1.0) });
        assert_eq!(run(none).report.trajectory_hash, ideal, "{}", scheme.id());
    }
}

#[test]
fn integral_action_removes_what_pd_leaves_at_rest() {
    let pd = run(held(SchemeDocument::Pd(None))).report;
    // At rest K_p e carries gravity but for what dry friction takes; K_p = 50.
    let left = pd.q_end_rad[0] - 60_f64.to_radians();
    assert!(left < -0.05, "{left}");
    let mut document = held(SchemeDocument::Pd(None));
    document.integral = Some(IntegralDocument { k_i: vec![60.0] });
    let pid = run(document).report;
    let left = pid.q_end_rad[0] - 60_f64.to_radians();
    assert!(left.abs() < 1e-3, "{left}");
}

/// Without weight and friction, pushed from rest by d, with gains that put all three poles at −p: `e(t) = d t² e^{−pt} / 2I`.
#[test]
fn a_pushed_pid_is_its_linear_closed_form() {
    let (inertia, push, p) = (0.25, 0.5, 4.0);
    let gains = PdGains { k_p: vec![3.0 * p * p * inertia], k_d: vec![3.0 * p * inertia] };
    let mut document = held(SchemeDocument::Pd(Some(gains)));
    document.integral = Some(IntegralDocument { k_i: vec![p * p * p * inertia] });
    document.plant.theta_scale = Some(vec![1.0, 0.0, 0.0, 0.0]);
    (document.integration.duration_s, document.recording.samples) = (3.0, 300);
    let disturbance = DisturbanceDocument { constant_nm: Some(vec![push]), ..Default::default() };
    document.effects = Some(EffectsDocument { disturbance: Some(disturbance), ..Default::default() });
    let run = run(document);
    for (t, e) in run.recording.times_s().zip(run.recording.signal(Signal::Error, 0)) {
        let expected = push * t * t * (-p * t).exp() / (2.0 * inertia);
        assert!((e - expected).abs() < 1e-10, "{t} s: {e} for {expected}");
    }
}

#[test]
fn a_misprinted_adaptation_diverges_or_learns_nothing() {
    let mut document = Scheme::SlotineLi.paper();
    let right = run(document.clone()).report;
    document.signs = Some(SignsDocument { adaptation: Some(-1.0), ..Default::default() });
    let wrong = run(document).report;
    assert_eq!(right.outcome, OutcomeKind::Completed);
    assert_eq!(wrong.outcome, OutcomeKind::Diverged);
}

#[test]
fn each_sign_is_that_of_its_term() {
    // Without adaptation, the turned model of a PD with gravity pulls down with the arm's weight.
    let hash = |signs| {
        let mut document = short(Scheme::SlotineLi);
        document.effects = Some(EffectsDocument { theta_hat_scale: Some(vec![1.0; 18]), ..Default::default() });
        document.signs = Some(signs);
        run(document).report.trajectory_hash
    };
    let mut all: Vec<_> = [
        SignsDocument::default(),
        SignsDocument { feedback: Some(-1.0), ..Default::default() },
        SignsDocument { reference: Some(-1.0), ..Default::default() },
        SignsDocument { model: Some(-1.0), ..Default::default() },
        SignsDocument { adaptation: Some(-1.0), ..Default::default() },
    ]
    .map(hash)
    .into();
    all.sort();
    all.dedup();
    assert_eq!(all.len(), 5);
}

/// Slotine and Li's controller of a pendulum of inertia I, without friction or weight, that knows I and does not learn; with
/// `κ = K_s/I`.
fn frozen(signs: &SignsDocument) -> ScenarioDocument {
    let gains = SlotineLiGains { k_s: vec![KAPPA * INERTIA], lambda: vec![LAMBDA], gamma_adapt: vec![1.0; 4] };
    let mut document = held(SchemeDocument::SlotineLi(Some(gains)));
    let only_inertia = || Some(vec![1.0, 0.0, 0.0, 0.0]);
    document.plant.theta_scale = only_inertia();
    document.effects = Some(EffectsDocument { theta_hat_scale: only_inertia(), ..Default::default() });
    document.signs = Some(SignsDocument { adaptation: Some(0.0), ..signs.clone() });
    (document.integration.duration_s, document.recording.samples) = (1.5, 150);
    document
}

const INERTIA: f64 = 0.25;
const KAPPA: f64 = 8.0;
const LAMBDA: f64 = 2.0;

/// With signs f and r, `s = ė + r λ e` and `I ṡ = −f K_s s`: from rest beside a sine,
/// `e = s₀ (e^{−rλt} − e^{−fκt}) / (fκ − rλ)`.
#[test]
fn turned_feedback_and_reference_run_along_their_closed_forms() {
    for (f, r) in [(1.0, 1.0), (-1.0, 1.0), (0.0, 1.0), (0.5, 1.0), (1.0, -1.0), (1.0, -0.3), (-1.0, -1.0)] {
        let mut document = frozen(&SignsDocument { feedback: Some(f), reference: Some(r), ..Default::default() });
        document.trajectory.sine_deg = Some(vec![vec![2.0]]);
        document.initial.velocity = InitialVelocityDocument::Rest;
        let run = run(document);
        let (start, decays) = (-2_f64.to_radians(), [f * KAPPA, r * LAMBDA]);
        let [by_feedback, by_reference] = decays;
        let signals = [Signal::Error, Signal::SlidingVariable].map(|signal| run.recording.signal(signal, 0));
        let [errors, sliding] = signals;
        let mut count = 0;
        for ((t, e), s) in run.recording.times_s().zip(errors).zip(sliding) {
            let wanted_s = start * (-by_feedback * t).exp();
            let wanted_e =
                start * ((-by_reference * t).exp() - (-by_feedback * t).exp()) / (by_feedback - by_reference);
            assert!((s - wanted_s).abs() < 1e-9 * wanted_s.abs().max(1.0), "f {f}, r {r}, {t} s: s {s} for {wanted_s}");
            assert!((e - wanted_e).abs() < 1e-9 * wanted_e.abs().max(1.0), "f {f}, r {r}, {t} s: e {e} for {wanted_e}");
            count += 1;
        }
        // The one that grows fastest leaves at its own time, not before.
        assert!(count > 100 || f < 0.0, "{count} samples");
        assert!(run.recording.signal(Signal::ThetaHat, 0).all(|inertia| inertia == INERTIA));
    }
}

/// With sign m of the model, pushed by d where it is held: `ë + (mλ + κ) ė + κλ e = d/I`.
#[test]
fn a_turned_model_takes_damping_away() {
    let push = 0.5;
    for m in [-1.0_f64, -0.5] {
        let mut document = frozen(&SignsDocument { model: Some(m), ..Default::default() });
        let disturbance = DisturbanceDocument { constant_nm: Some(vec![push]), ..Default::default() };
        document.effects.as_mut().unwrap().disturbance = Some(disturbance);
        let half = 0.5 * (m * LAMBDA + KAPPA);
        let omega = (KAPPA * LAMBDA - half * half).sqrt();
        let run = run(document);
        for (t, e) in run.recording.times_s().zip(run.recording.signal(Signal::Error, 0)) {
            let swing = (-half * t).exp() * ((omega * t).cos() + half / omega * (omega * t).sin());
            let wanted = push / (INERTIA * KAPPA * LAMBDA) * (1.0 - swing);
            assert!((e - wanted).abs() < 1e-9, "m {m}, {t} s: {e} for {wanted}");
        }
    }
}

/// Without friction and feedback, `I s²/2 + Σ θ̃²/(2 a Γ)` stays what it was, whatever is wanted: `I ṡ = Y θ̃` and
/// `θ̃' = −a Γ Yᵀ s`. With the printed sign, a = −1, both grow together.
#[test]
fn adaptation_of_either_sign_keeps_its_energy() {
    let (gamma, truth) = ([0.005, 0.02, 0.01, 0.2], [INERTIA, 0.0, 0.0, 0.5 * 9.81]);
    for a in [1.0, 0.4, -0.4, -1.0] {
        let gains = SlotineLiGains { k_s: vec![1.0], lambda: vec![LAMBDA], gamma_adapt: gamma.to_vec() };
        let mut document = ScenarioDocument::of_robot("pendulum", SchemeDocument::SlotineLi(Some(gains)));
        document.plant.theta_scale = Some(vec![1.0, 0.0, 0.0, 1.0]);
        document.plant.friction.width_rad_s = 1.0;
        document.effects =
            Some(EffectsDocument { theta_hat_scale: Some(vec![0.8, 0.5, 0.3, 0.9]), ..Default::default() });
        document.signs = Some(SignsDocument { feedback: Some(0.0), adaptation: Some(a), ..Default::default() });
        (document.integration.duration_s, document.recording.samples) = (1.0, 100);
        let run = run(document);
        assert_eq!(run.report.outcome, OutcomeKind::Completed, "a {a}");
        let estimates: Vec<Vec<f64>> = (0..4).map(|k| run.recording.signal(Signal::ThetaHat, k).collect()).collect();
        let parts: Vec<[f64; 2]> = run
            .recording
            .signal(Signal::SlidingVariable, 0)
            .enumerate()
            .map(|(n, s)| {
                let wrong = |k: usize| (estimates[k][n] - truth[k]).powi(2) / (2.0 * a * gamma[k]);
                [0.5 * INERTIA * s * s, (0..4).map(wrong).sum::<f64>()]
            })
            .collect();
        let [kinetic, learned] = parts[0];
        assert!(parts.iter().any(|part| (part[0] - kinetic).abs() > 1e-3), "a {a}: nothing moves");
        for [now_kinetic, now_learned] in parts {
            let change = now_kinetic + now_learned - kinetic - learned;
            assert!(change.abs() < 1e-9 * now_kinetic.max(1.0), "a {a}: {change}");
        }
    }
}

#[test]
fn parameters_of_a_yardstick_can_be_off() {
    let with = |scale: f64| {
        let mut document = held(SchemeDocument::PdGravity(None));
        document.effects = Some(EffectsDocument { theta_hat_scale: Some(vec![scale; 4]), ..Default::default() });
        run(document).report.trajectory_hash
    };
    assert_eq!(with(0.0), run(held(SchemeDocument::Pd(None))).report.trajectory_hash);
    assert_eq!(with(1.0), run(held(SchemeDocument::PdGravity(None))).report.trajectory_hash);
    assert_ne!(with(0.5), with(1.0));
}

#[test]
fn a_pause_loses_no_bit_of_the_integral() {
    let mut document = short(Scheme::SlotineLi);
    document.integral = Some(IntegralDocument { k_i: vec![50.0; 3] });
    let scenario = Scenario::new(document).unwrap();
    let whole = scenario.run().report;
    let mut first = scenario.start();
    first.advance(123);
    let mut second = scenario.resume(first.snapshot()).unwrap();
    second.advance(u64::MAX);
    assert_eq!(scenario.finish(second).report, whole);
}

#[test]
fn what_has_no_meaning_is_refused() {
    let refusal = |change: &dyn Fn(&mut ScenarioDocument)| {
        let mut document = held(SchemeDocument::Pd(None));
        change(&mut document);
        Scenario::new(document).unwrap_err().to_string()
    };
    let two = refusal(&|document| document.integral = Some(IntegralDocument { k_i: vec![1.0; 2] }));
    assert!(two.starts_with("integral.k_i: has 2 numbers where 1 are needed"), "{two}");
    let negative = refusal(&|document| document.integral = Some(IntegralDocument { k_i: vec![-1.0] }));
    assert!(negative.starts_with("integral.k_i[0]: -1 is outside the allowed range 0 to 1000000"), "{negative}");
    let signs = refusal(&|document| document.signs = Some(SignsDocument::default()));
    assert_eq!(signs, "signs: has no meaning for a scheme that does not adapt");
    let big = refusal(&|document| {
        document.scheme = SchemeDocument::SlotineLi(None);
        document.signs = Some(SignsDocument { model: Some(2.0), ..Default::default() });
    });
    assert_eq!(big, "signs.model: 2 is outside the allowed range -1 to 1");
}
