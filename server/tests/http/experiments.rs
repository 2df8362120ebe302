//! Experiments as jobs: what they give is what the core gives, whoever asks and however; what is wrong is said with its place.

use crate::support::{App, JOBS, short};
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
        let summary = Summary::of(&experiment, &results);
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
        let file = |name: &str| app.get(&format!("{job}/result/files/{name}")).await;
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
    let file = |name: &str| app.get(&format!("{job}/result/files/{name}"));
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
async fn an_experiment_can_be_read_while_it_runs_and_canceled() {
    let app = App::new().await;
    let mut long = monte_carlo(2000);
    long["bases"][0]["scenario"]["integration"]["duration_s"] = json!(60.0);
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
    refused(&|body| body["kind"] = json!("study"), "/problems/malformed", "/spec/bases").await;
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
        body["spec"]["bases"][0]["scenario"]["integration"]["duration_s"] = json!(12.0 * 1000.0);
    };
    refused(&long, "/problems/too-much", "/spec").await;
    let schema = app.get("/api/v1/schema/experiment").await.json();
    assert!(schema["properties"]["monte_carlo"].is_object(), "{schema}");
    let limits = app.get("/api/v1/limits").await.json();
    assert_eq!(limits["experiment"]["runs"], 200_000);
}
