//! The parameter error, split: the part that the motion excites, which an adaptation law can learn away, and the part that it cannot see.
//!
//! `x = S⁻¹ (θ̂ − θ)`, S the parameters' nominal sizes, is projected on the eigenvectors of the whole run's Gram matrix: those above and
//! those below the excitation's threshold. `‖x‖² = ‖x_excited‖² + ‖x_unexcited‖²`.

use super::excitation::{UNEXCITED, directions};
use super::gram::Gram;
use super::{Trace, Traced};
use crate::recording::{Recording, Signal};
use crate::robots::RobotData;
use serde::Serialize;

/// Norms of the relative parameter error and its parts.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ErrorNorms {
    /// `‖x‖`: the root of the number of parameters where nothing is known of a nominal arm.
    pub all: f64,
    /// Of the excited part.
    pub excited: f64,
    /// Of the unexcited part.
    pub unexcited: f64,
}

/// The parameter error at both ends of a run.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ParameterErrorSummary {
    /// At the start.
    pub start: ErrorNorms,
    /// At the end.
    pub end: ErrorNorms,
}

/// Splits the error of every row.
pub(super) fn split(
    gram: &Gram,
    theta: &[f64],
    robot: &RobotData,
    recording: &Recording,
    trace: &mut Trace,
) -> ParameterErrorSummary {
    let directions = directions(gram, theta.len());
    let most = directions.last().map_or(0.0, |pair| pair.0);
    let scales = robot.parameter_sizes();
    let columns = recording.columns();
    let mut summary = ParameterErrorSummary { start: ErrorNorms::default(), end: ErrorNorms::default() };
    for (row, numbers) in recording.rows().chunks_exact(columns.width()).enumerate() {
        let estimates = &numbers[columns.start(Signal::ThetaHat)..][..theta.len()];
        let error: Vec<_> = estimates.iter().zip(theta).zip(&scales).map(|((a, b), scale)| (a - b) / scale).collect();
        let mut squares = [0.0, 0.0];
        for (eigenvalue, direction) in &directions {
            let part: f64 = direction.iter().zip(&error).map(|(a, b)| a * b).sum();
            squares[usize::from(*eigenvalue <= UNEXCITED * most)] += part * part;
        }
        let all: f64 = error.iter().map(|x| x * x).sum();
        summary.end = ErrorNorms { all: all.sqrt(), excited: squares[0].sqrt(), unexcited: squares[1].sqrt() };
        if row == 0 {
            summary.start = summary.end;
        }
        trace.set(Traced::ExcitedError, row, summary.end.excited);
        trace.set(Traced::UnexcitedError, row, summary.end.unexcited);
    }
    summary
}
