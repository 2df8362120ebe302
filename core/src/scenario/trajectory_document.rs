//! The part of a scenario that says where the robot should go, as it is written and read.
//!
//! Fields are stable: add, never rename; a field that is not given is not written. Which belong to which kind, and what is
//! allowed in them, is decided in `validate_trajectory`.

use crate::robots::Bend;
use serde::{Deserialize, Serialize};

/// The desired trajectory. One struct for all kinds, so that a mistake in it is found at its place.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = super::schema::trajectory))]
#[serde(deny_unknown_fields)]
pub struct TrajectoryDocument {
    /// Which; each kind has fields of its own.
    pub kind: TrajectoryKind,
    /// Base angular frequency of `fourier` and `random_fourier`, lowest of `chirp`, rad/s; 1 when left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frequency_rad_s: Option<f64>,
    /// Constant part per joint, deg.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub offset_deg: Option<Vec<f64>>,
    /// Amplitudes of the sines per joint and harmonic, deg; none when left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sine_deg: Option<Vec<Vec<f64>>>,
    /// Amplitudes of the cosines per joint and harmonic, deg; none when left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cosine_deg: Option<Vec<Vec<f64>>>,
    /// Number of harmonics of `random_fourier`; 5 when left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub harmonics: Option<usize>,
    /// Level of excitation of `random_fourier`: root mean square of each joint's desired velocity, deg/s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rms_deg_s: Option<f64>,
    /// Amplitude of `chirp` per joint, deg.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub amplitude_deg: Option<Vec<f64>>,
    /// Highest angular frequency of `chirp`, rad/s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frequency_end_rad_s: Option<f64>,
    /// Time in which `chirp` goes from the lowest frequency to the highest, s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sweep_s: Option<f64>,
    /// Joint angles of `minimum_jerk`, point by point, or of `samples`, row by row, deg.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub points_deg: Option<Vec<Vec<f64>>>,
    /// Times of `samples`, one per row of `points_deg`, s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub times_s: Option<Vec<f64>>,
    /// Time of one move of `minimum_jerk` or one way of `line`, s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub move_s: Option<f64>,
    /// Pause of `minimum_jerk` after each move, s; 0 when left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dwell_s: Option<f64>,
    /// Where `line` starts, m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub from_m: Option<Vec<f64>>,
    /// Where `line` turns back, m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub to_m: Option<Vec<f64>>,
    /// Centre of `circle`, m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub centre_m: Option<Vec<f64>>,
    /// Radius of `circle`, m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub radius_m: Option<f64>,
    /// Direction across `circle`; up for the A465, out of their plane for planar robots when left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub normal: Option<Vec<f64>>,
    /// Time of one round of `circle`, s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub period_s: Option<f64>,
    /// Which way the elbow points on `line` and `circle`; up when left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub elbow: Option<ElbowDocument>,
}

/// Which way the elbow points.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum ElbowDocument {
    /// The last joint's angle is negative.
    #[default]
    Up,
    /// The last joint's angle is positive.
    Down,
}

impl From<ElbowDocument> for Bend {
    fn from(elbow: ElbowDocument) -> Self {
        match elbow {
            ElbowDocument::Up => Self::Up,
            ElbowDocument::Down => Self::Down,
        }
    }
}

/// Kind of trajectory.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum TrajectoryKind {
    /// Paper eq. (24); for the A465 only.
    #[default]
    Paper,
    /// A finite Fourier series per joint.
    Fourier,
    /// The robot's own: `paper` for the A465, a `fourier` for each other. The canonical form says which.
    Default,
    /// A Fourier series drawn from the scenario's seed, at a chosen level of excitation.
    RandomFourier,
    /// Sines whose frequency glides up and down.
    Chirp,
    /// From point to point with minimum jerk; the last is held.
    MinimumJerk,
    /// A straight line of the tip, to and fro with minimum jerk.
    Line,
    /// A circle of the tip at constant speed.
    Circle,
    /// A table of joint angles, interpolated smoothly from rest to rest.
    Samples,
}

impl TrajectoryKind {
    /// Every kind.
    pub const ALL: [Self; 9] = [
        Self::Paper,
        Self::Fourier,
        Self::Default,
        Self::RandomFourier,
        Self::Chirp,
        Self::MinimumJerk,
        Self::Line,
        Self::Circle,
        Self::Samples,
    ];

    /// Name in scenarios.
    pub const fn id(self) -> &'static str {
        match self {
            Self::Paper => "paper",
            Self::Fourier => "fourier",
            Self::Default => "default",
            Self::RandomFourier => "random_fourier",
            Self::Chirp => "chirp",
            Self::MinimumJerk => "minimum_jerk",
            Self::Line => "line",
            Self::Circle => "circle",
            Self::Samples => "samples",
        }
    }
}

impl TrajectoryDocument {
    /// Every field beside the kind, and whether it is given.
    pub(super) fn given(&self) -> [(&'static str, bool); 20] {
        [
            ("frequency_rad_s", self.frequency_rad_s.is_some()),
            ("offset_deg", self.offset_deg.is_some()),
            ("sine_deg", self.sine_deg.is_some()),
            ("cosine_deg", self.cosine_deg.is_some()),
            ("harmonics", self.harmonics.is_some()),
            ("rms_deg_s", self.rms_deg_s.is_some()),
            ("amplitude_deg", self.amplitude_deg.is_some()),
            ("frequency_end_rad_s", self.frequency_end_rad_s.is_some()),
            ("sweep_s", self.sweep_s.is_some()),
            ("points_deg", self.points_deg.is_some()),
            ("times_s", self.times_s.is_some()),
            ("move_s", self.move_s.is_some()),
            ("dwell_s", self.dwell_s.is_some()),
            ("from_m", self.from_m.is_some()),
            ("to_m", self.to_m.is_some()),
            ("centre_m", self.centre_m.is_some()),
            ("radius_m", self.radius_m.is_some()),
            ("normal", self.normal.is_some()),
            ("period_s", self.period_s.is_some()),
            ("elbow", self.elbow.is_some()),
        ]
    }

    /// The robot's own, whichever robot it is.
    pub fn of_robot() -> Self {
        Self { kind: TrajectoryKind::Default, ..Self::default() }
    }
}
