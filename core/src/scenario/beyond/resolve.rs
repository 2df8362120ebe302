//! What the optional parts may say. Fills in defaults where they would otherwise hide in code.

use super::document::{
    AdaptationDocument, AdaptationKind, EffectsDocument, ElasticityDocument, SignsDocument, VelocityDocument,
    VelocityKind,
};
use super::velocity_kind;
use crate::robots::{RobotData, payload_parameters};
use crate::scenario::document::{MethodDocument, ScenarioDocument, SchemeDocument};
use crate::scenario::error::{Problem, ScenarioError};
use crate::scenario::gains::{ModelParameters, ProposedGains};
use crate::scenario::validate::{Check, at_most, length, range};

/// Ranges, all inclusive.
pub(super) mod limits {
    pub const BANDWIDTH_RAD_S: [f64; 2] = [0.1, 1e5];
    pub const OBSERVER_GAIN: [f64; 2] = [0.0, 1e5];
    pub const STRENGTH: [f64; 2] = [0.0, 1e4];
    pub const DEAD_ZONE_RAD_S: [f64; 2] = [0.0, 10.0];
    pub const FILTER_RAD_S: [f64; 2] = [1e-3, 1e4];
    pub const GAIN_LIMIT: [f64; 2] = [1.0, 1e6];
    pub const STACK: [usize; 2] = [1, 200];
    pub const RECORD_S: [f64; 2] = [1e-3, 1e3];
    pub const EXCITATION_FLOOR: [f64; 2] = [1e-8, 1.0];
    pub const PERIOD_S: [f64; 2] = [1e-6, 1.0];
    pub const ENCODER_STEP_RAD: [f64; 2] = [0.0, 0.1];
    pub const POSITION_NOISE_RAD: [f64; 2] = [0.0, 0.1];
    pub const VELOCITY_NOISE_RAD_S: [f64; 2] = [0.0, 10.0];
    pub const TORQUE_LIMIT_NM: [f64; 2] = [0.0, 1e6];
    pub const VOLTAGE_LIMIT_V: [f64; 2] = [0.0, 1e5];
    pub const DISTURBANCE_NM: [f64; 2] = [-1e4, 1e4];
    pub const FREQUENCY_RAD_S: [f64; 2] = [0.0, 1e3];
    pub const TIME_S: [f64; 2] = [0.0, 1e5];
    pub const MASS_KG: [f64; 2] = [0.0, 100.0];
    pub const PAYLOADS: usize = 100;
    pub const EXCESS_NM: [f64; 2] = [0.0, 1e3];
    pub const STIFFNESS_NM_RAD: [f64; 2] = [1.0, 1e9];
    pub const SPRING_DAMPING_NMS_RAD: [f64; 2] = [0.0, 1e6];
    pub const MOTOR_INERTIA_KGM2: [f64; 2] = [1e-6, 1e3];
    /// Motors against their springs, per integration step: Runge and Kutta's method is stable below 2.8.
    pub const STEP_ANGLE: f64 = 2.0;
    pub const STRIBECK_RAD_S: [f64; 2] = [1e-4, 10.0];
    pub const THETA_HAT_SCALE: [f64; 2] = [0.0, 100.0];
    pub const INTEGRAL_GAIN: [f64; 2] = [0.0, 1e6];
    pub const SIGN: [f64; 2] = [-1.0, 1.0];
}

const PER_JOINT: &str = "one per joint of the robot";
const PER_PARAMETER: &str = "one per parameter of the robot";

/// Checks the optional parts of a document whose other parts have been resolved.
pub(in crate::scenario) fn resolve(document: &mut ScenarioDocument, robot: &RobotData) -> Check {
    if let Some(mut velocity) = document.velocity.take() {
        resolve_velocity(&mut velocity, &document.scheme, robot)?;
        document.velocity = Some(velocity);
    }
    if let Some(adaptation) = &mut document.adaptation {
        needs_estimates("/adaptation", &document.scheme)?;
        resolve_adaptation(adaptation)?;
        if let Some(record_s) = adaptation.record_every_s {
            check_record(record_s, document)?;
        }
    }
    if let Some(integral) = &document.integral {
        let (joints, limits) = (robot.joint_count(), limits::INTEGRAL_GAIN);
        numbers("/integral/k_i", &integral.k_i, joints, PER_JOINT, limits, "N·m/(rad·s)")?;
    }
    if let Some(signs) = &document.signs {
        needs_estimates("/signs", &document.scheme)?;
        let SignsDocument { feedback, reference, model, adaptation } = *signs;
        for (name, sign) in
            [("feedback", feedback), ("reference", reference), ("model", model), ("adaptation", adaptation)]
        {
            optional(&format!("/signs/{name}"), sign, limits::SIGN, "")?;
        }
    }
    if let Some(effects) = document.effects.take() {
        check_loads(&effects, robot)?;
        if let Some(elasticity) = &effects.elasticity {
            check_elasticity(elasticity, robot, document.integration.step_s)?;
        }
        check_sensors(&effects, document)?;
        check_clock(&effects, document)?;
        if let Some(scale) = &effects.theta_hat_scale {
            needs_estimates_or_model("/effects/theta_hat_scale", &document.scheme)?;
            numbers(
                "/effects/theta_hat_scale",
                scale,
                robot.parameter_count(),
                PER_PARAMETER,
                limits::THETA_HAT_SCALE,
                "",
            )?;
        }
        document.effects = Some(effects);
    }
    Ok(())
}

fn resolve_velocity(velocity: &mut VelocityDocument, scheme: &SchemeDocument, robot: &RobotData) -> Check {
    use VelocityKind::{FilteredDifference, HighGain, Measured, Observer};
    let is_linear = matches!(velocity.kind, FilteredDifference | HighGain);
    let VelocityDocument { kind, bandwidth_rad_s, lambda_z, lambda_x, k_d } = velocity;
    if is_linear {
        let bandwidth = *bandwidth_rad_s.get_or_insert(300.0);
        range("/velocity/bandwidth_rad_s", bandwidth, limits::BANDWIDTH_RAD_S, "rad/s")?;
    } else if bandwidth_rad_s.is_some() {
        return conflict("/velocity/bandwidth_rad_s", "belongs to kinds filtered_difference and high_gain");
    }
    let own = match scheme {
        SchemeDocument::Proposed(Some(gains)) => gains.clone(),
        _ => ProposedGains::default(),
    };
    for (name, gains, default) in
        [("lambda_z", lambda_z, own.lambda_z), ("lambda_x", lambda_x, own.lambda_x), ("k_d", k_d, own.k_d)]
    {
        let pointer = format!("/velocity/{name}");
        match kind {
            Observer => {
                let gains = gains.get_or_insert(default);
                numbers(&pointer, gains, robot.joint_count(), PER_JOINT, limits::OBSERVER_GAIN, "1/s")?;
            }
            Measured | FilteredDifference | HighGain if gains.is_some() => {
                return conflict(&pointer, "belongs to kind observer");
            }
            Measured | FilteredDifference | HighGain => {}
        }
    }
    Ok(())
}

fn resolve_adaptation(adaptation: &mut AdaptationDocument) -> Check {
    use AdaptationKind::{Concurrent, Drem, LeastSquares};
    for (name, value, limits, unit) in [
        ("sigma", adaptation.sigma, limits::STRENGTH, ""),
        ("e_modification", adaptation.e_modification, limits::STRENGTH, ""),
        ("dead_zone_rad_s", adaptation.dead_zone_rad_s, limits::DEAD_ZONE_RAD_S, "rad/s"),
        ("normalisation", adaptation.normalisation, limits::STRENGTH, ""),
    ] {
        optional(&format!("/adaptation/{name}"), value, limits, unit)?;
    }
    let AdaptationDocument { kind, .. } = *adaptation;
    let weight = if kind == Concurrent { 1.0 } else { 0.1 };
    for (name, value, default, limits, unit, kinds) in [
        ("filter_rad_s", &mut adaptation.filter_rad_s, 15.0, limits::FILTER_RAD_S, "rad/s", FILTERING),
        ("weight", &mut adaptation.weight, weight, limits::STRENGTH, "", &[LeastSquares, Concurrent]),
        ("forgetting", &mut adaptation.forgetting, 1.0, limits::STRENGTH, "1/s", &[LeastSquares, Drem]),
        ("gain_limit", &mut adaptation.gain_limit, 2.0, limits::GAIN_LIMIT, "", &[LeastSquares]),
        ("record_every_s", &mut adaptation.record_every_s, 0.1, limits::RECORD_S, "s", &[Concurrent]),
        ("rate_per_s", &mut adaptation.rate_per_s, 1.0, limits::STRENGTH, "1/s", &[Drem]),
        ("excitation_floor", &mut adaptation.excitation_floor, 1e-3, limits::EXCITATION_FLOOR, "", &[Drem]),
    ] {
        let pointer = format!("/adaptation/{name}");
        if kinds.contains(&kind) {
            range(&pointer, *value.get_or_insert(default), limits, unit)?;
        } else if value.is_some() {
            return conflict(&pointer, &belongs_to(kinds));
        }
    }
    if kind == Concurrent {
        let stack = *adaptation.stack.get_or_insert(20);
        range("/adaptation/stack", stack as f64, limits::STACK.map(|count| count as f64), "moments")?;
    } else if adaptation.stack.is_some() {
        return conflict("/adaptation/stack", &belongs_to(&[Concurrent]));
    }
    Ok(())
}

/// Kinds that filter the dynamics by themselves.
const FILTERING: &[AdaptationKind] =
    &[AdaptationKind::LeastSquares, AdaptationKind::Concurrent, AdaptationKind::Drem];

fn belongs_to(kinds: &[AdaptationKind]) -> String {
    let name = |kind: &AdaptationKind| match kind {
        AdaptationKind::Scheme => "scheme",
        AdaptationKind::LeastSquares => "least_squares",
        AdaptationKind::Concurrent => "concurrent",
        AdaptationKind::Drem => "drem",
    };
    let names: Vec<_> = kinds.iter().map(name).collect();
    format!("belongs to {} {}", if names.len() == 1 { "kind" } else { "kinds" }, names.join(", "))
}

/// Moments are recorded with a step, and with a sample where the controller has a clock.
fn check_record(record_s: f64, document: &ScenarioDocument) -> Check {
    let pointer = "/adaptation/record_every_s";
    if document.integration.method != MethodDocument::Rk4 {
        return conflict("/integration/method", "recorded moments need fixed steps: use rk4");
    }
    whole_number(pointer, record_s, document.integration.step_s, "integration steps")?;
    let period_s = document.effects.as_ref().and_then(|effects| effects.sampling.as_ref()).map(|it| it.period_s);
    period_s.filter(|period_s| *period_s != 0.0).map_or(Ok(()), |period_s| {
        whole_number(pointer, record_s, period_s, "sampling periods")
    })
}

fn whole_number(pointer: &str, time_s: f64, unit_s: f64, what: &str) -> Check {
    let count = time_s / unit_s;
    if (count - count.round()).abs() > 1e-6 * count.max(1.0) {
        return conflict(pointer, &format!("{time_s} s is {count} {what} of {unit_s} s; it must be a whole number of them"));
    }
    Ok(())
}

fn check_elasticity(elasticity: &ElasticityDocument, robot: &RobotData, step_s: f64) -> Check {
    let ElasticityDocument { stiffness_nm_rad, motor_inertia_kgm2, damping_nms_rad, .. } = elasticity;
    let joints = robot.joint_count();
    let none = vec![0.0; joints];
    let damping = damping_nms_rad.as_ref().unwrap_or(&none);
    for (name, list, limits, unit) in [
        ("stiffness_nm_rad", stiffness_nm_rad, limits::STIFFNESS_NM_RAD, "N·m/rad"),
        ("damping_nms_rad", damping, limits::SPRING_DAMPING_NMS_RAD, "N·m·s/rad"),
        ("motor_inertia_kgm2", motor_inertia_kgm2, limits::MOTOR_INERTIA_KGM2, "kg·m²"),
    ] {
        numbers(&format!("/effects/elasticity/{name}"), list, joints, PER_JOINT, limits, unit)?;
    }
    for joint in 0..joints {
        let (k, j) = (stiffness_nm_rad[joint], motor_inertia_kgm2[joint]);
        let (frequency, decay) = ((k / j).sqrt(), damping[joint] / j);
        for (name, rate) in [("stiffness_nm_rad", frequency), ("damping_nms_rad", decay)] {
            if rate * step_s > limits::STEP_ANGLE {
                let longest_s = limits::STEP_ANGLE / rate;
                let message = format!("makes the motor too fast for steps of {step_s} s; at most {longest_s:.2e} s would do");
                return conflict(&format!("/effects/elasticity/{name}/{joint}"), &message);
            }
        }
    }
    Ok(())
}

fn check_loads(effects: &EffectsDocument, robot: &RobotData) -> Check {
    let joints = robot.joint_count();
    let per_joint = |pointer: &str, list: &Option<Vec<f64>>, limits| {
        list.as_ref().map_or(Ok(()), |list| numbers(pointer, list, joints, PER_JOINT, limits, "N·m"))
    };
    per_joint("/effects/torque_limit_nm", &effects.torque_limit_nm, limits::TORQUE_LIMIT_NM)?;
    optional("/effects/voltage_limit_v", effects.voltage_limit_v, limits::VOLTAGE_LIMIT_V, "V")?;
    if let Some(disturbance) = &effects.disturbance {
        per_joint("/effects/disturbance/constant_nm", &disturbance.constant_nm, limits::DISTURBANCE_NM)?;
        per_joint("/effects/disturbance/sine_nm", &disturbance.sine_nm, limits::DISTURBANCE_NM)?;
        let pointer = "/effects/disturbance/frequency_rad_s";
        optional(pointer, disturbance.frequency_rad_s, limits::FREQUENCY_RAD_S, "rad/s")?;
        span("/effects/disturbance", disturbance.from_s, disturbance.to_s)?;
    }
    if let Some(stribeck) = &effects.stribeck {
        numbers("/effects/stribeck/excess_nm", &stribeck.excess_nm, joints, PER_JOINT, limits::EXCESS_NM, "N·m")?;
        range("/effects/stribeck/velocity_rad_s", stribeck.velocity_rad_s, limits::STRIBECK_RAD_S, "rad/s")?;
    }
    let Some(payloads) = &effects.payloads else { return Ok(()) };
    at_most("/effects/payloads", payloads.len(), limits::PAYLOADS, "payloads")?;
    if !payloads.is_empty() && payload_parameters(robot).is_none() {
        return conflict("/effects/payloads", &format!("what a payload does to robot {} is not known", robot.id));
    }
    for (n, payload) in payloads.iter().enumerate() {
        let pointer = format!("/effects/payloads/{n}");
        range(&format!("{pointer}/mass_kg"), payload.mass_kg, limits::MASS_KG, "kg")?;
        span(&pointer, payload.from_s, payload.to_s)?;
    }
    Ok(())
}

fn check_sensors(effects: &EffectsDocument, document: &ScenarioDocument) -> Check {
    let is_sampled = effects.sampling.as_ref().is_some_and(|sampling| sampling.period_s != 0.0);
    let has_sensor = velocity_kind(document) == VelocityKind::Measured;
    for (name, value, limits, unit) in [
        ("encoder_step_rad", effects.encoder_step_rad, limits::ENCODER_STEP_RAD, "rad"),
        ("position_noise_rad", effects.position_noise_rad, limits::POSITION_NOISE_RAD, "rad"),
        ("velocity_noise_rad_s", effects.velocity_noise_rad_s, limits::VELOCITY_NOISE_RAD_S, "rad/s"),
    ] {
        let pointer = format!("/effects/{name}");
        optional(&pointer, value, limits, unit)?;
        let is_on = value.is_some_and(|value| value != 0.0);
        if is_on && !is_sampled {
            return conflict(&pointer, "needs samples: give effects.sampling a period_s");
        }
        if is_on && name == "velocity_noise_rad_s" && !has_sensor {
            return conflict(&pointer, "needs a velocity sensor: this controller has none");
        }
    }
    Ok(())
}

/// Whatever happens in one instant needs fixed steps, and a clock that they divide.
fn check_clock(effects: &EffectsDocument, document: &ScenarioDocument) -> Check {
    let integration = &document.integration;
    let mut needs_steps =
        effects.disturbance.is_some() || effects.payloads.as_ref().is_some_and(|list| !list.is_empty());
    if let Some(sampling) = &effects.sampling {
        let (period_s, delay_s) = (sampling.period_s, sampling.delay_s);
        needs_steps |= period_s != 0.0;
        if period_s != 0.0 {
            range("/effects/sampling/period_s", period_s, limits::PERIOD_S, "s (or 0 for a continuous controller)")?;
        }
        range("/effects/sampling/delay_s", delay_s, [0.0, period_s], "s, at most the period")?;
        for (name, time_s) in [("period_s", period_s), ("delay_s", delay_s)] {
            let pointer = format!("/effects/sampling/{name}");
            whole_number(&pointer, time_s, integration.step_s, "integration steps")?;
        }
    }
    if needs_steps && integration.method != MethodDocument::Rk4 {
        return conflict("/integration/method", "samples, payloads and disturbances need fixed steps: use rk4");
    }
    Ok(())
}

fn needs_estimates(pointer: &str, scheme: &SchemeDocument) -> Check {
    match scheme {
        SchemeDocument::Proposed(_) | SchemeDocument::TangArteaga(_) | SchemeDocument::SlotineLi(_) => Ok(()),
        SchemeDocument::Pd(_) | SchemeDocument::PdGravity(_) | SchemeDocument::ComputedTorque(_) => {
            conflict(pointer, "has no meaning for a scheme that does not adapt")
        }
    }
}

/// Whether there are numbers in the model that can be off.
fn needs_estimates_or_model(pointer: &str, scheme: &SchemeDocument) -> Check {
    let parameters = match scheme {
        SchemeDocument::PdGravity(gains) => gains.as_ref().map(|gains| gains.parameters),
        SchemeDocument::ComputedTorque(gains) => gains.as_ref().map(|gains| gains.parameters),
        _ => return needs_estimates(pointer, scheme),
    };
    if parameters == Some(ModelParameters::True) {
        return conflict(pointer, "has no meaning beside true parameters; take nominal ones");
    }
    Ok(())
}

fn span(pointer: &str, from_s: Option<f64>, to_s: Option<f64>) -> Check {
    optional(&format!("{pointer}/from_s"), from_s, limits::TIME_S, "s")?;
    optional(&format!("{pointer}/to_s"), to_s, limits::TIME_S, "s")?;
    match to_s {
        Some(to_s) if to_s < from_s.unwrap_or(0.0) => {
            conflict(&format!("{pointer}/to_s"), &format!("{to_s} s is before from_s"))
        }
        _ => Ok(()),
    }
}

fn numbers(
    pointer: &str,
    list: &[f64],
    count: usize,
    why: &'static str,
    limits: [f64; 2],
    unit: &'static str,
) -> Check {
    length(pointer, list.len(), count, why)?;
    list.iter().enumerate().try_for_each(|(n, value)| range(&format!("{pointer}/{n}"), *value, limits, unit))
}

fn optional(pointer: &str, value: Option<f64>, limits: [f64; 2], unit: &'static str) -> Check {
    value.map_or(Ok(()), |value| range(pointer, value, limits, unit))
}

fn conflict(pointer: &str, message: &str) -> Check {
    Err(ScenarioError::new(pointer, Problem::Conflict { message: message.to_owned() }))
}
