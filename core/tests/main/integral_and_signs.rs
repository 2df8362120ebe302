//! Integral action and signs of terms: nothing at zero strength, the right thing otherwise, no bits lost over a pause.

use adaptarm_core::scenario::{
    EffectsDocument, IntegralDocument, OutcomeKind, Run, Scenario, ScenarioDocument, Scheme, SchemeDocument,
    SignsDocument, TrajectoryDocument, TrajectoryKind,
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
