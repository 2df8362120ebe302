//! The job kind `study`: scenarios, each simulated to its end; a diverging one is a result like any other.

use super::NewScenario;
use crate::config::Limits;
use adaptarm_core::scenario::{Problem, Scenario, ScenarioDocument, ScenarioError};
use thiserror::Error;

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
    pub fn new(documents: Vec<ScenarioDocument>, pointer: &str, limits: &Limits) -> Result<Self, StudyError> {
        let (count, most) = (documents.len(), limits.scenarios_per_job);
        if count == 0 {
            let problem = Problem::OutOfRange { value: 0.0, min: 1.0, max: most as f64, unit: "scenarios" };
            return Err(ScenarioError::new(pointer, problem).into());
        }
        check_total(pointer, "scenarios", count as u64, most as u64)?;
        let mut scenarios = Vec::with_capacity(count);
        for (n, document) in documents.into_iter().enumerate() {
            scenarios.push(Scenario::new(document).map_err(|error| error.within(&format!("{pointer}/{n}")))?);
        }
        let study = Self { scenarios };
        check_total(pointer, "integration steps", study.steps(), limits.steps_per_job)?;
        let samples: usize = study.scenarios.iter().map(|scenario| scenario.settings().samples).sum();
        check_total(pointer, "samples", samples as u64, limits.samples_per_job)?;
        Ok(study)
    }

    /// The scenarios as a job holds them. Takes a while for many: not for an async task.
    pub fn into_new_scenarios(self) -> Vec<NewScenario> {
        self.scenarios.iter().map(NewScenario::of).collect()
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

/// Refuses too much of something.
pub(super) fn check_total(pointer: &str, what: &'static str, total: u64, most: u64) -> Result<(), StudyError> {
    if total <= most { Ok(()) } else { Err(StudyError::TooMuch { pointer: pointer.to_owned(), what, total, most }) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use adaptarm_core::scenario::Scheme;

    fn limits() -> Limits {
        Limits { scenarios_per_job: 64, steps_per_job: 1_000_000_000, samples_per_job: 400_000, ..Limits::default() }
    }

    fn refusal(documents: Vec<ScenarioDocument>) -> String {
        Study::new(documents, "/spec/scenarios", &limits()).unwrap_err().to_string()
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
