//! Scenarios that differ in numbers only, run side by side in the lanes of the machine's vector instructions.
//!
//! Each gets the bits that it has alone; what cannot share lanes runs by itself.

use super::{Run, Scenario, beyond, build, build_trajectory};
use crate::lanes::{self, WithLanes};
use crate::robots::for_robot;
use crate::scalar::Scalar;
use crate::simulation::{Lanes, Lockstep};
use std::mem::discriminant;
use std::ops::ControlFlow;

/// Scenarios under way side by side.
pub struct SideBySide<'a> {
    scenarios: Vec<&'a Scenario>,
    lockstep: Box<dyn Lockstep>,
}

/// Builds the closed loop for a kind of lanes.
struct Start<'a, 'b>(&'b [&'a Scenario]);

impl WithLanes for Start<'_, '_> {
    type Output = Option<Box<dyn Lockstep>>;

    fn with<T: Scalar>(self) -> Self::Output {
        let documents: Vec<_> = self.0.iter().map(|scenario| &scenario.document).collect();
        let identities = self.0.iter().map(|scenario| scenario.hash()).collect();
        let robot = self.0[0].robot;
        let system = for_robot!(robot, R, N, P => build::closed_loop::<R, T, N, P>(&documents));
        Some(Box::new(Lanes::new(identities, system, self.0[0].settings())?))
    }
}

impl Scenario {
    /// Whether both can be lanes of one simulation: they take the same steps and samples, differ in numbers only, and say
    /// nothing beyond the paper.
    pub fn runs_beside(&self, other: &Self) -> bool {
        let (a, b) = (&self.document, &other.document);
        let (settings, others) = (self.settings(), other.settings());
        !beyond::is_beyond(a)
            && !beyond::is_beyond(b)
            && self.robot.id == other.robot.id
            && self.scheme() == other.scheme()
            && settings == others
            && settings.steps_per_sample().is_some()
            && a.initial.velocity == b.initial.velocity
            && discriminant(&build::friction_sign::<f64>(&[a])) == discriminant(&build::friction_sign::<f64>(&[b]))
            && build_trajectory::run_beside(self.robot, a, b)
    }
}

impl<'a> SideBySide<'a> {
    /// Starts scenarios in `width` lanes; `None` where the machine has no such lanes, there are more scenarios than lanes, or
    /// they cannot run beside each other.
    pub fn start(scenarios: &[&'a Scenario], width: usize) -> Option<Self> {
        let first = scenarios.first()?;
        // The first beside itself, too: alone in a lane it would still be built for lanes.
        if scenarios.len() > width || !scenarios.iter().all(|scenario| first.runs_beside(scenario)) {
            return None;
        }
        let lockstep = lanes::with_lanes(width, Start(scenarios)).flatten()?;
        Some(Self { scenarios: scenarios.to_vec(), lockstep })
    }

    /// Takes at most `max_steps` steps with each; true once all have ended.
    pub fn advance(&mut self, max_steps: u64) -> bool {
        self.lockstep.advance(max_steps)
    }

    /// Steps taken with each that has not diverged.
    pub fn step(&self) -> u64 {
        self.lockstep.step()
    }

    /// The reports on all, with their recordings, in the order of the scenarios.
    pub fn finish(self) -> Vec<Run> {
        let finish = |(scenario, snapshot): (&Scenario, _)| match scenario.resume(snapshot) {
            Ok(simulation) => scenario.finish(simulation),
            Err(error) => unreachable!("a lane leaves a snapshot of its own scenario: {error}"),
        };
        self.scenarios.into_iter().zip(self.lockstep.snapshots()).map(finish).collect()
    }
}

/// Runs every scenario to its end, as many side by side as the machine has lanes, and hands each run over with the index of
/// its scenario as soon as its group has ended; breaks off where `each` says so.
pub fn run_each(scenarios: &[Scenario], mut each: impl FnMut(usize, Run) -> ControlFlow<()>) -> ControlFlow<()> {
    let most = lanes::widths()[0];
    for group in groups(scenarios, most) {
        let members: Vec<_> = group.iter().map(|&n| &scenarios[n]).collect();
        let fitting = lanes::widths().iter().copied().filter(|&width| width >= members.len()).min();
        let lanes = fitting.filter(|&width| width > 1).and_then(|width| SideBySide::start(&members, width));
        let runs = match lanes {
            Some(mut lanes) => {
                lanes.advance(u64::MAX);
                lanes.finish()
            }
            None => members.into_iter().map(Scenario::run).collect(),
        };
        for (n, run) in group.into_iter().zip(runs) {
            each(n, run)?;
        }
    }
    ControlFlow::Continue(())
}

/// Indices of scenarios that run beside each other, at most `most` together, in the order of their first members.
fn groups(scenarios: &[Scenario], most: usize) -> Vec<Vec<usize>> {
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
