//! The replication search: every simulation once, what is cut from it as if it had ended there, the same summary however rows
//! come.

use super::{folded, rows};
use adaptarm_core::experiments::replication::{ReplicationSummary, Verdict, check_claims, study};
use adaptarm_core::experiments::{Experiment, Results, RowOutcome};
use adaptarm_core::scenario::{InitialVelocityDocument, Run, Scenario, ScenarioDocument};
use serde_json::{Value, json};
use std::sync::OnceLock;

const SCHEMES: [&str; 3] = ["proposed", "tang_arteaga", "slotine_li"];

fn document(section: &Value) -> Value {
    let base = |scheme: &&str| {
        json!({ "name": scheme, "scenario": {
            "format": "adaptarm.scenario/1",
            "scheme": { "kind": scheme },
            "integration": { "duration_s": 2 },
            "recording": { "samples": 200 },
        } })
    };
    let bases: Vec<_> = SCHEMES.iter().map(base).collect();
    json!({ "format": "adaptarm.experiment/1", "kind": "replication", "bases": bases, "replication": section })
}

fn section() -> Value {
    json!({
        "unknowns": [
            { "name": "start", "options": [
                { "name": "moving" },
                { "name": "at rest", "change": { "initial": { "velocity": "rest" } } },
            ] },
            { "name": "observer gain", "schemes": ["proposed"], "options": [
                { "name": "as is" },
                { "name": "double", "change": { "scheme": { "gains": { "k_d": [300, 540, 600] } } } },
                { "name": "half", "change": { "scheme": { "gains": { "k_d": [75, 135, 150] } } } },
            ] },
        ],
        "horizons_s": [2, 1],
        "windows": [{ "name": "whole" }, { "name": "late", "from": 0.5 }],
        "units": ["labelled", "radian_tables", "radians"],
        "plausible_factor": 3.0,
    })
}

fn read(document: &Value) -> Result<Experiment, String> {
    Experiment::read(document).map_err(|error| error.to_string())
}

fn done() -> &'static (Experiment, Results) {
    static DONE: OnceLock<(Experiment, Results)> = OnceLock::new();
    DONE.get_or_init(|| {
        let experiment = read(&document(&section())).unwrap();
        let rows = rows(&experiment, experiment.plan(0..u64::MAX));
        let results = folded(&experiment, rows);
        (experiment, results)
    })
}

fn summary() -> ReplicationSummary {
    let (experiment, results) = done();
    ReplicationSummary::of(experiment, results).unwrap().unwrap()
}

#[test]
fn what_an_unknown_does_not_concern_is_simulated_once() {
    let (experiment, _) = done();
    // Six of the proposed scheme, two of each other one.
    assert_eq!(experiment.runs(), Some(10));
    let all = experiment.plan(0..u64::MAX);
    let mut hashes: Vec<_> = all.iter().map(|run| run.scenario.as_ref().unwrap().hash()).collect();
    hashes.sort();
    hashes.dedup();
    assert_eq!(hashes.len(), 10, "two runs of one scenario");
    for n in (0..10).rev() {
        assert_eq!(experiment.plan(n..n + 1), all[n as usize..=n as usize]);
        let place = experiment.place(n).unwrap();
        let options = experiment.values(place.point);
        let scenario = all[n as usize].scenario.as_ref().unwrap();
        let rests = scenario.document().initial.velocity == InitialVelocityDocument::Rest;
        assert_eq!((options[0] == 1.0, SCHEMES[place.base]), (rests, scenario.scheme().id()), "run {n}");
        assert!(place.base == 0 || options[1] == 0.0, "run {n}");
    }
    assert_eq!((experiment.place(10), experiment.plan(10..12)), (None, vec![]));
}

#[test]
fn the_summary_does_not_depend_on_how_rows_come() {
    let (experiment, results) = done();
    let mut again = Results::new();
    for n in (0..10).rev() {
        let rows = rows(experiment, experiment.plan(n..n + 1));
        again.merge(experiment, &folded(experiment, rows)).unwrap();
    }
    assert!(again.rows().eq(results.rows()));
    let summary = summary();
    assert_eq!((summary.readings, summary.complete, summary.done), (6 * 2 * 2 * 3, 72, 10));
    assert_eq!(ReplicationSummary::of(experiment, &again).unwrap().unwrap(), summary);
}

fn study_of(adjust: impl Fn(&mut ScenarioDocument)) -> [Run; 3] {
    let runs: Vec<_> = study(adjust).unwrap().iter().map(Scenario::run).collect();
    runs.try_into().unwrap()
}

/// The first reading is the study of these settings, to the bit.
#[test]
fn the_first_reading_is_the_study_itself() {
    let runs = study_of(|document| {
        document.integration.duration_s = 2.0;
        document.recording.samples = 200;
    });
    let ours = numbers(&runs);
    assert_eq!(summary().first.unwrap().ours, ours);
}

fn numbers(runs: &[Run; 3]) -> Vec<f64> {
    let errors = runs.iter().flat_map(|run| run.report.metrics.index_e_deg.clone());
    let rates = runs.iter().flat_map(|run| run.report.metrics.index_de_deg_s.clone());
    errors.chain(rates).chain(runs[0].report.metrics.z_peak_deg.clone().unwrap()).collect()
}

/// A horizon of one second says what a simulation of one second says, numbers and verdicts alike.
#[test]
fn a_shorter_horizon_is_a_shorter_study() {
    let mut only = section();
    only["unknowns"] = json!([]);
    only["horizons_s"] = json!([1]);
    only["windows"] = json!([{ "name": "whole" }]);
    only["units"] = json!(["labelled"]);
    let experiment = read(&document(&only)).unwrap();
    let results = folded(&experiment, rows(&experiment, experiment.plan(0..3)));
    let summary = ReplicationSummary::of(&experiment, &results).unwrap().unwrap();
    let runs = study_of(|document| {
        document.integration.duration_s = 1.0;
        document.recording.samples = 100;
    });
    assert_eq!(summary.best[0].ours, numbers(&runs));
    let verdicts: Vec<_> = summary.claims.iter().map(|claim| claim.at_best.unwrap()).collect();
    let direct: Vec<_> = check_claims(&runs).iter().map(|claim| claim.verdict == Verdict::Holds).collect();
    assert_eq!(verdicts, direct);
    assert!(direct.contains(&true) && direct.contains(&false));
}

#[test]
fn the_best_is_the_best_and_counts_add_up() {
    let summary = summary();
    let best = &summary.best[0];
    assert!(summary.best.windows(2).all(|pair| pair[0].distance <= pair[1].distance));
    for unknown in &summary.unknowns {
        let least = unknown.options.iter().filter_map(|option| option.distance).fold(f64::INFINITY, f64::min);
        assert_eq!(least, best.distance, "{}", unknown.name);
        assert_eq!(unknown.options.iter().map(|option| option.plausible).sum::<u64>(), summary.plausible);
    }
    for claim in &summary.claims {
        assert_eq!(claim.plausible.holds + claim.plausible.does_not_hold, summary.plausible, "{}", claim.id);
    }
    for (entry, ours) in summary.entries.iter().zip(&best.ours) {
        let [least, most] = entry.plausible_ratio.unwrap();
        assert!((least..=most).contains(&(ours / entry.paper)), "{}", entry.symbol);
        assert!(entry.reached_by_plausible <= entry.reached_by);
    }
    assert!(summary.most_reached.unwrap().reached >= best.reached);
    assert!(summary.plausible > 1 && summary.plausible < summary.complete, "{}", summary.plausible);
}

/// Read in radians the tables' numbers are smaller by 180/π; the observer peaks only where they are meant too.
#[test]
fn units_are_only_read() {
    let summaries = ["labelled", "radian_tables", "radians"].map(|units| {
        let (experiment, _) = done();
        let mut document = serde_json::to_value(experiment.document()).unwrap();
        document["replication"]["units"] = json!([units]);
        let experiment = read(&document).unwrap();
        let results = folded(&experiment, done().1.rows().map(Result::unwrap));
        ReplicationSummary::of(&experiment, &results).unwrap().unwrap().first.unwrap().ours
    });
    let [labelled, tables, all] = summaries;
    for n in 0..21 {
        assert_eq!(tables[n], if n < 18 { labelled[n].to_radians() } else { labelled[n] });
        assert_eq!(all[n], labelled[n].to_radians());
    }
}

/// Of a run that diverges, the horizons before that are read.
#[test]
fn a_run_that_diverges_counts_as_far_as_it_came() {
    let mut coarse = section();
    coarse["unknowns"] = json!([{ "name": "step", "options": [
        { "name": "fine" }, { "name": "coarse", "change": { "integration": { "step_s": 0.02 } } },
    ] }]);
    coarse["horizons_s"] = json!([2, 0.6]);
    let experiment = read(&document(&coarse)).unwrap();
    let rows = rows(&experiment, experiment.plan(0..u64::MAX));
    let diverged = rows.iter().filter(|row| row.outcome == RowOutcome::Diverged).count();
    assert!(diverged > 0);
    for row in rows.iter().filter(|row| row.outcome == RowOutcome::Diverged) {
        let per_horizon = row.metrics.len() / 2;
        let at_s = row.at_s.unwrap();
        assert!(row.metrics[..per_horizon].iter().all(Option::is_none), "it never came to 2 s");
        assert_eq!(row.metrics[per_horizon].is_some(), at_s > 0.6, "{at_s}");
    }
    let summary = ReplicationSummary::of(&experiment, &folded(&experiment, rows)).unwrap().unwrap();
    assert_eq!(summary.diverged, diverged);
    assert!(summary.complete < summary.readings && summary.complete > 0);
}

#[test]
fn mistakes_are_named() {
    let said = |pointer: &str, value: Value| {
        let mut wrong = document(&section());
        *wrong.pointer_mut(pointer).unwrap() = value;
        read(&wrong).expect_err(pointer)
    };
    for (pointer, value, expected) in [
        ("/bases", json!([]), "bases: is empty"),
        ("/bases/0/scenario/scheme/kind", json!("pd"), "needs three scenarios of the crs_a465"),
        ("/bases/2/scenario/recording/samples", json!(100), "bases: differ in duration or samples"),
        ("/replication/horizons_s", json!([]), "replication.horizons_s: is empty"),
        ("/replication/horizons_s/0", json!(2.5), "2.5 is outside the allowed range"),
        ("/replication/horizons_s/0", json!(1.005), "must be a whole number of them"),
        ("/replication/horizons_s/0", json!(1), "stand here twice"),
        ("/replication/windows/1/from", json!(1), "holds no sample"),
        ("/replication/windows/1/from", json!(-1), "outside the allowed range"),
        ("/replication/windows/1/name", json!("whole"), "taken already"),
        ("/replication/units", json!(["radians", "radians"]), "names a unit twice"),
        ("/replication/units", json!([]), "replication.units: is empty"),
        ("/replication/plausible_factor", json!(0.5), "outside the allowed range"),
        ("/replication/unknowns/0/options", json!([]), "options: is empty"),
        ("/replication/unknowns/1/schemes", json!(["pd"]), "proposed, tang_arteaga, slotine_li"),
        ("/replication/unknowns/1/schemes", json!([]), "leave it out"),
        ("/replication/unknowns/1/schemes", json!(["slotine_li"]), "with base \"slotine_li\""),
        ("/replication/unknowns/0/options/1/change", json!(3), "is no object"),
        ("/replication/unknowns/0/options/1/change", json!({ "robot": "pendulum" }), "change: with base"),
        (
            "/replication/unknowns/0/options/1/change",
            json!({ "scheme": { "kind": "pd", "gains": null } }),
            "neither robot",
        ),
        ("/replication/unknowns/0/options/1/change", json!({ "recording": { "samples": 7 } }), "horizons do"),
    ] {
        let said = said(pointer, value);
        assert!(said.contains(expected), "{pointer}: {said}");
    }
    let many: Vec<_> = (0..16).map(|n| json!({ "name": format!("{n}") })).collect();
    let unknowns: Vec<_> = (0..16).map(|n| json!({ "name": format!("{n}"), "options": many })).collect();
    let said = said("/replication/unknowns", json!(unknowns));
    assert!(said.contains("readings; at most 2000000 are allowed"), "{said}");
}
