//! Experiments: every run from its number alone, the same summary however rows come, the same tuning however often it is
//! stopped.

mod mistakes;
mod tuning;

use adaptarm_core::experiments::{Experiment, ExperimentDocument, PlannedRun, Results, Row, RowOutcome, Summary};
use adaptarm_core::scenario::{Scenario, read_document};
use proptest::prelude::*;
use serde_json::{Value, json};
use std::ops::ControlFlow;
use std::sync::OnceLock;

/// A scheme for a twentieth of a second.
fn scenario(scheme: &str) -> Value {
    json!({
        "format": "adaptarm.scenario/1",
        "scheme": { "kind": scheme },
        "integration": { "duration_s": 0.05 },
        "recording": { "samples": 50 },
    })
}

fn experiment(kind: &str, bases: &[&str], section: &Value) -> Result<Experiment, String> {
    let bases: Vec<_> = bases.iter().map(|name| json!({ "name": name, "scenario": scenario(name) })).collect();
    let mut document = json!({ "format": "adaptarm.experiment/1", "kind": kind, "seed": 7, "bases": bases });
    document[kind] = section.clone();
    Experiment::read(&document).map_err(|error| error.to_string())
}

const SCHEMES: [&str; 3] = ["proposed", "tang_arteaga", "slotine_li"];

fn parameters() -> Value {
    json!([{
        "field": "/plant/theta_scale/*",
        "distribution": { "kind": "lognormal", "median": 1.0, "log_sd": 0.05 },
        "relative": true,
    }])
}

fn monte_carlo(draws: u32) -> Experiment {
    experiment("monte_carlo", &SCHEMES, &json!({ "draws": draws, "fields": parameters() })).unwrap()
}

fn sobol() -> Experiment {
    let axes = json!([
        { "field": "/scheme/gains/k_v/0", "min": 10, "max": 100, "log": true },
        { "field": "/scheme/gains/lambda/1", "min": 0.5, "max": 1.5, "relative": true },
    ]);
    experiment("sweep", &["proposed"], &json!({ "design": "sobol", "points": 20, "axes": axes })).unwrap()
}

fn latin() -> Experiment {
    let axes = json!([{ "field": "/plant/friction/width_rad_s", "min": 1e-3, "max": 1e-1, "log": true }]);
    let section = json!({ "design": "latin_hypercube", "points": 20, "axes": axes });
    experiment("sweep", &["proposed", "slotine_li"], &section).unwrap()
}

fn grid() -> Experiment {
    let axes = json!([
        { "field": "/scheme/gains/k_v/0", "min": 10, "max": 1000, "log": true, "points": 3 },
        { "field": "/recording/samples", "values": [50, 25] },
    ]);
    experiment("sweep", &["proposed"], &json!({ "design": "grid", "axes": axes })).unwrap()
}

fn comparison() -> Experiment {
    let conditions = json!([
        { "name": "as in the paper" },
        { "name": "heavy", "set": [{ "field": "/plant/theta_scale/17", "value": 1.2, "relative": true }] },
    ]);
    let section = json!({ "conditions": conditions, "draws": 4, "fields": parameters() });
    experiment("compare", &SCHEMES, &section).unwrap()
}

fn rows(experiment: &Experiment, planned: Vec<PlannedRun>) -> Vec<Row> {
    let mut rows = Vec::new();
    assert!(
        experiment
            .run(planned, |row| {
                rows.push(row);
                ControlFlow::Continue(())
            })
            .is_continue()
    );
    rows
}

fn folded(experiment: &Experiment, rows: impl IntoIterator<Item = Row>) -> Results {
    let mut results = Results::new();
    rows.into_iter().for_each(|row| results.insert(experiment, row).unwrap());
    results
}

#[test]
fn any_range_is_planned_without_the_rest() {
    for experiment in [monte_carlo(5), sobol(), latin(), grid(), comparison()] {
        let runs = experiment.runs().unwrap();
        let all = experiment.plan(0..u64::MAX);
        assert_eq!(all.len() as u64, runs);
        for n in (0..runs).rev() {
            assert_eq!(experiment.plan(n..n + 1), all[n as usize..=n as usize]);
        }
        assert_eq!(experiment.plan(runs..runs + 5), []);
        let mut hashes: Vec<_> = all.iter().map(|run| run.scenario.as_ref().unwrap().hash()).collect();
        hashes.sort();
        hashes.dedup();
        assert_eq!(hashes.len() as u64, runs, "two runs of one scenario");
    }
}

#[test]
fn a_grid_has_every_combination_and_its_ends_to_the_bit() {
    let experiment = grid();
    let points: Vec<_> = (0..6).map(|point| experiment.values(point)).collect();
    assert_eq!((points[0].as_slice(), points[5].as_slice()), (&[10.0, 50.0][..], &[1000.0, 25.0][..]));
    assert!((points[2][0] - 100.0).abs() < 1e-12 && points[2][1] == 50.0 && points[3][1] == 25.0);
    let planned = experiment.plan(5..6).remove(0).scenario.unwrap();
    assert_eq!(planned.document().recording.samples, 25);
}

#[test]
fn bases_and_conditions_meet_the_same_chance() {
    let experiment = comparison();
    let plants = |n: usize| {
        let run = experiment.plan(n as u64..n as u64 + 1).remove(0);
        let document = run.scenario.unwrap().document().clone();
        (document.plant.theta_scale.unwrap(), document.seed)
    };
    for draw in 0..4 {
        let first = plants(6 * draw);
        assert_eq!(plants(6 * draw + 2), first);
        let heavy = plants(6 * draw + 4);
        assert_eq!((&heavy.0[..17], heavy.1), (&first.0[..17], first.1));
        assert_eq!(heavy.0[17].to_bits(), (1.2 * (first.0[17])).to_bits());
        assert_ne!(plants(6 * ((draw + 1) % 4)), first);
    }
}

/// A finished Monte Carlo study of 21 runs.
fn study() -> &'static (Experiment, Vec<Row>) {
    static STUDY: OnceLock<(Experiment, Vec<Row>)> = OnceLock::new();
    STUDY.get_or_init(|| {
        let experiment = monte_carlo(7);
        let rows = rows(&experiment, experiment.plan(0..21));
        (experiment, rows)
    })
}

#[test]
fn a_row_is_the_same_alone_and_beside_others() {
    let (experiment, together) = study();
    let together = folded(experiment, together.clone());
    for n in 0..21 {
        let alone = rows(experiment, experiment.plan(n..n + 1));
        assert_eq!(&alone[..], std::slice::from_ref(together.row(n).unwrap()));
        let run = experiment.plan(n..n + 1).remove(0).scenario.unwrap().run();
        let place = experiment.columns().place("index_e_deg_2").unwrap();
        assert_eq!(alone[0].metrics[place].unwrap().to_bits(), run.report.metrics.index_e_deg[1].to_bits());
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    #[test]
    fn the_summary_does_not_depend_on_order_or_partition(
        order in Just((0..21_usize).collect::<Vec<_>>()).prop_shuffle(),
        parts in prop::collection::vec(0..4_usize, 21),
    ) {
        let (experiment, rows) = study();
        let expected = Summary::of(experiment, &folded(experiment, rows.clone()));
        let mut results = Results::new();
        for part in 0..4 {
            let chosen = order.iter().filter(|n| parts[**n] == part).map(|n| rows[*n].clone());
            results.merge(experiment, folded(experiment, chosen)).unwrap();
        }
        prop_assert_eq!(Summary::of(experiment, &results), expected);
    }
}

#[test]
fn rows_that_cannot_be_are_refused() {
    let (experiment, rows) = study();
    let mut results = folded(experiment, rows.clone());
    let mut other = rows[3].clone();
    assert_eq!(results.insert(experiment, other.clone()), Ok(()));
    other.metrics[0] = Some(1.0);
    assert!(results.insert(experiment, other.clone()).unwrap_err().to_string().contains("came twice"));
    other.metrics.pop();
    assert!(Results::new().insert(experiment, other.clone()).unwrap_err().to_string().contains("47 numbers where 48"));
    other.index = 21;
    assert!(Results::new().insert(experiment, other).unwrap_err().to_string().contains("no run 21"));
}

/// Rows whose first column is given, all others absent.
fn made_up(experiment: &Experiment, value: impl Fn(u64, usize, usize) -> Option<f64>) -> Results {
    let width = experiment.columns().names().len();
    let row = |index| {
        let place = experiment.place(index).unwrap();
        let mut metrics = vec![None; width];
        metrics[0] = value(place.point, place.condition, place.base);
        let outcome = if metrics[0].is_some() { RowOutcome::Completed } else { RowOutcome::Diverged };
        Row { index, outcome, at_s: None, refusal: None, metrics }
    };
    folded(experiment, (0..experiment.runs().unwrap()).map(row))
}

#[test]
fn pairing_removes_what_all_bases_share() {
    let experiment = monte_carlo(200);
    // Chance is a hundred times the difference between the first two; the third always diverges.
    let chance = |point: u64| 100.0 * (point as f64 * 0.7).sin();
    let results = made_up(&experiment, |point, _, base| (base < 2).then(|| 200.0 + chance(point) + base as f64));
    let summary = Summary::of(&experiment, &results);
    assert_eq!(summary.groups[2].diverged.as_ref().unwrap().count, 200);
    assert!(summary.groups[0].metrics[0].statistics.sd.unwrap() > 50.0);
    let pair = summary.pairs.iter().find(|pair| pair.metric == "index_e_deg").unwrap();
    assert_eq!((pair.a.as_str(), pair.b.as_str(), pair.a_better.count), ("proposed", "tang_arteaga", 200));
    let difference = pair.difference.as_ref().unwrap();
    assert!((difference.mean + 1.0).abs() < 1e-9 && difference.sd.unwrap() < 1e-9);
    let ranking = summary.rankings.iter().find(|ranking| ranking.metric == "index_e_deg").unwrap();
    let places: Vec<_> = ranking.bases.iter().map(|it| (it.base.as_str(), it.mean_rank, it.best_share)).collect();
    let expected = [("proposed", 1.0, Some(1.0)), ("tang_arteaga", 2.0, Some(0.0)), ("slotine_li", 3.0, Some(0.0))];
    assert_eq!(places, expected);
}

#[test]
fn a_ranking_between_equals_is_uncertain() {
    let experiment = monte_carlo(100);
    // Digits far behind the point, where there is no order.
    let disorder = |n: u64| (12.9898 * n as f64).sin() * 43_758.545_3;
    let value = |point: u64, base: usize| disorder(3 * point + base as u64).rem_euclid(1.0) + 1.0;
    let results = made_up(&experiment, |point, _, base| Some(value(point, base)));
    let summary = Summary::of(&experiment, &results);
    let ranking = &summary.rankings[0];
    assert_eq!((ranking.blocks, ranking.resampled.as_deref()), (100, Some("draw")));
    let sum: f64 = ranking.bases.iter().map(|it| it.best_share.unwrap()).sum();
    assert!((sum - 1.0).abs() < 1e-9);
    for base in &ranking.bases {
        let [low, high] = base.interval.unwrap();
        assert!(low < base.mean_rank && base.mean_rank < high && high - low > 0.1, "{base:?}");
    }
}

#[test]
fn fields_that_matter_are_found() {
    let experiment = sobol();
    let results = made_up(&experiment, |point, _, _| Some(experiment.values(point)[1].powi(3)));
    let summary = Summary::of(&experiment, &results);
    assert_eq!(summary.sensitivities[1].field, "/scheme/gains/lambda/1");
    assert_eq!(summary.sensitivities[1].rank_correlation, 1.0);
    assert!(summary.sensitivities[0].rank_correlation.abs() < 0.5);
    let best = &summary.groups[0].metrics[0];
    assert_eq!(experiment.values(best.best_point)[1].powi(3), best.statistics.min);
}

#[test]
fn a_draw_that_makes_no_arm_is_refused_and_counted() {
    let fields = json!([{
        "field": "/plant/theta_scale/7",
        "distribution": { "kind": "normal", "mean": 0.1, "sd": 0.2 },
    }]);
    let experiment = experiment("monte_carlo", &["proposed"], &json!({ "draws": 10, "fields": fields })).unwrap();
    let results = folded(&experiment, rows(&experiment, experiment.plan(0..10)));
    let summary = Summary::of(&experiment, &results);
    let group = &summary.groups[0];
    assert!(group.refused > 0 && group.completed > 0 && group.refused + group.completed == 10, "{group:?}");
    assert!(summary.first_refusal.unwrap().why.starts_with("plant.theta_scale"));
}

#[test]
fn a_document_is_the_same_after_writing_and_reading() {
    for experiment in [monte_carlo(5), sobol(), latin(), grid(), comparison()] {
        let text = serde_json::to_string(experiment.document()).unwrap();
        let again: ExperimentDocument = read_document(&mut serde_json::Deserializer::from_str(&text)).unwrap();
        let again = Experiment::new(again).unwrap();
        assert_eq!((again.hash(), &again), (experiment.hash(), &experiment));
    }
    // What is planned is a scenario like any other.
    let planned = sobol().plan(3..4).remove(0).scenario.unwrap();
    let text = serde_json::to_string(planned.document()).unwrap();
    assert_eq!(Scenario::read(&mut serde_json::Deserializer::from_str(&text)).unwrap().hash(), planned.hash());
}
