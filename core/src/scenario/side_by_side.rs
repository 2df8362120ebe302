//! Scenarios that differ in numbers only, run side by side in the lanes of the machine's vector instructions.
//!
//! Each gets the bits that it has alone; what cannot share lanes runs by itself.

use super::{Run, Scenario, beyond, build, build_trajectory};
use crate::lanes::{self, WithLanes};
use crate::robots::for_robot;
use crate::scalar::Scalar;
use crate::simulation::{Lanes, Lockstep, Snapshot};
use std::mem::discriminant;

/// Scenarios under way side by side.
pub struct SideBySide<'a> {
    scenarios: Vec<&'a Scenario>,
    lockstep: Box<dyn Lockstep>,
}

/// Builds the closed loop for a kind of lanes, at its start or where snapshots left it.
struct Start<'a, 'b>(&'b [&'a Scenario], Option<Vec<Snapshot>>);

impl WithLanes for Start<'_, '_> {
    type Output = Option<Box<dyn Lockstep>>;

    fn with<T: Scalar>(self) -> Self::Output {
        let documents: Vec<_> = self.0.iter().map(|scenario| &scenario.document).collect();
        let identities = self.0.iter().map(|scenario| scenario.hash()).collect();
        let robot = self.0[0].robot;
        let system = for_robot!(robot, R, N, P => build::closed_loop::<R, T, N, P>(&documents));
        let settings = self.0[0].settings();
        Some(match self.1 {
            None => Box::new(Lanes::new(identities, system, settings)?),
            Some(snapshots) => Box::new(Lanes::resume(system, settings, snapshots)?),
        })
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
        Self::build(scenarios, width, None)
    }

    /// Goes on where these snapshots left their scenarios; `None` also where they are not snapshots of these or stand at
    /// different steps.
    pub fn resume(scenarios: &[&'a Scenario], width: usize, snapshots: Vec<Snapshot>) -> Option<Self> {
        let fits = |(scenario, snapshot): (&&Scenario, &Snapshot)| scenario.resume(snapshot.clone()).is_ok();
        if snapshots.len() != scenarios.len() || !scenarios.iter().zip(&snapshots).all(fits) {
            return None;
        }
        Self::build(scenarios, width, Some(snapshots))
    }

    fn build(scenarios: &[&'a Scenario], width: usize, snapshots: Option<Vec<Snapshot>>) -> Option<Self> {
        let first = scenarios.first()?;
        // The first beside itself, too: alone in a lane it would still be built for lanes.
        if scenarios.len() > width || !scenarios.iter().all(|scenario| first.runs_beside(scenario)) {
            return None;
        }
        let lockstep = lanes::with_lanes(width, Start(scenarios, snapshots)).flatten()?;
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

    /// Steps taken with all of them together.
    pub fn steps_of_all(&self) -> u64 {
        self.lockstep.steps_of_all()
    }

    /// Where each is, to go on from another time, in lanes or alone.
    pub fn snapshots(self) -> Vec<Snapshot> {
        self.lockstep.snapshots()
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
