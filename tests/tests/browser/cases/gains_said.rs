//! What the page's texts say of small and large gains, run by the core: a text whose numbers drift fails here.

use crate::bench::Bench;
use crate::native::edited;
use crate::page::{Page, Screen};
use adaptarm_core::recording::Signal;
use adaptarm_core::scenario::Scheme::{Proposed, SlotineLi, TangArteaga};
use adaptarm_core::scenario::{OutcomeKind, Run, Scenario, Scheme};
use anyhow::{Context, Result, ensure};
use serde_json::{Value, json};
use std::ops::RangeInclusive;

/// What a text speaks of. Ratios are to the run with the paper's values.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Of {
    /// Ratio of I(e), by joint.
    Index,
    /// I(e2), °.
    Index2Deg,
    /// Ratio of the observer error's peaks, by joint.
    Observer,
    /// Ratio of the torque peaks, by joint.
    Torque,
    /// Largest torque peak of all joints, N·m.
    TorqueNm,
    /// Ratio of the second differences of joint 2's torque: how rough it is from sample to sample.
    Roughness2,
    /// Ratio of the norm of the parameter error at the end.
    ParameterError,
    /// How many estimates end within 10 % of the truth.
    Close,
    /// Lowest value that any estimate has along the run.
    Lowest,
    /// Highest multiple of its true value that any estimate has along the run.
    Highest,
    /// When it diverges, s.
    Diverges,
}

type Said = (Scheme, &'static str, f64, Of, &'static [RangeInclusive<f64>]);

/// Scheme, gain, factor on the paper's value, and what is said: one range, or one per joint.
#[rustfmt::skip]
const SAID: &[Said] = &[
    (Proposed, "k_v", 0.1, Of::Index, &[1.9..=4.0]),
    (Proposed, "k_v", 0.1, Of::ParameterError, &[0.0..=0.9]),
    (Proposed, "k_v", 10.0, Of::Index, &[0.108..=0.145]),
    (Proposed, "k_v", 10.0, Of::ParameterError, &[1.1..=2.0]),
    (Proposed, "lambda", 0.1, Of::Index, &[9.0..=11.0]),
    (Proposed, "lambda", 0.1, Of::ParameterError, &[0.97..=1.03]),
    (Proposed, "lambda", 10.0, Of::Index, &[0.09..=0.11]),
    (Proposed, "lambda", 10.0, Of::Torque, &[1.19..=1.35]),
    (Proposed, "lambda_z", 0.1, Of::Index, &[0.9999..=1.0001]),
    (Proposed, "lambda_z", 0.1, Of::Torque, &[0.9999..=1.0001]),
    (Proposed, "lambda_z", 0.1, Of::Observer, &[3.0..=4.0]),
    (Proposed, "lambda_z", 10.0, Of::Index, &[0.9999..=1.0001]),
    (Proposed, "lambda_z", 10.0, Of::Observer, &[0.105..=0.12]),
    (Proposed, "lambda_x", 0.1, Of::Index, &[0.99..=1.01]),
    (Proposed, "lambda_x", 0.1, Of::Observer, &[0.1..=0.51]),
    (Proposed, "lambda_x", 10.0, Of::Diverges, &[0.0..=0.1]),
    (Proposed, "k_d", 0.1, Of::TorqueNm, &[1000.0..=20_000.0]),
    (Proposed, "k_d", 0.1, Of::Index2Deg, &[3.0..=20.0]),
    (Proposed, "k_d", 3.0, Of::Observer, &[0.28..=0.36]),
    (Proposed, "k_d", 3.0, Of::Index, &[0.99..=1.0]),
    (Proposed, "k_d", 10.0, Of::Diverges, &[0.0..=12.0]),
    (Proposed, "beta", 0.1, Of::Index, &[1.02..=1.065]),
    (Proposed, "beta", 10.0, Of::Index, &[0.715..=0.825]),
    (Proposed, "beta", 10.0, Of::ParameterError, &[0.0..=0.9]),
    (Proposed, "gamma", 0.1, Of::Index, &[1.02..=1.065]),
    (Proposed, "gamma", 10.0, Of::Index, &[0.715..=0.825]),
    (Proposed, "gamma", 10.0, Of::ParameterError, &[0.0..=0.9]),
    (Proposed, "forgetting", 1.0, Of::Close, &[0.0..=0.0]),
    (Proposed, "forgetting", 0.0, Of::Close, &[11.0..=11.0]),
    (Proposed, "forgetting", 0.0, Of::Index, &[0.45..=0.55]),
    (Proposed, "forgetting", 10.0, Of::Index, &[1.02..=1.065]),
    (Proposed, "filter_rad_s", 0.1, Of::Index, &[1.0..=1.015]),
    (Proposed, "filter_rad_s", 10.0, Of::Index, &[0.999..=1.001]),
    (Proposed, "rho", 0.4, Of::Index, &[0.9995..=1.0005]),
    (Proposed, "rho", 0.4, Of::Lowest, &[-2e-4..=-9.5e-5]),
    (Proposed, "rho", 10.0, Of::Index, &[0.9995..=1.0005]),
    (Proposed, "rho", 10.0, Of::Lowest, &[-8.5e-5..=0.0]),
    (Proposed, "gamma_adapt", 0.1, Of::Index, &[1.2..=1.5]),
    (Proposed, "gamma_adapt", 10.0, Of::Index, &[0.4..=0.6]),
    (Proposed, "gamma_adapt", 10.0, Of::Highest, &[7.0..=10.0]),
    (Proposed, "lower_margin", 0.1, Of::Index, &[0.9995..=1.0005]),
    (Proposed, "lower_margin", 10.0, Of::Index, &[0.9995..=1.0005]),
    (Proposed, "lower_margin", 10.0, Of::Lowest, &[-4.5e-4..=-3.5e-4]),
    (Proposed, "upper_factor", 1.0, Of::Highest, &[0.0..=1.4]),
    (Proposed, "upper_factor", 0.01, Of::Index, &[1.1..=1.4]),
    (Proposed, "upper_factor", 0.01, Of::Highest, &[0.095..=0.102]),
    (Proposed, "upper_factor", 10.0, Of::Index, &[1.0..=1.0]),
    (TangArteaga, "k_s", 0.1, Of::Index, &[5.0..=6.0, 2.0..=3.0, 1.4..=1.6]),
    (TangArteaga, "k_s", 0.1, Of::Highest, &[20.0..=200.0]),
    (TangArteaga, "k_s", 10.0, Of::Index, &[0.1..=0.165]),
    (TangArteaga, "k_s", 10.0, Of::ParameterError, &[1.2..=1.3]),
    (TangArteaga, "lambda", 0.1, Of::Index, &[9.0..=11.0]),
    (TangArteaga, "lambda", 10.0, Of::Index, &[0.09..=0.11]),
    (TangArteaga, "lambda", 10.0, Of::Roughness2, &[5.0..=50.0]),
    (TangArteaga, "delta", 0.1, Of::Index, &[0.999..=1.001]),
    (TangArteaga, "delta", 10.0, Of::Index, &[0.99..=1.01]),
    (TangArteaga, "delta", 1000.0, Of::TorqueNm, &[150.0..=900.0]),
    (TangArteaga, "gamma", 0.1, Of::Index, &[0.999..=1.001]),
    (TangArteaga, "gamma", 10.0, Of::Index, &[0.99..=1.01]),
    (TangArteaga, "gamma", 1000.0, Of::TorqueNm, &[150.0..=900.0]),
    (TangArteaga, "forgetting", 0.0, Of::Index, &[0.94..=0.96]),
    (TangArteaga, "forgetting", 10.0, Of::Index, &[0.999..=1.001]),
    (TangArteaga, "filter_rad_s", 0.1, Of::Index, &[0.999..=1.001]),
    (TangArteaga, "filter_rad_s", 10.0, Of::Index, &[0.999..=1.001]),
    (TangArteaga, "gamma_adapt", 0.1, Of::Index, &[1.0..=1.03, 1.15..=1.25, 1.4..=1.6]),
    (TangArteaga, "gamma_adapt", 10.0, Of::Index, &[0.88..=0.92, 0.43..=0.58, 0.43..=0.58]),
    (TangArteaga, "gamma_adapt", 10.0, Of::Lowest, &[-8.5..=-7.5]),
    (TangArteaga, "gamma_adapt", 10.0, Of::Highest, &[75.0..=77.0]),
    (SlotineLi, "k_s", 0.1, Of::Index, &[2.9..=4.0]),
    (SlotineLi, "k_s", 0.1, Of::ParameterError, &[0.0..=0.9]),
    (SlotineLi, "k_s", 10.0, Of::Index, &[0.11..=0.165]),
    (SlotineLi, "k_s", 10.0, Of::ParameterError, &[1.1..=1.2]),
    (SlotineLi, "k_s", 100.0, Of::Diverges, &[0.0..=12.0]),
    (SlotineLi, "lambda", 0.1, Of::Index, &[4.0..=6.0]),
    (SlotineLi, "lambda", 10.0, Of::Index, &[0.1..=0.112]),
    (SlotineLi, "lambda", 10.0, Of::Torque, &[1.09..=1.26]),
    (SlotineLi, "gamma_adapt", 0.1, Of::Index, &[1.08..=1.12, 1.15..=1.25, 1.4..=1.6]),
    (SlotineLi, "gamma_adapt", 10.0, Of::Index, &[0.43..=0.57]),
    (SlotineLi, "gamma_adapt", 10.0, Of::Lowest, &[-1.35..=-1.25]),
];

/// At a step of 0.1 ms: what is the step's fault ends, what is the loop's does not.
const FINE_STEP: &[(Scheme, &str, f64, OutcomeKind)] = &[
    (Proposed, "k_d", 10.0, OutcomeKind::Completed),
    (Proposed, "lambda_x", 10.0, OutcomeKind::Diverged),
    (SlotineLi, "k_s", 100.0, OutcomeKind::Completed),
];

pub fn what_is_said_of_gains_is_so(bench: &Bench) -> Result<()> {
    for (scheme, gain, factor, of, ranges) in SAID {
        let found = measure(*of, &run(*scheme, gain, *factor, None)?, &run(*scheme, gain, 1.0, None)?)?;
        for (joint, value) in found.iter().enumerate() {
            let range = &ranges[joint.min(ranges.len() - 1)];
            ensure!(
                range.contains(value),
                "{} {gain} × {factor}: {of:?} of joint {} is {value}, said to be in {range:?}",
                scheme.id(),
                joint + 1
            );
        }
    }
    for (scheme, gain, factor, outcome) in FINE_STEP {
        let found = run(*scheme, gain, *factor, Some(1e-4))?.report.outcome;
        ensure!(found == *outcome, "{} {gain} × {factor}: {found:?} with a step of 0.1 ms", scheme.id());
    }

    // Every gain has something said of it, and between the ends of its range its runs end.
    let page = Page::open(bench, Screen::Desktop)?;
    let gains =
        page.run_async("const done = arguments[0]; import('/js/explain/gains.js').then((m) => done(m.GAINS))", &[])?;
    for scheme in Scheme::ALL {
        for (gain, facts) in gains[scheme.id()].as_object().context("no gains of a scheme")? {
            let twin = if gain == "upper_hard_factor" { "upper_factor" } else { gain };
            for factor in facts["tries"].as_array().context("no tries")? {
                ensure!(
                    SAID.iter()
                        .any(|said| said.0 == scheme && said.1 == twin && json!(said.2) == json!(factor.as_f64())),
                    "{} {gain} × {factor}: nothing proves what is said",
                    scheme.id()
                );
            }
            for factor in facts["range"].as_array().context("no range")? {
                let outcome = run(scheme, gain, factor.as_f64().context("no number")?, None)?.report.outcome;
                ensure!(outcome == OutcomeKind::Completed, "{} {gain} × {factor}: {outcome:?}", scheme.id());
            }
        }
    }
    Ok(())
}

/// The paper's run of a scheme with one gain scaled; the projection's two upper bounds go together.
fn run(scheme: Scheme, gain: &str, factor: f64, step_s: Option<f64>) -> Result<Run> {
    let mut document = edited(scheme, &[])?;
    let names = match gain {
        "upper_factor" | "upper_hard_factor" => vec!["projection/upper_factor", "projection/upper_hard_factor"],
        "lower_margin" => vec!["projection/lower_margin"],
        plain => vec![plain],
    };
    for name in names {
        let value = document.pointer_mut(&format!("/scheme/gains/{name}")).context("no such gain")?;
        *value = match &*value {
            Value::Array(numbers) => numbers.iter().map(|number| scaled(number, factor)).collect::<Result<_>>()?,
            number => scaled(number, factor)?,
        };
    }
    if let Some(step_s) = step_s {
        document["integration"]["step_s"] = json!(step_s);
    }
    Ok(Scenario::read(&document)?.run())
}

fn scaled(number: &Value, factor: f64) -> Result<Value> {
    Ok(json!(number.as_f64().context("no number")? * factor))
}

fn measure(of: Of, run: &Run, paper: &Run) -> Result<Vec<f64>> {
    let ratios = |own: &[f64], theirs: &[f64]| own.iter().zip(theirs).map(|(a, b)| a / b).collect();
    let (own, theirs) = (&run.report, &paper.report);
    let truth = &own.theta_true;
    let estimates =
        || (0..truth.len()).flat_map(|k| run.recording.signal(Signal::ThetaHat, k).map(move |x| (x, truth[k])));
    if of == Of::Diverges {
        return Ok(vec![own.at_s.context("it does not diverge")?]);
    }
    ensure!(own.outcome == OutcomeKind::Completed, "{:?} at {:?}", own.outcome, own.at_s);
    Ok(match of {
        Of::Index => ratios(&own.metrics.index_e_deg, &theirs.metrics.index_e_deg),
        Of::Index2Deg => vec![own.metrics.index_e_deg[1]],
        Of::Observer => ratios(
            own.metrics.z_peak_deg.as_ref().context("no observer")?,
            theirs.metrics.z_peak_deg.as_ref().context("no observer")?,
        ),
        Of::Torque => ratios(&own.metrics.tau_peak_nm, &theirs.metrics.tau_peak_nm),
        Of::TorqueNm => vec![own.metrics.tau_peak_nm.iter().fold(0.0, |a: f64, b| a.max(*b))],
        Of::Roughness2 => vec![roughness(run) / roughness(paper)],
        Of::ParameterError => vec![distance(&own.theta_hat_end, truth) / distance(&theirs.theta_hat_end, truth)],
        Of::Close => {
            vec![own.theta_hat_end.iter().zip(truth).filter(|(a, b)| (*a - *b).abs() < 0.1 * *b).count() as f64]
        }
        Of::Lowest => vec![estimates().map(|(estimate, _)| estimate).fold(f64::INFINITY, f64::min)],
        Of::Highest => vec![estimates().map(|(estimate, true_value)| estimate / true_value).fold(0.0, f64::max)],
        Of::Diverges => Vec::new(),
    })
}

fn distance(estimates: &[f64], truth: &[f64]) -> f64 {
    estimates.iter().zip(truth).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
}

/// Root mean square of the second differences of joint 2's torque after the first second.
fn roughness(run: &Run) -> f64 {
    let torque: Vec<_> = run.recording.signal(Signal::Torque, 1).skip(250).collect();
    torque.windows(3).map(|x| (x[2] - 2.0 * x[1] + x[0]).powi(2)).sum::<f64>().sqrt()
}
