//! Cutting a job into shards of about a second of computing each.

use adaptarm_core::scenario::{Scenario, Scheme};

/// Computing time that a shard aims at, µs. A scenario is never cut: a long one is a shard of its own that checkpoints.
pub const SHARD_TARGET_US: f64 = 1e6;

/// What a scenario costs beside its steps: writing down and storing its samples, µs.
const SCENARIO_COST_US: f64 = 5_000.0;

/// Consecutive scenarios that are computed one after another.
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
    fn what_has_a_result_is_in_no_shard_of_its_own() {
        assert_eq!(plan([None, None]), []);
        // Between two others it may lie within a shard, which passes over it.
        assert_eq!(plan([None, Some(1.0), None, Some(1.0), None]), [Shard { first: 1, count: 3 }]);
    }
}
