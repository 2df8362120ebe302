//! The job kind `study`: scenarios, each simulated to its end; a diverging one is a result like any other.

use adaptarm_core::recording::Recording;
use adaptarm_core::scenario::{Problem, Report, Run, Scenario, ScenarioDocument, ScenarioError};
use serde::Serialize;

/// Limits on one study, beside those on each scenario. All are inclusive.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct StudyLimits {
    /// Fewest and most scenarios.
    pub scenarios: [usize; 2],
    /// Most integration steps of all scenarios together.
    pub steps: u64,
    /// Most samples of all scenarios together.
    pub samples: usize,
    /// Longest label, characters.
    pub label_chars: usize,
}

/// The limits of this version: about an hour of one core, and 120 MB of samples.
pub const STUDY_LIMITS: StudyLimits =
    StudyLimits { scenarios: [1, 64], steps: 1_000_000_000, samples: 400_000, label_chars: 200 };

/// Scenarios that have been checked, one by one and together.
#[derive(Debug, Clone, PartialEq)]
pub struct Study {
    scenarios: Vec<Scenario>,
}

impl Study {
    /// Checks documents that a larger document holds at `pointer`.
    pub fn new(documents: Vec<ScenarioDocument>, pointer: &str) -> Result<Self, ScenarioError> {
        let [fewest, most] = STUDY_LIMITS.scenarios;
        let (count, limits) = (documents.len(), STUDY_LIMITS.scenarios.map(|count| count as f64));
        if !(fewest..=most).contains(&count) {
            let [min, max] = limits;
            let problem = Problem::OutOfRange { value: count as f64, min, max, unit: "scenarios" };
            return Err(ScenarioError::new(pointer, problem));
        }
        let mut scenarios = Vec::with_capacity(count);
        for (n, document) in documents.into_iter().enumerate() {
            scenarios.push(Scenario::new(document).map_err(|error| error.within(&format!("{pointer}/{n}")))?);
        }
        let study = Self { scenarios };
        study.check_total(pointer, "integration steps", study.steps() as f64, STUDY_LIMITS.steps as f64)?;
        let samples: usize = study.scenarios.iter().map(|scenario| scenario.settings().samples).sum();
        study.check_total(pointer, "samples", samples as f64, STUDY_LIMITS.samples as f64)?;
        Ok(study)
    }

    fn check_total(&self, pointer: &str, what: &str, total: f64, most: f64) -> Result<(), ScenarioError> {
        if total <= most {
            return Ok(());
        }
        let count = self.scenarios.len();
        let message = format!("{count} scenarios have {total:.3e} {what} together; a study may have {most:.0e}");
        Err(ScenarioError::new(pointer, Problem::Conflict { message }))
    }

    /// The scenarios, in the order of the result.
    pub fn scenarios(&self) -> &[Scenario] {
        &self.scenarios
    }

    /// Integration steps of all scenarios (an adaptive method may take more).
    pub fn steps(&self) -> u64 {
        self.scenarios.iter().map(|scenario| scenario.settings().steps()).sum()
    }
}

/// What a study gave.
#[derive(Debug, Clone, PartialEq)]
pub struct StudyResult {
    /// One report per scenario.
    pub reports: Vec<Report>,
    /// One recording per scenario; empty once they have made room for newer ones.
    pub recordings: Vec<Recording>,
}

impl StudyResult {
    /// From the finished runs.
    pub fn new(runs: Vec<Run>) -> Self {
        let (reports, recordings) = runs.into_iter().map(|run| (run.report, run.recording)).unzip();
        Self { reports, recordings }
    }

    /// Memory that the recordings take.
    pub fn recording_bytes(&self) -> usize {
        self.recordings.iter().map(|recording| size_of_val(recording.rows())).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use adaptarm_core::scenario::Scheme;

    fn refusal(documents: Vec<ScenarioDocument>) -> String {
        Study::new(documents, "/spec/scenarios").unwrap_err().to_string()
    }

    #[test]
    fn refuses_too_few_too_many_and_too_much_together() {
        let paper = Scheme::SlotineLi.paper();
        assert_eq!(refusal(vec![]), "spec.scenarios: 0 is outside the allowed range 1 to 64 scenarios");
        assert!(refusal(vec![paper.clone(); 65]).contains("65 is outside"));
        let mut long = paper.clone();
        long.integration.duration_s = 90_000.0;
        assert!(refusal(vec![long; 64]).contains("integration steps together"));
        let mut fine = paper;
        fine.recording.samples = 200_000;
        assert!(refusal(vec![fine; 3]).contains("6.000e5 samples together"));
    }
}
