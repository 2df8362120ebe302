//! From a checked document to the trajectory it describes.

use super::document::{ScenarioDocument, TrajectoryDocument, TrajectoryKind};
use crate::robots::{Kinematics, Point, Robot, RobotData, for_robot};
use crate::scalar::Scalar;
use crate::trajectories::{Chirp, Fourier, Motion, Path, PointToPoint, Samples, TipPath, Trajectory, random_fourier};
use nalgebra::SVector;
use std::sync::Arc;

/// The trajectory of robot `R` that documents describe, one per lane; they run beside each other.
pub(super) fn trajectory<R: Robot<N, P>, T: Scalar, const N: usize, const P: usize>(
    documents: &[&ScenarioDocument],
) -> Trajectory<T, N> {
    let lanes: Vec<_> = documents.iter().map(|document| of(document, R::DATA)).collect();
    Trajectory::side_by_side(&lanes)
}

/// Whether a robot can follow both documents' trajectories in the lanes of one simulation.
pub(super) fn run_beside(robot: &RobotData, a: &ScenarioDocument, b: &ScenarioDocument) -> bool {
    for_robot!(robot, R, N, P => {
        let [a, b]: [Trajectory<f64, N>; 2] = [of(a, robot), of(b, robot)];
        a.runs_beside(&b)
    })
}

/// One document's. What a resolved document lacks its kind does not need.
fn of<const N: usize>(scenario: &ScenarioDocument, robot: &RobotData) -> Trajectory<f64, N> {
    let document = &scenario.trajectory;
    let motion: Arc<dyn Motion<N>> = match document.kind {
        TrajectoryKind::Paper => return Trajectory::Fourier(Fourier::paper()),
        // Validation leaves no `default`.
        TrajectoryKind::Fourier | TrajectoryKind::Default => {
            return Trajectory::Fourier(Fourier::from_degrees(
                document.frequency_rad_s.unwrap_or(1.0),
                document.offset_deg.as_deref().unwrap_or_default(),
                document.sine_deg.as_deref().unwrap_or_default(),
                document.cosine_deg.as_deref().unwrap_or_default(),
            ));
        }
        TrajectoryKind::RandomFourier => {
            return Trajectory::Fourier(random_fourier(
                scenario.seed,
                document.frequency_rad_s.unwrap_or(1.0),
                document.harmonics.unwrap_or_default(),
                document.offset_deg.as_deref().unwrap_or_default(),
                document.rms_deg_s.unwrap_or_default(),
            ));
        }
        TrajectoryKind::Chirp => {
            let lowest = document.frequency_rad_s.unwrap_or(1.0);
            Arc::new(Chirp {
                offset: radians(document.offset_deg.as_deref().unwrap_or_default()),
                amplitude: radians(document.amplitude_deg.as_deref().unwrap_or_default()),
                frequency_rad_s: [lowest, document.frequency_end_rad_s.unwrap_or(lowest)],
                sweep_s: document.sweep_s.unwrap_or(1.0),
            })
        }
        TrajectoryKind::MinimumJerk => {
            let dwell_s = document.dwell_s.unwrap_or_default();
            Arc::new(PointToPoint::new(points(document), document.move_s.unwrap_or(1.0), dwell_s))
        }
        TrajectoryKind::Samples => {
            Arc::new(Samples::new(document.times_s.clone().unwrap_or_default(), &points(document)))
        }
        TrajectoryKind::Line | TrajectoryKind::Circle => Arc::new(TipPath {
            path: path(document),
            kinematics: Kinematics::new(robot),
            bend: document.elbow.unwrap_or_default().into(),
        }),
    };
    Trajectory::Motions(vec![motion])
}

/// The way of the tip.
fn path(document: &TrajectoryDocument) -> Path {
    let point = |coordinates: &Option<Vec<f64>>| -> Point {
        let coordinates = coordinates.as_deref().unwrap_or_default();
        std::array::from_fn(|n| coordinates.get(n).copied().unwrap_or_default())
    };
    if document.kind == TrajectoryKind::Line {
        let move_s = document.move_s.unwrap_or(1.0);
        Path::Line { from: point(&document.from_m), to: point(&document.to_m), move_s }
    } else {
        Path::Circle {
            centre: point(&document.centre_m),
            radius_m: document.radius_m.unwrap_or_default(),
            normal: point(&document.normal),
            period_s: document.period_s.unwrap_or(1.0),
        }
    }
}

fn points<const N: usize>(document: &TrajectoryDocument) -> Vec<SVector<f64, N>> {
    document.points_deg.iter().flatten().map(|row| radians(row)).collect()
}

fn radians<const N: usize>(degrees: &[f64]) -> SVector<f64, N> {
    SVector::from_fn(|joint, _| degrees[joint].to_radians())
}
