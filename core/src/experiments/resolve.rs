//! What an experiment may say. Checks a document once and lays its runs out.

use super::distribution::{Distribution, DistributionDocument, DistributionKind};
use super::document::{
    AxisDocument, CompareDocument, ConditionDocument, EXPERIMENT_FORMAT, ExperimentDocument, ExperimentKind,
    MonteCarloDocument, RandomFieldDocument, SweepDesign, SweepDocument,
};
use super::experiment::{Base, Experiment, Work, bounded};
use super::fields::{Change, Tree};
use super::latin::LatinHypercube;
use super::layout::{Condition, Design, Filling, Layout};
use super::limits::{EXPERIMENT_LIMITS, check_count, check_name, check_range, conflict, unknown};
use super::row::ResultColumns;
use super::sobol::Sobol;
use super::stream::Purpose;
use super::tuning::TuningPlan;
use crate::scalar::{exponential, logarithm};
use crate::scenario::{Scenario, ScenarioError};

const LIMITS: &super::limits::ExperimentLimits = &EXPERIMENT_LIMITS;

/// Checks a document and fills its bases in.
pub(super) fn resolve(mut document: ExperimentDocument) -> Result<Experiment, ScenarioError> {
    if document.format != EXPERIMENT_FORMAT {
        return Err(unknown("/format", &document.format, EXPERIMENT_FORMAT.to_owned()));
    }
    if !document.title.is_empty() {
        check_name("/title", &document.title, std::iter::empty())?;
    }
    // Whole numbers beyond this are not kept exact by every reader of JSON.
    check_range("/seed", document.seed as f64, [0.0, 9_007_199_254_740_992.0], "")?;
    check_range("/confidence", document.confidence, LIMITS.confidence, "")?;
    check_sections(&document)?;
    let bases = bases(&mut document)?;
    let joints = bases.iter().map(|base| base.scenario.robot().joint_count()).max().unwrap_or(0);
    let columns = ResultColumns::new(joints);
    let (seed, count) = (document.seed, bases.len());
    let work = match document.kind {
        ExperimentKind::Sweep => Work::LaidOut(sweep(section(document.sweep.as_ref())?, seed, &bases)?),
        ExperimentKind::MonteCarlo => {
            Work::LaidOut(monte_carlo(section(document.monte_carlo.as_ref())?, seed, &bases)?)
        }
        ExperimentKind::Compare => Work::LaidOut(compare(section(document.compare.as_ref())?, seed, &bases)?),
        ExperimentKind::Tuning if count > 1 => {
            return Err(conflict("/bases", format!("has {count} scenarios; a tuning takes one")));
        }
        ExperimentKind::Tuning => {
            Work::Searched(TuningPlan::new(section(document.tuning.as_ref())?, seed, &bases[0], &columns)?)
        }
    };
    let runs = match &work {
        Work::LaidOut(layout) => layout.runs(),
        Work::Searched(plan) => plan.most_runs(),
    };
    if runs > LIMITS.runs {
        let message = format!("asks for {runs} runs in all; at most {} are allowed", LIMITS.runs);
        return Err(conflict(format!("/{}", name_of(document.kind)), message));
    }
    for (n, base) in bases.iter().enumerate() {
        bounded(base.scenario.clone(), runs).map_err(|error| error.within(&format!("/bases/{n}/scenario")))?;
    }
    Ok(Experiment { document, bases, columns, work })
}

/// The section called as the kind, which [`check_sections`] has seen.
fn section<T>(section: Option<&T>) -> Result<&T, ScenarioError> {
    section.ok_or_else(|| conflict("/kind", "lacks the section called so".to_owned()))
}

fn name_of(kind: ExperimentKind) -> &'static str {
    match kind {
        ExperimentKind::Sweep => "sweep",
        ExperimentKind::MonteCarlo => "monte_carlo",
        ExperimentKind::Compare => "compare",
        ExperimentKind::Tuning => "tuning",
    }
}

/// The section called as the kind is there, and no other.
fn check_sections(document: &ExperimentDocument) -> Result<(), ScenarioError> {
    let sections = [
        (ExperimentKind::Sweep, document.sweep.is_some()),
        (ExperimentKind::MonteCarlo, document.monte_carlo.is_some()),
        (ExperimentKind::Compare, document.compare.is_some()),
        (ExperimentKind::Tuning, document.tuning.is_some()),
    ];
    for (kind, given) in sections {
        let name = name_of(kind);
        let pointer = format!("/{name}");
        match (kind == document.kind, given) {
            (true, false) => return Err(conflict(pointer, format!("missing; kind {name} needs this section"))),
            (false, true) => return Err(conflict(pointer, "belongs to another kind of experiment".to_owned())),
            _ => {}
        }
    }
    Ok(())
}

fn bases(document: &mut ExperimentDocument) -> Result<Vec<Base>, ScenarioError> {
    check_count("/bases", document.bases.len(), LIMITS.bases, "base scenarios")?;
    let mut bases: Vec<Base> = Vec::new();
    for (n, base) in document.bases.iter_mut().enumerate() {
        check_name(&format!("/bases/{n}/name"), &base.name, bases.iter().map(|base| base.name.as_str()))?;
        let scenario =
            Scenario::new(base.scenario.clone()).map_err(|error| error.within(&format!("/bases/{n}/scenario")))?;
        base.scenario = scenario.document().clone();
        bases.push(Base { name: base.name.clone(), tree: Tree::of(&scenario), scenario });
    }
    Ok(bases)
}

/// The changes that a pointer stands for: in every base the same ones, all numbers.
pub(crate) fn changes(pointer: &str, relative: bool, at: &str, bases: &[&Tree]) -> Result<Vec<Change>, ScenarioError> {
    let mut pointers: Option<Vec<String>> = None;
    for tree in bases {
        let found = tree.expand(pointer, at)?;
        if pointers.get_or_insert_with(|| found.clone()) != &found {
            return Err(conflict(at, format!("{pointer} stands for lists of different lengths in the bases")));
        }
    }
    Ok(pointers.unwrap_or_default().into_iter().map(|pointer| Change { pointer, relative }).collect())
}

/// Refuses a field that is named twice, and too many of them.
pub(crate) fn check_fields(fields: &[Change], most: usize, at: &str) -> Result<(), ScenarioError> {
    if fields.len() > most {
        let problem = crate::scenario::Problem::TooMany { found: fields.len(), most, what: "fields that vary" };
        return Err(ScenarioError::new(at, problem));
    }
    for (n, field) in fields.iter().enumerate() {
        if fields[..n].iter().any(|other| other.pointer == field.pointer) {
            return Err(conflict(at, format!("{} varies twice", field.pointer)));
        }
    }
    Ok(())
}

/// Random fields with their distributions, each element of a list on its own.
pub(crate) fn random_fields(
    fields: &[RandomFieldDocument],
    at: &str,
    bases: &[&Tree],
) -> Result<(Vec<Change>, Vec<Distribution>), ScenarioError> {
    let (mut all, mut distributions) = (Vec::new(), Vec::new());
    for (n, field) in fields.iter().enumerate() {
        let at = format!("{at}/{n}");
        let distribution = Distribution::new(&field.distribution, &format!("{at}/distribution"))?;
        let mut new = changes(&field.field, field.relative, &format!("{at}/field"), bases)?;
        distributions.resize(distributions.len() + new.len(), distribution);
        all.append(&mut new);
    }
    check_fields(&all, LIMITS.fields, at)?;
    Ok((all, distributions))
}

fn trees(bases: &[Base]) -> Vec<&Tree> {
    bases.iter().map(|base| &base.tree).collect()
}

fn nominal() -> Condition {
    Condition { name: "nominal".to_owned(), changes: Vec::new() }
}

fn draws(pointer: &str, draws: u32) -> Result<u64, ScenarioError> {
    check_range(pointer, f64::from(draws), [1.0, LIMITS.runs as f64], "draws")?;
    Ok(u64::from(draws))
}

fn monte_carlo(document: &MonteCarloDocument, seed: u64, bases: &[Base]) -> Result<Layout, ScenarioError> {
    let (fields, distributions) = random_fields(&document.fields, "/monte_carlo/fields", &trees(bases))?;
    Ok(Layout {
        seed,
        fields,
        design: Design::Cube(Filling::Random(Purpose::Draw), distributions),
        points: draws("/monte_carlo/draws", document.draws)?,
        conditions: vec![nominal()],
        bases: bases.len(),
        vary_seed: document.vary_seed,
    })
}

fn compare(document: &CompareDocument, seed: u64, bases: &[Base]) -> Result<Layout, ScenarioError> {
    let trees = trees(bases);
    check_count("/compare/conditions", document.conditions.len(), LIMITS.conditions, "conditions")?;
    let mut conditions: Vec<Condition> = Vec::new();
    for (n, ConditionDocument { name, set }) in document.conditions.iter().enumerate() {
        let at = format!("/compare/conditions/{n}");
        check_name(&format!("{at}/name"), name, conditions.iter().map(|condition| condition.name.as_str()))?;
        let mut all = Vec::new();
        for (m, setting) in set.iter().enumerate() {
            let at = format!("{at}/set/{m}");
            for change in changes(&setting.field, setting.relative, &format!("{at}/field"), &trees)? {
                all.push((change, setting.value));
            }
        }
        let only: Vec<_> = all.iter().map(|(change, _)| change.clone()).collect();
        check_fields(&only, LIMITS.fields, &format!("{at}/set"))?;
        let condition = Condition { name: name.clone(), changes: all };
        // What every draw shares is wrong before the first of them.
        for base in bases {
            let mut tree = base.tree.clone();
            let wrong = condition.changes.iter().try_for_each(|(change, value)| tree.apply(change, *value));
            if let Err(error) = wrong.and_then(|()| tree.scenario().map(drop)) {
                return Err(conflict(format!("{at}/set"), format!("with base {:?}: {error}", base.name)));
            }
        }
        conditions.push(condition);
    }
    let (fields, distributions) = random_fields(&document.fields, "/compare/fields", &trees)?;
    Ok(Layout {
        seed,
        fields,
        design: Design::Cube(Filling::Random(Purpose::Draw), distributions),
        points: draws("/compare/draws", document.draws)?,
        conditions,
        bases: bases.len(),
        vary_seed: document.vary_seed,
    })
}

fn sweep(document: &SweepDocument, seed: u64, bases: &[Base]) -> Result<Layout, ScenarioError> {
    check_count("/sweep/axes", document.axes.len(), LIMITS.axes, "axes")?;
    let mut fields = Vec::new();
    for (n, axis) in document.axes.iter().enumerate() {
        let at = format!("/sweep/axes/{n}/field");
        let found = changes(&axis.field, axis.relative, &at, &trees(bases))?;
        if found.len() > 1 {
            return Err(conflict(at, "stands for several fields; an axis is one".to_owned()));
        }
        fields.extend(found);
    }
    check_fields(&fields, LIMITS.axes, "/sweep/axes")?;
    let (design, points) = match (document.design, document.points) {
        (SweepDesign::Grid, Some(_)) => {
            return Err(conflict("/sweep/points", "has no meaning for a grid; each axis has its own".to_owned()));
        }
        (SweepDesign::Grid, None) => {
            let axes = document.axes.iter().enumerate().map(|(n, axis)| grid_axis(axis, n));
            let axes: Vec<_> = axes.collect::<Result<_, _>>()?;
            // Beyond the limit it makes no difference how far.
            let points = axes.iter().fold(1, |points: u64, axis| points.saturating_mul(axis.len() as u64));
            (Design::Grid(axes), points.min(LIMITS.runs + 1))
        }
        (_, None) => {
            return Err(conflict("/sweep/points", "missing; this design needs the number of its points".to_owned()));
        }
        (design, Some(points)) => {
            check_range("/sweep/points", f64::from(points), [1.0, LIMITS.runs as f64], "points")?;
            let ranges = document.axes.iter().enumerate().map(|(n, axis)| range_axis(axis, n));
            let ranges: Vec<_> = ranges.collect::<Result<_, _>>()?;
            let filling = if design == SweepDesign::Sobol {
                Filling::Sobol(Sobol::new(seed, ranges.len()))
            } else {
                Filling::Latin(LatinHypercube::new(seed, ranges.len(), points))
            };
            (Design::Cube(filling, ranges), u64::from(points))
        }
    };
    Ok(Layout { seed, fields, design, points, conditions: vec![nominal()], bases: bases.len(), vary_seed: false })
}

/// The range of an axis as a distribution that covers it evenly.
fn range_axis(axis: &AxisDocument, n: usize) -> Result<Distribution, ScenarioError> {
    let at = format!("/sweep/axes/{n}");
    for (name, given) in [("values", axis.values.is_some()), ("points", axis.points.is_some())] {
        if given {
            let message = "has no meaning for this design; min and max say where its points are".to_owned();
            return Err(conflict(format!("{at}/{name}"), message));
        }
    }
    even(axis.min, axis.max, axis.log, &at)
}

/// Even between two limits.
pub(crate) fn even(min: Option<f64>, max: Option<f64>, log: bool, at: &str) -> Result<Distribution, ScenarioError> {
    let kind = if log { DistributionKind::LogUniform } else { DistributionKind::Uniform };
    let document = DistributionDocument { kind, mean: None, sd: None, median: None, log_sd: None, min, max };
    Distribution::new(&document, at)
}

/// The values of an axis of a grid.
fn grid_axis(axis: &AxisDocument, n: usize) -> Result<Vec<f64>, ScenarioError> {
    let at = format!("/sweep/axes/{n}");
    if let Some(values) = &axis.values {
        let values_at = format!("{at}/values");
        check_count(&values_at, values.len(), LIMITS.values, "values")?;
        for (m, value) in values.iter().enumerate() {
            check_range(&format!("{values_at}/{m}"), *value, [-1e12, 1e12], "")?;
        }
        if axis.min.is_some() || axis.max.is_some() || axis.points.is_some() || axis.log {
            return Err(conflict(values_at, "stand beside min, max, points or log; give one or the other".to_owned()));
        }
        return Ok(values.clone());
    }
    even(axis.min, axis.max, axis.log, &at)?;
    let (Some(min), Some(max), Some(points)) = (axis.min, axis.max, axis.points) else {
        return Err(conflict(format!("{at}/points"), "missing; a grid needs the number of values".to_owned()));
    };
    check_range(&format!("{at}/points"), f64::from(points), [2.0, LIMITS.values as f64], "values")?;
    let value = |n: u32| {
        let share = f64::from(n) / f64::from(points - 1);
        match (n, axis.log) {
            // The ends are what was written, to the bit.
            (0, _) => min,
            _ if n == points - 1 => max,
            (_, false) => min + share * (max - min),
            (_, true) => exponential(logarithm(min) + share * (logarithm(max) - logarithm(min))),
        }
    };
    Ok((0..points).map(value).collect())
}
