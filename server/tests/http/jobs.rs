//! The life of a job: to its result, to a cancel, to its end by deletion.

use crate::support::{App, JOBS, long, short, study};
use adaptarm_core::scenario::Scenario;
use serde_json::{Value, json};

#[tokio::test]
async fn a_study_gives_the_reports_that_the_core_gives() {
    let app = App::new().await;
    let scenarios = [short("proposed"), short("tang_arteaga"), short("slotine_li")];
    let body = json!({ "kind": "study", "spec": { "scenarios": scenarios }, "label": "three", "priority": 3 });
    let accepted = app.post(JOBS, body.to_string()).await;
    assert_eq!(accepted.status, 202);
    let view = accepted.json();
    assert_eq!((&view["state"], &view["kind"], &view["label"]), (&json!("queued"), &json!("study"), &json!("three")));
    assert_eq!((&view["priority"], &view["scenarios"], &view["cached"]), (&json!(3), &json!(3), &json!(false)));
    let job = accepted.header("location").to_owned();
    assert_eq!(view["links"]["self"], job);

    let view = app.wait(&job, &["succeeded"]).await;
    assert_eq!((&view["progress"], &view["scenarios_done"]), (&json!(1.0), &json!(3)));
    let time = |name: &str| view[name].as_str().unwrap().parse::<jiff::Timestamp>().unwrap();
    assert!(time("created_at") <= time("started_at") && time("started_at") <= time("finished_at"));

    let result = app.get(view["links"]["result"].as_str().unwrap()).await.json();
    assert_eq!((&result["format"], &result["complete"]), (&json!("adaptarm.study/1"), &json!(true)));
    for (n, scenario) in scenarios.iter().enumerate() {
        let run = Scenario::read(scenario).unwrap().run();
        assert_eq!(result["reports"][n], serde_json::to_value(&run.report).unwrap());
        let series = app.get(&format!("{job}/result/series?scenario={n}")).await;
        assert_eq!(series.header("content-type"), "text/csv; charset=utf-8; header=present");
        assert_eq!(String::from_utf8(series.body).unwrap(), run.recording.to_csv());
    }
}

#[tokio::test]
async fn what_was_computed_before_is_not_computed_again() {
    let app = App::new().await;
    let first = app.submit(&[short("proposed")]).await;
    app.wait(&first, &["succeeded"]).await;
    let again = app.post(JOBS, study(&[short("proposed"), short("proposed")]).to_string()).await.json();
    assert_eq!((&again["state"], &again["cached"], &again["attempts"]), (&json!("succeeded"), &json!(true), &json!(0)));
    let report = |result: Value| result["reports"][0]["trajectory_hash"].clone();
    let result = app.get(again["links"]["result"].as_str().unwrap()).await.json();
    assert_eq!(report(result), report(app.get(&format!("{first}/result")).await.json()));
}

#[tokio::test]
async fn a_diverging_scenario_is_a_result() {
    let app = App::new().await;
    let mut scenario = short("slotine_li");
    scenario["integration"] = json!({ "duration_s": 12.0, "step_s": 0.1 });
    scenario["recording"]["samples"] = json!(100);
    let job = app.submit(&[scenario]).await;
    app.wait(&job, &["succeeded"]).await;
    let report = app.get(&format!("{job}/result")).await.json()["reports"][0].take();
    assert_eq!(report["outcome"], "diverged");
    assert!(report["at_s"].as_f64().unwrap() > 0.0 && !report["reason"].as_str().unwrap().is_empty());
}

#[tokio::test]
async fn a_cancel_takes_effect_while_it_runs_and_while_it_waits() {
    let app = App::with(|config| config.threads = Some(1)).await;
    let running = app.submit(&[long()]).await;
    app.wait(&running, &["running"]).await;
    let waiting = app.submit(&[short("slotine_li")]).await;
    let problem = app.get(&format!("{running}/result")).await.problem(409, "/problems/not-ready");
    assert_eq!(problem["state"], "running");
    for job in [&waiting, &running] {
        let view = app.ask("POST", &format!("{job}/cancel"), &[]).await.json();
        assert_eq!(view["state"], "canceled");
        assert!(view["reason"].is_string() && view["links"].get("cancel").is_none(), "{view}");
    }
    // The thread is free again, or this would take minutes.
    let job = app.submit(&[short("slotine_li")]).await;
    let view = app.wait(&job, &["succeeded"]).await;
    // Too late now, and no mistake.
    assert_eq!(app.ask("POST", &format!("{job}/cancel"), &[]).await.json(), view);
}

#[tokio::test]
async fn what_a_canceled_job_had_computed_can_be_read() {
    let app = App::with(|config| config.threads = Some(1)).await;
    let job = app.submit(&[short("proposed"), long()]).await;
    let path = format!("{job}/result/series");
    loop {
        let view = app.get(&job).await.json();
        if view["scenarios_done"] == 1 {
            break;
        }
        assert!(view["state"] == "queued" || view["state"] == "running", "{view}");
        tokio::time::sleep(std::time::Duration::from_millis(5)).await;
    }
    // Also while the rest is being computed.
    assert_eq!(app.get(&path).await.status, 200);
    app.ask("POST", &format!("{job}/cancel"), &[]).await;
    let result = app.get(&format!("{job}/result")).await.json();
    assert_eq!((&result["complete"], &result["state"]), (&json!(false), &json!("canceled")));
    assert_eq!(result["reports"][0]["outcome"], "completed");
    assert_eq!((&result["reports"][1], result["reports"].as_array().unwrap().len()), (&Value::Null, 2));
    assert_eq!(app.get(&path).await.status, 200);
    let problem = app.get(&format!("{path}?scenario=1")).await.problem(409, "/problems/not-ready");
    assert_eq!(problem["state"], "canceled");
    app.get(&format!("{path}?scenario=2")).await.problem(404, "/problems/http");
}

#[tokio::test]
async fn a_deleted_job_is_forgotten_and_stops() {
    let app = App::with(|config| config.threads = Some(1)).await;
    let job = app.submit(&[long()]).await;
    app.wait(&job, &["running"]).await;
    let deleted = app.ask("DELETE", &job, &[]).await;
    assert_eq!((deleted.status.as_u16(), deleted.body.len()), (204, 0));
    app.get(&job).await.problem(404, "/problems/http");
    app.ask("DELETE", &job, &[]).await.problem(404, "/problems/http");
    let next = app.submit(&[short("slotine_li")]).await;
    app.wait(&next, &["succeeded"]).await;
}

#[tokio::test]
async fn unknown_jobs() {
    let app = App::new().await;
    for id in ["nonsense", "01a1faef-47aa-739c-8da0-8ec25cc71ac6", "%00", "..%2f.."] {
        for rest in ["", "/result", "/result/series", "/result/figures/torques.svg", "/result/diagnostics", "/events"] {
            app.get(&format!("/api/v1/jobs/{id}{rest}")).await.problem(404, "/problems/http");
        }
        app.ask("POST", &format!("/api/v1/jobs/{id}/cancel"), &[]).await.problem(404, "/problems/http");
    }
}

#[tokio::test]
async fn a_server_that_is_about_to_end_takes_nothing_new() {
    let app = App::new().await;
    app.state.drain();
    let refused = app.post(JOBS, study(&[short("proposed")]).to_string()).await;
    refused.problem(503, "/problems/http");
    assert_eq!(refused.header("retry-after"), "5");
    app.get("/readyz").await.problem(503, "/problems/http");
    assert_eq!(app.get("/healthz").await.status, 200);
}
