//! How many steps an experiment takes is known before its first run, whichever of its fields say how long runs are.

use super::tuning::tuning_section;
use super::{SCHEMES, experiment, scenario};
use adaptarm_core::experiments::Experiment;
use serde_json::{Value, json};

const STEP: &str = "/integration/step_s";
const DURATION: &str = "/integration/duration_s";

/// Steps of all runs, one by one; a run that is refused takes none.
fn counted(experiment: &Experiment) -> u64 {
    let scenarios = experiment.plan(0..u64::MAX).into_iter().filter_map(|run| run.scenario.ok());
    scenarios.map(|scenario| scenario.settings().steps()).sum()
}

#[test]
fn every_step_is_counted_before_the_first_run() {
    let grid = |axes: Value| ("sweep", json!({ "design": "grid", "axes": axes }));
    let filled = |design: &str, axes: &Value| ("sweep", json!({ "design": design, "points": 50, "axes": axes }));
    let random = |distribution: Value| {
        let fields = json!([
            { "field": "/plant/theta_scale/*", "distribution": { "kind": "uniform", "min": 0.9, "max": 1.1 } },
            { "field": STEP, "relative": true, "distribution": distribution },
        ]);
        json!({ "draws": 50, "fields": fields })
    };
    let beta = json!({ "field": "/scheme/gains/beta", "values": [4, 8, 12] });
    let ranges = json!([
        { "field": STEP, "min": 1e-5, "max": 1e-2, "log": true },
        { "field": DURATION, "min": 0.5, "max": 3, "relative": true },
    ]);
    let unbounded = random(json!({ "kind": "normal", "mean": 1, "sd": 0.8 }));
    let conditions = json!([
        { "name": "as it is" },
        { "name": "longer", "set": [{ "field": DURATION, "value": 3, "relative": true }] },
        { "name": "finer", "set": [{ "field": STEP, "value": 3e-5 }] },
    ]);
    let mut compared = unbounded.clone();
    compared["conditions"] = conditions;
    for (kind, section) in [
        grid(
            json!([beta, { "field": STEP, "values": [1e-6, 1e-3, 7e-4, 1] }, { "field": DURATION, "values": [0.05, 0.3] }]),
        ),
        grid(json!([beta])),
        filled("sobol", &ranges),
        filled("latin_hypercube", &ranges),
        ("monte_carlo", random(json!({ "kind": "lognormal", "median": 0.5, "log_sd": 1 }))),
        ("monte_carlo", unbounded),
        ("compare", compared),
    ] {
        let bases = if kind == "sweep" { &SCHEMES[..1] } else { &SCHEMES };
        let experiment = experiment(kind, bases, &section).unwrap();
        assert_eq!(experiment.steps(), counted(&experiment), "{section}");
    }
}

#[test]
fn a_tuning_takes_at_most_the_steps_of_its_slowest_candidate() {
    let plain = experiment("tuning", &["proposed"], &tuning_section()).unwrap();
    // 50 steps; 25 candidates and as many as fit in the generation begun last, on 2 plants; two of them on 3 more.
    let runs = 2 * (1 + 24 + 256) + 2 * 3;
    assert_eq!((plain.most_runs(), plain.steps()), (runs, 50 * runs));
    let mut section = tuning_section();
    section["variables"][1] = json!({ "field": STEP, "min": 1e-4, "max": 1e-2 });
    section["plants"]["fields"][0] =
        json!({ "field": DURATION, "relative": true, "distribution": { "kind": "uniform", "min": 2, "max": 4 } });
    let slow = experiment("tuning", &["proposed"], &section).unwrap();
    assert!(slow.steps() > 1000 * runs && slow.steps() < 2000 * runs, "{} in {runs}", slow.steps());
}

/// No field gets round the limit on all steps, and what is refused names it.
#[test]
fn fields_that_make_runs_long_are_within_the_limit_of_all_steps() {
    let refusal = |kind: &str, duration_s: f64, section: Value| {
        let mut base = scenario("proposed");
        base["integration"] = json!({ "duration_s": duration_s });
        let bases = json!([{ "name": "a", "scenario": base }]);
        let mut document = json!({ "format": "adaptarm.experiment/1", "kind": kind, "bases": bases });
        document[kind] = section;
        Experiment::read(&document).unwrap_err().to_string()
    };
    let theta = |n: u32, points: u32| json!({ "field": format!("/plant/theta_scale/{n}"), "min": 0.9, "max": 1.1, "points": points });
    let swept = |field: &str, value: f64| {
        let axes = json!([{ "field": field, "values": [value] }, theta(0, 1000), theta(1, 20)]);
        json!({ "design": "grid", "axes": axes })
    };
    assert_eq!(
        refusal("sweep", 90.0, swept(STEP, 1e-6)),
        "sweep: 1800000000000 steps in 20000 runs are more than the 1e12 steps that are allowed; one run has up to \
         90000000, with /integration/step_s 0.000001 and /integration/duration_s 90"
    );
    let long = refusal("sweep", 12.0, swept(DURATION, 1e5));
    assert!(long.starts_with("sweep: 2000000000000 steps in 20000 runs"), "{long}");
    assert!(
        long.ends_with("up to 100000000, with /integration/step_s 0.001 and /integration/duration_s 100000"),
        "{long}"
    );
    let distribution = json!({ "kind": "uniform", "min": 1e-6, "max": 1e-5 });
    let fields = json!([{ "field": STEP, "distribution": distribution }]);
    let drawn = refusal("monte_carlo", 90.0, json!({ "draws": 100_000, "fields": fields }));
    assert!(drawn.starts_with("monte_carlo: ") && drawn.contains("/integration/step_s 0.00000100"), "{drawn}");
    let set = json!([{ "field": STEP, "value": 1e-6 }]);
    let compared = json!({ "conditions": [{ "name": "fine", "set": set }], "draws": 20_000 });
    let compared = refusal("compare", 90.0, compared);
    assert!(compared.starts_with("compare: 1800000000000 steps in 20000 runs"), "{compared}");
    let mut section = tuning_section();
    section["variables"][1] = json!({ "field": STEP, "min": 1e-6, "max": 1e-2 });
    section["evaluations"] = json!(20_000);
    let tuned = refusal("tuning", 90.0, section);
    assert!(
        tuned.starts_with("tuning: ") && tuned.contains("up to 90000000, with /integration/step_s 0.000001 "),
        "{tuned}"
    );
}
