//! The JSON Schema of a scenario says all that `validate` demands of one field: ranges, lengths, and which fields belong to
//! which kind. Parts allow what some robot allows; the whole says which lengths belong to which robot. What holds between fields (steps in all, the projection's two bounds, positive inertia) it cannot say.

use super::document::{FORMAT, TrajectoryDocument, TrajectoryKind};
use super::gains::{GainInfo, GainShape};
use super::validate::LIMITS;
use super::validate_trajectory::{fields, needed};
use crate::robots::{ROBOTS, RobotData, RobotKind};
use schemars::{Schema, json_schema, transform::Transform};

/// Adds keywords to the part of a schema at a JSON pointer.
pub(super) fn refine(schema: &mut Schema, pointer: &str, keywords: &Schema) {
    let part = schema.pointer_mut(pointer).and_then(|part| part.as_object_mut());
    debug_assert!(part.is_some(), "no {pointer} in {schema:?}");
    if let (Some(part), Some(keywords)) = (part, keywords.as_object()) {
        part.extend(keywords.clone());
    }
}

pub(super) fn range([min, max]: [f64; 2]) -> Schema {
    json_schema!({ "minimum": min, "maximum": max })
}

/// A number within limits.
fn number([minimum, maximum]: [f64; 2]) -> Schema {
    json_schema!({ "type": "number", "format": "double", "minimum": minimum, "maximum": maximum })
}

/// A list with one number per joint or parameter, as `count` tells, of any robot.
pub(super) fn list(count: fn(&RobotData) -> usize, limits: [f64; 2]) -> Schema {
    let (fewest, most) = of_all_robots(count);
    json_schema!({ "items": number(limits), "minItems": fewest, "maxItems": most })
}

/// Fewest and most over all robots.
fn of_all_robots(count: fn(&RobotData) -> usize) -> (usize, usize) {
    let counts = || ROBOTS.iter().map(|robot| count(robot));
    (counts().min().unwrap_or_default(), counts().max().unwrap_or_default())
}

/// Of the whole document.
pub(super) fn scenario(schema: &mut Schema) {
    refine(schema, "/properties/format", &json_schema!({ "const": FORMAT }));
    let robots: Vec<_> = ROBOTS.iter().map(|robot| robot.id).collect();
    refine(schema, "/properties/robot", &json_schema!({ "enum": robots }));
    refine(schema, "/properties/seed", &json_schema!({ "maximum": u64::MAX }));
    let lengths: Vec<_> = ROBOTS.iter().map(|robot| of_robot(robot)).collect();
    refine(schema, "", &json_schema!({ "allOf": lengths }));
}

/// What one robot asks for where a document names it, or names none and means it.
fn of_robot(robot: &RobotData) -> Schema {
    let named = json_schema!({ "properties": { "robot": { "const": robot.id } } });
    let named = if robot.id == super::document::default_robot() {
        named
    } else {
        json_schema!({ "allOf": [named, { "required": ["robot"] }] })
    };
    let exactly = |count: usize| json_schema!({ "minItems": count, "maxItems": count });
    let (joints, parameters) = (robot.joint_count(), robot.parameter_count());
    let mut factors = exactly(parameters);
    let limits = |inertial| if inertial { LIMITS.inertial_scale } else { LIMITS.other_scale };
    let each: Vec<_> = robot.parameters.iter().map(|parameter| number(limits(parameter.inertial))).collect();
    factors.insert("prefixItems".to_owned(), each.into());
    let mut gains = json_schema!({});
    for gain in super::Scheme::ALL.iter().flat_map(|scheme| scheme.gains()) {
        match gain.shape {
            GainShape::Scalar => None,
            GainShape::Joint => gains.insert(gain.name.to_owned(), exactly(joints).into()),
            GainShape::Parameter => gains.insert(gain.name.to_owned(), exactly(parameters).into()),
        };
    }
    let is_the_papers = robot.kind == RobotKind::CrsA465;
    let kinds: Vec<_> = TrajectoryKind::ALL
        .into_iter()
        .filter(|kind| is_the_papers || *kind != TrajectoryKind::Paper)
        .map(TrajectoryKind::id)
        .collect();
    let amplitudes = json_schema!({ "maxItems": joints });
    json_schema!({ "if": named, "then": { "properties": {
        "plant": { "properties": { "theta_scale": factors } },
        "scheme": { "properties": { "gains": { "properties": gains } } },
        "trajectory": { "properties": {
            "kind": { "enum": kinds },
            "offset_deg": exactly(joints),
            "sine_deg": amplitudes,
            "cosine_deg": amplitudes,
            "amplitude_deg": exactly(joints),
            "points_deg": { "items": exactly(joints) },
        } },
    } } })
}

/// Of the simulated arm.
pub(super) fn plant(schema: &mut Schema) {
    refine(schema, "/properties/theta_scale", &list(RobotData::parameter_count, LIMITS.other_scale));
}

/// Of friction's sign.
pub(super) fn friction(schema: &mut Schema) {
    let width = range(LIMITS.friction_width_rad_s);
    refine(schema, "/properties/width_rad_s", &json_schema!({ "anyOf": [{ "const": 0 }, width] }));
}

/// Of the desired trajectory: an alternative for each kind.
pub(super) fn trajectory(schema: &mut Schema) {
    let (_, joints) = of_all_robots(RobotData::joint_count);
    refine(schema, "/properties/frequency_rad_s", &range(LIMITS.frequency_rad_s));
    refine(schema, "/properties/offset_deg", &list(RobotData::joint_count, LIMITS.angle_deg));
    for name in ["sine_deg", "cosine_deg"] {
        let amplitudes = json_schema!({
            "maxItems": joints,
            "items": {
                "type": "array",
                "maxItems": LIMITS.harmonics,
                "items": number(LIMITS.angle_deg),
            },
        });
        refine(schema, &format!("/properties/{name}"), &amplitudes);
    }
    refine(schema, "/properties/harmonics", &json_schema!({ "minimum": 1, "maximum": LIMITS.harmonics }));
    refine(schema, "/properties/amplitude_deg", &list(RobotData::joint_count, LIMITS.angle_deg));
    let (fewest, _) = of_all_robots(RobotData::joint_count);
    let row = json_schema!({
        "type": "array", "minItems": fewest, "maxItems": joints, "items": number(LIMITS.angle_deg),
    });
    refine(schema, "/properties/points_deg", &json_schema!({ "minItems": 1, "maxItems": LIMITS.points, "items": row }));
    let latest = [0.0, LIMITS.duration_s[1]];
    let times = json_schema!({ "minItems": 2, "maxItems": LIMITS.points, "items": number(latest) });
    refine(schema, "/properties/times_s", &times);
    for name in ["from_m", "to_m", "centre_m", "normal"] {
        let point = json_schema!({ "minItems": 3, "maxItems": 3, "items": number(LIMITS.coordinate_m) });
        refine(schema, &format!("/properties/{name}"), &point);
    }
    for (name, limits) in [
        ("rms_deg_s", LIMITS.rms_deg_s),
        ("frequency_end_rad_s", LIMITS.frequency_rad_s),
        ("sweep_s", LIMITS.move_s),
        ("move_s", LIMITS.move_s),
        ("dwell_s", [0.0, LIMITS.move_s[1]]),
        ("radius_m", LIMITS.radius_m),
        ("period_s", LIMITS.move_s),
    ] {
        refine(schema, &format!("/properties/{name}"), &range(limits));
    }
    let kinds: Vec<_> = TrajectoryKind::ALL.into_iter().map(of_kind).collect();
    refine(schema, "", &json_schema!({ "oneOf": kinds }));
}

/// One kind of trajectory: it needs some fields and has nothing in those of other kinds.
fn of_kind(kind: TrajectoryKind) -> Schema {
    let needed = needed(kind);
    let mut properties = json_schema!({ "kind": { "const": kind.id() } });
    for (name, _) in TrajectoryDocument::default().given() {
        if !fields(kind).contains(&name) {
            properties.insert(name.to_owned(), json_schema!({ "type": "null" }).into());
        } else if needed.contains(&name) {
            properties.insert(name.to_owned(), json_schema!({ "not": { "type": "null" } }).into());
        }
    }
    json_schema!({ "properties": properties, "required": needed })
}

/// Of the scheme: gains may be left out.
pub(super) fn scheme(schema: &mut Schema) {
    for n in 0..super::Scheme::ALL.len() + super::Scheme::YARDSTICKS.len() {
        refine(schema, &format!("/oneOf/{n}"), &json_schema!({ "required": ["kind"] }));
    }
}

/// Of a set of gains with this table.
pub(super) struct Gains(pub(super) &'static [GainInfo]);

impl Transform for Gains {
    fn transform(&mut self, schema: &mut Schema) {
        for gain in self.0 {
            let limits = [gain.min, gain.max];
            let keywords = match gain.shape {
                GainShape::Scalar => range(limits),
                GainShape::Joint => list(RobotData::joint_count, limits),
                GainShape::Parameter => list(RobotData::parameter_count, limits),
            };
            refine(schema, &format!("/properties/{}", gain.name), &keywords);
        }
    }
}

/// Of the integration: tolerances belong to the adaptive method.
pub(super) fn integration(schema: &mut Schema) {
    refine(schema, "/properties/step_s", &range(LIMITS.step_s));
    refine(schema, "/properties/duration_s", &range(LIMITS.duration_s));
    for name in ["relative_tolerance", "absolute_tolerance"] {
        refine(schema, &format!("/properties/{name}"), &range(LIMITS.tolerance));
    }
    let nothing = json_schema!({ "type": "null" });
    let fixed = json_schema!({ "properties": {
        "method": { "const": "rk4" },
        "relative_tolerance": nothing,
        "absolute_tolerance": nothing,
    } });
    let adaptive = json_schema!({ "properties": { "method": { "const": "dopri5" } }, "required": ["method"] });
    refine(schema, "", &json_schema!({ "oneOf": [fixed, adaptive] }));
}

/// Of what is kept.
pub(super) fn recording(schema: &mut Schema) {
    let [minimum, maximum] = LIMITS.samples;
    refine(schema, "/properties/samples", &json_schema!({ "minimum": minimum, "maximum": maximum }));
}
