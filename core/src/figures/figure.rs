//! Which figures there are: names, sizes, and where they belong. What is in them is `panels`' business.

use crate::scenario::Scheme;

/// A figure.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Figure {
    /// Joint tracking errors `e = q − q_d`. Paper figure 2.
    TrackingErrors,
    /// Joint velocity errors `ė = q̇ − q̇_d`. Paper figure 3.
    VelocityErrors,
    /// Observer errors `z = q − q̂`. Paper figure 4.
    ObserverErrors,
    /// Estimates of θ1 to θ6. Paper figure 5.
    Estimates1,
    /// Estimates of θ7 to θ12. Paper figure 6.
    Estimates2,
    /// Estimates of θ13 to θ18. Paper figure 7.
    Estimates3,
    /// Joint torques τ, with the effort limits where they are in range. Paper eq. (3), (8), (13).
    Torques,
    /// Joint angles q beside the desired ones q_d, paper eq. (24).
    Positions,
    /// Motor voltages `v = τ Ra / (r Ka)` within the supply's limits. Paper eq. (1), section 2.1.
    Voltages,
    /// Sliding variables `s = v* − v_r`. Paper eq. (5) to (7), (15).
    SlidingVariables,
    /// Each joint's `ė` over its `e`; time is the way along the curve.
    PhasePlane,
    /// How far the estimates are from the truth, as one number: the root mean square over k of `(θ̂k − θk) / θk`. Relative,
    /// so that parameters of different units can be added: 1 where nothing is known (θ̂ = 0), 0 where everything is.
    ParameterErrorNorm,
    /// All estimates as small multiples with the true values. Paper figures 5 to 7.
    Estimates,
    /// One run's torques, split into inertia, Coriolis, gravity, viscous and dry friction. Paper eq. (1).
    TorqueParts,
    /// Smallest eigenvalue of the regressor's Gram matrix over a moving window, along the motion and along the desired one.
    Excitation,
    /// The scheme's Lyapunov function and its rate.
    Lyapunov,
    /// The relative parameter error's excited and unexcited part.
    ParameterErrorParts,
    /// Kinetic and potential energy, work of the actuators, work lost to friction.
    Energy,
}

/// Height of the legend and the time axis' title, layout pixels.
const AROUND: f64 = 60.0;

impl Figure {
    /// Every figure.
    pub const ALL: [Self; 18] = [
        Self::TrackingErrors,
        Self::VelocityErrors,
        Self::ObserverErrors,
        Self::Estimates1,
        Self::Estimates2,
        Self::Estimates3,
        Self::Torques,
        Self::Positions,
        Self::Voltages,
        Self::SlidingVariables,
        Self::PhasePlane,
        Self::ParameterErrorNorm,
        Self::Estimates,
        Self::TorqueParts,
        Self::Excitation,
        Self::Lyapunov,
        Self::ParameterErrorParts,
        Self::Energy,
    ];

    /// The figures of the replication report: the paper's in its order, and the torques.
    pub const REPLICATION: [Self; 7] = [
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
            Self::Positions => "positions",
            Self::Voltages => "voltages",
            Self::SlidingVariables => "sliding_variables",
            Self::PhasePlane => "phase_plane",
            Self::ParameterErrorNorm => "parameter_error_norm",
            Self::Estimates => "estimates",
            Self::TorqueParts => "torque_parts",
            Self::Excitation => "excitation",
            Self::Lyapunov => "lyapunov",
            Self::ParameterErrorParts => "parameter_error_parts",
            Self::Energy => "energy",
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
            _ => None,
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
            Self::Positions => "Joint angles",
            Self::Voltages => "Motor voltages",
            Self::SlidingVariables => "Sliding variables",
            Self::PhasePlane => "Phase plane of the tracking errors",
            Self::ParameterErrorNorm => "Relative error of the estimates",
            Self::Estimates => "Parameter estimates",
            Self::TorqueParts => "What the torques are spent on",
            Self::Excitation => "Excitation of the parameters",
            Self::Lyapunov => "Lyapunov function",
            Self::ParameterErrorParts => "Excited and unexcited parameter error",
            Self::Energy => "Energy",
        }
    }

    /// Size in layout pixels at which it looks best on paper.
    pub const fn natural_size(self) -> (u32, u32) {
        match self {
            Self::Estimates1 | Self::Estimates2 | Self::Estimates3 => (900, 680),
            Self::Estimates => (1080, 560),
            Self::PhasePlane => (900, 340),
            Self::ParameterErrorNorm => (900, 300),
            Self::Excitation | Self::Lyapunov | Self::ParameterErrorParts => (900, 440),
            _ => (900, 620),
        }
    }

    /// Height in layout pixels that suits a width: where there is room for fewer panels side by side, there are more rows.
    pub fn height_at(self, width: f64) -> f64 {
        let (panels, row) = match self {
            Self::Estimates => (18, 170.0),
            Self::Estimates1 | Self::Estimates2 | Self::Estimates3 => (6, 205.0),
            Self::PhasePlane => (3, 270.0),
            Self::ParameterErrorNorm => (1, 240.0),
            Self::Excitation | Self::Lyapunov | Self::ParameterErrorParts => (2, 140.0),
            Self::Energy => (4, 140.0),
            _ => (3, 140.0),
        };
        row * f64::from(u32::div_ceil(panels, self.columns(width) as u32)) + AROUND
    }

    /// Panels side by side at this width, layout pixels.
    pub(super) const fn columns(self, width: f64) -> usize {
        match self {
            Self::Estimates1 | Self::Estimates2 | Self::Estimates3 if width >= 420.0 => 2,
            Self::Estimates if width >= 1000.0 => 6,
            Self::Estimates | Self::PhasePlane if width >= 560.0 => 3,
            Self::Estimates => 2,
            _ => 1,
        }
    }

    /// Whether its values can be drawn on a symmetric-logarithmic axis: errors, which cross zero and shrink by decades.
    pub const fn has_symlog(self) -> bool {
        matches!(
            self,
            Self::TrackingErrors
                | Self::VelocityErrors
                | Self::ObserverErrors
                | Self::SlidingVariables
                | Self::ParameterErrorNorm
        )
    }

    /// Whether it shows the curves of a run's diagnostics.
    pub const fn shows_diagnostics(self) -> bool {
        matches!(self, Self::Excitation | Self::Lyapunov | Self::ParameterErrorParts | Self::Energy)
    }

    /// Whether a scheme's run belongs in the figure.
    pub fn shows(self, scheme: Scheme) -> bool {
        self != Self::ObserverErrors || scheme == Scheme::Proposed
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn identifiers_lead_back_and_the_report_keeps_its_seven() {
        for figure in Figure::ALL {
            assert_eq!(Figure::from_id(figure.id()), Some(figure));
        }
        assert_eq!(Figure::from_id("nonsense"), None);
        assert_eq!(
            Figure::REPLICATION.iter().filter_map(|figure| figure.paper_number()).collect::<Vec<_>>(),
            [2, 3, 4, 5, 6, 7]
        );
    }

    #[test]
    fn eighteen_estimates_fit_any_width() {
        let columns = |width| Figure::Estimates.columns(width);
        assert_eq!([1000.0, 999.0, 560.0, 559.0].map(columns), [6, 3, 3, 2]);
        assert!(Figure::Estimates.height_at(390.0) > 2.0 * Figure::Estimates.height_at(1000.0));
    }
}
