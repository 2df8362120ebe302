//! The runs that the page shows: figures, arm and read-outs all look at these samples; each is held once.

use crate::failure::{Failure, read};
use adaptarm_core::decomposition::TorqueParts;
use adaptarm_core::recording::{Columns, Recording};
use adaptarm_core::scenario::Scenario;
use std::cell::OnceCell;
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
    /// True parameters of its arm.
    pub theta: Vec<f64>,
    /// Its torques, split; computed when first asked for.
    parts: OnceCell<TorqueParts>,
    /// Differs from that of every other run that was ever added: what is made from a run is current while this is.
    #[cfg_attr(not(target_arch = "wasm32"), expect(dead_code, reason = "read only where something is drawn"))]
    pub revision: u64,
}

impl ShownRun {
    /// The `revision`th run that is shown.
    pub fn new(scenario: Scenario, recording: Recording, completed: bool, revision: u64) -> Self {
        let theta = scenario.theta();
        Self { scenario, recording, completed, theta, parts: OnceCell::new(), revision }
    }

    /// Its torques, split into what they are spent on.
    pub fn torque_parts(&self) -> &TorqueParts {
        self.parts.get_or_init(|| self.scenario.torque_parts(&self.recording))
    }
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

    /// All samples of a run as a comma-separated table with a header, as the command line and the server write it. Throws JSON
    /// text `{pointer, message}` if there is no such run.
    pub fn csv(&self, id: &str) -> Result<String, JsValue> {
        let run = self.get(id).ok_or_else(|| Failure::new(format!("there is no run {id:?}")))?;
        Ok(run.recording.to_csv())
    }
}

impl Runs {
    pub(crate) fn insert(
        &mut self,
        id: &str,
        scenario_json: &str,
        rows: Vec<f64>,
        completed: bool,
    ) -> Result<(), Failure> {
        let scenario = read(scenario_json)?;
        let robot = scenario.robot();
        let columns = Columns { joints: robot.joint_count(), parameters: robot.parameter_count() };
        let recording = Recording::from_rows(columns, rows)
            .ok_or_else(|| Failure::new("the samples end in the middle of a row".to_owned()))?;
        self.added += 1;
        self.runs.insert(id.to_owned(), ShownRun::new(scenario, recording, completed, self.added));
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

    #[test]
    fn a_table_has_every_sample_of_its_run() {
        let mut runs = Runs::new();
        runs.insert("a", SCENARIO, vec![0.5; 2 * 37], true).unwrap();
        let Ok(csv) = runs.csv("a") else { panic!("the run exists") };
        assert_eq!(csv.lines().count(), 3);
        assert!(csv.starts_with("t_s,e_deg_1,"));
    }
}
