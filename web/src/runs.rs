//! The runs that the page shows: figures, arm and read-outs all look at these samples; each is held once.

use crate::failure::{Failure, read};
use adaptarm_core::recording::{Columns, Recording};
use adaptarm_core::scenario::Scenario;
use std::collections::BTreeMap;
use wasm_bindgen::JsValue;
use wasm_bindgen::prelude::wasm_bindgen;

/// A run that is shown.
pub(crate) struct ShownRun {
    /// What was simulated.
    pub scenario: Scenario,
    /// Its samples.
    pub recording: Recording,
    /// Whether it reached its duration.
    pub completed: bool,
    /// Differs from that of every other run that was ever added: what is made from a run is current while this is.
    pub revision: u64,
}

/// Runs by the page's names for them.
#[wasm_bindgen]
#[derive(Default)]
pub struct Runs {
    runs: BTreeMap<String, ShownRun>,
    added: u64,
}

#[wasm_bindgen]
impl Runs {
    /// Without runs.
    #[wasm_bindgen(constructor)]
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds or replaces the run called `id`: its scenario as JSON text, its `rows` as `Run.rows` gives them; `completed` is
    /// false for a diverged run. Throws on a scenario that is not allowed and on rows that end in the middle of one.
    pub fn set(&mut self, id: &str, scenario_json: &str, rows: Vec<f64>, completed: bool) -> Result<(), JsValue> {
        Ok(self.insert(id, scenario_json, rows, completed)?)
    }

    /// Forgets a run; nothing happens where there is none.
    pub fn remove(&mut self, id: &str) {
        self.runs.remove(id);
    }
}

impl Runs {
    fn insert(&mut self, id: &str, scenario_json: &str, rows: Vec<f64>, completed: bool) -> Result<(), Failure> {
        let scenario = read(scenario_json)?;
        let robot = scenario.robot();
        let columns = Columns { joints: robot.joint_count(), parameters: robot.parameter_count() };
        let recording = Recording::from_rows(columns, rows)
            .ok_or_else(|| Failure::new("the samples end in the middle of a row".to_owned()))?;
        self.added += 1;
        self.runs.insert(id.to_owned(), ShownRun { scenario, recording, completed, revision: self.added });
        Ok(())
    }

    /// The run called `id`.
    pub(crate) fn get(&self, id: &str) -> Option<&ShownRun> {
        self.runs.get(id)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SCENARIO: &str = r#"{"format":"adaptarm.scenario/1","scheme":{"kind":"slotine_li"}}"#;

    #[test]
    fn rows_must_be_whole_and_scenarios_allowed() {
        let mut runs = Runs::new();
        assert!(runs.insert("a", SCENARIO, vec![0.0; 38], true).unwrap_err().message.contains("middle of a row"));
        assert!(runs.insert("a", "{}", Vec::new(), true).is_err());
        assert!(runs.get("a").is_none());
        runs.insert("a", SCENARIO, Vec::new(), true).unwrap();
        assert!(runs.get("a").is_some_and(|run| run.recording.is_empty()));
        runs.remove("a");
        assert!(runs.get("a").is_none());
    }
}
