//! A tuning under way: a value that says which runs come next and learns from their rows.
//!
//! Of one objective by CMA-ES (`cmaes`), of several by NSGA-II (`nsga2`). First the start on all plants, then generations of candidates with restarts of twice the population, in the end the start
//! and the best found on plants that the search never saw. Killed and taken up anywhere, it goes the same way.

pub(super) use super::objective::TuningPlan;

use super::cmaes::Cma;
use super::experiment::{Base, Experiment, PlannedRun, Work};
use super::limits::EXPERIMENT_LIMITS;
use super::nsga2::{Member, Nsga, hypervolume};
use super::objective::PlantSet;
use super::row::{Row, RowOutcome};
use super::statistics::{Share, Statistics};
use super::stream::{Purpose, Stream};
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// A search for the best values.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Tuning {
    experiment_hash: String,
    core_version: String,
    phase: Phase,
    restart: u32,
    candidates: u64,
    runs: u64,
    search: Search,
    scales: Vec<f64>,
    start: Option<Candidate>,
    best: Option<Candidate>,
    front_reference: Vec<f64>,
    history: Vec<Generation>,
    validation: Option<Validation>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
enum Phase {
    Start,
    Search,
    Validation,
    Done,
}

/// How candidates are found.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
enum Search {
    /// For the best.
    One(Cma),
    /// For a front.
    Front(Nsga),
}

impl Search {
    fn ask(&self, plan: &TuningPlan, stream: &mut Stream) -> Vec<Vec<f64>> {
        match self {
            Self::One(cma) => cma.ask(stream),
            Self::Front(nsga) => nsga.ask(plan.variables.len(), stream),
        }
    }

    fn is_sound(&self, plan: &TuningPlan) -> bool {
        let most = EXPERIMENT_LIMITS.population[1] as usize;
        match self {
            Self::One(cma) => plan.objectives.is_empty() && cma.is_sound(plan.variables.len()) && cma.population <= most,
            Self::Front(nsga) => {
                nsga.is_sound(plan.variables.len(), plan.objectives.len()) && nsga.population == plan.population
            }
        }
    }
}

/// Values with what they cost on the plants of the search.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Candidate {
    /// Values of the variables; factors where a variable is relative.
    pub values: Vec<f64>,
    /// The objective with the price of exceeded limits.
    pub objective: f64,
    /// Generation in which it was tried, from 1; 0 is the start.
    pub generation: u32,
}

/// A generation in short.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Generation {
    /// Restarts before it.
    pub restart: u32,
    /// Its candidates.
    pub population: u64,
    /// The smallest objective in it.
    pub best: f64,
    /// Size of the distribution that they came from, in ranges of the variables; 0 of a search for a front, which has none.
    pub sigma: f64,
    /// Hypervolume of the front after it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hypervolume: Option<f64>,
}

/// Candidates that keep all limits and of which none beats another in every objective.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Front {
    /// Names of the objectives.
    pub objectives: Vec<String>,
    /// Twice the start's objectives: up to there the hypervolume counts.
    pub reference: Vec<f64>,
    /// Volume of what the front beats within the reference.
    pub hypervolume: f64,
    /// By rising first objective.
    pub candidates: Vec<FrontCandidate>,
}

/// A candidate of a front.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FrontCandidate {
    /// Values of the variables; factors where a variable is relative.
    pub values: Vec<f64>,
    /// What it costs, objective by objective.
    pub objectives: Vec<f64>,
    /// Generation in which it was tried, from 1; 0 is the start.
    pub generation: u32,
}

/// The start and the best found on plants that the search never saw.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Validation {
    /// Objective of the start.
    pub start: f64,
    /// Objective of the best.
    pub best: f64,
    /// Plants on which the best costs less than the start.
    pub better: Share,
    /// Runs of the start that reached no end.
    pub start_failed: usize,
    /// Runs of the best that reached no end.
    pub best_failed: usize,
    /// Cost of the best minus that of the start, plant by plant, where both reached the end.
    pub difference: Option<Statistics>,
}

/// What a tuning found.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct TuningSummary {
    /// `adaptarm.tuning_summary/1`.
    pub format: String,
    /// Version of the core that computed it.
    pub core_version: String,
    /// Hash of the experiment.
    pub experiment_hash: String,
    /// For people.
    pub title: String,
    /// Whether the search has ended.
    pub finished: bool,
    /// Candidates tried, with the start.
    pub candidates: u64,
    /// Runs made.
    pub runs: u64,
    /// JSON pointers of the variables.
    pub variables: Vec<String>,
    /// What counts as one for each part of the objective.
    pub scales: Vec<f64>,
    /// The base's own values.
    pub start: Option<Candidate>,
    /// The best found; the start if nothing was better. Of several objectives by their sum.
    pub best: Option<Candidate>,
    /// Of several objectives.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub front: Option<Front>,
    /// Both on other plants.
    pub validation: Option<Validation>,
    /// Generation by generation.
    pub history: Vec<Generation>,
}

/// Why rows cannot be learnt from.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum TuningError {
    /// Not the rows of the runs that were asked for.
    #[error("these are not the rows of the {expected} runs that come next")]
    OtherRows {
        /// Runs asked for.
        expected: usize,
    },
    /// The start has no number that could count as one.
    #[error("the start reaches no end or lacks {metric} on every plant, or it is 0: give {goal}/scale")]
    NoScale {
        /// Metric of the goal.
        metric: String,
        /// JSON pointer to it.
        goal: String,
    },
}

impl Experiment {
    /// The tuning at its start; `None` of other kinds.
    pub fn tuning(&self) -> Option<Tuning> {
        let plan = plan(self)?;
        Some(Tuning {
            experiment_hash: self.hash(),
            core_version: crate::VERSION.to_owned(),
            phase: Phase::Start,
            restart: 0,
            candidates: 0,
            runs: 0,
            search: if plan.objectives.is_empty() {
                let start = plan.variables.iter().map(|it| it.start_unit).collect();
                Search::One(Cma::new(start, plan.initial_step, plan.population))
            } else {
                Search::Front(Nsga::new(plan.population))
            },
            scales: vec![1.0; plan.goals.len()],
            start: None,
            best: None,
            front_reference: Vec::new(),
            history: Vec::new(),
            validation: None,
        })
    }
}

fn plan(experiment: &Experiment) -> Option<&TuningPlan> {
    match &experiment.work {
        Work::Searched(plan) => Some(plan),
        Work::LaidOut(_) => None,
    }
}

impl Tuning {
    /// Whether this is a state of that experiment, computed by this version, and sound.
    pub fn belongs_to(&self, experiment: &Experiment) -> bool {
        let Some(plan) = plan(experiment) else { return false };
        let dimension = plan.variables.len();
        let fits = |candidate: &Option<Candidate>| match candidate {
            Some(candidate) => candidate.values.len() == dimension,
            None => self.phase == Phase::Start,
        };
        self.experiment_hash == experiment.hash()
            && self.core_version == crate::VERSION
            && self.search.is_sound(plan)
            && self.scales.len() == plan.goals.len()
            && (self.phase == Phase::Start || self.front_reference.len() == plan.objectives.len())
            && fits(&self.start)
            && fits(&self.best)
    }

    /// Whether nothing is left to do.
    pub fn is_done(&self) -> bool {
        self.phase == Phase::Done
    }

    /// Candidates tried and to be tried, unless the search settles earlier.
    pub fn progress(&self, experiment: &Experiment) -> (u64, u64) {
        let all = plan(experiment).map_or(0, |plan| 1 + plan.evaluations).max(self.candidates);
        (if self.is_done() { all } else { self.candidates }, all)
    }

    /// The candidates of this step with their plants.
    fn candidates(&self, plan: &TuningPlan) -> (Vec<Vec<f64>>, PlantSet) {
        let values = |candidate: &Option<Candidate>| candidate.iter().map(|it| it.values.clone()).collect::<Vec<_>>();
        match self.phase {
            Phase::Start => (vec![plan.variables.iter().map(|it| it.start).collect()], PlantSet::Search),
            Phase::Search => {
                let points = self.search.ask(plan, &mut self.stream(plan));
                (points.iter().map(|point| plan.values(point)).collect(), PlantSet::Search)
            }
            Phase::Validation => ([values(&self.start), values(&self.best)].concat(), PlantSet::Validation),
            Phase::Done => (Vec::new(), PlantSet::Search),
        }
    }

    fn stream(&self, plan: &TuningPlan) -> Stream {
        Stream::new(plan.seed, Purpose::Generation, self.history.len() as u64)
    }

    /// The runs that come next, numbered from 0; none once it is done.
    pub fn plan(&self, experiment: &Experiment) -> Vec<PlannedRun> {
        let Some(plan) = plan(experiment) else { return Vec::new() };
        let base: &Base = &experiment.bases[0];
        let (candidates, set) = self.candidates(plan);
        let mut runs = Vec::new();
        for values in &candidates {
            for plant in 0..plan.plant_count(set) {
                let scenario = plan.scenario(base, values, set, plant);
                runs.push(PlannedRun { index: runs.len() as u64, scenario });
            }
        }
        runs
    }

    /// Learns from the rows of all runs of this step, in any order.
    pub fn tell(&mut self, experiment: &Experiment, mut rows: Vec<Row>) -> Result<(), TuningError> {
        let Some(plan) = plan(experiment) else { return Err(TuningError::OtherRows { expected: 0 }) };
        let (candidates, set) = self.candidates(plan);
        let plants = plan.plant_count(set) as usize;
        let expected = candidates.len() * plants;
        rows.sort_by_key(|row| row.index);
        let columns = experiment.columns().names();
        let belongs = |(n, row): (usize, &Row)| row.index == n as u64 && row.metrics.len() == columns.len();
        if rows.len() != expected || expected == 0 || !rows.iter().enumerate().all(belongs) {
            return Err(TuningError::OtherRows { expected });
        }
        let duration_s = experiment.bases[0].scenario.settings().duration_s;
        if self.phase == Phase::Start {
            self.scales = scales(plan, &rows, columns)?;
        }
        self.runs += expected as u64;
        let objectives: Vec<_> =
            rows.chunks(plants).map(|rows| plan.objective(rows, &self.scales, duration_s)).collect();
        match self.phase {
            Phase::Start => {
                let start = Candidate { values: candidates.concat(), objective: objectives[0], generation: 0 };
                (self.start, self.best) = (Some(start.clone()), Some(start));
                let points = vec![plan.variables.iter().map(|it| it.start_unit.clamp(0.0, 1.0)).collect()];
                self.take_in(plan, points, &rows, duration_s, 0);
                let values = plan.front_values(&rows, &self.scales, duration_s).0;
                self.front_reference = values.iter().map(|value| 2.0 * value).collect();
                self.candidates += 1;
                self.phase = Phase::Search;
            }
            Phase::Search => self.learn(plan, &candidates, &objectives, &rows, duration_s),
            Phase::Validation => {
                self.validation = Some(self.validate(experiment, plan, &rows, duration_s));
                self.phase = Phase::Done;
            }
            Phase::Done => {}
        }
        Ok(())
    }

    /// Gives a search for a front its members; nothing to another.
    fn take_in(&mut self, plan: &TuningPlan, points: Vec<Vec<f64>>, rows: &[Row], duration_s: f64, generation: u32) {
        let Search::Front(nsga) = &mut self.search else { return };
        let plants = rows.len() / points.len().max(1);
        let member = |(point, rows): (Vec<f64>, &[Row])| {
            let (objectives, violation) = plan.front_values(rows, &self.scales, duration_s);
            Member { point, objectives, violation, generation }
        };
        nsga.tell(points.into_iter().zip(rows.chunks(plants.max(1))).map(member).collect());
    }

    fn learn(
        &mut self,
        plan: &TuningPlan,
        candidates: &[Vec<f64>],
        objectives: &[f64],
        rows: &[Row],
        duration_s: f64,
    ) {
        let points = self.search.ask(plan, &mut self.stream(plan));
        let least = objectives.iter().copied().fold(f64::INFINITY, f64::min);
        let sigma = if let Search::One(cma) = &self.search { cma.sigma } else { 0.0 };
        let population = objectives.len() as u64;
        self.history.push(Generation { restart: self.restart, population, best: least, sigma, hypervolume: None });
        self.candidates += population;
        for (values, objective) in candidates.iter().zip(objectives) {
            if self.best.as_ref().is_none_or(|best| *objective < best.objective) {
                let generation = self.history.len() as u32;
                self.best = Some(Candidate { values: values.clone(), objective: *objective, generation });
            }
        }
        let spent = self.candidates > plan.evaluations;
        let settled = if let Search::One(cma) = &mut self.search {
            cma.tell(&points, objectives);
            cma.has_settled() || !cma.is_sound(plan.variables.len())
        } else {
            self.take_in(plan, points, rows, duration_s, self.history.len() as u32);
            let hypervolume = self.front(plan).map(|front| front.hypervolume);
            if let Some(generation) = self.history.last_mut() {
                generation.hypervolume = hypervolume;
            }
            false
        };
        if !spent && settled && self.restart < plan.restarts {
            self.restart += 1;
            let mut stream = Stream::new(plan.seed, Purpose::Restart, u64::from(self.restart));
            let most = EXPERIMENT_LIMITS.population[1] as usize;
            let population = plan.population.saturating_mul(1 << self.restart.min(8)).min(most);
            let mean = plan.variables.iter().map(|_| stream.unit()).collect();
            self.search = Search::One(Cma::new(mean, plan.initial_step, population));
        } else if spent || settled {
            let validates = plan.plant_count(PlantSet::Validation) > 0;
            self.phase = if validates { Phase::Validation } else { Phase::Done };
        }
    }

    fn validate(&self, experiment: &Experiment, plan: &TuningPlan, rows: &[Row], duration_s: f64) -> Validation {
        let (start, best) = rows.split_at(rows.len() / 2);
        let cost = |row: &Row| plan.objective(std::slice::from_ref(row), &self.scales, duration_s);
        let failed = |rows: &[Row]| rows.iter().filter(|row| row.outcome != RowOutcome::Completed).count();
        let pairs = || start.iter().zip(best);
        let completed = |row: &Row| row.outcome == RowOutcome::Completed;
        let differences: Vec<_> = pairs()
            .filter(|(start, best)| completed(start) && completed(best))
            .map(|(start, best)| cost(best) - cost(start))
            .collect();
        let confidence = experiment.document.confidence;
        let better = pairs().filter(|(start, best)| cost(best) < cost(start)).count();
        Validation {
            start: plan.objective(start, &self.scales, duration_s),
            best: plan.objective(best, &self.scales, duration_s),
            better: Share::new(better, start.len(), confidence),
            start_failed: failed(start),
            best_failed: failed(best),
            difference: Statistics::of(&differences, confidence),
        }
    }

    /// The front so far; `None` of a single objective.
    fn front(&self, plan: &TuningPlan) -> Option<Front> {
        let Search::Front(nsga) = &self.search else { return None };
        let members = nsga.front();
        let reference = self.front_reference.clone();
        let points: Vec<_> = members.iter().map(|member| member.objectives.as_slice()).collect();
        Some(Front {
            objectives: plan.objectives.clone(),
            hypervolume: hypervolume(&points, &reference),
            reference,
            candidates: members
                .into_iter()
                .map(|member| FrontCandidate {
                    values: plan.values(&member.point),
                    objectives: member.objectives.clone(),
                    generation: member.generation,
                })
                .collect(),
        })
    }

    /// What it has found so far.
    pub fn summary(&self, experiment: &Experiment) -> TuningSummary {
        let variables = plan(experiment).map_or(&[][..], |plan| &plan.variables);
        TuningSummary {
            format: "adaptarm.tuning_summary/1".to_owned(),
            core_version: crate::VERSION.to_owned(),
            experiment_hash: self.experiment_hash.clone(),
            title: experiment.document.title.clone(),
            finished: self.is_done(),
            candidates: self.candidates,
            runs: self.runs,
            variables: variables.iter().map(|variable| variable.change.pointer.clone()).collect(),
            scales: self.scales.clone(),
            start: self.start.clone(),
            best: self.best.clone(),
            front: plan(experiment).and_then(|plan| self.front(plan)),
            validation: self.validation.clone(),
            history: self.history.clone(),
        }
    }

    /// The base scenario with the best values found.
    pub fn best_scenario(&self, experiment: &Experiment) -> Option<crate::scenario::Scenario> {
        let (plan, best) = (plan(experiment)?, self.best.as_ref()?);
        let mut tree = experiment.bases[0].tree.clone();
        for (variable, value) in plan.variables.iter().zip(&best.values) {
            tree.apply(&variable.change, *value).ok()?;
        }
        tree.scenario().ok()
    }
}

/// What counts as one: as written, or the start's mean over the plants on which it reaches the end.
fn scales(plan: &TuningPlan, rows: &[Row], columns: &[String]) -> Result<Vec<f64>, TuningError> {
    let scale = |goal: &super::objective::Goal| {
        if let Some(scale) = goal.scale {
            return Ok(scale);
        }
        let numbers: Vec<_> = rows.iter().filter_map(|row| row.metrics[goal.column]).collect();
        let mean = numbers.iter().sum::<f64>() / numbers.len() as f64;
        // Written so that nothing, which is no number, fails.
        let missing = || TuningError::NoScale { metric: columns[goal.column].clone(), goal: goal.at.clone() };
        if mean > 0.0 { Ok(mean) } else { Err(missing()) }
    };
    plan.goals.iter().map(scale).collect()
}
