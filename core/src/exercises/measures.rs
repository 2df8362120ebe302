//! Numbers by which a run is judged: the metrics of experiments, and how far the estimates are from the truth.
//!
//! `theta_error_percent`: `100 sqrt(mean ((θ̂_i − θ_i) / θ_i)²)` at the end of the run, over the parameters that are not zero;
//! `theta_error_percent_k` is `100 |θ̂_k − θ_k| / |θ_k|`.

use crate::experiments::ResultColumns;
use crate::robots::RobotData;
use crate::scenario::Report;

const THETA_ERROR: &str = "theta_error_percent";

/// Where a criterion finds its number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Measure {
    /// Place among the columns of experiments.
    Column(usize),
    /// Of all parameters.
    ThetaError,
    /// Of one, from 0.
    ThetaErrorOf(usize),
}

/// Names of all metrics for a robot.
pub fn metric_names(robot: &RobotData) -> Vec<String> {
    let parameters = (1..=robot.parameter_count()).map(|k| format!("{THETA_ERROR}_{k}"));
    let columns = ResultColumns::new(robot.joint_count());
    columns.names().iter().cloned().chain([THETA_ERROR.to_owned()]).chain(parameters).collect()
}

impl Measure {
    /// The metric of this name.
    pub fn find(name: &str, robot: &RobotData) -> Option<Self> {
        if let Some(place) = ResultColumns::new(robot.joint_count()).place(name) {
            return Some(Self::Column(place));
        }
        match name.strip_prefix(THETA_ERROR)? {
            "" => Some(Self::ThetaError),
            rest => {
                // As metric_names writes it: no sign, no leading zero.
                let k: usize = rest.strip_prefix('_')?.parse().ok()?;
                let named = format!("_{k}") == rest && (1..=robot.parameter_count()).contains(&k);
                named.then(|| Self::ThetaErrorOf(k - 1))
            }
        }
    }

    /// Of a run that was completed; nothing where there is no number, as for an arm that never settles.
    pub fn of(self, report: &Report, columns: &[Option<f64>]) -> Option<f64> {
        match self {
            Self::Column(place) => columns.get(place).copied().flatten(),
            Self::ThetaErrorOf(k) => relative_error(*report.theta_hat_end.get(k)?, *report.theta_true.get(k)?),
            Self::ThetaError => {
                let pairs = report.theta_hat_end.iter().zip(&report.theta_true);
                let errors: Vec<_> = pairs.filter_map(|(estimate, truth)| relative_error(*estimate, *truth)).collect();
                let squares: f64 = errors.iter().map(|error| error * error).sum();
                (!errors.is_empty()).then(|| (squares / errors.len() as f64).sqrt())
            }
        }
    }
}

/// `100 |estimate − truth| / |truth|`; nothing where the truth is zero.
fn relative_error(estimate: f64, truth: f64) -> Option<f64> {
    (truth != 0.0).then(|| 100.0 * ((estimate - truth) / truth).abs())
}
