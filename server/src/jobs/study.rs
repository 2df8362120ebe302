//! The job kind `study`: scenarios, each simulated to its end; a diverging one is a result like any other.

use adaptarm_core::recording::Recording;
use adaptarm_core::scenario::{Problem, Report, Run, Scenario, ScenarioDocument, ScenarioError};
use serde::Serialize;
use thiserror::Error;

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

/// Why there is no such study.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum StudyError {
    /// Something in its document is wrong.
    #[error(transparent)]
    Document(#[from] ScenarioError),
    /// It would be more work, or more to keep, than one study may be.
    #[error("the study has {total} {what}; a study may have at most {most}")]
    TooMuch {
        /// JSON pointer to the scenarios.
        pointer: String,
        /// What there is too much of, over all scenarios together.
        what: &'static str,
        /// How much there is.
        total: u64,
        /// How much there may be.
        most: u64,
    },
}

/// Scenarios that have been checked, one by one and together.
#[derive(Debug, Clone, PartialEq)]
pub struct Study {
    scenarios: Vec<Scenario>,
}

impl Study {
    /// Checks documents that a larger document holds at `pointer`.
    pub fn new(documents: Vec<ScenarioDocument>, pointer: &str) -> Result<Self, StudyError> {
        let [fewest, most] = STUDY_LIMITS.scenarios;
        let count = documents.len();
        if count < fewest {
            let [min, max] = STUDY_LIMITS.scenarios.map(|count| count as f64);
            let problem = Problem::OutOfRange { value: count as f64, min, max, unit: "scenarios" };
            return Err(ScenarioError::new(pointer, problem).into());
        }
        check_total(pointer, "scenarios", count as u64, most as u64)?;
        let mut scenarios = Vec::with_capacity(count);
        for (n, document) in documents.into_iter().enumerate() {
            scenarios.push(Scenario::new(document).map_err(|error| error.within(&format!("{pointer}/{n}")))?);
        }
        let study = Self { scenarios };
        check_total(pointer, "integration steps", study.steps(), STUDY_LIMITS.steps)?;
        let samples: usize = study.scenarios.iter().map(|scenario| scenario.settings().samples).sum();
        check_total(pointer, "samples", samples as u64, STUDY_LIMITS.samples as u64)?;
        Ok(study)
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

fn check_total(pointer: &str, what: &'static str, total: u64, most: u64) -> Result<(), StudyError> {
    if total <= most { Ok(()) } else { Err(StudyError::TooMuch { pointer: pointer.to_owned(), what, total, most }) }
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
        assert!(refusal(vec![paper.clone(); 65]).contains("65 scenarios; a study may have at most 64"));
        let mut long = paper.clone();
        long.integration.duration_s = 90_000.0;
        assert!(refusal(vec![long; 64]).contains("integration steps; a study may have at most 1000000000"));
        let mut fine = paper;
        fine.recording.samples = 200_000;
        assert!(refusal(vec![fine; 3]).contains("600000 samples"));
    }
}
