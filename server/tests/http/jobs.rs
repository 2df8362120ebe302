//! The life of a job: to its result, to a cancel, to a failure that harms nobody else.

use crate::support::{App, long, request, short};
use adaptarm::config::Capacity;
use adaptarm_core::scenario::Scenario;
use axum::body::Body;
use serde_json::json;

#[tokio::test]
async fn a_study_gives_the_reports_that_the_core_gives() {
    let app = App::new();
    let scenarios = [short("proposed"), short("tang_arteaga"), short("slotine_li")];
    let body = json!({ "kind": "study", "spec": { "scenarios": scenarios }, "label": "three" });
    let accepted = app.post("/api/v1/jobs", body.to_string()).await;
    assert_eq!(accepted.status, 202);
    let view = accepted.json();
    assert_eq!((&view["state"], &view["kind"], &view["label"]), (&json!("queued"), &json!("study"), &json!("three")));
    let job = accepted.header("location").to_owned();
    assert_eq!(view["links"]["self"], job);

    let view = app.wait(&job, &["succeeded"]).await;
    assert_eq!(view["progress"], 1.0);
    let time = |name: &str| view[name].as_str().unwrap().parse::<jiff::Timestamp>().unwrap();
    assert!(time("created_at") <= time("started_at") && time("started_at") <= time("finished_at"));

    let result = app.get(view["links"]["result"].as_str().unwrap()).await.json();
    assert_eq!(result["format"], "adaptarm.study/1");
    for (n, scenario) in scenarios.iter().enumerate() {
        let run = Scenario::read(scenario).unwrap().run();
        assert_eq!(result["reports"][n], serde_json::to_value(&run.report).unwrap());
        let series = app.get(&format!("{job}/result/series?scenario={n}")).await;
        assert_eq!(series.header("content-type"), "text/csv; charset=utf-8; header=present");
        assert_eq!(String::from_utf8(series.body).unwrap(), run.recording.to_csv());
    }
    app.get(&format!("{job}/result/series?scenario=3")).await.problem(404, "/problems/http");
    app.get(&format!("{job}/result/series?scenario=x")).await.problem(400, "/problems/http");
    app.get(&format!("{job}/result/series?column=q")).await.problem(400, "/problems/http");
    app.get(&format!("{job}/result/series?columns=q")).await.problem(422, "/problems/unknown");
}

/// Compression once asked for more after the last piece, which the pieces answered with a panic.
#[tokio::test]
async fn compressed_samples_come_to_their_end() {
    let app = App::new();
    let job = app.submit(&[short("proposed")]).await;
    app.wait(&job, &["succeeded"]).await;
    let path = format!("{job}/result/series");
    let plain = app.get(&path).await;
    let compressed = request("GET", &path).header("accept-encoding", "gzip").body(Body::empty()).unwrap();
    let compressed = app.call(compressed).await;
    assert_eq!(compressed.header("content-encoding"), "gzip");
    // RFC 1952: the last four bytes are the length of what was compressed.
    let length = compressed.body.last_chunk::<4>().map(|bytes| u32::from_le_bytes(*bytes) as usize);
    assert_eq!(length, Some(plain.body.len()));
}

#[tokio::test]
async fn a_diverging_scenario_is_a_result() {
    let app = App::new();
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
    let app = App::new();
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let running = app.submit(&vec![long(); threads]).await;
    let waiting = app.submit(&[short("slotine_li")]).await;
    app.wait(&running, &["running"]).await;
    let problem = app.get(&format!("{running}/result")).await.problem(409, "/problems/not-ready");
    assert_eq!(problem["state"], "running");
    for job in [&waiting, &running] {
        let cancel = request("POST", &format!("{job}/cancel")).body(Body::empty()).unwrap();
        assert_eq!(app.call(cancel).await.json()["state"], "canceled");
        let problem = app.get(&format!("{job}/result")).await.problem(409, "/problems/not-ready");
        assert_eq!(problem["state"], "canceled");
    }
    // The threads are free again, or this would take minutes.
    let job = app.submit(&[short("slotine_li")]).await;
    let view = app.wait(&job, &["succeeded"]).await;
    // Too late now, and no mistake.
    let cancel = request("POST", &format!("{job}/cancel")).body(Body::empty()).unwrap();
    assert_eq!(app.call(cancel).await.json(), view);
}

#[tokio::test]
async fn a_full_queue_refuses_and_says_when_to_come_again() {
    let app = App::with(Capacity { unfinished: 1, ..Capacity::default() });
    let job = app.submit(&[long()]).await;
    let refused = app.post("/api/v1/jobs", crate::support::study(&[short("proposed")]).to_string()).await;
    refused.problem(503, "/problems/queue-full");
    assert_eq!(refused.header("retry-after"), "5");
    app.call(request("POST", &format!("{job}/cancel")).body(Body::empty()).unwrap()).await;
    app.submit(&[short("proposed")]).await;
}

#[tokio::test]
async fn a_panic_fails_its_job_and_nothing_else() {
    let app = App::simulating(Capacity::default(), |scenario, _| {
        assert!(scenario.document().seed != 666, "a bug on purpose");
        Some(scenario.run())
    });
    let mut cursed = short("proposed");
    cursed["seed"] = json!(666);
    let job = app.submit(&[short("proposed"), cursed, short("proposed")]).await;
    let view = app.wait(&job, &["failed"]).await;
    assert_eq!(view["reason"], "scenario 1 made the simulation fail: a bug on purpose");
    let problem = app.get(&format!("{job}/result")).await.problem(409, "/problems/not-ready");
    assert_eq!(problem["state"], "failed");
    let job = app.submit(&[short("proposed")]).await;
    app.wait(&job, &["succeeded"]).await;
}

#[tokio::test]
async fn old_recordings_are_gone_and_old_jobs_unknown() {
    let app = App::with(Capacity { finished: 1, recording_bytes: 0, ..Capacity::default() });
    let first = app.submit(&[short("proposed")]).await;
    app.wait(&first, &["succeeded"]).await;
    assert_eq!(app.get(&format!("{first}/result")).await.status, 200);
    app.get(&format!("{first}/result/series")).await.problem(410, "/problems/gone");
    let second = app.submit(&[short("proposed")]).await;
    app.wait(&second, &["succeeded"]).await;
    app.get(&first).await.problem(404, "/problems/http");
}

#[tokio::test]
async fn unknown_jobs() {
    let app = App::new();
    for id in ["nonsense", "01a1faef-47aa-739c-8da0-8ec25cc71ac6", "%00", "..%2f.."] {
        for rest in ["", "/result", "/result/series"] {
            app.get(&format!("/api/v1/jobs/{id}{rest}")).await.problem(404, "/problems/http");
        }
    }
}
