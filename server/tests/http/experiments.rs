//! Experiments as jobs: what they give is what the core gives, whoever asks and however; what is wrong is said with its place.

use crate::support::{App, JOBS, short};
use adaptarm_core::experiments::replication::ReplicationSummary;
use adaptarm_core::experiments::{Experiment, Results, Summary};
use serde_json::{Value, json};
use std::ops::ControlFlow;

fn monte_carlo(draws: u32) -> Value {
    let distribution = json!({ "kind": "normal", "mean": 1, "sd": 0.1, "min": 0.5 });
    json!({
        "format": "adaptarm.experiment/1", "kind": "monte_carlo", "seed": 3,
        "bases": [{ "name": "a", "scenario": short("proposed") }, { "name": "b", "scenario": short("slotine_li") }],
        "monte_carlo": {
            "draws": draws, "fields": [{ "field": "/plant/theta_scale/*", "distribution": distribution }],
        },
    })
}

fn grid() -> Value {
    json!({
        "format": "adaptarm.experiment/1", "kind": "sweep",
        "bases": [{ "name": "a", "scenario": short("proposed") }],
        "sweep": { "design": "grid", "axes": [
            { "field": "/scheme/gains/k_v/0", "min": 10, "max": 160, "points": 4, "log": true },
            // The last value is beyond what is allowed: refused, and said.
            { "field": "/scheme/gains/beta", "values": [4.0, 8.0, 1e9] },
        ] },
    })
}

fn tuning() -> Value {
    let field = json!({ "field": "/plant/theta_scale/*", "distribution": { "kind": "normal", "mean": 1, "sd": 0.1, "min": 0.5 } });
    json!({
        "format": "adaptarm.experiment/1", "kind": "tuning", "seed": 5,
        "bases": [{ "name": "a", "scenario": short("proposed") }],
        "tuning": {
            "variables": [{ "field": "/scheme/gains/k_v/*", "min": 0.1, "max": 10, "log": true, "relative": true }],
            "objective": [{ "metric": "index_e_deg", "weight": 1 }],
            "plants": { "count": 3, "fields": [field], "validation": 4 },
            "evaluations": 25,
        },
    })
}

/// Two readings of each of two ways to begin, with three steps of integration for one scheme.
fn replication() -> Value {
    let bases: Vec<_> =
        ["proposed", "tang_arteaga", "slotine_li"].map(|it| json!({ "name": it, "scenario": short(it) })).into();
    let rest = json!({ "initial": { "velocity": "rest" } });
    let step = |step_s: f64| json!({ "integration": { "step_s": step_s } });
    json!({
        "format": "adaptarm.experiment/1", "kind": "replication", "bases": bases,
        "replication": {
            "unknowns": [
                { "name": "start", "options": [{ "name": "moving" }, { "name": "at rest", "change": rest }] },
                { "name": "step", "schemes": ["slotine_li"], "options": [
                    { "name": "usual" }, { "name": "half", "change": step(0.0005) }, { "name": "tenth", "change": step(0.0001) },
                ] },
            ],
            "horizons_s": [short("proposed")["integration"]["duration_s"]],
            "windows": [{ "name": "whole" }, { "name": "second half", "from": 0.5 }],
        },
    })
}

fn request(experiment: &Value) -> String {
    json!({ "kind": experiment["kind"], "spec": experiment }).to_string()
}

async fn submit(app: &App, experiment: &Value) -> String {
    let answer = app.post(JOBS, request(experiment)).await;
    assert_eq!(answer.status, 202, "{answer:?}");
    answer.header("location").to_owned()
}

fn text(document: &impl serde::Serialize) -> String {
    serde_json::to_string_pretty(document).unwrap() + "\n"
}

/// What the core says when it makes all runs in a row.
fn in_a_row(experiment: &Value) -> (Experiment, Results) {
    let experiment = Experiment::read(experiment).unwrap();
    let mut results = Results::new();
    let planned = experiment.plan(0..experiment.runs().unwrap());
    let _ = experiment.run(planned, |row| {
        results.insert(&experiment, row).unwrap();
        ControlFlow::Continue(())
    });
    (experiment, results)
}

#[tokio::test]
async fn an_experiment_gives_to_the_byte_what_the_core_gives() {
    let app = App::new().await;
    for document in [monte_carlo(30), grid()] {
        let job = submit(&app, &document).await;
        let (experiment, results) = in_a_row(&document);
        let summary = Summary::of(&experiment, &results).unwrap();
        let view = app.wait(&job, &["succeeded"]).await;
        assert_eq!((&view["kind"], &view["scenarios"]), (&document["kind"], &json!(results.len())));
        assert_eq!((&view["scenarios_done"], &view["progress"]), (&view["scenarios"], &json!(1.0)));
        let result = app.get(view["links"]["result"].as_str().unwrap()).await;
        let said = result.json();
        assert_eq!((&said["format"], &said["complete"]), (&json!("adaptarm.experiment_result/1"), &json!(true)));
        assert_eq!(said["summary"], serde_json::to_value(&summary).unwrap());
        assert_eq!(
            app.ask("GET", &format!("{job}/result"), &[("if-none-match", result.header("etag"))]).await.status,
            304
        );
        let file = async |name: &str| app.get(&format!("{job}/result/files/{name}")).await;
        assert_eq!(String::from_utf8(file("summary.json").await.body).unwrap(), text(&summary));
        assert_eq!(String::from_utf8(file("experiment.json").await.body).unwrap(), text(experiment.document()));
        let csv = file("runs.csv").await;
        assert_eq!(csv.header("content-type"), "text/csv; charset=utf-8; header=present");
        assert_eq!(String::from_utf8(csv.body).unwrap().lines().count(), 1 + results.len());
        assert_eq!(&file("runs.parquet").await.body[..4], b"PAR1");
        file("best.json").await.problem(404, "/problems/http");
        for figure in said["figures"].as_array().unwrap() {
            let svg =
                app.get(&format!("{job}/result/figures/{}.svg?metric=tau_rms_nm", figure.as_str().unwrap())).await;
            assert_eq!((svg.status.as_u16(), svg.header("content-type")), (200, "image/svg+xml"));
        }
        let png = app.get(&format!("{job}/result/figures/boxes.png")).await;
        assert!(png.body.starts_with(b"\x89PNG"));
    }
    let job = submit(&app, &grid()).await;
    let view = app.wait(&job, &["succeeded"]).await;
    let result = app.get(view["links"]["result"].as_str().unwrap()).await.json();
    assert_eq!(result["summary"]["groups"][0]["refused"], 4);
    assert_eq!(result["figures"], json!(["heat_map", "boxes", "parallel_coordinates"]));
    let problem = app.get(&format!("{job}/result/figures/torques.svg")).await.problem(404, "/problems/http");
    assert!(problem["allowed"].as_str().unwrap().contains("heat_map.svg"), "{problem}");
    let problem =
        app.get(&format!("{job}/result/figures/boxes.svg?metric=luck")).await.problem(422, "/problems/unknown");
    assert_eq!(problem["parameter"], "metric");
}

#[tokio::test]
async fn a_tuning_goes_step_by_step_to_what_the_core_finds() {
    let app = App::new().await;
    let job = submit(&app, &tuning()).await;
    let experiment = Experiment::read(&tuning()).unwrap();
    let mut search = experiment.tuning().unwrap();
    while !search.is_done() {
        let mut rows = Vec::new();
        let _ = experiment.run(search.plan(&experiment), |row| {
            rows.push(row);
            ControlFlow::Continue(())
        });
        search.tell(&experiment, rows).unwrap();
    }
    let summary = search.summary(&experiment);
    let view = app.wait(&job, &["succeeded"]).await;
    assert_eq!((&view["scenarios_done"], &view["scenarios"]), (&json!(summary.candidates), &json!(summary.candidates)));
    let file = async |name: &str| app.get(&format!("{job}/result/files/{name}")).await;
    assert_eq!(String::from_utf8(file("summary.json").await.body).unwrap(), text(&summary));
    let best = search.best_scenario(&experiment).unwrap();
    assert_eq!(String::from_utf8(file("best.json").await.body).unwrap(), text(best.document()));
    let generations = String::from_utf8(file("generations.csv").await.body).unwrap();
    assert_eq!(generations.lines().count(), 1 + summary.history.len());
    assert_eq!(app.get(&format!("{job}/result/figures/convergence.svg")).await.status, 200);
    // Whoever follows hears how it got on: of what was told on the way, the newest.
    let stream = String::from_utf8(app.get(&format!("{job}/events")).await.body).unwrap();
    assert_eq!(stream.matches("event: partial").count(), 1);
    assert!(stream.contains(&format!("\"candidates\":{}", summary.candidates)), "{stream}");
}

#[tokio::test]
async fn a_replication_finds_what_the_core_finds_and_reports_it() {
    let app = App::new().await;
    let job = submit(&app, &replication()).await;
    let (experiment, results) = in_a_row(&replication());
    let summary = ReplicationSummary::of(&experiment, &results).unwrap().unwrap();
    assert_eq!((results.len(), summary.readings, summary.complete), (2 + 2 + 6, 12, 12));
    let view = app.wait(&job, &["succeeded"]).await;
    assert_eq!((&view["kind"], &view["scenarios_done"]), (&json!("replication"), &json!(10)));
    let said = app.get(&format!("{job}/result")).await.json();
    assert_eq!(said["summary"], serde_json::to_value(&summary).unwrap());
    assert_eq!((&said["figures"], &said["metrics"]), (&json!(["entries", "unknowns"]), &json!([])));
    let file = async |name: &str| app.get(&format!("{job}/result/files/{name}")).await;
    assert_eq!(String::from_utf8(file("summary.json").await.body).unwrap(), text(&summary));
    let report = file("report.md").await;
    assert_eq!(report.header("content-type"), "text/markdown; charset=utf-8");
    assert!(String::from_utf8(report.body).unwrap().contains("12 readings, from 10 simulations"));
    assert_eq!(String::from_utf8(file("runs.csv").await.body).unwrap().lines().count(), 11);
    for figure in ["entries.svg", "unknowns.svg"] {
        assert!(app.get(&format!("{job}/result/figures/{figure}")).await.body.starts_with(b"<svg width=\"900\""));
    }
    let problem = app.get(&format!("{job}/result/figures/boxes.svg")).await.problem(404, "/problems/http");
    assert_eq!(problem["allowed"], "entries.svg, entries.png, unknowns.svg, unknowns.png");
    let stream = String::from_utf8(app.get(&format!("{job}/events")).await.body).unwrap();
    assert!(stream.contains("\"readings\":12"), "{stream}");
}

/// An option may make runs longer than the bases': what it may come to is what counts.
#[tokio::test]
async fn a_replication_counts_the_steps_of_its_options() {
    let app = App::new().await;
    let mut long = replication();
    for base in long["bases"].as_array_mut().unwrap() {
        base["scenario"]["integration"]["duration_s"] = json!(10_000);
    }
    long["replication"]["horizons_s"] = json!([10_000]);
    // Ten runs of up to 10⁸ steps are within 10¹⁰; with ten times as many of them they are not.
    let options: Vec<_> = (0..11).map(|n| json!({ "name": n.to_string() })).collect();
    long["replication"]["unknowns"].as_array_mut().unwrap().push(json!({ "name": "nothing", "options": options }));
    let problem = app.post(JOBS, request(&long)).await.problem(422, "/problems/too-much");
    assert_eq!(problem["pointer"], "/spec", "{problem}");
}

#[tokio::test]
async fn an_experiment_can_be_read_while_it_runs_and_canceled() {
    let app = App::new().await;
    let mut long = monte_carlo(2000);
    long["bases"][0]["scenario"]["integration"]["duration_s"] = json!(10.0);
    let job = submit(&app, &long).await;
    let started = std::time::Instant::now();
    let partial = loop {
        let result = app.get(&format!("{job}/result")).await.json();
        if !result["summary"].is_null() {
            break result;
        }
        assert!(started.elapsed().as_secs() < 55, "nothing was summed up");
        tokio::time::sleep(std::time::Duration::from_millis(50)).await;
    };
    assert_eq!(partial["complete"], false);
    assert!(partial["summary"]["done"].as_u64().unwrap() >= 400, "{}", partial["summary"]["done"]);
    app.post(&format!("{job}/cancel"), "").await;
    let view = app.wait(&job, &["canceled"]).await;
    assert!(view["scenarios_done"].as_i64().unwrap() < 4000);
    let csv = app.get(&format!("{job}/result/files/runs.csv")).await;
    assert_eq!(
        String::from_utf8(csv.body).unwrap().lines().count() as i64 - 1,
        view["scenarios_done"].as_i64().unwrap()
    );
}

#[tokio::test]
async fn what_is_wrong_is_said_with_its_place() {
    let app = App::new().await;
    let refused = async |change: &dyn Fn(&mut Value), kind: &str, pointer: &str| {
        let mut body = json!({ "kind": "monte_carlo", "spec": monte_carlo(3) });
        change(&mut body);
        let problem = app.post(JOBS, body.to_string()).await.problem(422, kind);
        assert_eq!(problem["pointer"], pointer, "{problem}");
    };
    refused(&|body| body["kind"] = json!("tuning"), "/problems/conflict", "/spec/kind").await;
    refused(&|body| body["kind"] = json!("luck"), "/problems/malformed", "/kind").await;
    refused(&|body| body["kind"] = json!("study"), "/problems/malformed", "/spec/kind").await;
    refused(
        &|body| body["spec"]["monte_carlo"]["draws"] = json!(0),
        "/problems/out-of-range",
        "/spec/monte_carlo/draws",
    )
    .await;
    refused(&|body| body["spec"]["monte_carlo"]["luck"] = json!(0), "/problems/malformed", "/spec/monte_carlo/luck")
        .await;
    let gains = json!({ "k_v": [-1, 1, 1] });
    let at = "/spec/bases/0/scenario/scheme/gains/k_v/0";
    refused(
        &|body| body["spec"]["bases"][0]["scenario"]["scheme"]["gains"] = gains.clone(),
        "/problems/out-of-range",
        at,
    )
    .await;
    refused(&|body| body["spec"]["monte_carlo"]["draws"] = json!(100_001), "/problems/conflict", "/spec/monte_carlo")
        .await;
    let long = |body: &mut Value| {
        body["spec"]["monte_carlo"]["draws"] = json!(50_000);
        body["spec"]["bases"][0]["scenario"]["integration"]["duration_s"] = json!(24.0 * 1000.0);
    };
    refused(&long, "/problems/conflict", "/spec/bases/0/scenario/integration").await;
    let schema = app.get("/api/v1/schema/experiment").await.json();
    assert!(schema["properties"]["monte_carlo"].is_object(), "{schema}");
    let limits = app.get("/api/v1/limits").await.json();
    assert_eq!(limits["experiment"]["runs"], 200_000);
}

/// The step is a field like any other: what it makes of the runs counts.
#[tokio::test]
async fn steps_that_a_field_makes_count_towards_the_limit() {
    let app = App::with(|config| config.limits.steps_per_job = 1_000_000).await;
    let duration_s = short("proposed")["integration"]["duration_s"].as_f64().unwrap();
    for (field, value, steps) in [("step_s", 1e-6, duration_s / 1e-6), ("duration_s", 2000.0, 2000.0 / 1e-3)] {
        let mut asked = grid();
        asked["sweep"]["axes"][1] = json!({ "field": format!("/integration/{field}"), "values": [value] });
        let problem = app.post(JOBS, request(&asked)).await.problem(422, "/problems/too-much");
        assert_eq!((&problem["pointer"], &problem["what"]), (&json!("/spec"), &json!("integration steps")));
        assert_eq!((&problem["total"], &problem["most"]), (&json!(4 * steps.round() as u64), &json!(1_000_000)));
    }
}
