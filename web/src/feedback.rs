//! What a run's feedback had to do: the size of its sliding variable, from which the page tells why a joint tracks worst.

use crate::runs::Runs;
use adaptarm_core::metrics::performance_index;
use adaptarm_core::recording::Signal;
use wasm_bindgen::prelude::wasm_bindgen;

/// Root mean square of the sliding variable of each joint over the samples that the performance index takes, rad/s; none
/// where there is no run called `id`. Times the feedback gain it is the torque that the estimates failed to supply.
#[wasm_bindgen]
pub fn sliding_rms(runs: &Runs, id: &str) -> Option<Vec<f64>> {
    let run = runs.get(id)?;
    let samples = run.scenario.document().recording.samples;
    let joint = |joint| performance_index(run.recording.signal(Signal::SlidingVariable, joint).take(samples));
    Some((0..run.recording.columns().joints).map(joint).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use adaptarm_core::scenario::{Scenario, Scheme};

    #[test]
    fn it_is_the_index_of_s_over_the_samples_and_not_the_end() {
        let mut document = Scheme::SlotineLi.paper();
        document.integration.duration_s = 0.5;
        document.recording.samples = 50;
        let scenario = Scenario::new(document).unwrap();
        let run = scenario.run();
        let mut runs = Runs::new();
        let text = serde_json::to_string(scenario.document()).unwrap();
        runs.set("a", &text, run.recording.rows().to_vec(), true).unwrap();
        let column = run.recording.columns().start(Signal::SlidingVariable) + 1;
        let rows: Vec<_> = run.recording.rows().chunks(run.recording.columns().width()).collect();
        assert_eq!(rows.len(), 51);
        let squares: f64 = rows[..50].iter().map(|row| row[column].powi(2)).sum();
        let found = sliding_rms(&runs, "a").unwrap();
        assert_eq!(found.len(), 3);
        assert!((found[1] - (squares / 50.0).sqrt()).abs() < 1e-15, "{found:?}");
        assert!(sliding_rms(&runs, "b").is_none());
    }
}
