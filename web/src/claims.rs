//! The paper's claims tested against the runs that are shown, as one JSON document for the tour.

use crate::failure::Failure;
use crate::runs::Runs;
use adaptarm_core::experiments::replication::{Claim, check_claims};
use adaptarm_core::scenario::{Report, Run, Scheme};
use std::collections::BTreeMap;
use wasm_bindgen::JsValue;
use wasm_bindgen::prelude::wasm_bindgen;

/// Every claim with its verdict, as JSON text: a list of `{id, claim, criterion, verdict, evidence}`. `reports_json` holds the
/// reports of the runs called like the schemes, by those names. Throws JSON text `{pointer, message}` unless every scheme
/// has a run and a report that belongs to it.
#[wasm_bindgen]
pub fn claims(runs: &Runs, reports_json: &str) -> Result<String, JsValue> {
    let claims = tested(runs, reports_json)?;
    serde_json::to_string(&claims).map_err(|error| Failure::new(error.to_string()).into())
}

fn tested(runs: &Runs, reports_json: &str) -> Result<Vec<Claim>, Failure> {
    let mut reports: BTreeMap<String, Report> =
        serde_json::from_str(reports_json).map_err(|error| Failure::new(error.to_string()))?;
    let mut run = |scheme: Scheme| {
        let missing = || Failure::new(format!("there is no finished run of {}", scheme.name()));
        let shown = runs.get(scheme.id()).ok_or_else(missing)?;
        let report = reports.remove(scheme.id()).ok_or_else(missing)?;
        if report.scenario_hash != shown.scenario.hash() {
            return Err(Failure::new(format!("the report on {} is that of another run", scheme.name())));
        }
        Ok(Run { report, recording: shown.recording.clone() })
    };
    Ok(check_claims(&[run(Scheme::Proposed)?, run(Scheme::TangArteaga)?, run(Scheme::SlotineLi)?]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use adaptarm_core::experiments::replication::study;
    use serde_json::json;

    #[test]
    fn claims_on_shown_runs_are_those_of_the_replication() {
        let scenarios = study(|document| document.integration.duration_s = 1.0).unwrap();
        let mut runs = Runs::new();
        let mut reports = BTreeMap::new();
        let mut finished = Vec::new();
        for scenario in &scenarios {
            let (id, run) = (scenario.scheme().id(), scenario.run());
            let document = serde_json::to_string(scenario.document()).unwrap();
            runs.set(id, &document, run.recording.rows().to_vec(), true).unwrap();
            reports.insert(id, json!(run.report));
            finished.push(run);
        }
        let expected = check_claims(&finished.try_into().unwrap());
        assert_eq!(tested(&runs, &json!(reports).to_string()).unwrap(), expected);

        reports.insert("proposed", reports["slotine_li"].clone());
        let other = tested(&runs, &json!(reports).to_string()).unwrap_err();
        assert!(other.message.contains("another run"), "{}", other.message);
        reports.remove("proposed");
        let missing = tested(&runs, &json!(reports).to_string()).unwrap_err();
        assert!(missing.message.contains("no finished run of Proposed"), "{}", missing.message);
    }
}
