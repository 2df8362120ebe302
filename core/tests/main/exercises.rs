//! Exercises: documents are checked, runs follow from gains and seed, grades from reports, and nothing hidden leaks.

use adaptarm_core::exercises::{Exercise, ExerciseDocument, Grade, GradeError, Released, Visibility};
use adaptarm_core::scenario::{Report, Scenario};
use serde_json::{Value, json};
use std::collections::BTreeMap;

fn text(of: &str) -> Value {
    json!({ "en": of, "es": of })
}

/// A pendulum held by PD against gravity: plants differ in gravity.
fn document() -> Value {
    let fields = json!([{
        "field": "/plant/theta_scale/3", "distribution": { "kind": "uniform", "min": 0.8, "max": 1.2 }
    }]);
    let limit = |id: &str, metric: &str, full: f64, zero: f64| json!({ "id": id, "label": text(id), "metric": metric, "full": full, "zero": zero, "weight": 5.0 });
    let moved = |name: &str, field: &str, max: f64, start: f64| json!({ "name": name, "label": text(name), "fields": [field], "min": 0.0, "max": max, "start": start });
    json!({
        "format": "adaptarm.exercise/1", "id": "hold", "level": "first", "minutes": 10,
        "title": text("Hold"), "goal": text("goal"), "statement": text("statement"), "explanation": text("because"),
        "teacher_note": text("note"),
        "hints": [{ "after_attempts": 2, "text": text("hint") }],
        "scenario": {
            "format": "adaptarm.scenario/1", "robot": "pendulum",
            "scheme": { "kind": "pd", "gains": { "k_p": [20.0], "k_d": [2.0] } },
            "integration": { "duration_s": 1.0 }, "recording": { "samples": 100 },
        },
        "moves": [moved("k_p", "/scheme/gains/k_p/0", 500.0, 20.0), moved("k_d", "/scheme/gains/k_d/0", 50.0, 2.0)],
        "visible": { "count": 2, "fields": fields },
        "hidden": { "count": 3, "fields": fields, "vary_seed": true },
        "criteria": [limit("error", "e_peak_deg", 2.0, 12.0), limit("effort", "tau_peak_nm", 30.0, 60.0)],
        "solutions": [{ "name": "stiff", "gains": { "k_p": 400.0, "k_d": 20.0 } }],
    })
}

fn exercise(document: &Value) -> Exercise {
    Exercise::read(document).unwrap()
}

fn gains(k_p: f64, k_d: f64) -> BTreeMap<String, f64> {
    [("k_p".to_owned(), k_p), ("k_d".to_owned(), k_d)].into()
}

fn reports(exercise: &Exercise, gains: &BTreeMap<String, f64>, seed: u64, visibility: Visibility) -> Vec<Report> {
    let runs = exercise.runs(gains, seed, visibility).unwrap();
    runs.iter().map(|run| run.run().report).collect()
}

fn grade(exercise: &Exercise, gains: &BTreeMap<String, f64>, visibility: Visibility) -> Grade {
    exercise.grade(gains, 7, visibility, &reports(exercise, gains, 7, visibility)).unwrap()
}

#[test]
fn runs_follow_from_gains_and_seed() {
    let exercise = exercise(&document());
    let hashes = |seed, visibility| {
        let runs = exercise.runs(&gains(50.0, 5.0), seed, visibility).unwrap();
        runs.iter().map(Scenario::hash).collect::<Vec<_>>()
    };
    let visible = hashes(1, Visibility::Visible);
    assert_eq!(visible, hashes(1, Visibility::Visible));
    assert_eq!((visible.len(), hashes(1, Visibility::Hidden).len()), (2, 3));
    let all = [visible, hashes(2, Visibility::Visible), hashes(1, Visibility::Hidden), hashes(2, Visibility::Hidden)];
    let mut all = all.concat();
    all.sort();
    all.dedup();
    assert_eq!(all.len(), 10, "each variant of each seed is another plant");
    let run = &exercise.runs(&gains(50.0, 5.0), 1, Visibility::Hidden).unwrap()[0];
    assert_eq!(json!(run.document())["scheme"]["gains"], json!({ "k_p": [50.0], "k_d": [5.0] }));
    assert_ne!(run.document().seed, 0);
}

#[test]
fn credit_is_whole_within_linear_between_and_none_beyond() {
    let exercise = exercise(&document());
    let stiff = grade(&exercise, &gains(400.0, 20.0), Visibility::Hidden);
    assert_eq!((stiff.score, stiff.points, stiff.of), (1.0, 10.0, 10.0));
    let soft = grade(&exercise, &gains(20.0, 2.0), Visibility::Hidden);
    assert_eq!(soft.criteria[1].points, 5.0);
    for gains in [gains(60.0, 5.0), gains(100.0, 10.0), gains(20.0, 2.0)] {
        let grade = grade(&exercise, &gains, Visibility::Hidden);
        let worst = grade.variants.iter().map(|variant| variant.criteria[0].value.unwrap()).fold(0.0, f64::max);
        let share = ((12.0 - worst) / 10.0).clamp(0.0, 1.0);
        assert!((grade.criteria[0].share - share).abs() < 1e-12, "{worst} deg: {share}");
        assert_eq!(grade.criteria[0].points, (share * 500.0).round() / 100.0);
    }
}

#[test]
fn shares_are_folded_as_the_criterion_says() {
    let fold = |aggregate: Value| {
        let mut document = document();
        let criterion = document["criteria"][0].as_object_mut().unwrap();
        criterion.extend(aggregate.as_object().unwrap().clone());
        let grade = grade(&exercise(&document), &gains(60.0, 5.0), Visibility::Hidden);
        let mut shares: Vec<_> = grade.variants.iter().map(|variant| variant.criteria[0].share).collect();
        shares.sort_by(f64::total_cmp);
        (grade.criteria[0].share, shares)
    };
    let (share, shares) = fold(json!({ "aggregate": "mean" }));
    assert!((share - shares.iter().sum::<f64>() / 3.0).abs() < 1e-15);
    let (share, shares) = fold(json!({ "aggregate": "worst" }));
    assert_eq!(share, shares[0]);
    let (share, shares) = fold(json!({ "aggregate": "quantile", "quantile": 0.5 }));
    assert_eq!(share, shares[1]);
    assert!(shares[0] < shares[1] && shares[1] < shares[2] && shares[2] < 1.0, "{shares:?}");
}

#[test]
fn more_can_be_better() {
    let mut document = document();
    document["criteria"][1]["full"] = json!(60.0);
    document["criteria"][1]["zero"] = json!(0.0);
    let grade = grade(&exercise(&document), &gains(20.0, 2.0), Visibility::Visible);
    for variant in &grade.variants {
        let (value, share) = (variant.criteria[1].value.unwrap(), variant.criteria[1].share);
        assert!((share - value / 60.0).abs() < 1e-12);
    }
}

#[test]
fn a_run_that_diverged_gets_nothing() {
    let exercise = exercise(&document());
    let gains = gains(400.0, 20.0);
    let mut reports = reports(&exercise, &gains, 7, Visibility::Hidden);
    reports[1].outcome = adaptarm_core::scenario::OutcomeKind::Diverged;
    let grade = exercise.grade(&gains, 7, Visibility::Hidden, &reports).unwrap();
    assert_eq!((grade.score, grade.variants[1].criteria[0].value), (0.0, None));
    assert!((grade.criteria[0].full_share - 2.0 / 3.0).abs() < 1e-15);
}

#[test]
fn the_public_grade_says_nothing_about_hidden_variants() {
    let exercise = exercise(&document());
    let hidden = grade(&exercise, &gains(60.0, 5.0), Visibility::Hidden);
    let public = json!(hidden.public());
    let names: Vec<_> = public.as_object().unwrap().keys().map(String::as_str).collect();
    assert_eq!(names, ["core_version", "criteria", "exercise", "fingerprint", "of", "points", "score", "visibility"]);
    let names: Vec<_> = public["criteria"][0].as_object().unwrap().keys().map(String::as_str).collect();
    assert_eq!(names, ["id", "label", "of", "points"]);
    assert_eq!(public["score"], json!(hidden.score));
    let visible = grade(&exercise, &gains(60.0, 5.0), Visibility::Visible);
    assert_eq!(visible.public().variants, visible.variants);
}

#[test]
fn the_public_document_is_an_exercise_with_the_same_visible_runs() {
    let whole = exercise(&document());
    let public = whole.public(Released { attempts: 1, explanation: false });
    let names: Vec<_> = json!(public).as_object().unwrap().keys().cloned().collect();
    for secret in ["hidden", "solutions", "teacher_note", "explanation", "hints"] {
        assert!(!names.iter().any(|name| name == secret), "{secret}");
    }
    let public = exercise(&json!(public));
    let gains = gains(60.0, 5.0);
    let runs = |exercise: &Exercise| exercise.runs(&gains, 3, Visibility::Visible).unwrap();
    assert_eq!(runs(&public), runs(&whole));
    assert!(public.runs(&gains, 3, Visibility::Hidden).unwrap_err().to_string().starts_with("hidden:"));
    let later = whole.public(Released { attempts: 2, explanation: true });
    assert!(later.hints.len() == 1 && later.explanation.is_some() && later.teacher_note.is_none());
}

#[test]
fn the_fingerprint_covers_what_grades_and_no_text() {
    let fingerprint = |change: &dyn Fn(&mut Value)| {
        let mut document = document();
        change(&mut document);
        exercise(&document).fingerprint()
    };
    let plain = fingerprint(&|_| {});
    assert_eq!(plain, fingerprint(&|document| document["statement"]["en"] = json!("other words")));
    assert_eq!(plain, fingerprint(&|document| document["solutions"] = json!([])));
    let changes: [&dyn Fn(&mut Value); 5] = [
        &|document| document["criteria"][0]["full"] = json!(2.5),
        &|document| document["moves"][0]["max"] = json!(501.0),
        &|document| document["hidden"]["count"] = json!(4),
        &|document| document["scenario"]["integration"]["duration_s"] = json!(2.0),
        &|document| document["id"] = json!("other"),
    ];
    for change in changes {
        assert_ne!(plain, fingerprint(change));
    }
}

#[test]
fn what_a_student_may_not_submit_is_refused_by_name() {
    let exercise = exercise(&document());
    let refusal = |gains: &BTreeMap<String, f64>| exercise.runs(gains, 0, Visibility::Hidden).unwrap_err().to_string();
    let range = "is outside the allowed range 0 to 500";
    assert_eq!(refusal(&gains(501.0, 1.0)), format!("gains.k_p: 501 {range}"));
    assert_eq!(refusal(&gains(f64::NAN, 1.0)), format!("gains.k_p: NaN {range}"));
    assert_eq!(refusal(&gains(f64::INFINITY, 1.0)), format!("gains.k_p: inf {range}"));
    let mut stray = gains(1.0, 1.0);
    stray.insert("plant".to_owned(), 1.0);
    assert_eq!(refusal(&stray), "gains: \"plant\" is not known; allowed: k_p, k_d");
    let few = [("k_p".to_owned(), 1.0)].into();
    assert_eq!(refusal(&few), "gains.k_d: missing; needed are k_p, k_d");
    let seed = exercise.runs(&gains(1.0, 1.0), u64::MAX, Visibility::Hidden).unwrap_err();
    assert_eq!(seed.pointer, "/seed");
}

#[test]
fn reports_on_other_runs_are_not_graded() {
    let exercise = exercise(&document());
    let mine = gains(400.0, 20.0);
    let grade = |reports: &[Report]| exercise.grade(&mine, 7, Visibility::Hidden, reports).unwrap_err();
    let mut all = reports(&exercise, &mine, 7, Visibility::Hidden);
    assert!(matches!(grade(&all[..2]), GradeError::Count { found: 2, expected: 3 }));
    assert!(matches!(
        grade(&reports(&exercise, &gains(400.0, 20.5), 7, Visibility::Hidden)),
        GradeError::OtherScenario { variant: 0, .. }
    ));
    all[2].outcome = adaptarm_core::scenario::OutcomeKind::Unfinished;
    assert_eq!(grade(&all), GradeError::Unfinished { variant: 2 });
    all.swap(0, 1);
    assert!(matches!(grade(&all), GradeError::OtherScenario { variant: 0, .. }));
}

#[test]
fn estimates_are_judged_by_their_distance_from_the_truth() {
    let mut document = document();
    document["scenario"]["scheme"] = json!({ "kind": "pd_gravity" });
    document["criteria"][0]["metric"] = json!("theta_error_percent");
    document["criteria"][1]["metric"] = json!("theta_error_percent_4");
    let exercise = exercise(&document);
    let grade = grade(&exercise, &gains(60.0, 5.0), Visibility::Hidden);
    let runs = exercise.runs(&gains(60.0, 5.0), 7, Visibility::Hidden).unwrap();
    for (variant, run) in grade.variants.iter().zip(&runs) {
        // The controller knows the nominal gravity; the arm's is scaled, and nothing else is.
        let scale = run.document().plant.theta_scale.as_ref().unwrap()[3];
        let error = 100.0 * (1.0 / scale - 1.0).abs();
        assert!((variant.criteria[1].value.unwrap() - error).abs() < 1e-9);
        assert!((variant.criteria[0].value.unwrap() - 0.5 * error).abs() < 1e-9, "root of the mean of four squares");
    }
}

#[test]
fn mistakes_in_a_document_are_named() {
    let refusal = |pointer: &str, value: Value| {
        let mut document = document();
        *document.pointer_mut(pointer).unwrap() = value;
        Exercise::read(&document).unwrap_err().to_string()
    };
    for (pointer, value, told) in [
        ("/format", json!("adaptarm.exercise/2"), "format: \"adaptarm.exercise/2\" is not known"),
        ("/id", json!("../hold"), "id: \"../hold\" is not known; allowed: a lower-case letter"),
        ("/minutes", json!(0), "minutes: 0 is outside the allowed range 1 to 1000 min"),
        ("/title/es", json!(" "), "title.es: is empty"),
        ("/statement/en", json!("a\u{7}"), "statement.en: holds a control character"),
        ("/hints/0/after_attempts", json!(101), "hints[0].after_attempts: 101 is outside"),
        ("/scenario/robot", json!("toaster"), "scenario.robot: \"toaster\" is not known"),
        ("/moves/0/fields/0", json!("/scheme/gains/k_i/0"), "moves[0].fields[0]: "),
        ("/moves/1/fields/0", json!("/scheme/gains/k_p/0"), "moves: /scheme/gains/k_p/0 varies twice"),
        ("/moves/0/start", json!(501), "moves[0].start: 501 is outside the allowed range 0 to 500"),
        ("/moves/1/name", json!("k_p"), "moves[1].name: \"k_p\" is taken already"),
        ("/visible/count", json!(9), "visible.count: 9 is outside the allowed range 1 to 8 variants"),
        ("/hidden/count", json!(0), "hidden.count: 0 is outside"),
        ("/hidden/fields/0/field", json!("/scheme/gains/k_p/0"), "hidden.fields: /scheme/gains/k_p/0 is the student's"),
        ("/criteria/0/metric", json!("beauty"), "criteria[0].metric: \"beauty\" is not known; allowed: index_e_deg,"),
        ("/criteria/0/metric", json!("theta_error_percent_05"), "criteria[0].metric: "),
        ("/criteria/0/zero", json!(2.0), "criteria[0].zero: is 2 like full"),
        ("/criteria/0/weight", json!(0.333), "criteria[0].weight: 0.333 is no whole number of hundredths"),
        ("/solutions/0/gains/k_p", json!(600), "solutions[0].gains.k_p: 600 is outside the allowed range 0 to 500"),
        ("/scenario/integration/duration_s", json!(500), "scenario.integration: 500000 steps in each of 5 variants"),
    ] {
        let found = refusal(pointer, value);
        assert!(found.starts_with(told), "{found}\nis not\n{told}");
    }
    let mut quantile = document();
    quantile["criteria"][0]["aggregate"] = json!("quantile");
    assert!(Exercise::read(&quantile).unwrap_err().to_string().starts_with("criteria[0].quantile: missing"));
}

#[test]
fn a_document_reads_back_as_it_was_written() {
    let exercise = exercise(&document());
    let again: ExerciseDocument = serde_json::from_value(json!(exercise.document())).unwrap();
    assert_eq!(&again, exercise.document());
}
