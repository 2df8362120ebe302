//! What a scenario may say. Checks a document once and fills in everything it left out.

use super::document::{FORMAT, MethodDocument, ScenarioDocument, SchemeDocument, TrajectoryDocument, TrajectoryKind};
use super::error::{Problem, ScenarioError};
use super::gains::{GainSet, GainShape};
use super::robot_defaults::{self, RobotGains};
use crate::robots::{ROBOTS, RobotData, RobotKind, robot};

/// Limits on what a scenario can ask for. All are inclusive.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Limits {
    /// Shortest and longest step, s.
    pub step_s: [f64; 2],
    /// Shortest and longest duration, s.
    pub duration_s: [f64; 2],
    /// Most integration steps.
    pub steps: f64,
    /// Fewest and most samples.
    pub samples: [usize; 2],
    /// Factor on a parameter that enters the inertia matrix.
    pub inertial_scale: [f64; 2],
    /// Factor on any other parameter.
    pub other_scale: [f64; 2],
    /// Width of friction's sign, rad/s, unless it is 0.
    pub friction_width_rad_s: [f64; 2],
    /// Base frequency of a Fourier trajectory, rad/s.
    pub frequency_rad_s: [f64; 2],
    /// Angles of a Fourier trajectory, deg.
    pub angle_deg: [f64; 2],
    /// Most harmonics of a Fourier trajectory.
    pub harmonics: usize,
    /// Tolerances of an adaptive method.
    pub tolerance: [f64; 2],
}

/// The limits of this version.
pub const LIMITS: Limits = Limits {
    step_s: [1e-6, 0.1],
    duration_s: [1e-3, 100_000.0],
    steps: 1e8,
    samples: [1, 200_000],
    inertial_scale: [0.01, 100.0],
    other_scale: [0.0, 100.0],
    friction_width_rad_s: [1e-9, 10.0],
    frequency_rad_s: [1e-3, 100.0],
    angle_deg: [-3600.0, 3600.0],
    harmonics: 50,
    tolerance: [1e-14, 1e-2],
};

/// Defaults of the adaptive method's tolerances.
const DEFAULT_RELATIVE_TOLERANCE: f64 = 1e-10;
const DEFAULT_ABSOLUTE_TOLERANCE: f64 = 1e-12;

type Check = Result<(), ScenarioError>;

/// Checks a document and fills in what it left out.
pub(super) fn resolve(mut document: ScenarioDocument) -> Result<(ScenarioDocument, &'static RobotData), ScenarioError> {
    if document.format != FORMAT {
        return Err(unknown("/format", &document.format, FORMAT));
    }
    let Some(robot) = robot(&document.robot) else {
        let ids: Vec<_> = ROBOTS.iter().map(|robot| robot.id).collect();
        return Err(unknown("/robot", &document.robot, &ids.join(", ")));
    };
    resolve_plant(&mut document, robot)?;
    resolve_trajectory(&mut document.trajectory, robot)?;
    resolve_scheme(&mut document.scheme, robot)?;
    resolve_integration(&mut document)?;
    let [fewest, most] = LIMITS.samples.map(|samples| samples as f64);
    range("/recording/samples", document.recording.samples as f64, [fewest, most], "")?;
    Ok((document, robot))
}

fn resolve_plant(document: &mut ScenarioDocument, robot: &RobotData) -> Check {
    let count = robot.parameter_count();
    let scale = document.plant.theta_scale.get_or_insert_with(|| vec![1.0; count]);
    length("/plant/theta_scale", scale.len(), count, "one per parameter of the robot")?;
    for (n, (factor, parameter)) in scale.iter().zip(robot.parameters).enumerate() {
        let limits = if parameter.inertial { LIMITS.inertial_scale } else { LIMITS.other_scale };
        range(&format!("/plant/theta_scale/{n}"), *factor, limits, "")?;
    }
    let width_rad_s = document.plant.friction.width_rad_s;
    if width_rad_s != 0.0 {
        range(
            "/plant/friction/width_rad_s",
            width_rad_s,
            LIMITS.friction_width_rad_s,
            "rad/s (or 0 for the true sign)",
        )?;
    }
    Ok(())
}

fn resolve_trajectory(trajectory: &mut TrajectoryDocument, robot: &RobotData) -> Check {
    match trajectory.kind {
        TrajectoryKind::Default => {
            refuse_fields(trajectory, "default, which is the robot's own")?;
            *trajectory = robot_defaults::trajectory(robot);
            resolve_trajectory(trajectory, robot)
        }
        TrajectoryKind::Paper if robot.kind != RobotKind::CrsA465 => {
            let message = format!(
                "paper is the CRS A465's trajectory and has no meaning for robot {}; use kind fourier, or default for the \
                 robot's own",
                robot.id
            );
            Err(ScenarioError::new("/trajectory/kind", Problem::Conflict { message }))
        }
        TrajectoryKind::Paper => refuse_fields(trajectory, "paper, which is fixed"),
        TrajectoryKind::Fourier => resolve_fourier(trajectory, robot),
    }
}

/// Refuses every field beside the kind.
fn refuse_fields(trajectory: &TrajectoryDocument, kind: &str) -> Check {
    let TrajectoryDocument { kind: _, frequency_rad_s, offset_deg, sine_deg, cosine_deg } = trajectory;
    for (name, given) in [
        ("frequency_rad_s", frequency_rad_s.is_some()),
        ("offset_deg", offset_deg.is_some()),
        ("sine_deg", sine_deg.is_some()),
        ("cosine_deg", cosine_deg.is_some()),
    ] {
        if given {
            let message = format!("has no meaning for kind {kind}; use kind fourier");
            return Err(ScenarioError::new(format!("/trajectory/{name}"), Problem::Conflict { message }));
        }
    }
    Ok(())
}

fn resolve_fourier(trajectory: &mut TrajectoryDocument, robot: &RobotData) -> Check {
    let joints = robot.joint_count();
    let frequency_rad_s = *trajectory.frequency_rad_s.get_or_insert(1.0);
    range("/trajectory/frequency_rad_s", frequency_rad_s, LIMITS.frequency_rad_s, "rad/s")?;
    let Some(offset_deg) = &trajectory.offset_deg else {
        let message = "missing; a trajectory of kind fourier needs one angle per joint of the robot".to_owned();
        return Err(ScenarioError::new("/trajectory/offset_deg", Problem::Conflict { message }));
    };
    length("/trajectory/offset_deg", offset_deg.len(), joints, "one per joint of the robot")?;
    angles("/trajectory/offset_deg", offset_deg)?;
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

fn angles(pointer: &str, degrees: &[f64]) -> Check {
    degrees
        .iter()
        .enumerate()
        .try_for_each(|(n, angle)| range(&format!("{pointer}/{n}"), *angle, LIMITS.angle_deg, "deg"))
}

fn resolve_scheme(scheme: &mut SchemeDocument, robot: &RobotData) -> Check {
    match scheme {
        SchemeDocument::Proposed(gains) => {
            let gains = RobotGains::given(gains, robot);
            check_gains("/scheme/gains", gains, robot)?;
            let bounds = &gains.projection;
            check_gains("/scheme/gains/projection", bounds, robot)?;
            if bounds.upper_hard_factor <= bounds.upper_factor {
                let message = format!("{} must exceed upper_factor, {}", bounds.upper_hard_factor, bounds.upper_factor);
                let pointer = "/scheme/gains/projection/upper_hard_factor";
                return Err(ScenarioError::new(pointer, Problem::Conflict { message }));
            }
            Ok(())
        }
        SchemeDocument::TangArteaga(gains) => check_gains("/scheme/gains", RobotGains::given(gains, robot), robot),
        SchemeDocument::SlotineLi(gains) => check_gains("/scheme/gains", RobotGains::given(gains, robot), robot),
    }
}

fn check_gains(pointer: &str, gains: &impl GainSet, robot: &RobotData) -> Check {
    for (info, values) in gains.table().iter().zip(gains.values()) {
        let pointer = format!("{pointer}/{}", info.name);
        let (expected, why) = match info.shape {
            GainShape::Scalar => (1, ""),
            GainShape::Joint => (robot.joint_count(), "one per joint of the robot"),
            GainShape::Parameter => (robot.parameter_count(), "one per parameter of the robot"),
        };
        length(&pointer, values.len(), expected, why)?;
        for (n, value) in values.iter().enumerate() {
            let element = if info.shape == GainShape::Scalar { pointer.clone() } else { format!("{pointer}/{n}") };
            range(&element, *value, [info.min, info.max], info.unit)?;
        }
    }
    Ok(())
}

fn resolve_integration(document: &mut ScenarioDocument) -> Check {
    let integration = &mut document.integration;
    range("/integration/step_s", integration.step_s, LIMITS.step_s, "s")?;
    range("/integration/duration_s", integration.duration_s, LIMITS.duration_s, "s")?;
    let steps = integration.duration_s / integration.step_s;
    if steps > LIMITS.steps {
        let message = format!(
            "{} s in steps of {} s are {steps:.3e} steps; at most {:.0e} are allowed: raise step_s or lower duration_s",
            integration.duration_s, integration.step_s, LIMITS.steps
        );
        return Err(ScenarioError::new("/integration/step_s", Problem::Conflict { message }));
    }
    let tolerances = [
        ("relative_tolerance", &mut integration.relative_tolerance, DEFAULT_RELATIVE_TOLERANCE),
        ("absolute_tolerance", &mut integration.absolute_tolerance, DEFAULT_ABSOLUTE_TOLERANCE),
    ];
    for (name, tolerance, default) in tolerances {
        let pointer = format!("/integration/{name}");
        match (integration.method, &tolerance) {
            (MethodDocument::Dopri5, _) => {
                range(&pointer, *tolerance.get_or_insert(default), LIMITS.tolerance, "")?;
            }
            (MethodDocument::Rk4, Some(_)) => {
                let message = "has no meaning for method rk4, whose step is fixed; use method dopri5".to_owned();
                return Err(ScenarioError::new(pointer, Problem::Conflict { message }));
            }
            (MethodDocument::Rk4, None) => {}
        }
    }
    Ok(())
}

fn unknown(pointer: &str, value: &str, allowed: &str) -> ScenarioError {
    // A hostile name must not make a hostile message.
    let value = value.chars().take(60).collect();
    ScenarioError::new(pointer, Problem::Unknown { value, allowed: allowed.to_owned() })
}

fn at_most(pointer: &str, found: usize, most: usize, what: &'static str) -> Check {
    if found <= most { Ok(()) } else { Err(ScenarioError::new(pointer, Problem::TooMany { found, most, what })) }
}

fn length(pointer: &str, found: usize, expected: usize, why: &'static str) -> Check {
    if found == expected {
        Ok(())
    } else {
        Err(ScenarioError::new(pointer, Problem::WrongLength { found, expected, why }))
    }
}

fn range(pointer: &str, value: f64, [min, max]: [f64; 2], unit: &'static str) -> Check {
    // Written so that NaN fails.
    if value >= min && value <= max {
        Ok(())
    } else {
        Err(ScenarioError::new(pointer, Problem::OutOfRange { value, min, max, unit }))
    }
}
