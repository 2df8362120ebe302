//! How many integration steps an experiment takes in all its runs, counted before any of them is made.
//!
//! A run's steps follow from its step and its duration alone: whatever else varies is not looked at, and no scenario is made.
//! Adaptive methods may take more steps than these, as in any scenario.

use super::experiment::{Base, Work};
use super::fields::Change;
use super::layout::Layout;
use super::limits::{EXPERIMENT_LIMITS, conflict};
use super::objective::PlantSet;
use super::tuning::TuningPlan;
use crate::scenario::{LIMITS, ScenarioError, check_steps};
use crate::simulation::Settings;

const STEP: &str = "/integration/step_s";
const DURATION: &str = "/integration/duration_s";

/// The steps of several runs, and which of them has the most.
#[derive(Default)]
struct Count {
    total: u64,
    longest: Option<Longest>,
}

/// A run than which none has more steps.
struct Longest {
    steps: u64,
    settings: Settings,
    base: usize,
}

impl Count {
    fn add(&mut self, base: usize, settings: Settings, steps: u64, runs: u64) {
        self.total = self.total.saturating_add(steps.saturating_mul(runs));
        if self.longest.as_ref().is_none_or(|longest| longest.steps < steps) {
            self.longest = Some(Longest { steps, settings, base });
        }
    }
}

/// Integration steps of all runs, of a tuning or a replication at most; `section` is the experiment's kind.
pub(super) fn of_all_runs(work: &Work, bases: &[Base], runs: u64, section: &str) -> Result<u64, ScenarioError> {
    let mut count = Count::default();
    match work {
        Work::LaidOut(layout) => laid_out(layout, bases, &mut count),
        Work::Searched(plan) => searched(plan, &bases[0], &mut count),
        Work::Replicated(search) => {
            let all = bases.iter().map(|base| base.scenario.settings());
            if let Some((base, settings)) = all.enumerate().max_by_key(|(_, settings)| settings.steps()) {
                count.add(base, settings, settings.steps().max(search.steps), runs);
            }
        }
    }
    let Count { total, longest: Some(longest) } = count else { return Ok(0) };
    if total as f64 <= EXPERIMENT_LIMITS.steps {
        return Ok(total);
    }
    let Longest { steps, settings: Settings { step_s, duration_s, .. }, base } = longest;
    let own = bases[base].scenario.settings();
    let is_own = (step_s, duration_s, steps) == (own.step_s, own.duration_s, own.steps());
    let at = if is_own { format!("/bases/{base}/scenario/integration") } else { format!("/{section}") };
    let message = format!(
        "{total} steps in {runs} runs are more than the {:e} steps that are allowed; one run has up to {steps}, with \
         {STEP} {step_s} and {DURATION} {duration_s}",
        EXPERIMENT_LIMITS.steps
    );
    Err(conflict(at, message))
}

/// What changes leave of step and duration.
fn changed<'a>(mut settings: Settings, changes: impl IntoIterator<Item = (&'a Change, f64)>) -> Settings {
    for (change, value) in changes {
        match change.pointer.as_str() {
            STEP => settings.step_s = change.of(settings.step_s, value),
            DURATION => settings.duration_s = change.of(settings.duration_s, value),
            _ => {}
        }
    }
    settings
}

fn varies(change: &Change) -> bool {
    [STEP, DURATION].contains(&change.pointer.as_str())
}

/// Every run as it will be; one that will be refused takes no step.
fn laid_out(layout: &Layout, bases: &[Base], count: &mut Count) {
    let steps = |settings: Settings| match check_steps(settings.step_s, settings.duration_s) {
        Ok(()) => settings.steps(),
        Err(_) => 0,
    };
    let mut starts = Vec::new();
    for (n, base) in bases.iter().enumerate() {
        for condition in &layout.conditions {
            let changes = condition.changes.iter().map(|(change, value)| (change, *value));
            starts.push((n, changed(base.scenario.settings(), changes)));
        }
    }
    let varying: Vec<_> = layout.fields.iter().enumerate().filter(|(_, change)| varies(change)).collect();
    if varying.is_empty() {
        for (base, settings) in &starts {
            count.add(*base, *settings, steps(*settings), layout.points);
        }
        return;
    }
    for point in 0..layout.points {
        let place = layout.design.place(layout.seed, point);
        let values = varying.iter().map(|(n, change)| (*change, layout.design.value(*n, place[*n])));
        for (base, settings) in &starts {
            let settings = changed(*settings, values.clone());
            count.add(*base, settings, steps(settings), 1);
        }
    }
}

/// As if every candidate had the shortest step and the longest duration that it may have.
fn searched(plan: &TuningPlan, base: &Base, count: &mut Count) {
    let slowest = plan.variables.iter().map(|variable| {
        let [least, greatest] = variable.ends();
        (&variable.change, if variable.change.pointer == STEP { least } else { greatest })
    });
    for (set, candidates) in [(PlantSet::Search, plan.most_candidates()), (PlantSet::Validation, 2)] {
        for plant in 0..plan.plant_count(set) {
            let mut settings = changed(base.scenario.settings(), plan.plant(set, plant).0);
            settings = changed(settings, slowest.clone());
            // What is beyond a scenario's limits will be refused.
            settings.step_s = settings.step_s.max(LIMITS.step_s[0]);
            settings.duration_s = settings.duration_s.min(LIMITS.duration_s[1]);
            count.add(0, settings, settings.steps().min(LIMITS.steps as u64), candidates);
        }
    }
}
