//! Where the arm is at an instant of a run, where it should be, and the ways that its tip takes.
//!
//! Between samples the joint angles are interpolated along straight lines: it is only a picture. `q_d = q − e`. Errors may be
//! drawn larger than they are: the arm is then at `q_d + k e`, and the desired arm stays where it belongs.

use crate::runs::{Runs, ShownRun};
use adaptarm_core::recording::Signal;
use adaptarm_core::robots::{ArmPoints, Kinematics, distance_m};
use wasm_bindgen::prelude::wasm_bindgen;

/// An arm and where it should be.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Pose {
    /// Joint angles as drawn, rad.
    pub q: Vec<f64>,
    /// Desired joint angles, rad.
    pub q_d: Vec<f64>,
    /// Points as drawn, m.
    pub actual: ArmPoints,
    /// Desired points, m.
    pub desired: ArmPoints,
}

/// A run read as motion; `None` for a run without samples.
pub(crate) struct Motion<'a> {
    pub kinematics: Kinematics,
    rows: &'a [f64],
    joints: usize,
    width: usize,
    error: usize,
    position: usize,
}

impl<'a> Motion<'a> {
    pub fn new(run: &'a ShownRun) -> Option<Self> {
        let columns = run.recording.columns();
        let kinematics = Kinematics::new(run.scenario.robot());
        (!run.recording.is_empty()).then(|| Self {
            kinematics,
            rows: run.recording.rows(),
            joints: columns.joints,
            width: columns.width(),
            error: columns.start(Signal::Error),
            position: columns.start(Signal::Position),
        })
    }

    /// Number of samples.
    pub fn len(&self) -> usize {
        self.rows.len() / self.width
    }

    /// Time of a sample, s.
    pub fn time_s(&self, sample: usize) -> f64 {
        self.rows[sample * self.width]
    }

    /// The arm at a sample, with errors `exaggeration` times as large.
    pub fn at_sample(&self, sample: usize, exaggeration: f64) -> Pose {
        self.between(sample, sample, 0.0, exaggeration)
    }

    /// The arm at an instant; before the first sample and after the last it stands still.
    pub fn at(&self, time_s: f64, exaggeration: f64) -> Pose {
        let last = self.len() - 1;
        let (mut low, mut high) = (0, last);
        while low < high {
            let middle = (low + high).div_ceil(2);
            if self.time_s(middle) <= time_s { low = middle } else { high = middle - 1 }
        }
        let next = (low + 1).min(last);
        let (from, to) = (self.time_s(low), self.time_s(next));
        let share = if to > from { ((time_s - from) / (to - from)).clamp(0.0, 1.0) } else { 0.0 };
        self.between(low, next, share, exaggeration)
    }

    fn between(&self, low: usize, high: usize, share: f64, exaggeration: f64) -> Pose {
        let mix = |column: usize| {
            let value = |sample: usize| self.rows[sample * self.width + column];
            value(low) + share * (value(high) - value(low))
        };
        let e: Vec<_> = (0..self.joints).map(|joint| mix(self.error + joint)).collect();
        let q_d: Vec<_> = (0..self.joints).map(|joint| mix(self.position + joint) - e[joint]).collect();
        let q: Vec<_> = (0..self.joints).map(|joint| q_d[joint] + exaggeration * e[joint]).collect();
        Pose { actual: self.kinematics.points(&q), desired: self.kinematics.points(&q_d), q, q_d }
    }

    /// Samples to draw a path of at most `most` points with: every n-th and the last.
    pub fn path_samples(&self, most: usize) -> impl Iterator<Item = usize> {
        let last = self.len() - 1;
        let stride = last.div_ceil(most.max(2) - 1).max(1);
        (0..last).step_by(stride).chain(std::iter::once(last))
    }
}

/// The arm of the run called `id` at an instant: base, shoulder, elbow, wrist and tip as drawn, the same where they should be
/// (30 coordinates, m), the true distance between the tips (m), and 1 if a joint is beyond the maker's limits, else 0.
/// Nothing where there is no such run.
#[wasm_bindgen]
pub fn arm_pose(runs: &Runs, id: &str, time_s: f64, exaggeration: f64) -> Option<Vec<f64>> {
    let motion = Motion::new(runs.get(id)?)?;
    let (drawn, real) = (motion.at(time_s, exaggeration), motion.at(time_s, 1.0));
    let mut numbers: Vec<f64> = drawn.actual.all().into_iter().chain(drawn.desired.all()).flatten().collect();
    numbers.push(distance_m(real.actual.tip, real.desired.tip));
    numbers.push(f64::from(motion.kinematics.beyond_limits(&real.q).next().is_some()));
    Some(numbers)
}

/// The tip's way over the run called `id` with at most `most` points: time (s), tip as drawn, desired tip (m), again and again.
/// Nothing where there is no such run.
#[wasm_bindgen]
pub fn arm_paths(runs: &Runs, id: &str, most: usize, exaggeration: f64) -> Option<Vec<f64>> {
    let motion = Motion::new(runs.get(id)?)?;
    let mut numbers = Vec::with_capacity(7 * most);
    for sample in motion.path_samples(most) {
        let pose = motion.at_sample(sample, exaggeration);
        numbers.push(motion.time_s(sample));
        numbers.extend(pose.actual.tip);
        numbers.extend(pose.desired.tip);
    }
    Some(numbers)
}

#[cfg(test)]
mod tests {
    use super::*;
    use adaptarm_core::recording::{Columns, Recording};
    use adaptarm_core::scenario::Scenario;
    use std::f64::consts::FRAC_PI_2;

    /// Samples at 0, 1 and 2 s: the waist turns a rad a second and is 0.1 rad ahead of where it should be.
    fn run() -> ShownRun {
        let json = r#"{"format":"adaptarm.scenario/1","scheme":{"kind":"slotine_li"}}"#;
        let scenario = Scenario::read(&mut serde_json::Deserializer::from_str(json)).unwrap();
        let columns = Columns { joints: 3, parameters: 18 };
        let mut rows = vec![0.0; 3 * columns.width()];
        for (second, row) in rows.chunks_exact_mut(columns.width()).enumerate() {
            row[0] = second as f64;
            row[columns.start(Signal::Error)] = 0.1;
            let position = columns.start(Signal::Position);
            row[position..position + 3].copy_from_slice(&[second as f64, FRAC_PI_2, -FRAC_PI_2]);
        }
        ShownRun::new(scenario, Recording::from_rows(columns, rows).unwrap(), true, 1)
    }

    #[test]
    fn between_samples_it_is_interpolated_and_outside_it_stands_still() {
        let run = run();
        let motion = Motion::new(&run).unwrap();
        for (time_s, waist) in [(-1.0, 0.0), (0.0, 0.0), (0.25, 0.25), (1.0, 1.0), (1.5, 1.5), (2.0, 2.0), (9.0, 2.0)] {
            let pose = motion.at(time_s, 1.0);
            assert!((pose.q[0] - waist).abs() < 1e-12, "{time_s} s: {:?}", pose.q);
            assert!((pose.q_d[0] - (waist - 0.1)).abs() < 1e-12);
        }
    }

    #[test]
    fn an_exaggerated_error_moves_the_arm_and_not_its_aim() {
        let run = run();
        let motion = Motion::new(&run).unwrap();
        let pose = motion.at(1.0, 10.0);
        assert!((pose.q[0] - (0.9 + 1.0)).abs() < 1e-12);
        assert_eq!(pose.desired, motion.at(1.0, 1.0).desired);
    }

    #[test]
    fn a_path_has_its_ends_and_no_more_points_than_allowed() {
        let run = run();
        let motion = Motion::new(&run).unwrap();
        assert_eq!(motion.path_samples(9).collect::<Vec<_>>(), [0, 1, 2]);
        assert_eq!(motion.path_samples(2).collect::<Vec<_>>(), [0, 2]);
    }

    #[test]
    fn an_empty_run_has_no_motion() {
        let mut run = run();
        run.recording = Recording::from_rows(Columns { joints: 3, parameters: 18 }, Vec::new()).unwrap();
        assert!(Motion::new(&run).is_none());
    }
}
