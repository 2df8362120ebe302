//! What each figure shows: its panels, their labels and curves. Nothing here draws.

use crate::recording::{Recording, Signal};
use crate::robots::RobotData;
use crate::scenario::Scheme;

/// A run to be plotted.
#[derive(Debug, Clone, Copy)]
pub struct PlottedRun<'a> {
    /// Its scheme, which decides colour, dash and name.
    pub scheme: Scheme,
    /// Its samples.
    pub recording: &'a Recording,
    /// Whether it reached its duration; the last values of a diverged run must not decide a panel's range.
    pub completed: bool,
    /// True parameters of its arm; none are drawn if it is empty.
    pub theta_true: &'a [f64],
}

/// A figure.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Figure {
    /// Joint tracking errors. Paper figure 2.
    TrackingErrors,
    /// Joint velocity errors. Paper figure 3.
    VelocityErrors,
    /// Observer errors. Paper figure 4.
    ObserverErrors,
    /// Estimates of θ1 to θ6. Paper figure 5.
    Estimates1,
    /// Estimates of θ7 to θ12. Paper figure 6.
    Estimates2,
    /// Estimates of θ13 to θ18. Paper figure 7.
    Estimates3,
    /// Joint torques and the motor voltages they need.
    Torques,
}

/// One plot within a figure.
pub(super) struct Panel {
    /// What it shows, as symbol and unit: `e1 [°]`.
    pub label: String,
    /// Signal and component.
    pub signal: Signal,
    /// Component of the signal, from 0.
    pub component: usize,
    /// Factor from SI to the label's unit.
    pub factor: f64,
    /// True value to draw as a line, in the label's unit.
    pub truth: Option<f64>,
}

/// Parameters per figure of estimates.
const ESTIMATES_PER_FIGURE: usize = 6;

impl Figure {
    /// Every figure, in the paper's order.
    pub const ALL: [Self; 7] = [
        Self::TrackingErrors,
        Self::VelocityErrors,
        Self::ObserverErrors,
        Self::Estimates1,
        Self::Estimates2,
        Self::Estimates3,
        Self::Torques,
    ];

    /// Identifier, in file names and addresses.
    pub const fn id(self) -> &'static str {
        match self {
            Self::TrackingErrors => "tracking_errors",
            Self::VelocityErrors => "velocity_errors",
            Self::ObserverErrors => "observer_errors",
            Self::Estimates1 => "estimates_1",
            Self::Estimates2 => "estimates_2",
            Self::Estimates3 => "estimates_3",
            Self::Torques => "torques",
        }
    }

    /// The figure called `id`.
    pub fn from_id(id: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|figure| figure.id() == id)
    }

    /// Its number in the paper.
    pub const fn paper_number(self) -> Option<u8> {
        match self {
            Self::TrackingErrors => Some(2),
            Self::VelocityErrors => Some(3),
            Self::ObserverErrors => Some(4),
            Self::Estimates1 => Some(5),
            Self::Estimates2 => Some(6),
            Self::Estimates3 => Some(7),
            Self::Torques => None,
        }
    }

    /// Title.
    pub const fn title(self) -> &'static str {
        match self {
            Self::TrackingErrors => "Joint tracking errors",
            Self::VelocityErrors => "Joint velocity errors",
            Self::ObserverErrors => "Observer errors",
            Self::Estimates1 => "Parameter estimates θ1 to θ6",
            Self::Estimates2 => "Parameter estimates θ7 to θ12",
            Self::Estimates3 => "Parameter estimates θ13 to θ18",
            Self::Torques => "Joint torques",
        }
    }

    /// Size in layout pixels at which it looks best on paper.
    pub const fn natural_size(self) -> (u32, u32) {
        match self {
            Self::Estimates1 | Self::Estimates2 | Self::Estimates3 => (900, 680),
            _ => (900, 620),
        }
    }

    /// Panels side by side at this width, layout pixels.
    pub(super) const fn columns(self, width: f64) -> usize {
        match self {
            Self::Estimates1 | Self::Estimates2 | Self::Estimates3 if width >= 420.0 => 2,
            _ => 1,
        }
    }

    /// Whether a scheme's run belongs in the figure.
    pub fn shows(self, scheme: Scheme) -> bool {
        self != Self::ObserverErrors || scheme == Scheme::Proposed
    }

    /// Its panels, for a robot whose true parameters are `theta`.
    pub(super) fn panels(self, robot: &RobotData, theta: &[f64]) -> Vec<Panel> {
        let per_joint = |symbol: &str, unit: &str, signal: Signal| {
            (0..robot.joint_count())
                .map(|component| Panel {
                    label: format!("{symbol}{} [{unit}]", component + 1),
                    signal,
                    component,
                    factor: signal.exported().1,
                    truth: None,
                })
                .collect()
        };
        let estimates = |page: usize| {
            let first = page * ESTIMATES_PER_FIGURE;
            let shown = robot.parameters.iter().enumerate().skip(first).take(ESTIMATES_PER_FIGURE);
            shown
                .map(|(component, parameter)| Panel {
                    label: format!("{} [{}]", parameter.symbol, parameter.unit),
                    signal: Signal::ThetaHat,
                    component,
                    factor: 1.0,
                    truth: theta.get(component).copied(),
                })
                .collect()
        };
        match self {
            Self::TrackingErrors => per_joint("e", "°", Signal::Error),
            Self::VelocityErrors => per_joint("ė", "°/s", Signal::ErrorRate),
            Self::ObserverErrors => per_joint("z", "°", Signal::ObserverError),
            Self::Torques => per_joint("τ", "N·m", Signal::Torque),
            Self::Estimates1 => estimates(0),
            Self::Estimates2 => estimates(1),
            Self::Estimates3 => estimates(2),
        }
    }
}
