//! The scheme's Lyapunov function along a run, and where it rises although theory says that it must not.
//!
//! Schemes with a sliding variable: `V = ½ sᵀ H s + ½ θ̃ᵀ Γ⁻¹ θ̃`. With a measured velocity and the gradient law,
//! `V̇ = −sᵀ (K + D) s − sᵀ F_c (sgn q̇ − sgn v_r) ≤ 0` (Slotine and Li 1987); composite laws take `δ θ̃ᵀ Γ⁻¹ Z θ̃` off it as well, which
//! is sure to be positive only for a scalar Γ. The paper leaves out the analysis of its own scheme, so there V is only a yardstick.
//! PD with gravity: `½ ėᵀ H ė + ½ eᵀ Kp e`; computed torque: `½ ėᵀ ė + ½ eᵀ Kp e`, `V̇ = −ėᵀ Kd ė`. The rate here is V's difference over
//! each interval between samples: it needs no formula that could share a mistake.

use super::pass::Pass;
use super::{Trace, Traced};
use serde::Serialize;

/// V counts as risen where it rises by more than this share of its largest value: rounding, and the integrator's error.
const RISE: f64 = 1e-9;

/// V along a run.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct LyapunovSummary {
    /// V at the start.
    pub start: f64,
    /// V at the end.
    pub end: f64,
    /// Largest rate over an interval between samples, per second.
    pub largest_rate: f64,
    /// Intervals over which V rises, as a share of all.
    pub rising_share: f64,
    /// Time at which it first rises, s.
    pub first_rise_s: Option<f64>,
    /// Largest difference between the rate and what feedback and friction alone would make of it, per second: what adaptation, observers
    /// and imperfections add. Of the order of the sampling error where the gradient law works as its proof assumes.
    pub largest_excess_rate: f64,
}

/// Follows V from row to row; `None` where the scheme has none.
pub(super) fn summarise(pass: &Pass, trace: &mut Trace) -> Option<LyapunovSummary> {
    let (first, last) = (pass.lyapunov.first()?, pass.lyapunov.last()?);
    let tolerance = RISE * pass.lyapunov.iter().fold(0.0, |most, (value, _)| value.max(most));
    let mut summary = LyapunovSummary {
        start: first.0,
        end: last.0,
        largest_rate: 0.0,
        rising_share: 0.0,
        first_rise_s: None,
        largest_excess_rate: 0.0,
    };
    let mut rises = 0;
    for (row, (value, _)) in pass.lyapunov.iter().enumerate() {
        trace.set(Traced::Lyapunov, row, *value);
    }
    for (row, pair) in pass.lyapunov.windows(2).enumerate() {
        let [(before, caused_before), (after, caused_after)] = [pair[0], pair[1]];
        let rate = (after - before) / (pass.times_s[row + 1] - pass.times_s[row]);
        trace.set(Traced::LyapunovRate, row, rate);
        summary.largest_rate = if row == 0 { rate } else { summary.largest_rate.max(rate) };
        let excess = rate - 0.5 * (caused_before + caused_after);
        summary.largest_excess_rate = summary.largest_excess_rate.max(excess.abs());
        if after - before > tolerance {
            rises += 1;
            summary.first_rise_s.get_or_insert(pass.times_s[row]);
        }
    }
    summary.rising_share = f64::from(rises) / (pass.lyapunov.len() - 1).max(1) as f64;
    Some(summary)
}
