//! What runs are worth: shares of criteria per variant, folded over variants, times points.
//!
//! Share of a variant: `clamp((zero − x) / (zero − full), 0, 1)` of its metric x; 0 where the run diverged or has no such
//! number. Points are rounded to hundredths before they are added, so that every place that shows them shows the same.

use super::document::{CriterionDocument, ShareAggregate, Text};
use super::exercise::{Exercise, Visibility};
use crate::experiments::{ResultColumns, quantile};
use crate::scenario::{OutcomeKind, Report, ScenarioError};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use thiserror::Error;

/// Everything about a grade. Not for students while variants are hidden: [`Grade::public`] is.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Grade {
    /// The exercise's identifier.
    pub exercise: String,
    /// Hash of what was graded by: [`Exercise::fingerprint`].
    pub fingerprint: String,
    /// Version of the core that computed it.
    pub core_version: String,
    /// On which variants.
    pub visibility: Visibility,
    /// Points over all that there are, 0 to 1.
    pub score: f64,
    /// Points.
    pub points: f64,
    /// All points that there are.
    pub of: f64,
    /// Criterion by criterion.
    pub criteria: Vec<CriterionGrade>,
    /// Variant by variant.
    pub variants: Vec<VariantGrade>,
}

/// A criterion over all variants.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct CriterionGrade {
    /// Its identifier.
    pub id: String,
    /// What students read.
    pub label: Text,
    /// Points, in hundredths.
    pub points: f64,
    /// All points that there are for it.
    pub of: f64,
    /// Share of the points before they are rounded, 0 to 1.
    pub share: f64,
    /// Share of the variants with full credit.
    pub full_share: f64,
}

/// A variant.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct VariantGrade {
    /// Hash of its scenario.
    pub scenario_hash: String,
    /// Hash over the bits of its samples.
    pub trajectory_hash: String,
    /// How its run ended.
    pub outcome: OutcomeKind,
    /// When a diverged run was given up, s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at_s: Option<f64>,
    /// In the order of the criteria.
    pub criteria: Vec<VariantCriterion>,
}

/// A criterion on one variant.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct VariantCriterion {
    /// The metric; absent where the run diverged, and for an arm that never settles.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value: Option<f64>,
    /// Share of the points, 0 to 1.
    pub share: f64,
}

/// What a student may know of a grade.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PublicGrade {
    /// The exercise's identifier.
    pub exercise: String,
    /// Hash of what was graded by.
    pub fingerprint: String,
    /// Version of the core that computed it.
    pub core_version: String,
    /// On which variants.
    pub visibility: Visibility,
    /// Points over all that there are, 0 to 1.
    pub score: f64,
    /// Points.
    pub points: f64,
    /// All points that there are.
    pub of: f64,
    /// Criterion by criterion.
    pub criteria: Vec<PublicCriterion>,
    /// Variant by variant, where they are no secret.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub variants: Vec<VariantGrade>,
}

/// What a student may know of a criterion.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PublicCriterion {
    /// Its identifier.
    pub id: String,
    /// What it asks for.
    pub label: Text,
    /// Points, in hundredths.
    pub points: f64,
    /// All points that there are for it.
    pub of: f64,
}

/// Why reports cannot be graded.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum GradeError {
    /// The submission, or the exercise.
    #[error(transparent)]
    Refused(#[from] ScenarioError),
    /// Not one report per variant.
    #[error("{found} reports were given where the exercise has {expected} variants")]
    Count {
        /// Reports given.
        found: usize,
        /// Variants.
        expected: usize,
    },
    /// The report on something else.
    #[error("report {variant} is on scenario {found}; this variant is scenario {expected}")]
    OtherScenario {
        /// Variant, from 0.
        variant: usize,
        /// The report's scenario hash.
        found: String,
        /// The variant's.
        expected: String,
    },
    /// A run that is still under way.
    #[error("report {variant} is on a run that has not ended")]
    Unfinished {
        /// Variant, from 0.
        variant: usize,
    },
}

impl Exercise {
    /// The grade of runs, whose reports come in the order of [`Exercise::runs`] with the same arguments.
    pub fn grade(
        &self,
        gains: &BTreeMap<String, f64>,
        seed: u64,
        visibility: Visibility,
        reports: &[Report],
    ) -> Result<Grade, GradeError> {
        let runs = self.runs(gains, seed, visibility)?;
        if runs.len() != reports.len() {
            return Err(GradeError::Count { found: reports.len(), expected: runs.len() });
        }
        for (variant, (run, report)) in runs.iter().zip(reports).enumerate() {
            let (found, expected) = (report.scenario_hash.clone(), run.hash());
            if found != expected {
                return Err(GradeError::OtherScenario { variant, found, expected });
            }
            if report.outcome == OutcomeKind::Unfinished {
                return Err(GradeError::Unfinished { variant });
            }
        }
        let variants: Vec<_> = reports.iter().map(|report| self.variant(report)).collect();
        let criteria = self.document.criteria.iter().enumerate();
        let criteria: Vec<_> = criteria.map(|(n, criterion)| total(criterion, n, &variants)).collect();
        let of = hundredths(self.document.criteria.iter().map(|criterion| criterion.weight).sum());
        let points = hundredths(criteria.iter().map(|criterion| criterion.points).sum());
        Ok(Grade {
            exercise: self.document.id.clone(),
            fingerprint: self.fingerprint(),
            core_version: crate::VERSION.to_owned(),
            visibility,
            score: points / of,
            points,
            of,
            criteria,
            variants,
        })
    }

    fn variant(&self, report: &Report) -> VariantGrade {
        let completed = report.outcome == OutcomeKind::Completed;
        let columns = ResultColumns::new(self.robot.joint_count()).of(&report.metrics);
        let criterion = |(own, document): (&super::exercise::Criterion, &CriterionDocument)| {
            let value = if completed { own.measure.of(report, &columns) } else { None };
            VariantCriterion { value, share: value.map_or(0.0, |value| share(document, value)) }
        };
        VariantGrade {
            scenario_hash: report.scenario_hash.clone(),
            trajectory_hash: report.trajectory_hash.clone(),
            outcome: report.outcome,
            at_s: report.at_s,
            criteria: self.criteria.iter().zip(&self.document.criteria).map(criterion).collect(),
        }
    }
}

/// One within the full bound, nothing from the other on, linear between.
fn share(criterion: &CriterionDocument, value: f64) -> f64 {
    let CriterionDocument { full, zero, .. } = criterion;
    let within = if full < zero { value <= *full } else { value >= *full };
    // Exactly one, whatever rounding says.
    if within { 1.0 } else { ((zero - value) / (zero - full)).clamp(0.0, 1.0) }
}

fn total(criterion: &CriterionDocument, n: usize, variants: &[VariantGrade]) -> CriterionGrade {
    let mut shares: Vec<_> = variants.iter().map(|variant| variant.criteria[n].share).collect();
    let count = shares.len() as f64;
    let full = shares.iter().filter(|share| **share == 1.0).count() as f64;
    let share = match criterion.aggregate {
        ShareAggregate::Worst => shares.iter().copied().fold(1.0, f64::min),
        ShareAggregate::Mean => shares.iter().sum::<f64>() / count,
        ShareAggregate::Quantile => {
            shares.sort_by(f64::total_cmp);
            quantile(&shares, criterion.quantile.unwrap_or(0.0))
        }
    };
    CriterionGrade {
        id: criterion.id.clone(),
        label: criterion.label.clone(),
        points: hundredths(share * criterion.weight),
        of: criterion.weight,
        share,
        full_share: full / count,
    }
}

/// Rounded to hundredths: weights are, so that all points together make exactly one.
pub(super) fn hundredths(points: f64) -> f64 {
    (points * 100.0).round() / 100.0
}

impl Grade {
    /// What its student may know: of hidden variants nothing beside the points of each criterion.
    pub fn public(&self) -> PublicGrade {
        let criterion = |own: &CriterionGrade| PublicCriterion {
            id: own.id.clone(),
            label: own.label.clone(),
            points: own.points,
            of: own.of,
        };
        PublicGrade {
            exercise: self.exercise.clone(),
            fingerprint: self.fingerprint.clone(),
            core_version: self.core_version.clone(),
            visibility: self.visibility,
            score: self.score,
            points: self.points,
            of: self.of,
            criteria: self.criteria.iter().map(criterion).collect(),
            variants: match self.visibility {
                Visibility::Visible => self.variants.clone(),
                Visibility::Hidden => Vec::new(),
            },
        }
    }
}
