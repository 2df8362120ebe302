//! A tuning: the same way however often it is stopped, and only with the rows that it asked for.

use super::{experiment, monte_carlo, parameters, rows};
use adaptarm_core::experiments::{Experiment, Row, RowOutcome, Tuning};
use serde_json::{Value, json};

pub(super) fn tuning_section() -> Value {
    json!({
        "variables": [
            { "field": "/scheme/gains/k_v/*", "min": 0.1, "max": 10, "log": true, "relative": true },
            { "field": "/scheme/gains/beta", "min": 0.1, "max": 50, "log": true },
        ],
        "objective": [{ "metric": "index_e_deg", "weight": 1 }, { "metric": "tau_peak_nm", "weight": 0.1, "scale": 50 }],
        "constraints": [{ "metric": "tau_peak_nm_2", "max": 400 }],
        "plants": { "count": 2, "fields": parameters(), "validation": 3 },
        "population": 4,
        "evaluations": 24,
        "restarts": 1,
    })
}

fn step(experiment: &Experiment, tuning: &mut Tuning, reversed: bool) {
    let mut rows = rows(experiment, tuning.plan(experiment));
    if reversed {
        rows.reverse();
    }
    tuning.tell(experiment, rows).unwrap();
}

#[test]
fn a_tuning_goes_the_same_way_however_often_it_is_stopped() {
    let experiment = experiment("tuning", &["proposed"], &tuning_section()).unwrap();
    let mut straight = experiment.tuning().unwrap();
    while !straight.is_done() {
        step(&experiment, &mut straight, false);
    }
    let mut stopped = experiment.tuning().unwrap();
    while !stopped.is_done() {
        let mut bytes = Vec::new();
        ciborium::into_writer(&stopped, &mut bytes).unwrap();
        stopped = ciborium::from_reader(bytes.as_slice()).unwrap();
        assert!(stopped.belongs_to(&experiment));
        step(&experiment, &mut stopped, true);
    }
    assert_eq!(stopped, straight);
    let summary = straight.summary(&experiment);
    assert!(summary.finished && summary.history.len() == 6 && summary.candidates == 25 && summary.runs == 56);
    assert_eq!(summary.scales[1], 50.0);
    let (start, best) = (summary.start.unwrap(), summary.best.unwrap());
    assert!(best.objective < start.objective, "{best:?} is no better than {start:?}");
    let validation = summary.validation.unwrap();
    assert!(validation.best < validation.start, "{validation:?}");
    assert!(straight.best_scenario(&experiment).is_some());
    assert!(straight.plan(&experiment).is_empty() && straight.tell(&experiment, Vec::new()).is_err());
}

#[test]
fn a_tuning_takes_only_the_rows_that_it_asked_for() {
    let experiment = experiment("tuning", &["proposed"], &tuning_section()).unwrap();
    let mut tuning = experiment.tuning().unwrap();
    let mut rows = rows(&experiment, tuning.plan(&experiment));
    rows[1].index = 0;
    assert!(tuning.tell(&experiment, rows.clone()).unwrap_err().to_string().contains("of the 2 runs that come next"));
    for (n, row) in rows.iter_mut().enumerate() {
        *row = Row {
            index: n as u64,
            outcome: RowOutcome::Diverged,
            metrics: vec![None; row.metrics.len()],
            ..row.clone()
        };
    }
    let error = tuning.tell(&experiment, rows).unwrap_err().to_string();
    assert!(
        error.contains("lacks index_e_deg on every plant") && error.contains("/tuning/objective/0/scale"),
        "{error}"
    );
    assert!(!tuning.belongs_to(&monte_carlo(2)));
}

fn front_section() -> Value {
    let mut section = tuning_section();
    let fields = section.as_object_mut().unwrap();
    fields.remove("objective");
    fields.remove("restarts");
    fields.insert(
        "objectives".to_owned(),
        json!([
            { "name": "tracking", "terms": [{ "metric": "index_e_deg", "weight": 1 }] },
            { "name": "effort", "terms": [{ "metric": "tau_peak_nm", "weight": 1 }, { "metric": "tau_rms_nm", "weight": 0.5, "scale": 10 }] },
        ]),
    );
    section
}

/// Several objectives: the same way through pauses, and a front that is one, reached from the start on.
#[test]
fn a_search_for_a_front_goes_the_same_way_and_finds_one() {
    let experiment = experiment("tuning", &["proposed"], &front_section()).unwrap();
    let mut straight = experiment.tuning().unwrap();
    while !straight.is_done() {
        step(&experiment, &mut straight, false);
    }
    let mut stopped = experiment.tuning().unwrap();
    while !stopped.is_done() {
        let mut bytes = Vec::new();
        ciborium::into_writer(&stopped, &mut bytes).unwrap();
        stopped = ciborium::from_reader(bytes.as_slice()).unwrap();
        assert!(stopped.belongs_to(&experiment));
        step(&experiment, &mut stopped, true);
    }
    assert_eq!(stopped, straight);
    let summary = straight.summary(&experiment);
    let front = summary.front.unwrap();
    assert_eq!(front.objectives, ["tracking", "effort"]);
    assert_eq!(front.reference[0], 2.0, "what the start has is one");
    for a in &front.candidates {
        assert_eq!(a.values.len(), 4);
        for b in &front.candidates {
            let better = a.objectives.iter().zip(&b.objectives).all(|(a, b)| a <= b) && a.objectives != b.objectives;
            assert!(!better, "{a:?} beats {b:?}");
        }
    }
    let reached: Vec<_> = summary.history.iter().map(|generation| generation.hypervolume.unwrap()).collect();
    assert!(reached.windows(2).all(|pair| pair[1] >= pair[0] - 1e-12), "{reached:?}");
    assert_eq!(reached.last(), Some(&front.hypervolume));
    assert!(front.hypervolume > 0.0 && summary.validation.is_some() && summary.best.is_some());
}

#[test]
fn objectives_are_two_or_three_and_stand_alone() {
    let refusal = |change: &dyn Fn(&mut Value)| {
        let mut section = front_section();
        change(&mut section);
        experiment("tuning", &["proposed"], &section).unwrap_err()
    };
    let said = refusal(&|section| section["objective"] = tuning_section()["objective"].clone());
    assert!(said.starts_with("tuning.objectives: ") && said.contains("one of the two"), "{said}");
    let said = refusal(&|section| section["objectives"].as_array_mut().unwrap().truncate(1));
    assert!(said.starts_with("tuning.objectives: ") && said.contains("2 to 3"), "{said}");
    let said = refusal(&|section| section["objectives"][1]["terms"][0]["metric"] = json!("joy"));
    assert!(said.starts_with("tuning.objectives[1].terms[0].metric: ") && said.contains("joy"), "{said}");
    let said = refusal(&|section| section["restarts"] = json!(1));
    assert!(said.starts_with("tuning.restarts: "), "{said}");
}
