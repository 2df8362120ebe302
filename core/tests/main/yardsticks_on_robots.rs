//! Yardsticks on the robots beyond the paper's: gains of the robot's own length, and runs that end.

use adaptarm_core::robots::ROBOTS;
use adaptarm_core::scenario::{OutcomeKind, Scenario, Scheme, TrajectoryKind};

#[test]
fn every_yardstick_runs_on_every_robot() {
    for robot in ROBOTS {
        for scheme in Scheme::YARDSTICKS {
            let mut document = scheme.paper();
            document.robot = robot.id.to_owned();
            document.trajectory.kind = TrajectoryKind::Default;
            document.integration.duration_s = 3.0;
            let run = Scenario::new(document).unwrap().run();
            assert_eq!(run.report.outcome, OutcomeKind::Completed, "{} on {}", scheme.id(), robot.id);
            assert!(run.report.metrics.e_peak_deg.iter().all(|peak| *peak < 45.0), "{} on {}", scheme.id(), robot.id);
        }
    }
}
