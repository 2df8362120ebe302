//! A run for a worker: started from a scenario's JSON text, advanced in slices, then read as a report and rows.

use crate::failure::{Failure, read};
use adaptarm_core::scenario::{self, Scenario};
use adaptarm_core::simulation::Simulation;
use wasm_bindgen::JsValue;
use wasm_bindgen::prelude::wasm_bindgen;

/// Checks a scenario; returns its hash. Throws JSON text `{pointer, message}`.
#[wasm_bindgen]
pub fn check(scenario_json: &str) -> Result<String, JsValue> {
    Ok(read(scenario_json)?.hash())
}

/// Checks a scenario; returns it with everything filled in, as JSON text. Throws JSON text `{pointer, message}`.
#[wasm_bindgen]
pub fn resolve(scenario_json: &str) -> Result<String, JsValue> {
    serde_json::to_string(read(scenario_json)?.document()).map_err(|error| Failure::new(error.to_string()).into())
}

/// A run under way or finished.
#[wasm_bindgen]
pub struct Run {
    scenario: Scenario,
    stage: Stage,
}

/// Where a run stands. `finish` takes the simulation apart, so it is moved out on the way.
enum Stage {
    Running(Box<Simulation>),
    Finished(Box<scenario::Run>),
    Taken,
}

#[wasm_bindgen]
impl Run {
    /// A run at its start. Throws JSON text `{pointer, message}`.
    #[wasm_bindgen(constructor)]
    pub fn new(scenario_json: &str) -> Result<Self, JsValue> {
        let scenario = read(scenario_json)?;
        let stage = Stage::Running(Box::new(scenario.start()));
        Ok(Self { scenario, stage })
    }

    /// Takes at most `max_steps` steps; true once the run has ended.
    pub fn advance(&mut self, max_steps: u32) -> bool {
        if let Stage::Running(simulation) = &mut self.stage {
            if !simulation.advance(u64::from(max_steps)) {
                return false;
            }
            if let Stage::Running(simulation) = std::mem::replace(&mut self.stage, Stage::Taken) {
                self.stage = Stage::Finished(Box::new(self.scenario.finish(*simulation)));
            }
        }
        true
    }

    /// Share of the duration simulated, 0 to 1.
    pub fn progress(&self) -> f64 {
        if let Stage::Running(simulation) = &self.stage { simulation.progress() } else { 1.0 }
    }

    /// The report as JSON text. Throws before the run has ended.
    pub fn report(&self) -> Result<String, JsValue> {
        serde_json::to_string(&self.finished()?.report).map_err(|error| Failure::new(error.to_string()).into())
    }

    /// What has been recorded so far, thinned to at most `most` rows of those at equal distances: enough for a picture of a
    /// run under way. Empty once the run has ended.
    #[cfg(target_arch = "wasm32")]
    pub fn partial_rows(&self, most: u32) -> js_sys::Float64Array {
        js_sys::Float64Array::from(self.thinned(most as usize).as_slice())
    }

    /// All recorded rows, one after another, SI units: a copy that can be transferred, in `spare` where it is as long. Throws
    /// before the run has ended.
    #[cfg(target_arch = "wasm32")]
    pub fn rows(&self, spare: Option<js_sys::Float64Array>) -> Result<js_sys::Float64Array, JsValue> {
        let rows = self.finished()?.recording.rows();
        match spare {
            Some(spare) if spare.length() as usize == rows.len() => {
                spare.copy_from(rows);
                Ok(spare)
            }
            _ => Ok(js_sys::Float64Array::from(rows)),
        }
    }
}

impl Run {
    #[cfg_attr(not(target_arch = "wasm32"), allow(dead_code, reason = "only the browser and a test ask"))]
    fn thinned(&self, most: usize) -> Vec<f64> {
        let Stage::Running(simulation) = &self.stage else { return Vec::new() };
        let recording = simulation.recording();
        let every = recording.len().div_ceil(most.max(1)).max(1);
        recording.rows().chunks_exact(recording.columns().width()).step_by(every).flatten().copied().collect()
    }

    fn finished(&self) -> Result<&scenario::Run, Failure> {
        if let Stage::Finished(run) = &self.stage { Ok(run) } else { Err(Failure::new("the run has not ended")) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_resolved_scenario_has_every_field_and_the_same_hash() {
        let json = r#"{"format":"adaptarm.scenario/1","scheme":{"kind":"slotine_li","gains":{"k_s":[1,2,3]}}}"#;
        let Ok(full) = resolve(json) else { panic!("the scenario is allowed") };
        assert!(full.contains("\"theta_scale\"") && full.contains("[1.0,2.0,3.0]"), "{full}");
        assert_eq!(read(&full).unwrap().hash(), read(json).unwrap().hash());
    }

    #[test]
    fn a_run_in_slices_reports_what_a_run_in_one_does() {
        let json =
            r#"{"format":"adaptarm.scenario/1","scheme":{"kind":"slotine_li"},"integration":{"duration_s":0.5}}"#;
        let Ok(mut run) = Run::new(json) else { panic!("the scenario is allowed") };
        assert!(run.finished().is_err());
        let width = adaptarm_core::recording::Columns { joints: 3, parameters: 18 }.width();
        while !run.advance(7) {
            assert!(run.progress() < 1.0);
            let thinned = run.thinned(10);
            assert!(thinned.len() <= 10 * width && thinned.len().is_multiple_of(width));
        }
        assert!(run.thinned(10).is_empty());
        let expected = read(json).unwrap().run().report;
        assert_eq!(run.finished().unwrap().report, expected);
    }
}
