//! What a tuning wants: variables with their ranges, goals, limits, and the plants that every candidate is tried on.

use super::cmaes::Cma;
use super::distribution::Distribution;
use super::document::{Aggregate, GoalDocument, PlantsDocument, TuningDocument, VariableDocument};
use super::experiment::{Base, bounded};
use super::fields::{Change, Tree};
use super::limits::{EXPERIMENT_LIMITS, check_count, check_range, unknown};
use super::resolve::{changes, check_fields, even, random_fields};
use super::row::{ResultColumns, Row, RowOutcome};
use super::stream::{Purpose, Stream};
use crate::scalar::logarithm;
use crate::scenario::{Problem, Scenario, ScenarioError};

/// A field that the search may change.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Variable {
    pub change: Change,
    range: Distribution,
    /// The base's value and where it is in the range.
    pub start: f64,
    pub start_unit: f64,
}

/// `weight · metric / scale`.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Goal {
    /// The objective that it is a part of.
    objective: usize,
    pub column: usize,
    /// JSON pointer to it, from the section on.
    pub at: String,
    weight: f64,
    pub scale: Option<f64>,
}

#[derive(Debug, Clone, PartialEq)]
struct Constraint {
    column: usize,
    max: f64,
    weight: f64,
}

#[derive(Debug, Clone, PartialEq)]
struct Plants {
    count: u64,
    fields: Vec<Change>,
    distributions: Vec<Distribution>,
    aggregate: Aggregate,
    validation: u64,
}

/// A tuning that has been checked.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct TuningPlan {
    pub seed: u64,
    pub variables: Vec<Variable>,
    pub goals: Vec<Goal>,
    /// Names of several objectives; empty where there is one.
    pub objectives: Vec<String>,
    constraints: Vec<Constraint>,
    plants: Option<Plants>,
    pub population: usize,
    pub evaluations: u64,
    pub restarts: u32,
    pub initial_step: f64,
}

/// Costs that no run which reaches its end has: of a number that is missing, of a run given up, of one refused.
const MISSING: f64 = 1e3;
const DIVERGED: f64 = 1e6;
const REFUSED: f64 = 3e6;

/// Candidates per generation of a search with several objectives.
const FRONT_POPULATION: usize = 40;

/// Which plants.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum PlantSet {
    Search,
    Validation,
}

impl TuningPlan {
    pub fn new(
        document: &TuningDocument,
        seed: u64,
        base: &Base,
        columns: &ResultColumns,
    ) -> Result<Self, ScenarioError> {
        let tree = &base.tree;
        check_count("/tuning/variables", document.variables.len(), EXPERIMENT_LIMITS.variables, "variables")?;
        let mut variables = Vec::new();
        for (n, variable) in document.variables.iter().enumerate() {
            variables.append(&mut self::variables(variable, &format!("/tuning/variables/{n}"), tree)?);
        }
        let plants = document.plants.as_ref().map(|plants| self::plants(plants, tree)).transpose()?;
        let mut fields: Vec<_> = variables.iter().map(|variable| variable.change.clone()).collect();
        check_fields(&fields, EXPERIMENT_LIMITS.variables, "/tuning/variables")?;
        fields.extend(plants.iter().flat_map(|plants| plants.fields.iter().cloned()));
        check_fields(&fields, 2 * EXPERIMENT_LIMITS.variables, "/tuning/plants/fields")?;

        let column =
            |name: &str, at: String| columns.place(name).ok_or_else(|| unknown(at, name, columns.names().join(", ")));
        let goals = goals(document, &column)?;
        let objectives: Vec<_> = document.objectives.iter().map(|objective| objective.name.clone()).collect();
        let mut constraints = Vec::new();
        for (n, constraint) in document.constraints.iter().enumerate() {
            let at = format!("/tuning/constraints/{n}");
            check_range(&format!("{at}/max"), constraint.max, [1e-12, 1e12], "")?;
            check_range(&format!("{at}/weight"), constraint.weight, [0.0, 1e6], "")?;
            let column = column(&constraint.metric, format!("{at}/metric"))?;
            constraints.push(Constraint { column, max: constraint.max, weight: constraint.weight });
        }
        let population = match document.population {
            Some(population) => {
                let [fewest, most] = EXPERIMENT_LIMITS.population.map(f64::from);
                check_range("/tuning/population", f64::from(population), [fewest, most], "candidates")?;
                population as usize
            }
            None if !objectives.is_empty() => FRONT_POPULATION,
            None => Cma::default_population(variables.len()),
        };
        check_range(
            "/tuning/restarts",
            f64::from(document.restarts),
            [0.0, if objectives.is_empty() { f64::from(EXPERIMENT_LIMITS.restarts) } else { 0.0 }],
            if objectives.is_empty() { "" } else { "with several objectives" },
        )?;
        check_range("/tuning/evaluations", f64::from(document.evaluations), [1.0, EXPERIMENT_LIMITS.runs as f64], "")?;
        check_range("/tuning/initial_step", document.initial_step, [1e-4, 1.0], "of the range")?;
        let (evaluations, restarts) = (u64::from(document.evaluations), document.restarts);
        let initial_step = document.initial_step;
        Ok(Self { seed, variables, goals, objectives, constraints, plants, population, evaluations, restarts, initial_step })
    }

    /// Plants of a set.
    pub fn plant_count(&self, set: PlantSet) -> u64 {
        match (&self.plants, set) {
            (None, PlantSet::Search) => 1,
            (None, PlantSet::Validation) => 0,
            (Some(plants), PlantSet::Search) => plants.count,
            (Some(plants), PlantSet::Validation) => plants.validation,
        }
    }

    /// More runs than this it never asks for.
    pub fn most_runs(&self) -> u64 {
        let candidates = 1 + self.evaluations + u64::from(EXPERIMENT_LIMITS.population[1]);
        candidates * self.plant_count(PlantSet::Search) + 2 * self.plant_count(PlantSet::Validation)
    }

    /// The values that a point of the cube stands for. Beyond the cube its walls are mirrors.
    pub fn values(&self, point: &[f64]) -> Vec<f64> {
        let value = |(variable, x): (&Variable, &f64)| {
            let turn = x - 2.0 * (0.5 * x).floor();
            variable.range.quantile(if turn > 1.0 { 2.0 - turn } else { turn })
        };
        self.variables.iter().zip(point).map(value).collect()
    }

    /// The scenario of a candidate on a plant.
    pub fn scenario(&self, base: &Base, values: &[f64], set: PlantSet, plant: u64) -> Result<Scenario, ScenarioError> {
        let mut tree = base.tree.clone();
        if let Some(plants) = &self.plants {
            let purpose = if set == PlantSet::Search { Purpose::Plant } else { Purpose::Validation };
            let mut stream = Stream::new(self.seed, purpose, plant);
            for (change, distribution) in plants.fields.iter().zip(&plants.distributions) {
                tree.apply(change, distribution.quantile(stream.unit()))?;
            }
            tree.set_seed(stream.seed());
        }
        for (variable, value) in self.variables.iter().zip(values) {
            tree.apply(&variable.change, *value)?;
        }
        bounded(tree.scenario()?, self.most_runs())
    }

    /// What one run costs, its goals in units of `scales`.
    fn cost(&self, row: &Row, scales: &[f64], duration_s: f64) -> f64 {
        match row.outcome {
            RowOutcome::Refused => return REFUSED,
            // The longer it lasted the better, so that the search finds out of where nothing works.
            RowOutcome::Diverged => return DIVERGED * (2.0 - row.at_s.unwrap_or(0.0) / duration_s),
            RowOutcome::Completed => {}
        }
        let mut cost = 0.0;
        for (goal, scale) in self.goals.iter().zip(scales) {
            cost += goal.of(row, *scale);
        }
        cost + self.excess(row)
    }

    /// Price of exceeded limits in a run that reached its end.
    fn excess(&self, row: &Row) -> f64 {
        let mut price = 0.0;
        for constraint in &self.constraints {
            let excess = row.metrics[constraint.column].map_or(MISSING, |metric| metric / constraint.max - 1.0);
            price += constraint.weight * excess.max(0.0);
        }
        price
    }

    /// Each of several objectives on all plants, whose rows these are, and the price of exceeded limits, of runs without an end too.
    pub fn front_values(&self, rows: &[Row], scales: &[f64], duration_s: f64) -> (Vec<f64>, f64) {
        let completed = |row: &&Row| row.outcome == RowOutcome::Completed;
        let over_plants = |values: Vec<f64>| match self.aggregate() {
            Aggregate::Mean => values.iter().sum::<f64>() / values.len().max(1) as f64,
            Aggregate::Worst => values.into_iter().fold(0.0, f64::max),
        };
        let price = |row: &Row| {
            let ends = row.outcome == RowOutcome::Completed;
            if ends { self.excess(row) } else { self.cost(row, scales, duration_s) }
        };
        let objective = |n: usize| {
            let of_run = |row: &Row| {
                let own = self.goals.iter().zip(scales).filter(|(goal, _)| goal.objective == n);
                own.map(|(goal, scale)| goal.of(row, *scale)).sum::<f64>()
            };
            over_plants(rows.iter().filter(completed).map(of_run).collect())
        };
        ((0..self.objectives.len()).map(objective).collect(), over_plants(rows.iter().map(price).collect()))
    }

    fn aggregate(&self) -> Aggregate {
        self.plants.as_ref().map_or(Aggregate::Mean, |plants| plants.aggregate)
    }

    /// What a candidate costs on all plants, whose rows these are.
    pub fn objective(&self, rows: &[Row], scales: &[f64], duration_s: f64) -> f64 {
        let costs = rows.iter().map(|row| self.cost(row, scales, duration_s));
        match self.aggregate() {
            Aggregate::Mean => costs.sum::<f64>() / rows.len() as f64,
            Aggregate::Worst => costs.fold(f64::NEG_INFINITY, f64::max),
        }
    }
}

impl Goal {
    /// `weight · metric / scale` of a run that reached its end.
    fn of(&self, row: &Row, scale: f64) -> f64 {
        self.weight * row.metrics[self.column].map_or(MISSING, |metric| metric / scale)
    }
}

/// The parts of one objective, or of several: `column` finds a metric's place.
fn goals(
    document: &TuningDocument,
    column: &impl Fn(&str, String) -> Result<usize, ScenarioError>,
) -> Result<Vec<Goal>, ScenarioError> {
    let (one, several) = (&document.objective, &document.objectives);
    if !one.is_empty() && !several.is_empty() {
        let message = "stands in the place of objective: give one of the two".to_owned();
        return Err(ScenarioError::new("/tuning/objectives", Problem::Conflict { message }));
    }
    if several.is_empty() {
        return goals_of(0, one, "objective", column);
    }
    check_range("/tuning/objectives", several.len() as f64, [2.0, 3.0], "objectives")?;
    let mut goals = Vec::new();
    for (n, objective) in several.iter().enumerate() {
        goals.append(&mut goals_of(n, &objective.terms, &format!("objectives/{n}/terms"), column)?);
    }
    Ok(goals)
}

fn goals_of(
    objective: usize,
    terms: &[GoalDocument],
    list: &str,
    column: &impl Fn(&str, String) -> Result<usize, ScenarioError>,
) -> Result<Vec<Goal>, ScenarioError> {
    check_count(&format!("/tuning/{list}"), terms.len(), EXPERIMENT_LIMITS.fields, "metrics")?;
    let goal = |(n, goal): (usize, &GoalDocument)| {
        let at = format!("/tuning/{list}/{n}");
        check_range(&format!("{at}/weight"), goal.weight, [0.0, 1e6], "")?;
        if let Some(scale) = goal.scale {
            check_range(&format!("{at}/scale"), scale, [1e-12, 1e12], "")?;
        }
        let column = column(&goal.metric, format!("{at}/metric"))?;
        Ok(Goal { objective, column, at, weight: goal.weight, scale: goal.scale })
    };
    terms.iter().enumerate().map(goal).collect()
}

fn variables(document: &VariableDocument, at: &str, tree: &Tree) -> Result<Vec<Variable>, ScenarioError> {
    let (min, max) = (document.min, document.max);
    let range = even(Some(min), Some(max), document.log, at)?;
    let pointer = format!("{at}/field");
    let variable = |change: Change| {
        let number = tree.number(&change.pointer, &pointer)?;
        let start = if document.relative { 1.0 } else { number };
        // The search begins at the base.
        check_range(&pointer, start, [min, max], "(the base's value; the search begins there)")?;
        let start_unit = if document.log {
            (logarithm(start) - logarithm(min)) / (logarithm(max) - logarithm(min))
        } else {
            (start - min) / (max - min)
        };
        Ok(Variable { change, range, start, start_unit })
    };
    changes(&document.field, document.relative, &pointer, &[tree])?.into_iter().map(variable).collect()
}

fn plants(document: &PlantsDocument, tree: &Tree) -> Result<Plants, ScenarioError> {
    let most = f64::from(EXPERIMENT_LIMITS.plants);
    check_range("/tuning/plants/count", f64::from(document.count), [1.0, most], "plants")?;
    check_range("/tuning/plants/validation", f64::from(document.validation), [0.0, 10.0 * most], "plants")?;
    let (fields, distributions) = random_fields(&document.fields, "/tuning/plants/fields", &[tree])?;
    Ok(Plants {
        count: u64::from(document.count),
        fields,
        distributions,
        aggregate: document.aggregate,
        validation: u64::from(document.validation),
    })
}
