//! The JSON Schema of a scenario says all that `validate` demands of one field: ranges, lengths, and which fields belong to
//! which kind. What holds between fields (steps in all, the projection's two bounds, positive inertia) it cannot say.

use super::document::FORMAT;
use super::gains::{GainInfo, GainShape};
use super::validate::LIMITS;
use crate::robots::{CrsA465, ROBOTS, Robot, RobotData};
use schemars::{Schema, json_schema, transform::Transform};

/// The only robot there is; with a second one, lengths will depend on which is named.
pub(super) const ROBOT: &RobotData = <CrsA465 as Robot<3, 18>>::DATA;

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

/// A list with one number per joint or parameter.
pub(super) fn list(length: usize, limits: [f64; 2]) -> Schema {
    let [minimum, maximum] = limits;
    json_schema!({
        "items": { "type": "number", "format": "double", "minimum": minimum, "maximum": maximum },
        "minItems": length,
        "maxItems": length,
    })
}

/// Of the whole document.
pub(super) fn scenario(schema: &mut Schema) {
    refine(schema, "/properties/format", &json_schema!({ "const": FORMAT }));
    let robots: Vec<_> = ROBOTS.iter().map(|robot| robot.id).collect();
    refine(schema, "/properties/robot", &json_schema!({ "enum": robots }));
    refine(schema, "/properties/seed", &json_schema!({ "maximum": u64::MAX }));
}

/// Of the simulated arm.
pub(super) fn plant(schema: &mut Schema) {
    let factors = ROBOT.parameters.iter().map(|parameter| {
        let [minimum, maximum] = if parameter.inertial { LIMITS.inertial_scale } else { LIMITS.other_scale };
        json_schema!({ "type": "number", "format": "double", "minimum": minimum, "maximum": maximum })
    });
    let factors: Vec<_> = factors.collect();
    refine(schema, "/properties/theta_scale", &list(ROBOT.parameter_count(), LIMITS.other_scale));
    refine(schema, "/properties/theta_scale", &json_schema!({ "prefixItems": factors }));
}

/// Of friction's sign.
pub(super) fn friction(schema: &mut Schema) {
    let width = range(LIMITS.friction_width_rad_s);
    refine(schema, "/properties/width_rad_s", &json_schema!({ "anyOf": [{ "const": 0 }, width] }));
}

/// Of the desired trajectory: an alternative for each kind.
pub(super) fn trajectory(schema: &mut Schema) {
    let joints = ROBOT.joint_count();
    let [lowest, highest] = LIMITS.angle_deg;
    refine(schema, "/properties/frequency_rad_s", &range(LIMITS.frequency_rad_s));
    refine(schema, "/properties/offset_deg", &list(joints, LIMITS.angle_deg));
    for name in ["sine_deg", "cosine_deg"] {
        let amplitudes = json_schema!({
            "maxItems": joints,
            "items": {
                "type": "array",
                "maxItems": LIMITS.harmonics,
                "items": { "type": "number", "format": "double", "minimum": lowest, "maximum": highest },
            },
        });
        refine(schema, &format!("/properties/{name}"), &amplitudes);
    }
    let nothing = json_schema!({ "type": "null" });
    let paper = json_schema!({ "properties": {
        "kind": { "const": "paper" },
        "frequency_rad_s": nothing,
        "offset_deg": nothing,
        "sine_deg": nothing,
        "cosine_deg": nothing,
    } });
    let fourier = json_schema!({
        "properties": { "kind": { "const": "fourier" }, "offset_deg": { "type": "array" } },
        "required": ["offset_deg"],
    });
    refine(schema, "", &json_schema!({ "oneOf": [paper, fourier] }));
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
                GainShape::Joint => list(ROBOT.joint_count(), limits),
                GainShape::Parameter => list(ROBOT.parameter_count(), limits),
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
