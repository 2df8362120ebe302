//! What a scenario may say. Checks a document once and fills in everything it left out.

use super::beyond;
use super::document::{FORMAT, MethodDocument, ScenarioDocument, SchemeDocument};
use super::error::{Problem, ScenarioError};
use super::gains::{GainSet, GainShape};
use super::robot_defaults::RobotGains;
use super::validate_trajectory::resolve_trajectory;
use crate::robots::{ROBOTS, RobotData, robot};

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
    /// Root mean square velocity of a random Fourier trajectory, deg/s.
    pub rms_deg_s: [f64; 2],
    /// Time of a move, a sweep or a round, s.
    pub move_s: [f64; 2],
    /// Most points or samples of a trajectory.
    pub points: usize,
    /// Coordinate of a point in space, m.
    pub coordinate_m: [f64; 2],
    /// Radius of a circle, m.
    pub radius_m: [f64; 2],
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
    rms_deg_s: [1e-3, 1e4],
    move_s: [1e-3, 1e5],
    points: 10_000,
    coordinate_m: [-10.0, 10.0],
    radius_m: [1e-4, 10.0],
    tolerance: [1e-14, 1e-2],
};

/// Defaults of the adaptive method's tolerances.
const DEFAULT_RELATIVE_TOLERANCE: f64 = 1e-10;
const DEFAULT_ABSOLUTE_TOLERANCE: f64 = 1e-12;

/// What a check gives.
pub(super) type Check = Result<(), ScenarioError>;

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
    beyond::resolve(&mut document, robot)?;
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
        SchemeDocument::Pd(gains) => check_gains("/scheme/gains", RobotGains::given(gains, robot), robot),
        SchemeDocument::PdGravity(gains) => check_gains("/scheme/gains", RobotGains::given(gains, robot), robot),
        SchemeDocument::ComputedTorque(gains) => check_gains("/scheme/gains", RobotGains::given(gains, robot), robot),
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

/// Whether a run may have this step and this duration, s.
pub(crate) fn check_steps(step_s: f64, duration_s: f64) -> Check {
    range("/integration/step_s", step_s, LIMITS.step_s, "s")?;
    range("/integration/duration_s", duration_s, LIMITS.duration_s, "s")?;
    let steps = duration_s / step_s;
    if steps > LIMITS.steps {
        let message = format!(
            "{duration_s} s in steps of {step_s} s are {steps:.3e} steps; at most {:.0e} are allowed: raise step_s or lower \
             duration_s",
            LIMITS.steps
        );
        return Err(ScenarioError::new("/integration/step_s", Problem::Conflict { message }));
    }
    Ok(())
}

fn resolve_integration(document: &mut ScenarioDocument) -> Check {
    let integration = &mut document.integration;
    check_steps(integration.step_s, integration.duration_s)?;
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

pub(super) fn at_most(pointer: &str, found: usize, most: usize, what: &'static str) -> Check {
    if found <= most { Ok(()) } else { Err(ScenarioError::new(pointer, Problem::TooMany { found, most, what })) }
}

pub(super) fn length(pointer: &str, found: usize, expected: usize, why: &'static str) -> Check {
    if found == expected {
        Ok(())
    } else {
        Err(ScenarioError::new(pointer, Problem::WrongLength { found, expected, why }))
    }
}

pub(super) fn range(pointer: &str, value: f64, [min, max]: [f64; 2], unit: &'static str) -> Check {
    // Written so that NaN fails.
    if value >= min && value <= max {
        Ok(())
    } else {
        Err(ScenarioError::new(pointer, Problem::OutOfRange { value, min, max, unit }))
    }
}
