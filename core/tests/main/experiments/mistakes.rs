//! Experiments that are wrong: field, value and range are named.

use super::tuning::tuning_section;
use super::{experiment, scenario};
use adaptarm_core::experiments::Experiment;
use serde_json::{Value, json};

#[test]
fn mistakes_name_field_value_and_range() {
    let error = |kind: &str, section: Value| experiment(kind, &["proposed"], &section).unwrap_err();
    let draws = |draws: Value| error("monte_carlo", json!({ "draws": draws }));
    assert_eq!(draws(json!(0)), "monte_carlo.draws: 0 is outside the allowed range 1 to 200000 draws");
    assert!(draws(json!(-1)).starts_with("monte_carlo.draws: invalid value: integer `-1`"));
    let field = |field: &str| {
        let distribution = json!({ "kind": "uniform", "min": 0, "max": 1 });
        error("monte_carlo", json!({ "draws": 1, "fields": [{ "field": field, "distribution": distribution }] }))
    };
    assert!(
        field("/scheme/gains/k_s/0").starts_with("monte_carlo.fields[0].field: \"/scheme/gains/k_s/0\" is not known")
    );
    assert!(field("/robot").contains("a JSON pointer to a number"));
    let axis = |axis: Value| error("sweep", json!({ "design": "grid", "axes": [axis] }));
    let beta = "/scheme/gains/beta";
    assert!(axis(json!({ "field": beta, "min": 1, "max": 2 })).starts_with("sweep.axes[0].points: missing"));
    assert!(
        axis(json!({ "field": beta, "min": 2, "max": 1, "points": 3 })).starts_with("sweep.axes[0].max: must be above")
    );
    assert!(axis(json!({ "field": beta, "values": [] })).contains("is empty"));
    let six = json!({ "field": "/plant/theta_scale/0", "min": 1, "max": 2, "points": 1000 });
    let mut second = six.clone();
    second["field"] = json!("/plant/theta_scale/1");
    let many = error("sweep", json!({ "design": "grid", "axes": [six, second] }));
    assert!(many.starts_with("sweep: asks for 200001 runs in all; at most 200000"), "{many}");
    let twice = json!([{ "field": beta, "values": [1] }, { "field": beta, "values": [2] }]);
    assert!(error("sweep", json!({ "design": "grid", "axes": twice })).contains("varies twice"));
    let impossible = json!({ "conditions": [{ "name": "x", "set": [{ "field": beta, "value": -1 }] }] });
    let said = error("compare", impossible);
    assert!(
        said.starts_with("compare.conditions[0].set: with base \"proposed\": scheme.gains.beta: -1 is outside"),
        "{said}"
    );
    let distribution = json!({ "kind": "uniform", "min": 1, "max": 9 });
    let in_vain = json!({ "conditions": [{ "name": "x", "set": [{ "field": beta, "value": 4 }] }],
        "fields": [{ "field": beta, "distribution": distribution }] });
    let said = error("compare", in_vain.clone());
    assert!(
        said.starts_with("compare.fields: /scheme/gains/beta is random, so that condition \"x\" sets it in vain"),
        "{said}"
    );
    let mut as_a_factor = in_vain;
    as_a_factor["fields"][0]["relative"] = json!(true);
    assert!(experiment("compare", &["proposed"], &as_a_factor).is_ok());
    let mut section = tuning_section();
    section["variables"][1]["min"] = json!(6);
    assert!(
        error("tuning", section).starts_with("tuning.variables[1].field: 5.5 is outside the allowed range 6 to 50")
    );
    let mut section = tuning_section();
    section["objective"][0]["metric"] = json!("beauty");
    assert!(error("tuning", section).contains("\"beauty\" is not known; allowed: index_e_deg, index_e_deg_1"));
    let other = error("sweep", json!({ "design": "sobol", "axes": [{ "field": beta, "min": 1, "max": 2 }] }));
    assert!(other.starts_with("sweep.points: missing"), "{other}");
}

#[test]
fn the_sections_and_the_limits_of_all_steps_are_checked() {
    let read = |document: &Value| Experiment::read(document).map_err(|error| error.to_string());
    let base = json!([{ "name": "a", "scenario": scenario("proposed") }]);
    let mut document = json!({ "format": "adaptarm.experiment/1", "kind": "sweep", "bases": base });
    assert_eq!(read(&document).unwrap_err(), "sweep: missing; kind sweep needs this section");
    document["monte_carlo"] = json!({ "draws": 100_000 });
    assert_eq!(read(&document).unwrap_err(), "sweep: missing; kind sweep needs this section");
    document["kind"] = json!("monte_carlo");
    assert!(read(&document).is_ok());
    document["bases"][0]["scenario"]["integration"] = json!({ "duration_s": 90_000 });
    assert!(read(&document).unwrap_err().contains("are more than the 1e12 steps"));
    document["bases"][0]["scenario"]["integration"] = json!({ "step_s": 7 });
    assert!(read(&document).unwrap_err().starts_with("bases[0].scenario.integration.step_s: 7 is outside"));
    document["bases"] = json!([]);
    assert!(read(&document).unwrap_err().starts_with("bases: is empty"));
    document["format"] = json!("adaptarm.experiment/9");
    assert!(read(&document).unwrap_err().starts_with("format: \"adaptarm.experiment/9\" is not known"));
}
