//! What exists, as one JSON document for building the page: robots, schemes with their gains, studies, limits, figures.

use adaptarm_core::decomposition::TorquePart;
use adaptarm_core::experiments::replication::{OBSERVER_PEAKS_DEG, TABLE_1_DEG, TABLE_2_DEG_S};
use adaptarm_core::figures::{Figure, Rgb, Theme, scheme_style, torque_style};
use adaptarm_core::metrics::{SETTLING_BAND_DEG, SETTLING_BAND_DEG_S};
use adaptarm_core::robots::{ROBOTS, RobotData};
use adaptarm_core::scenario::{GainSet, LIMITS, PRESETS, Preset, Scenario, ScenarioDocument, Scheme, SchemeDocument};
use serde::Serialize;
use serde_json::{Map, Value, json};
use std::collections::BTreeMap;
use wasm_bindgen::prelude::wasm_bindgen;

/// The description as JSON text.
#[wasm_bindgen]
pub fn describe() -> String {
    // Maps with text as keys and finite numbers: nothing that JSON could refuse.
    serde_json::to_string(&description()).unwrap_or_default()
}

/// The whole description. The documents stay typed, so that their fields keep their order: a reader that meets a scheme's
/// gains before its kind cannot say which gain is wrong.
#[derive(Serialize)]
struct Description {
    studies: Vec<Study>,
    #[serde(flatten)]
    rest: Value,
}

/// One scenario per scheme, with everything filled in.
#[derive(Serialize)]
struct Study {
    id: &'static str,
    documents: BTreeMap<&'static str, ScenarioDocument>,
}

fn description() -> Description {
    let rest = json!({
        "core_version": adaptarm_core::VERSION,
        "robots": ROBOTS.iter().map(|robot| describe_robot(robot)).collect::<Vec<_>>(),
        "schemes": Scheme::ALL.map(describe_scheme),
        "presets": PRESETS.iter().map(describe_preset).collect::<Vec<_>>(),
        "limits": LIMITS,
        "paper": {
            "index_e_deg": by_scheme(TABLE_1_DEG),
            "index_de_deg_s": by_scheme(TABLE_2_DEG_S),
            "z_peak_deg": { Scheme::Proposed.id(): OBSERVER_PEAKS_DEG },
        },
        "settling_bands": { "e_deg": SETTLING_BAND_DEG, "de_deg_s": SETTLING_BAND_DEG_S },
        "figures": Figure::ALL.map(|figure| json!({
            "id": figure.id(),
            "title": figure.title(),
            "paper_number": figure.paper_number(),
            "natural_size": figure.natural_size(),
            "has_symlog": figure.has_symlog(),
        })),
        "torque_lines": TorquePart::ALL.map(Some).into_iter().chain([None]).map(describe_torque).collect::<Vec<_>>(),
        "plot_background": { "light": hex(Theme::Light.background()), "dark": hex(Theme::Dark.background()) },
    });
    Description { studies: studies(), rest }
}

/// A table of the paper, by the scheme's identifier.
fn by_scheme(table: [(Scheme, [f64; 3]); 3]) -> Map<String, Value> {
    table.into_iter().map(|(scheme, row)| (scheme.id().to_owned(), json!(row))).collect()
}

fn describe_robot(robot: &RobotData) -> Value {
    let parameters = robot.parameters.iter().map(|parameter| {
        json!({
            "symbol": parameter.symbol,
            "unit": parameter.unit,
            "meaning": parameter.meaning,
            "value": parameter.value,
        })
    });
    json!({
        "id": robot.id,
        "name": robot.name,
        "joints": robot.joints,
        "parameters": parameters.collect::<Vec<_>>(),
    })
}

fn describe_scheme(scheme: Scheme) -> Value {
    let document = resolved(scheme.paper());
    let gains = match &document.scheme {
        SchemeDocument::Proposed(Some(gains)) => {
            let mut described = describe_gains("/scheme/gains", gains);
            described.extend(describe_gains("/scheme/gains/projection", &gains.projection));
            described
        }
        SchemeDocument::TangArteaga(Some(gains)) => describe_gains("/scheme/gains", gains),
        SchemeDocument::SlotineLi(Some(gains)) => describe_gains("/scheme/gains", gains),
        // A resolved document has its gains filled in.
        _ => Vec::new(),
    };
    let (light, dash) = scheme_style(scheme, Theme::Light);
    let (dark, _) = scheme_style(scheme, Theme::Dark);
    json!({
        "id": scheme.id(),
        "name": scheme.name(),
        "gains": gains,
        "color": { "light": hex(light), "dark": hex(dark) },
        "dash": dash.0,
    })
}

/// How a part of a torque is drawn, or the sum of the parts.
fn describe_torque(part: Option<TorquePart>) -> Value {
    let (light, dash) = torque_style(part, Theme::Light);
    let (dark, _) = torque_style(part, Theme::Dark);
    json!({
        "id": part.map_or("total", TorquePart::id),
        "color": { "light": hex(light), "dark": hex(dark) },
        "dash": dash.0,
    })
}

/// Each gain's documentation, its place in a scenario and the paper's values.
fn describe_gains(pointer: &str, gains: &impl GainSet) -> Vec<Value> {
    let described = gains.table().iter().zip(gains.values()).map(|(info, values)| {
        let mut described = json!(info);
        described["pointer"] = json!(format!("{pointer}/{}", info.name));
        described["default"] = json!(values);
        described
    });
    described.collect()
}

/// Sets of one scenario per scheme: the paper's study and its variations.
fn studies() -> Vec<Study> {
    let heavier = PRESETS.iter().find(|preset| preset.id == "proposed_heavier_arm").map(Preset::document);
    let study = |id, vary: &dyn Fn(&mut ScenarioDocument)| {
        let documents = Scheme::ALL
            .into_iter()
            .map(|scheme| {
                let mut document = scheme.paper();
                vary(&mut document);
                (scheme.id(), resolved(document))
            })
            .collect();
        Study { id, documents }
    };
    vec![
        study("paper", &|_| {}),
        study("from_rest", &|document| {
            document.initial.velocity = adaptarm_core::scenario::InitialVelocityDocument::Rest;
        }),
        study("heavier_arm", &|document| {
            if let Some(heavier) = &heavier {
                document.plant = heavier.plant.clone();
            }
        }),
    ]
}

fn describe_preset(preset: &Preset) -> Value {
    json!({ "id": preset.id, "title": preset.title, "description": preset.description })
}

/// The document with everything filled in; as it is if that should fail, which a test rules out.
fn resolved(document: ScenarioDocument) -> ScenarioDocument {
    Scenario::new(document.clone()).map_or(document, |scenario| scenario.document().clone())
}

fn hex((red, green, blue): Rgb) -> String {
    format!("#{red:02x}{green:02x}{blue:02x}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_document_is_allowed_and_every_pointer_leads_to_its_default() {
        let description = json!(description());
        for study in description["studies"].as_array().unwrap() {
            for (scheme, document) in study["documents"].as_object().unwrap() {
                let scenario = Scenario::read(document).unwrap();
                assert_eq!(scenario.scheme().id(), scheme);
                assert_eq!(&json!(scenario.document()), document, "documents come with everything filled in");
            }
        }
        let documents = &description["studies"][0]["documents"];
        for scheme in description["schemes"].as_array().unwrap() {
            let document = &documents[scheme["id"].as_str().unwrap()];
            for gain in scheme["gains"].as_array().unwrap() {
                let value = document.pointer(gain["pointer"].as_str().unwrap()).unwrap();
                let values = if value.is_array() { value.clone() } else { json!([value]) };
                assert_eq!(values, gain["default"]);
            }
        }
    }

    #[test]
    fn studies_are_the_presets_of_their_schemes() {
        for (study, suffix) in [(0, ""), (1, "_from_rest")] {
            for scheme in Scheme::ALL {
                let id = format!("{}{suffix}", scheme.id());
                let preset = PRESETS.iter().find(|preset| preset.id == id).unwrap();
                let document = &json!(description())["studies"][study]["documents"][scheme.id()];
                assert_eq!(&json!(resolved(preset.document())), document);
            }
        }
    }
}
