//! The optional parts of a scenario document, as they are written and read. Fields are stable: add, never rename.

use serde::{Deserialize, Serialize};

/// Defines a struct of optional fields, each left out of the canonical form while it is absent.
macro_rules! optional_fields {
    (
        $(#[$outer:meta])*
        $name:ident, $schema:path {
            $($(#[$own:meta])* $required:ident: $required_type:ty,)*
            ;
            $($(#[$meta:meta])* $field:ident: $type:ty,)*
        }
    ) => {
        $(#[$outer])*
        #[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
        #[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
        #[cfg_attr(feature = "schema", schemars(transform = $schema))]
        #[serde(deny_unknown_fields)]
        pub struct $name {
            $($(#[$own])* pub $required: $required_type,)*
            $($(#[$meta])* #[serde(default, skip_serializing_if = "Option::is_none")] pub $field: Option<$type>,)*
        }
    };
}

/// Where a controller's velocity comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum VelocityKind {
    /// A sensor.
    #[default]
    Measured,
    /// `ω s / (s + ω)` of the joint angle.
    FilteredDifference,
    /// The paper's model-free observer. Source: paper eq. (21) to (23).
    Observer,
    /// A linear high-gain observer with a double pole at −ω.
    HighGain,
}

optional_fields! {
    /// The velocity source, in place of the scheme's own.
    VelocityDocument, super::schema::velocity {
        /// Which.
        kind: VelocityKind,
        ;
        /// Bandwidth ω of `filtered_difference` and `high_gain`, rad/s; 300 when left out.
        bandwidth_rad_s: f64,
        /// Λ_z of `observer`, 1/s, per joint; the scheme's own when left out, or else the paper's.
        lambda_z: Vec<f64>,
        /// Λ_x of `observer`, 1/s, per joint; likewise.
        lambda_x: Vec<f64>,
        /// K_d of `observer`, 1/s, per joint; likewise.
        k_d: Vec<f64>,
    }
}

/// The law that moves the estimates.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum AdaptationKind {
    /// The scheme's own.
    #[default]
    Scheme,
    /// Least squares with bounded-gain forgetting; starts from the scheme's adaptation gain.
    LeastSquares,
    /// The gradient beside recorded moments; with the scheme's adaptation gain.
    Concurrent,
    /// Dynamic regressor extension and mixing: each parameter by itself, without the gradient.
    Drem,
}

optional_fields! {
    /// Changes to the adaptation: another law, and modifications that go with every law; 0 is none.
    AdaptationDocument, super::schema::adaptation {
        /// Which law.
        #[serde(default)]
        kind: AdaptationKind,
        ;
        /// σ of σ-modification, in units of the gradient per parameter.
        sigma: f64,
        /// κ of e-modification, the same per rad/s.
        e_modification: f64,
        /// φ of the dead zone on the sliding variable, rad/s.
        dead_zone_rad_s: f64,
        /// ν of normalisation.
        normalisation: f64,
        /// Bandwidth of the filter that spares the acceleration, rad/s; 15 when left out. Not of kind `scheme`.
        filter_rad_s: f64,
        /// `least_squares`, `concurrent`: weight γ of prediction errors; 0.1 and 1 when left out.
        weight: f64,
        /// `least_squares`, `drem`: forgetting rate λ0, 1/s; 1 when left out.
        forgetting: f64,
        /// `least_squares`: largest trace of the gain, as a multiple of the first one; 2 when left out.
        gain_limit: f64,
        /// `concurrent`: moments that the stack holds; 20 when left out.
        stack: usize,
        /// `concurrent`: time between moments that are looked at, s, a whole number of steps and of sampling periods; 0.1 when left out.
        record_every_s: f64,
        /// `drem`: rate at which errors fade under full excitation, 1/s; 1 when left out.
        rate_per_s: f64,
        /// `drem`: excitation (geometric over arithmetic mean of the eigenvalues) at which they fade half as fast; 0.001 when left out.
        excitation_floor: f64,
    }
}

/// Integral action beside a scheme's own law: `τ − K_i ∫ e dt`, from zero at the start.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = super::schema::integral))]
#[serde(deny_unknown_fields)]
pub struct IntegralDocument {
    /// K_i per joint, N·m/(rad·s); 0 is none.
    pub k_i: Vec<f64>,
}

optional_fields! {
    /// Factors on the terms of an adaptive scheme: 1 is right, −1 is a misprinted sign, to see what it does.
    SignsDocument, super::schema::signs {
        ;
        /// Of `−K s`; 1 when left out.
        feedback: f64,
        /// Of `Λ e` in the reference velocity; likewise.
        reference: f64,
        /// Of the model's torque `Y θ̂`; likewise.
        model: f64,
        /// Of the estimates' rate; likewise.
        adaptation: f64,
    }
}

/// A controller that runs on a clock.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = super::schema::sampling))]
#[serde(deny_unknown_fields)]
pub struct SamplingDocument {
    /// Period T, s, a whole number of integration steps; 0 means a continuous controller.
    pub period_s: f64,
    /// From a sample to its torque, s, a whole number of integration steps; at most the period.
    #[serde(default)]
    pub delay_s: f64,
}

optional_fields! {
    /// A torque from outside, per joint: `constant + sine · sin(frequency · t)`.
    DisturbanceDocument, super::schema::disturbance {
        ;
        /// Constant part per joint, N·m; none when left out.
        constant_nm: Vec<f64>,
        /// Amplitude per joint, N·m; none when left out.
        sine_nm: Vec<f64>,
        /// Angular frequency of the sine, rad/s; 1 when left out.
        frequency_rad_s: f64,
        /// Begins at, s; the start when left out.
        from_s: f64,
        /// Ends at, s; never when left out.
        to_s: f64,
    }
}

optional_fields! {
    /// A mass at the flange for a while.
    PayloadDocument, super::schema::payload {
        /// Mass, kg.
        mass_kg: f64,
        ;
        /// Picked up at, s, with the first integration step that starts then or later; the start when left out.
        from_s: f64,
        /// Dropped at, s, likewise; never when left out.
        to_s: f64,
    }
}

/// Friction beyond Coulomb's near rest: `excess · sgn(v) / (1 + (v / velocity)²)`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = super::schema::stribeck))]
#[serde(deny_unknown_fields)]
pub struct StribeckDocument {
    /// Excess of static over Coulomb friction per joint, N·m.
    pub excess_nm: Vec<f64>,
    /// Velocity at which half of it is gone, rad/s.
    pub velocity_rad_s: f64,
}

/// Which side of a joint's spring sensors sit on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum EncodersDocument {
    /// The motor's.
    #[default]
    Motor,
    /// The link's.
    Link,
}

optional_fields! {
    /// Elastic joints. Source: Spong (1987).
    ElasticityDocument, super::schema::elasticity {
        /// Stiffness of the springs per joint, N·m/rad.
        stiffness_nm_rad: Vec<f64>,
        /// The motors' share of the arm's inertia per joint, behind the gear, kg·m².
        motor_inertia_kgm2: Vec<f64>,
        /// Which side sensors sit on.
        #[serde(default)]
        encoders: EncodersDocument,
        ;
        /// Damping of the springs per joint, N·m·s/rad; none when left out.
        damping_nms_rad: Vec<f64>,
    }
}

optional_fields! {
    /// Imperfections of the arm, its sensors and its controller's computer. The controller is told of none of them.
    EffectsDocument, super::schema::effects {
        ;
        /// The controller runs on a clock.
        sampling: SamplingDocument,
        /// Angle between two encoder counts, rad (the CRS A465's: 1.571e-5); 0 is a perfect encoder. Needs `sampling`.
        encoder_step_rad: f64,
        /// Standard deviation of the noise on measured angles, rad. Needs `sampling`.
        position_noise_rad: f64,
        /// Standard deviation of the noise on measured velocities, rad/s. Needs `sampling` and a velocity sensor.
        velocity_noise_rad_s: f64,
        /// Largest torque per joint, N·m.
        torque_limit_nm: Vec<f64>,
        /// Largest motor voltage, V.
        voltage_limit_v: f64,
        /// A torque from outside.
        disturbance: DisturbanceDocument,
        /// Masses at the flange; those that overlap add up.
        payloads: Vec<PayloadDocument>,
        /// More friction near rest.
        stribeck: StribeckDocument,
        /// Springs between motors and links.
        elasticity: ElasticityDocument,
        /// Initial estimates as multiples of the robot's nominal parameters, one each; all 0, as in the paper, when left out. Of a
        /// yardstick with nominal parameters: what its model is computed with; all 1 when left out.
        theta_hat_scale: Vec<f64>,
    }
}
