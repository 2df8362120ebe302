//! An exercise for its page: gains become scenarios that workers run, and their reports become a grade on the visible variants.
//!
//! The same core functions as on the server, on the variants that the student may see; what it is worth there is no secret.

use crate::failure::Failure;
use adaptarm_core::exercises::{self, Visibility};
use adaptarm_core::scenario::{Report, Scenario};
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::collections::BTreeMap;
use wasm_bindgen::JsValue;
use wasm_bindgen::prelude::wasm_bindgen;

/// An exercise with the seed of one student's variants.
#[wasm_bindgen]
pub struct Exercise {
    exercise: exercises::Exercise,
    seed: u64,
}

#[wasm_bindgen]
impl Exercise {
    /// Reads the document as its student gets it. Throws JSON text `{pointer, message}`.
    #[wasm_bindgen(constructor)]
    pub fn new(document_json: &str, seed: f64) -> Result<Self, JsValue> {
        Ok(Self::read(document_json, seed)?)
    }

    /// The visible variants with these gains (JSON text, a number by name): JSON text, a list of scenario documents. Throws
    /// JSON text `{pointer, message}`.
    pub fn runs(&self, gains_json: &str) -> Result<String, JsValue> {
        Ok(self.documents(gains_json)?)
    }

    /// The grade of the visible variants' reports (JSON text, a list in the order of `runs` with the same gains) as JSON text.
    /// Throws JSON text `{pointer, message}`.
    pub fn grade(&self, gains_json: &str, reports_json: &str) -> Result<String, JsValue> {
        Ok(self.graded(gains_json, reports_json)?)
    }
}

impl Exercise {
    fn read(document_json: &str, seed: f64) -> Result<Self, Failure> {
        let mut document = serde_json::Deserializer::from_str(document_json);
        let exercise = exercises::Exercise::read(&mut document)?;
        if !(seed >= 0.0 && seed.fract() == 0.0) {
            return Err(Failure::at("/seed", format!("{seed} is not a whole number from 0 on")));
        }
        // What is above its range the core refuses at the first run.
        Ok(Self { exercise, seed: seed as u64 })
    }

    fn documents(&self, gains_json: &str) -> Result<String, Failure> {
        let runs = self.exercise.runs(&gains(gains_json)?, self.seed, Visibility::Visible)?;
        written(&runs.iter().map(Scenario::document).collect::<Vec<_>>())
    }

    fn graded(&self, gains_json: &str, reports_json: &str) -> Result<String, Failure> {
        let reports: Vec<Report> = parsed(reports_json)?;
        let grade = self.exercise.grade(&gains(gains_json)?, self.seed, Visibility::Visible, &reports);
        written(&grade.map_err(|error| Failure::new(error.to_string()))?)
    }
}

fn gains(json: &str) -> Result<BTreeMap<String, f64>, Failure> {
    parsed(json)
}

fn parsed<T: DeserializeOwned>(json: &str) -> Result<T, Failure> {
    serde_json::from_str(json).map_err(|error| Failure::new(error.to_string()))
}

fn written<T: Serialize>(value: &T) -> Result<String, Failure> {
    serde_json::to_string(value).map_err(|error| Failure::new(error.to_string()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::{Value, json};

    /// A pendulum held by PD against gravity.
    fn document() -> String {
        let text = |of: &str| json!({ "en": of, "es": of });
        let moved = |name: &str, start: f64| {
            json!({ "name": name, "label": text(name), "fields": [format!("/scheme/gains/{name}/0")], "min": 0.0, "max": 500.0,
                "start": start })
        };
        let fields = json!([{
            "field": "/plant/theta_scale/3", "distribution": { "kind": "uniform", "min": 0.8, "max": 1.2 }
        }]);
        json!({
            "format": "adaptarm.exercise/1", "id": "hold", "level": "first", "minutes": 10,
            "title": text("Hold"), "goal": text("goal"), "statement": text("statement"),
            "scenario": { "format": "adaptarm.scenario/1", "robot": "pendulum",
                "scheme": { "kind": "pd", "gains": { "k_p": [20.0], "k_d": [2.0] } },
                "integration": { "duration_s": 1.0 }, "recording": { "samples": 100 } },
            "moves": [moved("k_p", 20.0), moved("k_d", 2.0)],
            "visible": { "count": 2, "fields": fields },
            "criteria": [{ "id": "error", "label": text("error"), "metric": "e_peak_deg", "full": 2.0, "zero": 12.0,
                "weight": 5.0 }],
        })
        .to_string()
    }

    #[test]
    fn gains_become_the_core_s_runs_and_reports_its_grade() {
        let exercise = Exercise::read(&document(), 7.0).unwrap();
        let gains = r#"{"k_p": 400, "k_d": 20}"#;
        let documents: Vec<Value> = serde_json::from_str(&exercise.documents(gains).unwrap()).unwrap();
        let scenarios: Vec<_> = documents.iter().map(|document| Scenario::read(document).unwrap()).collect();
        let reports: Vec<_> = scenarios.iter().map(|scenario| scenario.run().report).collect();
        let grade: Value = serde_json::from_str(&exercise.graded(gains, &json!(reports).to_string()).unwrap()).unwrap();
        let core = exercise.exercise.grade(&parsed(gains).unwrap(), 7, Visibility::Visible, &reports).unwrap();
        assert_eq!(grade, json!(core));
        assert_eq!((documents.len(), grade["points"].as_f64()), (2, Some(5.0)));
        assert!(exercise.graded(gains, "[]").unwrap_err().message.contains("0 reports"));
    }

    #[test]
    fn what_is_not_allowed_names_its_place() {
        let exercise = Exercise::read(&document(), 7.0).unwrap();
        assert_eq!(exercise.documents(r#"{"k_p": 1000, "k_d": 20}"#).unwrap_err().pointer, "/gains/k_p");
        assert_eq!(exercise.documents(r#"{"k_p": 10}"#).unwrap_err().pointer, "/gains/k_d");
        for seed in [-1.0, 0.5, f64::NAN, f64::INFINITY] {
            let Err(failure) = Exercise::read(&document(), seed) else { panic!("{seed} is no seed") };
            assert_eq!(failure.pointer, "/seed");
        }
        assert!(Exercise::read("{}", 1.0).is_err());
    }
}
