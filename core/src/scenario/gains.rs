//! The gains of every scheme: name, default (the paper's section 4.2), allowed range and meaning, each stated once.
//!
//! Lists have as many numbers as the robot has joints or parameters; those of robots other than the A465 are in
//! `robot_defaults`. //! The tables make the document's structs, the validation, the documentation for building a form, and the JSON Schema's
//! defaults. Adding a gain is adding a line.

use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize};

/// How many numbers a gain has.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum GainShape {
    /// One number.
    Scalar,
    /// One per joint.
    Joint,
    /// One per parameter.
    Parameter,
}

/// One gain, for validation and for people.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct GainInfo {
    /// Field name in the scenario.
    pub name: &'static str,
    /// Symbol in the paper.
    pub symbol: &'static str,
    /// SI unit.
    pub unit: &'static str,
    /// Numbers it takes.
    pub shape: GainShape,
    /// Smallest allowed value.
    pub min: f64,
    /// Largest allowed value.
    pub max: f64,
    /// What it does.
    pub meaning: &'static str,
}

/// Gains as numbers by name, whatever the scheme.
pub trait GainSet {
    /// Table of the gains, in the order of [`GainSet::values`].
    fn table(&self) -> &'static [GainInfo];
    /// The numbers of each gain.
    fn values(&self) -> Vec<&[f64]>;
    /// Gains of which nothing has been said: lists are blank.
    fn left_out() -> Self
    where
        Self: Sized;
    /// Puts other gains' lists in the place of blank ones.
    fn fill(&mut self, from: Self)
    where
        Self: Sized;
}

macro_rules! field_type {
    (Scalar) => { f64 };
    ($many:ident) => { Vec<f64> };
}

/// A gain that somebody wrote. A list has a number, for one without would mean that it was left out.
fn written<'de, D: Deserializer<'de>, G: Deserialize<'de> + Gain>(deserializer: D) -> Result<G, D::Error> {
    let gain = G::deserialize(deserializer)?;
    if gain.is_blank() { Err(D::Error::invalid_length(0, &"a number per joint or parameter")) } else { Ok(gain) }
}

/// A gain's numbers: one, or a list.
trait Gain {
    /// Whether there is none.
    fn is_blank(&self) -> bool;
    /// Takes them all away, if it can be without.
    fn blank(&mut self);
}

impl Gain for f64 {
    fn is_blank(&self) -> bool {
        false
    }
    fn blank(&mut self) {}
}

impl Gain for Vec<f64> {
    fn is_blank(&self) -> bool {
        self.is_empty()
    }
    fn blank(&mut self) {
        self.clear();
    }
}

/// Gains of which nothing has been said: lists are blank until the robot is known, single numbers are the same for all.
fn left_out<G: GainSet>() -> G {
    G::left_out()
}

macro_rules! as_slice {
    (Scalar, $value:expr) => {
        std::slice::from_ref(&$value)
    };
    ($many:ident, $value:expr) => {
        &$value
    };
}

macro_rules! gain_set {
    (
        $(#[$outer:meta])*
        $name:ident $({ $(#[$sub_meta:meta])* $sub:ident: $sub_type:ty })? [
            $($field:ident $symbol:literal $unit:literal $shape:ident $min:literal..=$max:literal = $default:expr, $meaning:literal;)*
        ]
    ) => {
        $(#[$outer])*
        #[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
        #[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
        #[cfg_attr(feature = "schema", schemars(transform = super::schema::Gains($name::TABLE)))]
        #[cfg_attr(feature = "schema", schemars(default))]
        #[serde(deny_unknown_fields, default = "left_out")]
        pub struct $name {
            $(#[doc = $meaning] #[serde(deserialize_with = "written")] pub $field: field_type!($shape),)*
            $($(#[$sub_meta])* pub $sub: $sub_type,)?
        }

        impl Default for $name {
            fn default() -> Self {
                Self { $($field: $default,)* $($sub: Default::default(),)? }
            }
        }

        impl $name {
            /// Every gain of this set.
            pub const TABLE: &'static [GainInfo] = &[$(GainInfo {
                name: stringify!($field),
                symbol: $symbol,
                unit: $unit,
                shape: GainShape::$shape,
                min: $min,
                max: $max,
                meaning: $meaning,
            },)*];
        }

        impl GainSet for $name {
            fn table(&self) -> &'static [GainInfo] {
                Self::TABLE
            }

            fn values(&self) -> Vec<&[f64]> {
                vec![$(as_slice!($shape, self.$field),)*]
            }

            fn left_out() -> Self {
                let mut gains = Self::default();
                $(gains.$field.blank();)*
                gains
            }

            fn fill(&mut self, from: Self) {
                $(if self.$field.is_blank() { self.$field = from.$field; })*
            }
        }
    };
}

gain_set! {
    /// Gains of Slotine and Li's scheme. Source: paper eq. (3) to (7), section 4.2.
    SlotineLiGains [
        k_s "K_s" "N·m·s" Joint 0.0..=1e5 = vec![95.0, 115.0, 110.0],
            "Feedback gain on the sliding variable: torque per rad/s of s.";
        lambda "Λ_e" "1/s" Joint 0.0..=1e4 = vec![10.0, 6.5, 8.0],
            "How fast the tracking error decays on the sliding surface s = 0.";
        gamma_adapt "Γ_s" "" Parameter 0.0..=1e5 = vec![
            21e-6, 17e-6, 85e-7, 0.0011, 0.001, 0.0012, 0.0017, 4.3, 0.7, 3.0, 47.0, 5.5, 42.0, 0.21, 0.69, 0.845, 40.0, 22.5,
        ], "Adaptation gain of each parameter: how fast its estimate follows the gradient.";
    ]
}

gain_set! {
    /// Gains of Tang and Arteaga's scheme. Source: paper eq. (8) to (12), section 4.2.
    TangArteagaGains [
        k_s "K_s" "N·m·s" Joint 0.0..=1e5 = vec![60.0, 15.0, 40.0],
            "Feedback gain on the sliding variable: torque per rad/s of s.";
        lambda "Λ_q" "1/s" Joint 0.0..=1e4 = vec![190.0, 230.0, 220.0],
            "How fast the tracking error decays on the sliding surface s = 0.";
        delta "δ" "" Scalar 0.0..=1e4 = 0.1,
            "Weight of the remembered prediction error in the adaptation.";
        gamma "γ_2" "" Scalar 0.0..=1e4 = 0.05,
            "How strongly new prediction errors enter the memory.";
        forgetting "λ_g" "1/s" Scalar 0.0..=1e4 = 20.0,
            "How fast the memory of prediction errors fades.";
        filter_rad_s "λ_f" "rad/s" Scalar 1e-3..=1e4 = 15.0,
            "Bandwidth of the filter that spares the acceleration.";
        gamma_adapt "Γ_1" "" Parameter 0.0..=1e5 = vec![
            0.017, 0.017, 0.01, 0.017, 0.07, 0.002, 0.01, 0.08, 0.3, 0.17, 2.8, 0.12, 30.83, 0.0001, 0.09, 0.35, 12.75, 1.02,
        ], "Adaptation gain of each parameter: how fast its estimate follows the gradient.";
    ]
}

gain_set! {
    /// Bounds of the projection that keeps estimates within reason; the bound below is zero. Source: paper eq. (19), (20).
    ProjectionBounds [
        lower_margin "θ_2 − θ_1" "" Scalar 1e-9..=1e3 = 1e-4,
            "Width of the margin below zero over which the projection grows to full strength.";
        upper_factor "θ_3 / θ_o" "" Scalar 1e-3..=1e6 = 10.0,
            "Upper bound as a multiple of each parameter's nominal value.";
        upper_hard_factor "θ_4 / θ_o" "" Scalar 1e-3..=1e6 = 10.1,
            "Where the upper margin ends, as a multiple of each parameter's nominal value.";
    ]
}

gain_set! {
    /// Gains of the proposed scheme with observer. Source: paper eq. (13) to (23), section 4.2; k_d and lambda_x are chosen.
    ProposedGains { /// Bounds of the projection. Source: paper eq. (20).
        projection: ProjectionBounds } [
        k_v "K_v" "N·m·s" Joint 0.0..=1e5 = vec![40.0, 80.0, 75.0],
            "Feedback gain on the sliding variable: torque per rad/s of s.";
        lambda "Λ" "1/s" Joint 0.0..=1e4 = vec![60.0, 80.0, 70.0],
            "How fast the tracking error decays on the sliding surface s = 0.";
        lambda_z "Λ_z" "1/s" Joint 0.0..=1e4 = vec![100.0, 50.0, 110.0],
            "Observer: how fast its error decays.";
        lambda_x "Λ_x" "1/s" Joint 0.0..=1e4 = vec![60.0, 80.0, 70.0],
            "Observer: how strongly the tracking error enters (chosen, equal to the paper's Λ; the paper omits it).";
        k_d "K_d" "1/s" Joint 0.0..=1e5 = vec![150.0, 270.0, 300.0],
            "Observer: gain on its error (chosen; the paper omits it).";
        beta "β" "" Scalar 0.0..=1e4 = 5.5,
            "Weight of the remembered prediction error in the adaptation.";
        gamma "γ" "" Scalar 0.0..=1e4 = 0.1,
            "How strongly new prediction errors enter the memory.";
        forgetting "λ" "1/s" Scalar 0.0..=1e4 = 125.0,
            "How fast the memory of prediction errors fades.";
        filter_rad_s "λ_f" "rad/s" Scalar 1e-3..=1e4 = 70.0,
            "Bandwidth of the filter that spares the acceleration.";
        rho "ρ" "" Scalar 1.0..=1e3 = 2.5,
            "Strength of the projection at the end of its margin.";
        gamma_adapt "Γ" "" Parameter 0.0..=1e5 = vec![
            21e-6, 17e-6, 85e-7, 0.0011, 0.001, 0.0012, 0.0017, 2.5, 0.7, 0.9, 47.0, 4.9, 25.0, 0.21, 0.089, 1.45, 50.0, 5.5,
        ], "Adaptation gain of each parameter: how fast its estimate follows the gradient.";
    ]
}

/// Which parameters a model that does not adapt is computed with.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum ModelParameters {
    /// The robot's nominal ones: what its designer would know.
    #[default]
    Nominal,
    /// Those of the simulated arm, without its payload: what nobody knows.
    True,
}

gain_set! {
    /// Gains of PD, the yardstick without a model. Chosen: K_s Λ and K_s of the paper's Slotine and Li, the linear part of it.
    PdGains [
        k_p "K_p" "N·m" Joint 0.0..=1e6 = vec![950.0, 747.5, 880.0],
            "Torque per rad of tracking error.";
        k_d "K_d" "N·m·s" Joint 0.0..=1e5 = vec![95.0, 115.0, 110.0],
            "Torque per rad/s of velocity error.";
    ]
}

gain_set! {
    /// Gains of PD with gravity; chosen as for PD.
    PdGravityGains { /// Which parameters gravity is computed with.
        parameters: ModelParameters } [
        k_p "K_p" "N·m" Joint 0.0..=1e6 = vec![950.0, 747.5, 880.0],
            "Torque per rad of tracking error.";
        k_d "K_d" "N·m·s" Joint 0.0..=1e5 = vec![95.0, 115.0, 110.0],
            "Torque per rad/s of velocity error.";
    ]
}

gain_set! {
    /// Gains of computed torque. Chosen: the error decays as a critically damped oscillator of 10 rad/s.
    ComputedTorqueGains { /// Which parameters the model is computed with.
        parameters: ModelParameters } [
        k_p "K_p" "1/s²" Joint 0.0..=1e6 = vec![100.0, 100.0, 100.0],
            "Acceleration per rad of tracking error.";
        k_d "K_d" "1/s" Joint 0.0..=1e5 = vec![20.0, 20.0, 20.0],
            "Acceleration per rad/s of velocity error.";
    ]
}
