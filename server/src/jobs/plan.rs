//! Cutting a job into shards of about a second of computing each.

use adaptarm_core::scenario::{Scenario, Scheme};

/// Computing time that a shard aims at, µs. A scenario is never cut: a long one is a shard of its own that checkpoints.
pub const SHARD_TARGET_US: f64 = 1e6;

/// What a scenario costs beside its steps: writing down and storing its samples, µs.
const SCENARIO_COST_US: f64 = 5_000.0;

/// Lanes of the widest vector instructions, on whatever machine.
const WIDEST: u64 = 8;

/// Consecutive scenarios, or runs of an experiment, that are computed one after another.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shard {
    /// Number of the first scenario.
    pub first: usize,
    /// How many.
    pub count: usize,
}

/// Computing time of one integration step, µs, on an ordinary core (`cargo xtask bench` measures it). Only the size of
/// shards depends on it.
pub fn step_cost_us(scheme: Scheme) -> f64 {
    match scheme {
        Scheme::Proposed => 1.75,
        Scheme::TangArteaga => 1.55,
        Scheme::SlotineLi => 0.65,
        Scheme::Pd | Scheme::PdGravity | Scheme::ComputedTorque => 0.5,
    }
}

/// Expected computing time of a scenario, µs.
pub fn cost_us(scenario: &Scenario) -> f64 {
    scenario.settings().steps() as f64 * step_cost_us(scenario.scheme())
}

/// Shards over scenarios of these costs, µs; `None` where there is a result already.
pub fn plan(costs: impl IntoIterator<Item = Option<f64>>) -> Vec<Shard> {
    let mut shards: Vec<Shard> = Vec::new();
    let mut filled = f64::INFINITY;
    for (n, cost) in costs.into_iter().enumerate() {
        let Some(cost) = cost else { continue };
        let cost = cost + SCENARIO_COST_US;
        match shards.last_mut() {
            Some(shard) if filled + cost <= SHARD_TARGET_US => {
                filled += cost;
                shard.count = n - shard.first + 1;
            }
            _ => {
                filled = cost;
                shards.push(Shard { first: n, count: 1 });
            }
        }
    }
    shards
}

/// Most computing time of a shard that fills the lanes of vector instructions, µs.
const FULL_LANES_US: f64 = 30e6;

/// Fewest parts that runs are cut into where each may be computed on its own thread.
const PARTS: u64 = 4;

/// Shards over runs of an experiment, `cost_us` each, whose neighbours are of `bases` kinds that do not run beside each other:
/// full lanes of each kind where that does not take long.
pub fn plan_runs(runs: u64, bases: u64, cost_us: f64) -> Vec<Shard> {
    let full = WIDEST * bases.max(1);
    let fitting = (SHARD_TARGET_US / cost_us.max(1.0)) as u64;
    let wanted = if fitting >= full {
        fitting - fitting % full
    } else if full as f64 * cost_us <= FULL_LANES_US {
        full
    } else {
        fitting
    };
    // Two workers should both have something to do.
    let at_once = wanted.min(runs.div_ceil(PARTS)).max(1);
    let shard = |n: u64| Shard { first: (n * at_once) as usize, count: at_once.min(runs - n * at_once) as usize };
    (0..runs.div_ceil(at_once)).map(shard).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_scenarios_share_a_shard_and_a_long_one_has_its_own() {
        let cost = 0.3e6;
        let shards = plan([cost, cost, cost, cost, 50e6, cost].map(Some));
        let expected = [(0, 3), (3, 1), (4, 1), (5, 1)].map(|(first, count)| Shard { first, count });
        assert_eq!(shards, expected);
    }

    #[test]
    fn runs_fill_lanes_and_are_all_there() {
        for (runs, bases, cost_us) in [(1, 1, 1.0), (7, 3, 1e4), (10_000, 1, 21e3), (10_000, 3, 21e3), (9, 2, 1e9)] {
            let shards = plan_runs(runs, bases, cost_us);
            let mut next = 0;
            for shard in &shards {
                assert!(shard.first == next && shard.count > 0, "{runs} {bases} {cost_us}");
                next += shard.count;
            }
            assert_eq!(next as u64, runs);
        }
        assert_eq!(plan_runs(10_000, 1, 21e3)[0].count, 40);
        assert_eq!(plan_runs(10_000, 3, 21e3)[0].count, 24);
        assert_eq!(plan_runs(3, 1, 1e9)[0].count, 1);
    }

    #[test]
    fn what_has_a_result_is_in_no_shard_of_its_own() {
        assert_eq!(plan([None, None]), []);
        // Between two others it may lie within a shard, which passes over it.
        assert_eq!(plan([None, Some(1.0), None, Some(1.0), None]), [Shard { first: 1, count: 3 }]);
    }
}
