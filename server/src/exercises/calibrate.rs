//! Whether an exercise is fair: reference solutions, the naive start and random gains, each graded for many students.
//!
//! Fair means: every reference solution has full marks on every seed, the naive start under half on every seed, no bound lies
//! within the spread of good solutions nor closer to it than a tenth of that spread, and random gains seldom do.

use adaptarm_core::exercises::{CriterionDocument, Exercise, Grade, GradeError, ShareAggregate, Visibility};
use adaptarm_core::scenario::{Report, run_each};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use rayon::prelude::*;
use serde::Serialize;
use std::collections::BTreeMap;
use std::ops::ControlFlow;

/// How hard to try.
#[derive(Debug, Clone, Copy)]
pub struct Effort {
    /// Students, each with a seed.
    pub seeds: u64,
    /// Gains drawn at random within the moves' ranges.
    pub random: u64,
}

/// What an exercise showed.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Calibration {
    /// Identifier.
    pub exercise: String,
    /// What was calibrated.
    pub fingerprint: String,
    /// Seeds, 0 to this.
    pub seeds: u64,
    /// Hidden variants of each.
    pub variants: u32,
    /// Reference solutions.
    pub solutions: Vec<Scores>,
    /// The start values.
    pub naive: Scores,
    /// Random gains.
    pub random: Scores,
    /// How good solutions lie to each criterion's bounds.
    pub criteria: Vec<CriterionSpread>,
    /// What is not fair; nothing if the exercise is.
    pub findings: Vec<String>,
}

/// Scores of one kind of submission, over seeds.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Scores {
    /// What was submitted.
    pub name: String,
    /// Least score.
    pub min: f64,
    /// Median.
    pub median: f64,
    /// Greatest.
    pub max: f64,
    /// Share of full marks.
    pub full_share: f64,
}

/// A criterion's bounds beside what good solutions reach.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CriterionSpread {
    /// Identifier.
    pub id: String,
    /// Bound of full credit.
    pub full: f64,
    /// Bound of no credit.
    pub zero: f64,
    /// Least and greatest value of reference solutions, folded over variants as the criterion says.
    pub good: Option<[f64; 2]>,
    /// The same of the naive start.
    pub naive: Option<[f64; 2]>,
}

/// A bound this close to the spread of good solutions, as a share of it, is within.
const MARGIN: f64 = 0.1;
/// More random gains than this with full marks mean that there is nothing to find.
const MOST_LUCKY: f64 = 0.25;

/// Grades everything, on the threads of the current pool.
pub fn calibrate(exercise: &Exercise, effort: Effort) -> Result<Calibration, GradeError> {
    let document = exercise.document();
    let seeds = effort.seeds.max(1);
    let on_every_seed = |gains: &BTreeMap<String, f64>| -> Result<Vec<Grade>, GradeError> {
        (0..seeds).into_par_iter().map(|seed| grade(exercise, gains, seed)).collect()
    };
    let mut solutions = Vec::new();
    let mut good = Vec::new();
    for solution in &document.solutions {
        let grades = on_every_seed(&solution.gains)?;
        solutions.push(Scores::of(&solution.name, &grades));
        good.extend(grades);
    }
    let naive = on_every_seed(&exercise.start())?;
    let lucky = |n: u64| match grade(exercise, &random_gains(exercise, n), n % seeds) {
        // Numbers that make no scenario together are no submission.
        Err(GradeError::Refused(_)) => Ok(None),
        grade => grade.map(Some),
    };
    let random: Vec<Option<Grade>> = (0..effort.random).into_par_iter().map(lucky).collect::<Result<_, _>>()?;
    let random: Vec<_> = random.into_iter().flatten().collect();
    let mut calibration = Calibration {
        exercise: document.id.clone(),
        fingerprint: exercise.fingerprint(),
        seeds,
        variants: document.hidden.as_ref().map_or(0, |hidden| hidden.count),
        solutions,
        naive: Scores::of("naive", &naive),
        random: Scores::of("random", &random),
        criteria: document.criteria.iter().enumerate().map(|(n, own)| spread(own, n, &good, &naive)).collect(),
        findings: Vec::new(),
    };
    calibration.findings = findings(&calibration);
    Ok(calibration)
}

/// The grade on the hidden variants of a seed.
fn grade(exercise: &Exercise, gains: &BTreeMap<String, f64>, seed: u64) -> Result<Grade, GradeError> {
    exercise.grade(gains, seed, Visibility::Hidden, &reports(exercise, gains, seed, Visibility::Hidden)?)
}

/// Makes the runs on this thread, side by side where that is possible.
pub fn reports(
    exercise: &Exercise,
    gains: &BTreeMap<String, f64>,
    seed: u64,
    visibility: Visibility,
) -> Result<Vec<Report>, GradeError> {
    let scenarios = exercise.runs(gains, seed, visibility)?;
    let mut reports = vec![None; scenarios.len()];
    // Nothing breaks it off.
    let _ = run_each(&scenarios, |n, run| {
        reports[n] = Some(run.report);
        ControlFlow::Continue(())
    });
    Ok(reports.into_iter().flatten().collect())
}

/// Gains evenly within their ranges, in the logarithm where the slider moves so.
fn random_gains(exercise: &Exercise, n: u64) -> BTreeMap<String, f64> {
    let mut generator = StdRng::seed_from_u64(n);
    let mut draw = |own: &adaptarm_core::exercises::MoveDocument| {
        let share: f64 = generator.random();
        let value = if own.log {
            (own.min.ln() + share * (own.max.ln() - own.min.ln())).exp()
        } else {
            own.min + share * (own.max - own.min)
        };
        (own.name.clone(), value.clamp(own.min, own.max))
    };
    exercise.document().moves.iter().map(&mut draw).collect()
}

impl Scores {
    fn of(name: &str, grades: &[Grade]) -> Self {
        let mut scores: Vec<_> = grades.iter().map(|grade| grade.score).collect();
        scores.sort_by(f64::total_cmp);
        let count = scores.len().max(1) as f64;
        Self {
            name: name.to_owned(),
            min: scores.first().copied().unwrap_or(0.0),
            median: scores.get(scores.len() / 2).copied().unwrap_or(0.0),
            max: scores.last().copied().unwrap_or(0.0),
            full_share: scores.iter().filter(|score| **score == 1.0).count() as f64 / count,
        }
    }
}

fn spread(criterion: &CriterionDocument, n: usize, good: &[Grade], naive: &[Grade]) -> CriterionSpread {
    let range = |grades: &[Grade]| {
        let values = grades.iter().filter_map(|grade| folded(criterion, n, grade));
        values.fold(None, |range: Option<[f64; 2]>, value| {
            let [low, high] = range.unwrap_or([value; 2]);
            Some([low.min(value), high.max(value)])
        })
    };
    CriterionSpread {
        id: criterion.id.clone(),
        full: criterion.full,
        zero: criterion.zero,
        good: range(good),
        naive: range(naive),
    }
}

/// The value that decides a criterion: the worst one, or the one at the criterion's quantile counted from the worst; nothing where
/// a run has none.
fn folded(criterion: &CriterionDocument, n: usize, grade: &Grade) -> Option<f64> {
    let values: Option<Vec<f64>> = grade.variants.iter().map(|variant| variant.criteria[n].value).collect();
    let mut values = values?;
    values.sort_by(f64::total_cmp);
    if criterion.full < criterion.zero {
        values.reverse();
    }
    let place = match criterion.aggregate {
        ShareAggregate::Worst | ShareAggregate::Mean => 0.0,
        ShareAggregate::Quantile => criterion.quantile.unwrap_or(0.0) * (values.len() - 1) as f64,
    };
    values.get(place.floor() as usize).copied()
}

fn findings(calibration: &Calibration) -> Vec<String> {
    let mut findings = Vec::new();
    if calibration.solutions.is_empty() {
        findings.push("there is no reference solution".to_owned());
    }
    for solution in calibration.solutions.iter().filter(|solution| solution.min < 1.0) {
        findings.push(format!(
            "solution {} has {:.1} % on some seed, not full marks",
            solution.name,
            100.0 * solution.min
        ));
    }
    let naive = &calibration.naive;
    if naive.max >= 0.5 {
        findings.push(format!("the start values have {:.1} % on some seed, not under half", 100.0 * naive.max));
    }
    if calibration.random.full_share > MOST_LUCKY {
        let share = 100.0 * calibration.random.full_share;
        findings.push(format!("{share:.0} % of random gains have full marks: there is nothing to find"));
    }
    for criterion in &calibration.criteria {
        let Some([low, high]) = criterion.good else {
            findings.push(format!("criterion {}: no reference solution has a number for it", criterion.id));
            continue;
        };
        let margin = MARGIN * (high - low);
        for (name, bound) in [("full", criterion.full), ("zero", criterion.zero)] {
            if bound > low - margin && bound < high + margin {
                findings.push(format!(
                    "criterion {}: bound {name} = {bound} lies within {low:.4} to {high:.4}, the spread of good solutions",
                    criterion.id
                ));
            }
        }
    }
    findings
}
