//! What the optional parts may say, as JSON Schema keywords; what holds between fields only `resolve` knows.

use super::resolve::limits;
use crate::robots::RobotData;
use crate::scenario::schema::{list, range, refine};
use schemars::{Schema, json_schema};

fn ranges(schema: &mut Schema, fields: &[(&str, [f64; 2])]) {
    for (name, limits) in fields {
        refine(schema, &format!("/properties/{name}"), &range(*limits));
    }
}

fn per_joint(schema: &mut Schema, fields: &[(&str, [f64; 2])]) {
    for (name, limits) in fields {
        refine(schema, &format!("/properties/{name}"), &list(RobotData::joint_count, *limits));
    }
}

/// An alternative for each kind: fields that belong to another must be absent.
fn kinds(schema: &mut Schema, kinds: &[(&[&str], &[&str])]) {
    let alternative = |(names, absent): &(&[&str], &[&str])| {
        let mut alternative = json_schema!({ "properties": { "kind": { "enum": names } } });
        for name in *absent {
            refine(&mut alternative, "/properties", &json_schema!({ (*name): { "type": "null" } }));
        }
        alternative
    };
    let alternatives: Vec<_> = kinds.iter().map(alternative).collect();
    refine(schema, "", &json_schema!({ "anyOf": alternatives }));
}

/// Of the velocity source.
pub(super) fn velocity(schema: &mut Schema) {
    ranges(schema, &[("bandwidth_rad_s", limits::BANDWIDTH_RAD_S)]);
    let gains = ["lambda_z", "lambda_x", "k_d"];
    per_joint(schema, &gains.map(|name| (name, limits::OBSERVER_GAIN)));
    kinds(
        schema,
        &[
            (&["measured"], &["bandwidth_rad_s", "lambda_z", "lambda_x", "k_d"]),
            (&["observer"], &["bandwidth_rad_s"]),
            (&["filtered_difference", "high_gain"], &gains),
        ],
    );
}

/// Of the adaptation.
pub(super) fn adaptation(schema: &mut Schema) {
    ranges(
        schema,
        &[
            ("sigma", limits::STRENGTH),
            ("e_modification", limits::STRENGTH),
            ("dead_zone_rad_s", limits::DEAD_ZONE_RAD_S),
            ("normalisation", limits::STRENGTH),
            ("filter_rad_s", limits::FILTER_RAD_S),
            ("weight", limits::STRENGTH),
            ("forgetting", limits::STRENGTH),
            ("gain_limit", limits::GAIN_LIMIT),
            ("record_every_s", limits::RECORD_S),
            ("rate_per_s", limits::STRENGTH),
            ("excitation_floor", limits::EXCITATION_FLOOR),
        ],
    );
    let [fewest, most] = limits::STACK;
    refine(schema, "/properties/stack", &json_schema!({ "minimum": fewest, "maximum": most }));
    let all = [
        "filter_rad_s", "weight", "forgetting", "gain_limit", "stack", "record_every_s", "rate_per_s", "excitation_floor",
    ];
    kinds(
        schema,
        &[
            (&["scheme"], &all),
            (&["least_squares"], &all[4..]),
            (&["concurrent"], &["forgetting", "gain_limit", "rate_per_s", "excitation_floor"]),
            (&["drem"], &["weight", "gain_limit", "stack", "record_every_s"]),
        ],
    );
}

/// Of integral action.
pub(super) fn integral(schema: &mut Schema) {
    per_joint(schema, &[("k_i", limits::INTEGRAL_GAIN)]);
}

/// Of signs.
pub(super) fn signs(schema: &mut Schema) {
    ranges(schema, &["feedback", "reference", "model", "adaptation"].map(|name| (name, limits::SIGN)));
}

/// Of the controller's clock.
pub(super) fn sampling(schema: &mut Schema) {
    let period = json_schema!({ "anyOf": [{ "const": 0 }, range(limits::PERIOD_S)] });
    refine(schema, "/properties/period_s", &period);
    ranges(schema, &[("delay_s", [0.0, limits::PERIOD_S[1]])]);
}

/// Of a disturbance.
pub(super) fn disturbance(schema: &mut Schema) {
    per_joint(schema, &[("constant_nm", limits::DISTURBANCE_NM), ("sine_nm", limits::DISTURBANCE_NM)]);
    ranges(
        schema,
        &[("frequency_rad_s", limits::FREQUENCY_RAD_S), ("from_s", limits::TIME_S), ("to_s", limits::TIME_S)],
    );
}

/// Of a payload.
pub(super) fn payload(schema: &mut Schema) {
    ranges(schema, &[("mass_kg", limits::MASS_KG), ("from_s", limits::TIME_S), ("to_s", limits::TIME_S)]);
}

/// Of Stribeck's friction.
pub(super) fn stribeck(schema: &mut Schema) {
    per_joint(schema, &[("excess_nm", limits::EXCESS_NM)]);
    ranges(schema, &[("velocity_rad_s", limits::STRIBECK_RAD_S)]);
}

/// Of elastic joints.
pub(super) fn elasticity(schema: &mut Schema) {
    per_joint(
        schema,
        &[
            ("stiffness_nm_rad", limits::STIFFNESS_NM_RAD),
            ("damping_nms_rad", limits::SPRING_DAMPING_NMS_RAD),
            ("motor_inertia_kgm2", limits::MOTOR_INERTIA_KGM2),
        ],
    );
}

/// Of all imperfections.
pub(super) fn effects(schema: &mut Schema) {
    ranges(
        schema,
        &[
            ("encoder_step_rad", limits::ENCODER_STEP_RAD),
            ("position_noise_rad", limits::POSITION_NOISE_RAD),
            ("velocity_noise_rad_s", limits::VELOCITY_NOISE_RAD_S),
            ("voltage_limit_v", limits::VOLTAGE_LIMIT_V),
        ],
    );
    per_joint(schema, &[("torque_limit_nm", limits::TORQUE_LIMIT_NM)]);
    refine(schema, "/properties/theta_hat_scale", &list(RobotData::parameter_count, limits::THETA_HAT_SCALE));
    refine(schema, "/properties/payloads", &json_schema!({ "maxItems": limits::PAYLOADS }));
}

#[cfg(test)]
mod tests {
    use crate::scenario::ScenarioDocument;

    /// Every range and list above has found its field (`refine` insists on it), and stands where a reader looks for it.
    #[test]
    fn ranges_of_optional_parts_are_in_the_schema() {
        let schema = schemars::schema_for!(ScenarioDocument);
        let at = |pointer: &str| schema.pointer(pointer).unwrap_or_else(|| panic!("no {pointer}")).clone();
        assert_eq!(at("/$defs/EffectsDocument/properties/encoder_step_rad/maximum"), 0.1);
        assert_eq!(at("/$defs/EffectsDocument/properties/theta_hat_scale/maxItems"), 18);
        assert_eq!(at("/$defs/SamplingDocument/properties/period_s/anyOf/0/const"), 0);
        assert_eq!(at("/$defs/VelocityDocument/anyOf/0/properties/k_d/type"), "null");
        assert_eq!(at("/$defs/AdaptationDocument/properties/gain_limit/minimum"), 1.0);
        assert_eq!(at("/$defs/IntegralDocument/properties/k_i/maxItems"), 3);
        assert_eq!(at("/$defs/SignsDocument/properties/model/minimum"), -1.0);
        assert_eq!(at("/$defs/ComputedTorqueGains/properties/k_p/minItems"), 1);
        assert_eq!(at("/$defs/ComputedTorqueGains/properties/k_p/maxItems"), 3);
        assert_eq!(at("/$defs/SchemeDocument/oneOf").as_array().map(Vec::len), Some(6));
    }
}
