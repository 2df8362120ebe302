//! Energy balance of a run: what the actuators supplied went into motion, height and friction.
//!
//! `ΔT + ΔU = ∫ q̇ᵀ τ dt − ∫ q̇ᵀ (D q̇ + F_c sgn q̇) dt + ∫ q̇ᵀ d dt`, from paper eq. (1) and property 2.2. What remains is the error
//! of the trapezoids, the energy that a payload brings with it, or a torque that changes between samples.

use super::pass::Pass;
use super::{Trace, Traced};
use serde::Serialize;

/// Energies of a run, J.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct EnergySummary {
    /// Kinetic energy at the end minus at the start, J.
    pub kinetic_change_j: f64,
    /// Potential energy at the end minus at the start, J.
    pub potential_change_j: f64,
    /// Work of the actuators, J.
    pub supplied_j: f64,
    /// Work lost to friction, J.
    pub dissipated_j: f64,
    /// Work of the disturbance, J.
    pub disturbance_j: f64,
    /// Largest gap in the balance along the run, J.
    pub largest_gap_j: f64,
}

/// Adds up the powers; `None` where there are none.
pub(super) fn summarise(pass: &Pass, trace: &mut Trace) -> Option<EnergySummary> {
    let first = *pass.energy.first()?;
    let mut sum = EnergySummary {
        kinetic_change_j: 0.0,
        potential_change_j: 0.0,
        supplied_j: 0.0,
        dissipated_j: 0.0,
        disturbance_j: 0.0,
        largest_gap_j: 0.0,
    };
    let mut before = first;
    for (row, now) in pass.energy.iter().enumerate() {
        if row > 0 {
            let half_s = 0.5 * (pass.times_s[row] - pass.times_s[row - 1]);
            sum.supplied_j += half_s * (before.supplied + now.supplied);
            sum.dissipated_j += half_s * (before.dissipated + now.dissipated);
            sum.disturbance_j += half_s * (before.disturbance + now.disturbance);
            before = *now;
        }
        sum.kinetic_change_j = now.kinetic - first.kinetic;
        sum.potential_change_j = now.potential - first.potential;
        let stored = sum.kinetic_change_j + sum.potential_change_j;
        let gap = stored - sum.supplied_j + sum.dissipated_j - sum.disturbance_j;
        sum.largest_gap_j = sum.largest_gap_j.max(gap.abs());
        trace.set(Traced::Kinetic, row, now.kinetic);
        trace.set(Traced::Potential, row, now.potential);
        trace.set(Traced::Supplied, row, sum.supplied_j);
        trace.set(Traced::Dissipated, row, sum.dissipated_j);
    }
    Some(sum)
}
