//! What the paper's tables and claims ask of one run, up to a horizon and with indices over a window: a few dozen numbers.
//!
//! A verdict needs these of the three schemes and nothing of their samples; so a search keeps them and drops the samples.

use super::claims::FEWEST_SAMPLES;
use crate::metrics::{SETTLING_BAND_DEG_S, peak, performance_index, settling_time_s};
use crate::recording::{Recording, Signal};
use crate::scenario::Run;
use std::ops::Range;

/// Joints of the study's arm, and its parameters.
pub(super) const JOINTS: usize = 3;
pub(super) const PARAMETERS: usize = 18;

/// An estimate counts as constant if it moves less than this share of its whole range in the last sixth of the run.
const CONSTANT: f64 = 0.05;

/// Numbers of one run. Angles in degrees; one number per joint unless said otherwise.
#[derive(Debug, Clone, PartialEq)]
pub struct Findings {
    /// `I(e)` over the window, deg.
    pub index_e_deg: [f64; JOINTS],
    /// `I(ė)` over the window, deg/s.
    pub index_de_deg_s: [f64; JOINTS],
    /// What depends on the horizon only.
    pub horizon: HorizonFindings,
}

/// What depends on the horizon and not on the window.
#[derive(Debug, Clone, PartialEq)]
pub struct HorizonFindings {
    /// Peak `|z|`, deg; none where velocity is measured.
    pub z_peak_deg: [Option<f64>; JOINTS],
    /// `I(e)` over the second half divided by that over the first.
    pub growth_e: [f64; JOINTS],
    /// The same of z; not a number where velocity is measured.
    pub growth_z: [f64; JOINTS],
    /// When ė settles, s; none where it never does.
    pub settling_de_s: [Option<f64>; JOINTS],
    /// `I(ė3)` over the last sixth divided by that over the whole horizon.
    pub late_share: f64,
    /// Estimates that move less than 5 % of their range in the last sixth.
    pub settled_estimates: f64,
    /// `|θ̂ − θ| / θ` at the horizon, per parameter.
    pub distance: [f64; PARAMETERS],
}

/// Samples of a recording up to a horizon.
#[derive(Clone, Copy)]
pub(super) struct Horizon<'a> {
    pub recording: &'a Recording,
    /// Samples that count; one more row says where the run was at the horizon.
    pub samples: usize,
}

impl Horizon<'_> {
    /// Index of a signal of one joint over a range of samples, deg or deg/s.
    fn index(&self, signal: Signal, joint: usize, range: Range<usize>) -> f64 {
        performance_index(self.recording.signal(signal, joint).skip(range.start).take(range.len())).to_degrees()
    }

    /// The samples between two shares of the horizon.
    pub fn range(&self, from: f64, to: f64) -> Range<usize> {
        let count = self.samples as f64;
        (from * count) as usize..(to * count) as usize
    }

    /// `I(e)` and `I(ė)` over a window.
    pub fn indices(&self, window: &Range<usize>) -> [[f64; JOINTS]; 2] {
        [Signal::Error, Signal::ErrorRate]
            .map(|signal| std::array::from_fn(|joint| self.index(signal, joint, window.clone())))
    }

    /// What does not depend on the window; `theta` are the true parameters.
    pub fn findings(&self, observed: bool, theta: &[f64]) -> HorizonFindings {
        let growth = |signal, joint| {
            self.index(signal, joint, self.range(0.5, 1.0)) / self.index(signal, joint, self.range(0.0, 0.5))
        };
        let rate = |from| self.index(Signal::ErrorRate, JOINTS - 1, self.range(from, 1.0));
        let z = |joint| self.recording.signal(Signal::ObserverError, joint).take(self.samples);
        let settling = |joint| {
            let rates = self.recording.signal(Signal::ErrorRate, joint).take(self.samples);
            settling_time_s(self.recording.times_s(), rates, SETTLING_BAND_DEG_S.to_radians())
        };
        HorizonFindings {
            z_peak_deg: std::array::from_fn(|joint| observed.then(|| peak(z(joint)).to_degrees())),
            growth_e: std::array::from_fn(|joint| growth(Signal::Error, joint)),
            growth_z: std::array::from_fn(|joint| growth(Signal::ObserverError, joint)),
            settling_de_s: std::array::from_fn(settling),
            late_share: rate(5.0 / 6.0) / rate(0.0),
            settled_estimates: (0..PARAMETERS).filter(|k| self.is_settled(*k)).count() as f64,
            distance: std::array::from_fn(|k| (self.estimate(k) - theta[k]).abs() / theta[k]),
        }
    }

    /// An estimate at the horizon.
    fn estimate(&self, parameter: usize) -> f64 {
        self.recording.signal(Signal::ThetaHat, parameter).nth(self.samples).unwrap_or(f64::NAN)
    }

    /// Whether an estimate has come to rest; one that never moved has.
    fn is_settled(&self, parameter: usize) -> bool {
        let range = |skip: usize| {
            let values = self.recording.signal(Signal::ThetaHat, parameter).take(self.samples).skip(skip);
            let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)));
            high - low
        };
        let whole = range(0);
        whole <= 0.0 || range(self.samples * 5 / 6) / whole < CONSTANT
    }
}

impl HorizonFindings {
    /// Names of its numbers in a row.
    pub(super) fn names() -> Vec<String> {
        let per_joint = ["z_peak_deg", "growth_e", "growth_z", "settling_de_s"];
        let mut names = Vec::new();
        for (name, count) in per_joint.map(|name| (name, JOINTS)) {
            names.extend((1..=count).map(|n| format!("{name}_{n}")));
        }
        names.extend(["late_share".to_owned(), "settled_estimates".to_owned()]);
        names.extend((1..=PARAMETERS).map(|k| format!("distance_{k}")));
        names
    }

    /// Its numbers in a row; none where there is no finite one.
    pub(super) fn numbers(&self) -> Vec<Option<f64>> {
        let finite = |x: &f64| x.is_finite().then_some(*x);
        let mut numbers = self.z_peak_deg.to_vec();
        numbers.extend(self.growth_e.iter().chain(&self.growth_z).map(finite));
        numbers.extend(self.settling_de_s);
        numbers.extend([finite(&self.late_share), finite(&self.settled_estimates)]);
        numbers.extend(self.distance.iter().map(finite));
        numbers
    }

    /// Back from the numbers of a row.
    pub(super) fn read(numbers: &[Option<f64>]) -> Self {
        let mut rest = numbers.iter().copied();
        let mut next = || rest.next().flatten();
        let mut joints = || std::array::from_fn::<_, JOINTS, _>(|_| next());
        let [z_peak_deg, growth_e, growth_z, settling_de_s] = std::array::from_fn(|_| joints());
        let number = |x: Option<f64>| x.unwrap_or(f64::NAN);
        let (late_share, settled_estimates) = (number(next()), number(next()));
        Self {
            z_peak_deg,
            growth_e: growth_e.map(number),
            growth_z: growth_z.map(number),
            settling_de_s,
            late_share,
            settled_estimates,
            distance: std::array::from_fn(|_| number(next())),
        }
    }
}

impl Findings {
    /// Of a whole run with its end; `None` if it diverged or has too few samples.
    pub fn of(run: &Run) -> Option<Self> {
        let samples = run.report.samples;
        if run.report.at_s.is_some() || samples < FEWEST_SAMPLES {
            return None;
        }
        let horizon = Horizon { recording: &run.recording, samples };
        let [index_e_deg, index_de_deg_s] = horizon.indices(&(0..samples));
        let observed = run.report.metrics.z_peak_deg.is_some();
        Some(Self { index_e_deg, index_de_deg_s, horizon: horizon.findings(observed, &run.report.theta_true) })
    }
}
