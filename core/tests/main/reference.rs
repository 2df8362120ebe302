//! Every number of the reference data (`tests/reference/`), from an independent program at the same step (RK4, 1e-4 s).
//!
//! Tolerances, docs/physics.md section 4: 1e-8 relative for Slotine-Li and Tang-Arteaga, 1e-7 for the proposed scheme, whose
//! projection is stiff; 1e-10 absolute floor. Two numbers of the 7600 are beyond any program's reach and are checked
//! otherwise: see [`CHATTER`].

use adaptarm_core::scenario::{Run, Scenario, preset};
use serde_json::Value;
use std::path::PathBuf;

fn path(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/reference").join(name)
}

/// Largest disagreement, as a multiple of what is allowed.
struct Comparison {
    relative: f64,
    worst: f64,
    at: String,
    compared: usize,
}

impl Comparison {
    fn compare(&mut self, what: &str, ours: f64, reference: f64) {
        let allowed = self.relative * reference.abs() + 1e-10;
        let excess = (ours - reference).abs() / allowed;
        self.compared += 1;
        if excess.is_nan() || excess > self.worst {
            self.worst = excess;
            self.at = format!("{what}: {ours:e} instead of {reference:e}");
        }
    }

    fn compare_list(&mut self, what: &str, ours: &[f64], reference: &Value) {
        let reference = reference.as_array().unwrap();
        assert_eq!(ours.len(), reference.len(), "{what}");
        for (n, (ours, reference)) in ours.iter().zip(reference).enumerate() {
            self.compare(&format!("{what}[{n}]"), *ours, reference.as_f64().unwrap());
        }
    }
}

/// Numbers in which the reference caught its own integrator chattering, with what may be demanded instead.
///
/// From rest, θ̂17 comes back to the projection's margin at 0.32 s so steeply that RK4 at 1e-4 s is outside its stability
/// region there. Until 0.41 s θ̂17 hops about within 3e-4 of its bound, differently after every rounding; the solution
/// itself rests at −4e-5, which `the_reference_chatters_where_it_says_so` proves. τ2 carries θ̂17 cos q2.
const CHATTER: [(&str, &str, f64); 2] =
    [("proposed_from_rest", "theta_hat_17 at 0.4 s", 5e-4), ("proposed_from_rest", "tau_nm_2 at 0.4 s", 1e-4)];

fn run(case: &str) -> Run {
    let mut document = preset(case).unwrap().document();
    document.integration.step_s = 1e-4;
    Scenario::new(document).unwrap().run()
}

fn check(case: &str, relative: f64) {
    let run = run(case);
    let mut comparison = Comparison { relative, worst: 0.0, at: String::new(), compared: 0 };

    let json: Value = serde_json::from_str(&std::fs::read_to_string(path(&format!("{case}.json"))).unwrap()).unwrap();
    let (report, metrics) = (&run.report, &run.report.metrics);
    let mut lists: Vec<(&str, &[f64])> = vec![
        ("index_e_deg", &metrics.index_e_deg),
        ("index_de_deg_s", &metrics.index_de_deg_s),
        ("tau_peak_nm", &metrics.tau_peak_nm),
        ("theta_hat_end", &report.theta_hat_end),
        ("q_end_rad", &report.q_end_rad),
    ];
    if let Some(z) = &metrics.z_peak_deg {
        lists.push(("z_peak_deg", z));
    }
    // Beside the lists the reference holds only its settings and its own convergence check.
    assert_eq!(json.as_object().unwrap().len(), lists.len() + 2, "a number of {case}.json is not compared");
    for (what, ours) in lists {
        comparison.compare_list(what, ours, &json[what]);
    }

    let ours = run.recording.to_csv();
    let table = |text: &str| -> Vec<Vec<String>> {
        text.lines().map(|line| line.split(',').map(str::to_owned).collect()).collect()
    };
    let (ours, reference) = (table(&ours), table(&std::fs::read_to_string(path(&format!("{case}.csv"))).unwrap()));
    assert_eq!(ours.len(), 3002);
    assert_eq!(reference.len(), 32);
    // The reference holds every 100th sample and the end.
    let mut ours_by_time = ours[1..].iter();
    for row in &reference[1..] {
        let time: f64 = row[0].parse().unwrap();
        let ours_row = ours_by_time.find(|ours| (ours[0].parse::<f64>().unwrap() - time).abs() < 1e-9).unwrap();
        for (name, reference) in reference[0].iter().zip(row) {
            let column = ours[0].iter().position(|ours| ours == name).unwrap();
            let what = format!("{name} at {time} s");
            let (ours, reference): (f64, f64) = (ours_row[column].parse().unwrap(), reference.parse().unwrap());
            if let Some((_, _, allowed)) = CHATTER.iter().find(|chatter| (chatter.0, chatter.1) == (case, &what)) {
                assert!((ours - reference).abs() < *allowed, "{what}: {ours} instead of {reference}");
            } else {
                comparison.compare(&what, ours, reference);
            }
        }
    }
    println!(
        "{case}: {} numbers, worst at {:.3} of the tolerance ({})",
        comparison.compared, comparison.worst, comparison.at
    );
    assert!(comparison.compared > 1000);
    assert!(comparison.worst <= 1.0, "{case}: {}", comparison.at);
}

#[test]
fn slotine_li() {
    check("slotine_li", 1e-8);
}

#[test]
fn slotine_li_from_rest() {
    check("slotine_li_from_rest", 1e-8);
}

#[test]
fn tang_arteaga() {
    check("tang_arteaga", 1e-8);
}

#[test]
fn tang_arteaga_from_rest() {
    check("tang_arteaga_from_rest", 1e-8);
}

#[test]
fn proposed() {
    check("proposed", 1e-7);
}

#[test]
fn proposed_from_rest() {
    check("proposed_from_rest", 1e-7);
}

#[test]
fn proposed_heavier_arm() {
    check("proposed_heavier_arm", 1e-7);
}

/// What [`CHATTER`] rests on: at a tenth of the reference's step, θ̂17 rests at the projection's equilibrium
/// `−1e-4 / ρ = −4e-5` at 0.4 s, and the reference's own number is far from it.
#[test]
fn the_reference_chatters_where_it_says_so() {
    let mut document = preset("proposed_from_rest").unwrap().document();
    document.integration.step_s = 1e-5;
    document.integration.duration_s = 0.4;
    document.recording.samples = 100;
    let theta_hat_17 = Scenario::new(document).unwrap().run().report.theta_hat_end[16];
    assert!((theta_hat_17 + 4e-5).abs() < 1e-9, "{theta_hat_17}");
    let csv = std::fs::read_to_string(path("proposed_from_rest.csv")).unwrap();
    let row: Vec<_> = csv.lines().nth(2).unwrap().split(',').collect();
    let reference: f64 = row[16 + 16].parse().unwrap();
    assert_eq!(row[0], "0.4");
    assert!((reference + 4e-5).abs() > 5e-5, "{reference}");
}

/// At the study's own step of 1 ms the numbers are within about 1e-6 of the reference (docs/physics.md section 4).
#[test]
fn a_millisecond_step_is_fine_enough() {
    for case in ["slotine_li", "tang_arteaga", "proposed"] {
        let report = Scenario::new(preset(case).unwrap().document()).unwrap().run().report;
        let json: Value =
            serde_json::from_str(&std::fs::read_to_string(path(&format!("{case}.json"))).unwrap()).unwrap();
        let mut comparison = Comparison { relative: 2e-6, worst: 0.0, at: String::new(), compared: 0 };
        comparison.compare_list("index_e_deg", &report.metrics.index_e_deg, &json["index_e_deg"]);
        comparison.compare_list("index_de_deg_s", &report.metrics.index_de_deg_s, &json["index_de_deg_s"]);
        println!("{case} at 1 ms: worst at {:.3} of 2e-6 ({})", comparison.worst, comparison.at);
        assert!(comparison.worst <= 1.0, "{case}: {}", comparison.at);
    }
}
