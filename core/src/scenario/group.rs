//! Scenarios on the way to their end together: in lanes where they can, otherwise one after another; paused and resumed like
//! one of them. Each gets the bits that it has alone.

use super::{Run, Scenario, SideBySide};
use crate::lanes;
use crate::simulation::{Simulation, Snapshot, SnapshotError};
use std::ops::ControlFlow;

/// Scenarios on the way to their end together.
pub struct Group<'a> {
    way: Way<'a>,
}

enum Way<'a> {
    Lanes(SideBySide<'a>),
    Alone(Vec<(&'a Scenario, Simulation)>),
}

impl<'a> Group<'a> {
    /// Starts scenarios: in lanes if they can run beside each other and the machine has enough.
    pub fn start(members: &[&'a Scenario]) -> Self {
        let lanes = fitting_width(members.len()).and_then(|width| SideBySide::start(members, width));
        let way = lanes.map_or_else(
            || Way::Alone(members.iter().map(|scenario| (*scenario, scenario.start())).collect()),
            Way::Lanes,
        );
        Self { way }
    }

    /// Goes on where each scenario's snapshot left it.
    pub fn resume(members: &[&'a Scenario], snapshots: &[Snapshot]) -> Result<Self, SnapshotError> {
        let in_lanes = |width| SideBySide::resume(members, width, snapshots.to_vec());
        if let Some(lanes) = fitting_width(members.len()).and_then(in_lanes) {
            return Ok(Self { way: Way::Lanes(lanes) });
        }
        let resume =
            |(scenario, snapshot): (&&'a Scenario, &Snapshot)| Ok((*scenario, scenario.resume(snapshot.clone())?));
        Ok(Self { way: Way::Alone(members.iter().zip(snapshots).map(resume).collect::<Result<_, _>>()?) })
    }

    /// Takes at most `max_steps` steps with each that can go on; true once all have ended.
    pub fn advance(&mut self, max_steps: u64) -> bool {
        match &mut self.way {
            Way::Lanes(lanes) => lanes.advance(max_steps),
            Way::Alone(simulations) => {
                // One after another: what is done is out of the way early.
                let next = simulations.iter_mut().find(|(_, simulation)| simulation.outcome().is_none());
                if let Some((_, simulation)) = next {
                    simulation.advance(max_steps);
                }
                simulations.iter().all(|(_, simulation)| simulation.outcome().is_some())
            }
        }
    }

    /// Steps taken with all of them together.
    pub fn steps(&self) -> u64 {
        match &self.way {
            Way::Lanes(lanes) => lanes.steps_of_all(),
            Way::Alone(simulations) => simulations.iter().map(|(_, simulation)| simulation.steps()).sum(),
        }
    }

    /// Where each is, in the order of the scenarios.
    pub fn snapshots(self) -> Vec<Snapshot> {
        match self.way {
            Way::Lanes(lanes) => lanes.snapshots(),
            Way::Alone(simulations) => simulations.iter().map(|(_, simulation)| simulation.snapshot()).collect(),
        }
    }

    /// The reports on all, with their recordings, in the order of the scenarios. Those that have not ended are reported as far
    /// as they came.
    pub fn finish(self) -> Vec<Run> {
        match self.way {
            Way::Lanes(lanes) => lanes.finish(),
            Way::Alone(simulations) => {
                simulations.into_iter().map(|(scenario, simulation)| scenario.finish(simulation)).collect()
            }
        }
    }
}

/// The narrowest lanes that hold so many, if the machine has any; one runs alone.
fn fitting_width(count: usize) -> Option<usize> {
    lanes::widths().iter().copied().filter(|&width| width >= count).min().filter(|&width| width > 1)
}

/// Runs every scenario to its end, as many side by side as the machine has lanes, and hands each run over with the index of
/// its scenario as soon as its group has ended; breaks off where `each` says so.
pub fn run_each(scenarios: &[Scenario], mut each: impl FnMut(usize, Run) -> ControlFlow<()>) -> ControlFlow<()> {
    for members in groups(scenarios, lanes::widths()[0]) {
        let mut group = Group::start(&members.iter().map(|&n| &scenarios[n]).collect::<Vec<_>>());
        while !group.advance(u64::MAX) {}
        for (n, run) in members.into_iter().zip(group.finish()) {
            each(n, run)?;
        }
    }
    ControlFlow::Continue(())
}

/// Indices of scenarios that run beside each other, at most `most` together, in the order of their first members.
pub fn groups(scenarios: &[Scenario], most: usize) -> Vec<Vec<usize>> {
    let mut groups: Vec<Vec<usize>> = Vec::new();
    // Of each kind, the group that still has room.
    let mut open: Vec<usize> = Vec::new();
    for (n, scenario) in scenarios.iter().enumerate() {
        match open.iter().position(|&group| scenarios[groups[group][0]].runs_beside(scenario)) {
            Some(kind) if groups[open[kind]].len() < most => groups[open[kind]].push(n),
            kind => {
                groups.push(vec![n]);
                match kind {
                    Some(kind) => open[kind] = groups.len() - 1,
                    None => open.push(groups.len() - 1),
                }
            }
        }
    }
    groups
}
