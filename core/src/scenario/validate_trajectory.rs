//! What a trajectory may say, kind by kind: which fields belong to it, their ranges, and that the tip can go where it is sent.

use super::document::{TrajectoryDocument, TrajectoryKind};
use super::error::{Problem, ScenarioError};
use super::robot_defaults;
use super::validate::{Check, LIMITS, at_most, length, range};
use crate::robots::{Kinematics, Point, RobotData, RobotKind};
use crate::trajectories::Path;

/// Points of a path that are tried.
const TRIED: u32 = 2000;
/// No joint may turn further than this between two of them, rad: it would have jumped by a turn.
const LARGEST_TURN_RAD: f64 = 1.0;

/// Which fields a kind has beside `kind`; whatever else is given is refused.
pub(super) const fn fields(kind: TrajectoryKind) -> &'static [&'static str] {
    match kind {
        TrajectoryKind::Paper | TrajectoryKind::Default => &[],
        TrajectoryKind::Fourier => &["frequency_rad_s", "offset_deg", "sine_deg", "cosine_deg"],
        TrajectoryKind::RandomFourier => &["frequency_rad_s", "offset_deg", "harmonics", "rms_deg_s"],
        TrajectoryKind::Chirp => &["frequency_rad_s", "offset_deg", "amplitude_deg", "frequency_end_rad_s", "sweep_s"],
        TrajectoryKind::MinimumJerk => &["points_deg", "move_s", "dwell_s"],
        TrajectoryKind::Line => &["from_m", "to_m", "move_s", "elbow"],
        TrajectoryKind::Circle => &["centre_m", "radius_m", "normal", "period_s", "elbow"],
        TrajectoryKind::Samples => &["times_s", "points_deg"],
    }
}

/// The fields of a kind without which there is none.
pub(super) const fn needed(kind: TrajectoryKind) -> &'static [&'static str] {
    match kind {
        TrajectoryKind::Paper | TrajectoryKind::Default => &[],
        TrajectoryKind::Fourier => &["offset_deg"],
        TrajectoryKind::RandomFourier => &["offset_deg", "rms_deg_s"],
        TrajectoryKind::Chirp => &["offset_deg", "amplitude_deg", "frequency_end_rad_s", "sweep_s"],
        TrajectoryKind::MinimumJerk => &["points_deg", "move_s"],
        TrajectoryKind::Line => &["from_m", "to_m", "move_s"],
        TrajectoryKind::Circle => &["centre_m", "radius_m", "period_s"],
        TrajectoryKind::Samples => &["times_s", "points_deg"],
    }
}

/// Checks a trajectory and fills in what it leaves out.
pub(super) fn resolve_trajectory(trajectory: &mut TrajectoryDocument, robot: &RobotData) -> Check {
    check_fields(trajectory)?;
    match trajectory.kind {
        TrajectoryKind::Default => {
            *trajectory = robot_defaults::trajectory(robot);
            resolve_trajectory(trajectory, robot)
        }
        TrajectoryKind::Paper if robot.kind != RobotKind::CrsA465 => {
            let message = format!(
                "paper is the CRS A465's trajectory and has no meaning for robot {}; use kind fourier, or default for the \
                 robot's own",
                robot.id
            );
            Err(conflict("kind", message))
        }
        TrajectoryKind::Paper => Ok(()),
        TrajectoryKind::Fourier => resolve_fourier(trajectory, robot),
        TrajectoryKind::RandomFourier => resolve_random_fourier(trajectory, robot),
        TrajectoryKind::Chirp => resolve_chirp(trajectory, robot),
        TrajectoryKind::MinimumJerk => resolve_minimum_jerk(trajectory, robot),
        TrajectoryKind::Line => resolve_line(trajectory, robot),
        TrajectoryKind::Circle => resolve_circle(trajectory, robot),
        TrajectoryKind::Samples => resolve_samples(trajectory, robot),
    }
}

fn conflict(field: &str, message: impl Into<String>) -> ScenarioError {
    ScenarioError::new(format!("/trajectory/{field}"), Problem::Conflict { message: message.into() })
}

/// Refuses fields of other kinds and misses none that the kind needs.
fn check_fields(trajectory: &TrajectoryDocument) -> Check {
    let (kind, name) = (trajectory.kind, trajectory.kind.id());
    let given = trajectory.given();
    if let Some((field, _)) = given.iter().find(|(field, given)| *given && !fields(kind).contains(field)) {
        return Err(conflict(
            field,
            match kind {
                TrajectoryKind::Paper => "has no meaning for kind paper, which is fixed; use kind fourier".to_owned(),
                TrajectoryKind::Default => {
                    "has no meaning for kind default, which is the robot's own; use kind fourier".to_owned()
                }
                _ => format!("has no meaning for kind {name}, which takes {}", fields(kind).join(", ")),
            },
        ));
    }
    for field in needed(kind) {
        if given.contains(&(field, false)) {
            let message = match *field {
                "offset_deg" => format!("missing; a trajectory of kind {name} needs one angle per joint of the robot"),
                _ => format!("missing; a trajectory of kind {name} needs it"),
            };
            return Err(conflict(field, message));
        }
    }
    Ok(())
}

fn resolve_fourier(trajectory: &mut TrajectoryDocument, robot: &RobotData) -> Check {
    let joints = robot.joint_count();
    frequency(trajectory)?;
    per_joint("offset_deg", trajectory.offset_deg.as_deref(), robot)?;
    for (name, rows) in [("sine_deg", &mut trajectory.sine_deg), ("cosine_deg", &mut trajectory.cosine_deg)] {
        let pointer = format!("/trajectory/{name}");
        let rows = rows.get_or_insert_default();
        at_most(&pointer, rows.len(), joints, "lists: one per joint of the robot")?;
        for (joint, row) in rows.iter().enumerate() {
            let pointer = format!("{pointer}/{joint}");
            at_most(&pointer, row.len(), LIMITS.harmonics, "numbers: one per harmonic")?;
            angles(&pointer, row)?;
        }
    }
    Ok(())
}

fn resolve_random_fourier(trajectory: &mut TrajectoryDocument, robot: &RobotData) -> Check {
    frequency(trajectory)?;
    per_joint("offset_deg", trajectory.offset_deg.as_deref(), robot)?;
    let harmonics = *trajectory.harmonics.get_or_insert(5);
    range("/trajectory/harmonics", harmonics as f64, [1.0, LIMITS.harmonics as f64], "")?;
    number("rms_deg_s", trajectory.rms_deg_s, LIMITS.rms_deg_s, "deg/s")
}

fn resolve_chirp(trajectory: &mut TrajectoryDocument, robot: &RobotData) -> Check {
    let lowest = frequency(trajectory)?;
    per_joint("offset_deg", trajectory.offset_deg.as_deref(), robot)?;
    per_joint("amplitude_deg", trajectory.amplitude_deg.as_deref(), robot)?;
    let highest = LIMITS.frequency_rad_s[1];
    number("frequency_end_rad_s", trajectory.frequency_end_rad_s, [lowest, highest], "rad/s")?;
    number("sweep_s", trajectory.sweep_s, LIMITS.move_s, "s")
}

fn resolve_minimum_jerk(trajectory: &mut TrajectoryDocument, robot: &RobotData) -> Check {
    table(trajectory, robot, 1)?;
    number("move_s", trajectory.move_s, LIMITS.move_s, "s")?;
    number("dwell_s", Some(*trajectory.dwell_s.get_or_insert(0.0)), [0.0, LIMITS.move_s[1]], "s")
}

fn resolve_samples(trajectory: &mut TrajectoryDocument, robot: &RobotData) -> Check {
    table(trajectory, robot, 2)?;
    let rows = trajectory.points_deg.as_ref().map_or(0, Vec::len);
    let times_s = trajectory.times_s.as_deref().unwrap_or_default();
    length("/trajectory/times_s", times_s.len(), rows, "one per row of points_deg")?;
    let mut before = None;
    for (n, &time_s) in times_s.iter().enumerate() {
        // The first counts from the start of the run; then each is later than the one before.
        let earliest = before.map_or(0.0, |before| before + LIMITS.move_s[0]);
        range(&format!("/trajectory/times_s/{n}"), time_s, [earliest, LIMITS.duration_s[1]], "s")?;
        before = Some(time_s);
    }
    Ok(())
}

fn resolve_line(trajectory: &mut TrajectoryDocument, robot: &RobotData) -> Check {
    let (from, to) = (point("from_m", trajectory.from_m.as_deref())?, point("to_m", trajectory.to_m.as_deref())?);
    number("move_s", trajectory.move_s, LIMITS.move_s, "s")?;
    trajectory.elbow.get_or_insert_default();
    let move_s = trajectory.move_s.unwrap_or_default();
    reachable(trajectory, robot, &Path::Line { from, to, move_s }, &["from_m", "to_m"])
}

fn resolve_circle(trajectory: &mut TrajectoryDocument, robot: &RobotData) -> Check {
    // Planar robots move in the plane of x and z.
    let level = if robot.kind == RobotKind::CrsA465 { vec![0.0, 0.0, 1.0] } else { vec![0.0, -1.0, 0.0] };
    let normal = trajectory.normal.get_or_insert(level).clone();
    let (centre, normal) = (point("centre_m", trajectory.centre_m.as_deref())?, point("normal", Some(&normal))?);
    if normal.iter().map(|x| x * x).sum::<f64>() < 1e-6 {
        return Err(conflict("normal", format!("{normal:?} has no direction")));
    }
    number("radius_m", trajectory.radius_m, LIMITS.radius_m, "m")?;
    number("period_s", trajectory.period_s, LIMITS.move_s, "s")?;
    trajectory.elbow.get_or_insert_default();
    let (radius_m, period_s) = (trajectory.radius_m.unwrap_or_default(), trajectory.period_s.unwrap_or_default());
    reachable(trajectory, robot, &Path::Circle { centre, radius_m, normal, period_s }, &["radius_m"])
}

/// Tries points along the path: each must be within reach, and no joint may jump between them. The error names the point,
/// at the field of the nearest given end.
fn reachable(trajectory: &TrajectoryDocument, robot: &RobotData, path: &Path, ends: &[&str]) -> Check {
    let kinematics = Kinematics::new(robot);
    let bend = trajectory.elbow.unwrap_or_default().into();
    let mut before: Option<[f64; 3]> = None;
    for n in 0..=TRIED {
        let share = f64::from(n) / f64::from(TRIED);
        let tip = path.at(path.period_s() * share);
        // A line is half way round when it is at its other end.
        let field = if share < 0.25 { ends[0] } else { ends[ends.len() - 1] };
        let [x, y, z] = tip[0].into();
        let place = format!("the tip cannot follow it at [{x:.4}, {y:.4}, {z:.4}] m");
        let Some([q, _, _]) = kinematics.follow(&tip, bend) else {
            let message = format!("{place}: out of the reach of robot {}, or where it would be singular", robot.id);
            return Err(conflict(field, message));
        };
        if before.is_some_and(|before| (0..3).any(|joint| f64::abs(q[joint] - before[joint]) > LARGEST_TURN_RAD)) {
            return Err(conflict(field, format!("{place}: a joint would have to jump, or turn past its half turn")));
        }
        before = Some(q);
    }
    Ok(())
}

fn frequency(trajectory: &mut TrajectoryDocument) -> Result<f64, ScenarioError> {
    let frequency_rad_s = *trajectory.frequency_rad_s.get_or_insert(1.0);
    range("/trajectory/frequency_rad_s", frequency_rad_s, LIMITS.frequency_rad_s, "rad/s")?;
    Ok(frequency_rad_s)
}

/// A number that has been found to be there.
fn number(field: &str, value: Option<f64>, limits: [f64; 2], unit: &'static str) -> Check {
    range(&format!("/trajectory/{field}"), value.unwrap_or(f64::NAN), limits, unit)
}

fn per_joint(field: &str, degrees: Option<&[f64]>, robot: &RobotData) -> Check {
    let (pointer, degrees) = (format!("/trajectory/{field}"), degrees.unwrap_or_default());
    length(&pointer, degrees.len(), robot.joint_count(), "one per joint of the robot")?;
    angles(&pointer, degrees)
}

/// Rows of angles, one per joint each.
fn table(trajectory: &TrajectoryDocument, robot: &RobotData, fewest: usize) -> Check {
    let rows = trajectory.points_deg.as_deref().unwrap_or_default();
    at_most("/trajectory/points_deg", rows.len(), LIMITS.points, "points")?;
    if rows.len() < fewest {
        return Err(conflict("points_deg", format!("has {} points where at least {fewest} are needed", rows.len())));
    }
    for (n, row) in rows.iter().enumerate() {
        let pointer = format!("/trajectory/points_deg/{n}");
        length(&pointer, row.len(), robot.joint_count(), "one per joint of the robot")?;
        angles(&pointer, row)?;
    }
    Ok(())
}

fn angles(pointer: &str, degrees: &[f64]) -> Check {
    degrees
        .iter()
        .enumerate()
        .try_for_each(|(n, angle)| range(&format!("{pointer}/{n}"), *angle, LIMITS.angle_deg, "deg"))
}

/// A point in space.
fn point(field: &str, coordinates: Option<&[f64]>) -> Result<Point, ScenarioError> {
    let (pointer, coordinates) = (format!("/trajectory/{field}"), coordinates.unwrap_or_default());
    length(&pointer, coordinates.len(), 3, "x, y and z")?;
    for (n, coordinate) in coordinates.iter().enumerate() {
        range(&format!("{pointer}/{n}"), *coordinate, LIMITS.coordinate_m, "m")?;
    }
    Ok(std::array::from_fn(|n| coordinates[n]))
}
