//! What a run was worth: the paper's performance index, peaks, settling times and control effort.

use crate::recording::{Recording, Signal};
use crate::robots::RobotData;

/// A joint counts as settled once its tracking error stays within this band, deg.
pub const SETTLING_BAND_DEG: f64 = 0.1;
/// A joint's velocity counts as settled once its velocity error stays within this band, deg/s.
pub const SETTLING_BAND_DEG_S: f64 = 0.5;

/// Metrics of a recording; one number per joint.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Metrics {
    /// Performance index `I(e)`, deg. Source: paper section 4.3, Table 1.
    pub index_e_deg: Vec<f64>,
    /// Performance index `I(ė)`, deg/s. Source: paper section 4.3, Table 2.
    pub index_de_deg_s: Vec<f64>,
    /// Peak `|e|`, deg.
    pub e_peak_deg: Vec<f64>,
    /// Peak `|z|`, deg; absent where nothing observes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub z_peak_deg: Option<Vec<f64>>,
    /// Peak `|τ|`, N·m.
    pub tau_peak_nm: Vec<f64>,
    /// Peak motor voltage, V.
    pub voltage_peak_v: Vec<f64>,
    /// Root mean square torque, N·m.
    pub tau_rms_nm: Vec<f64>,
    /// Control effort `∫ τ² dt`, N²·m²·s.
    pub control_effort_n2m2s: Vec<f64>,
    /// Time after which `|e|` stays within [`SETTLING_BAND_DEG`], s; null where it never does.
    pub settling_e_s: Vec<Option<f64>>,
    /// Time after which `|ė|` stays within [`SETTLING_BAND_DEG_S`], s; null where it never does.
    pub settling_de_s: Vec<Option<f64>>,
    /// Ultimate bound: largest `|e|` over the last [`TAIL_SHARE`] of the run, deg; empty in reports of versions that did not know it.
    #[serde(default)]
    pub ultimate_bound_e_deg: Vec<f64>,
    /// Total variation of the torque per second, N·m/s; likewise.
    #[serde(default)]
    pub tau_variation_nm_s: Vec<f64>,
}

/// Performance index `I(x) = sqrt(1/k Σ_{i<k} x_i²)`; zero without samples. Source: paper section 4.3.
pub fn performance_index(samples: impl Iterator<Item = f64>) -> f64 {
    let (mut count, mut sum) = (0_u32, 0.0);
    for x in samples {
        count += 1;
        sum += x * x;
    }
    if count == 0 { 0.0 } else { (sum / f64::from(count)).sqrt() }
}

/// Largest magnitude; zero without samples.
pub fn peak(samples: impl Iterator<Item = f64>) -> f64 {
    samples.fold(0.0, |peak, x| peak.max(x.abs()))
}

/// First sample time from which on `|x|` stays within `band`; `None` where the last sample is outside.
pub fn settling_time_s(
    times_s: impl Iterator<Item = f64>,
    samples: impl Iterator<Item = f64>,
    band: f64,
) -> Option<f64> {
    let mut settled = None;
    for (time_s, x) in times_s.zip(samples) {
        if x.abs() > band {
            settled = None;
        } else if settled.is_none() {
            settled = Some(time_s);
        }
    }
    settled
}

/// Share of a run, at its end, over which an ultimate bound is taken.
pub const TAIL_SHARE: f64 = 0.25;

/// Ultimate bound: the largest magnitude in the last `share` of the samples; zero without samples.
pub fn ultimate_bound(samples: impl ExactSizeIterator<Item = f64>, share: f64) -> f64 {
    let tail = (samples.len() as f64 * share).ceil() as usize;
    let before = samples.len() - tail;
    peak(samples.skip(before))
}

/// Total variation `Σ |x_{i+1} − x_i|`.
pub fn total_variation(samples: impl Iterator<Item = f64>) -> f64 {
    let mut before = None;
    samples.fold(0.0, |sum, x| sum + (x - before.replace(x).unwrap_or(x)).abs())
}

/// How often the sign changes; zeros have none.
pub fn sign_changes(samples: impl Iterator<Item = f64>) -> usize {
    let mut before = 0.0;
    let mut changes = 0;
    for x in samples.filter(|x| *x != 0.0) {
        changes += usize::from(before * x < 0.0);
        before = x.signum();
    }
    changes
}

impl Metrics {
    /// Metrics over the first `samples` rows of a recording (the row at the end of the run is no sample); `observed` says
    /// whether a velocity observer ran, and `interval_s` is the time between samples.
    pub fn of(recording: &Recording, samples: usize, robot: &RobotData, observed: bool, interval_s: f64) -> Self {
        let per_joint = |f: &dyn Fn(usize) -> f64| (0..recording.columns().joints).map(f).collect::<Vec<_>>();
        let signal = |signal, joint| recording.signal(signal, joint).take(samples);
        let settling = |which, band: f64| {
            (0..recording.columns().joints)
                .map(|joint| settling_time_s(recording.times_s(), signal(which, joint), band.to_radians()))
                .collect()
        };
        let tau_peak_nm = per_joint(&|joint| peak(signal(Signal::Torque, joint)));
        let tau_rms_nm = per_joint(&|joint| performance_index(signal(Signal::Torque, joint)));
        let recorded_s = recording.len().min(samples) as f64 * interval_s;
        Self {
            index_e_deg: per_joint(&|joint| performance_index(signal(Signal::Error, joint)).to_degrees()),
            index_de_deg_s: per_joint(&|joint| performance_index(signal(Signal::ErrorRate, joint)).to_degrees()),
            e_peak_deg: per_joint(&|joint| peak(signal(Signal::Error, joint)).to_degrees()),
            z_peak_deg: observed.then(|| per_joint(&|joint| peak(signal(Signal::ObserverError, joint)).to_degrees())),
            voltage_peak_v: tau_peak_nm.iter().map(|tau| robot.voltage_v(*tau)).collect(),
            control_effort_n2m2s: tau_rms_nm.iter().map(|tau| tau * tau * recorded_s).collect(),
            settling_e_s: settling(Signal::Error, SETTLING_BAND_DEG),
            settling_de_s: settling(Signal::ErrorRate, SETTLING_BAND_DEG_S),
            ultimate_bound_e_deg: per_joint(&|joint| ultimate_bound(signal(Signal::Error, joint), TAIL_SHARE).to_degrees()),
            tau_variation_nm_s: per_joint(&|joint| {
                let variation = total_variation(signal(Signal::Torque, joint));
                if recorded_s > 0.0 { variation / recorded_s } else { 0.0 }
            }),
            tau_peak_nm,
            tau_rms_nm,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bounds_variation_and_changes_of_known_signals() {
        let x = [9.0, -3.0, 0.0, 2.0, 1.0, -0.5, 0.5, -1.0];
        assert_eq!(ultimate_bound(x.into_iter(), 0.25), 1.0);
        assert_eq!(ultimate_bound(x.into_iter(), 1.0), 9.0);
        assert_eq!(ultimate_bound([].into_iter(), 0.25), 0.0);
        assert_eq!(total_variation(x.into_iter()), 12.0 + 3.0 + 2.0 + 1.0 + 1.5 + 1.0 + 1.5);
        assert_eq!(sign_changes(x.into_iter()), 5);
    }

    #[test]
    fn index_and_settling_of_known_signals() {
        assert_eq!(performance_index([3.0, -3.0, 3.0].into_iter()), 3.0);
        assert_eq!(performance_index(std::iter::empty()), 0.0);
        let times = [0.0, 1.0, 2.0, 3.0];
        let settle = |x: [f64; 4]| settling_time_s(times.into_iter(), x.into_iter(), 0.5);
        assert_eq!(settle([9.0, 0.1, -7.0, 0.2]), Some(3.0));
        assert_eq!(settle([0.1, 0.1, 0.1, 0.2]), Some(0.0));
        assert_eq!(settle([0.1, 0.1, 0.1, -0.6]), None);
    }
}
