//! Each way in which a request can be wrong has its own answer, and each answer is a problem document.

use crate::support::{App, JOBS, request, short, study};
use axum::body::Body;
use serde_json::{Value, json};

/// What comes back for a study of one scenario in which `pointer` has been set to `value`.
async fn with_field(parent: &str, field: &str, value: Value) -> crate::support::Answer {
    let mut scenario = short("proposed");
    scenario.pointer_mut(parent).unwrap()[field] = value;
    App::new().await.post(JOBS, study(&[scenario]).to_string()).await
}

#[tokio::test]
async fn unknown_paths() {
    let app = App::new().await;
    for path in ["/api/v1/nothing", "/api", "/api/v2/jobs", "/nothing.html", "/api/v1//", "/%ff/..%2f"] {
        app.get(path).await.problem(404, "/problems/http");
    }
    let problem = app.get("/api/v1/presets/nonsense").await.problem(404, "/problems/http");
    assert_eq!(problem["detail"], r#"there is no preset "nonsense""#);
    for path in ["/api/v1/presets/%ff", "/api/v1/jobs/%ff/result", "/api/v1/jobs/x/result/figures/%ff"] {
        let problem = app.get(path).await.problem(400, "/problems/http");
        assert_eq!(problem["detail"], "the path, with its percent-encoding undone, is not UTF-8 text");
    }
}

#[tokio::test]
async fn wrong_method() {
    let app = App::new().await;
    let answer = app.ask("PUT", JOBS, &[]).await;
    answer.problem(405, "/problems/http");
    assert_eq!(answer.header("allow"), "POST,GET,HEAD");
    let answer = app.post("/api/v1/presets", "{}").await;
    answer.problem(405, "/problems/http");
    assert_eq!(answer.header("allow"), "GET,HEAD");
}

#[tokio::test]
async fn not_declared_as_json() {
    let body = study(&[short("proposed")]).to_string();
    for media_type in ["text/plain", "application/x-www-form-urlencoded", "", "application/jsonp", "json"] {
        let request = request("POST", JOBS).header("content-type", media_type).body(Body::from(body.clone())).unwrap();
        App::new().await.call(request).await.problem(415, "/problems/media-type");
    }
    let bare = request("POST", JOBS).body(Body::from(body.clone())).unwrap();
    App::new().await.call(bare).await.problem(415, "/problems/media-type");
    let charset = request("POST", JOBS).header("content-type", "Application/JSON; charset=utf-8");
    assert_eq!(App::new().await.call(charset.body(Body::from(body)).unwrap()).await.status, 202);
}

#[tokio::test]
async fn not_json() {
    let app = App::new().await;
    let problem = app.post(JOBS, "{\n  \"kind\": study\n}").await.problem(400, "/problems/malformed-json");
    assert_eq!((&problem["line"], &problem["column"]), (&json!(2), &json!(11)));
    assert_eq!(problem["pointer"], "/kind");
    for body in ["", " ", "hello", "{", "\u{0}"] {
        app.post(JOBS, body).await.problem(400, "/problems/malformed-json");
    }
    app.post(JOBS, &b"{\"kind\": \"\xff\"}"[..]).await.problem(400, "/problems/malformed-json");
    let nan = study(&[short("proposed")]).to_string().replace("0.5", "NaN");
    let problem = app.post(JOBS, nan).await.problem(400, "/problems/malformed-json");
    assert_eq!(problem["pointer"], "/spec/scenarios/0/integration/duration_s");
}

#[tokio::test]
async fn deep_nesting_is_refused_without_harm() {
    let app = App::new().await;
    for body in ["[".repeat(30_000), "{\"kind\":".repeat(30_000)] {
        let problem = app.post(JOBS, body).await.problem(400, "/problems/malformed-json");
        assert!(problem["detail"].as_str().unwrap().contains("recursion limit exceeded"), "{problem}");
    }
    let deep = study(&[short("proposed")]).to_string().replace("\"format\"", "\"trajectory\":TRAJECTORY,\"format\"");
    let deep = deep.replace("TRAJECTORY", &format!("{{\"a\":{}", "[".repeat(30_000)));
    let problem = app.post(JOBS, deep).await.problem(400, "/problems/malformed-json");
    assert!(problem["detail"].as_str().unwrap().contains("recursion limit exceeded"), "{problem}");
    assert_eq!(app.get("/healthz").await.status, 200);
}

#[tokio::test]
async fn unknown_missing_and_doubled_fields() {
    let problem = with_field("", "stepp", json!(1)).await.problem(422, "/problems/malformed");
    assert_eq!(problem["pointer"], "/spec/scenarios/0/stepp");
    assert!(problem["detail"].as_str().unwrap().contains("unknown field `stepp`"));
    let app = App::new().await;
    let problem = app.post(JOBS, r#"{"kind":"study","colour":1}"#).await.problem(422, "/problems/malformed");
    assert_eq!(problem["pointer"], "/colour");
    let problem = app.post(JOBS, r#"{"kind":"study"}"#).await.problem(422, "/problems/malformed");
    assert!(problem["detail"].as_str().unwrap().starts_with("missing field `spec`"), "{problem}");
    let problem = app.post(JOBS, r#"{"kind":"study","kind":"study"}"#).await.problem(422, "/problems/malformed");
    assert!(problem["detail"].as_str().unwrap().contains("duplicate field `kind`"));
    let problem = app.post(JOBS, r#"{"kind":"survey"}"#).await.problem(422, "/problems/malformed");
    assert_eq!(problem["pointer"], "/kind");
}

/// Whatever comes before `kind`, and whatever serde would take from a list.
#[tokio::test]
async fn a_wrong_type_is_found_at_its_place() {
    for (parent, field, value, place) in [
        ("", "integration", json!(["rk4", 0.001, 12]), "integration"),
        ("", "scheme", json!(["proposed"]), "scheme"),
        ("", "scheme", json!({ "gains": { "k_s": [1, 2, "z"] }, "kind": "slotine_li" }), "scheme/gains/k_s/2"),
        ("", "plant", json!({ "friction": { "width_rad_s": "wide" } }), "plant/friction/width_rad_s"),
        (
            "",
            "trajectory",
            json!({ "kind": "fourier", "offset_deg": [0, 90, -90], "sine_deg": [[1, "a"]] }),
            "trajectory/sine_deg/0/1",
        ),
    ] {
        let problem = with_field(parent, field, value).await.problem(422, "/problems/malformed");
        assert_eq!(problem["pointer"], format!("/spec/scenarios/0/{place}"));
    }
    let problem = App::new().await.post(JOBS, format!("[{}]", study(&[]))).await.problem(422, "/problems/malformed");
    assert_eq!(problem["detail"], "invalid type: list, expected an object");
}

#[tokio::test]
async fn numbers_outside_their_range_come_with_the_range() {
    let problem = with_field("/integration", "step_s", json!(-1)).await.problem(422, "/problems/out-of-range");
    assert_eq!(problem["pointer"], "/spec/scenarios/0/integration/step_s");
    assert_eq!((&problem["value"], &problem["min"], &problem["max"]), (&json!(-1.0), &json!(1e-6), &json!(0.1)));
    assert_eq!(problem["unit"], "s");
    let problem = with_field("/recording", "samples", json!(0)).await.problem(422, "/problems/out-of-range");
    assert_eq!(problem["pointer"], "/spec/scenarios/0/recording/samples");
}

#[tokio::test]
async fn lists_names_and_contradictions() {
    let gains = with_field("/scheme", "gains", json!({ "k_v": [1, 2] })).await;
    let problem = gains.problem(422, "/problems/wrong-length");
    assert_eq!(problem["pointer"], "/spec/scenarios/0/scheme/gains/k_v");
    assert_eq!((&problem["found"], &problem["expected"]), (&json!(2), &json!(3)));
    let harmonics = json!({ "kind": "fourier", "offset_deg": [0, 90, -90], "sine_deg": [vec![1; 51]] });
    let problem = with_field("", "trajectory", harmonics).await.problem(422, "/problems/too-long");
    assert_eq!(problem["pointer"], "/spec/scenarios/0/trajectory/sine_deg/0");
    assert_eq!((&problem["found"], &problem["most"]), (&json!(51), &json!(50)));
    let problem = with_field("", "robot", json!("puma")).await.problem(422, "/problems/unknown");
    assert_eq!(problem["allowed"], "crs_a465, two_link, pendulum");
    let many_steps = json!({ "step_s": 1e-6, "duration_s": 1e5 });
    let problem = with_field("", "integration", many_steps).await.problem(422, "/problems/conflict");
    assert_eq!(problem["pointer"], "/spec/scenarios/0/integration/step_s");
}

#[tokio::test]
async fn studies_that_are_too_much_together() {
    let app = App::with(|config| {
        config.limits.scenarios_per_job = 64;
        config.limits.steps_per_job = 1_000_000_000;
        config.limits.samples_per_job = 400_000;
    })
    .await;
    let problem = app.post(JOBS, study(&[]).to_string()).await.problem(422, "/problems/out-of-range");
    assert_eq!((&problem["pointer"], &problem["max"]), (&json!("/spec/scenarios"), &json!(64.0)));
    let mut sampled = short("proposed");
    sampled["recording"]["samples"] = json!(200_000);
    for (scenarios, what, most) in [
        (vec![short("proposed"); 65], "scenarios", 64),
        (vec![crate::support::long(); 12], "integration steps", 1_000_000_000),
        (vec![sampled; 3], "samples", 400_000),
    ] {
        let problem = app.post(JOBS, study(&scenarios).to_string()).await.problem(422, "/problems/too-much");
        assert_eq!(problem["pointer"], "/spec/scenarios");
        assert_eq!((&problem["what"], &problem["most"]), (&json!(what), &json!(most)));
        assert!(problem["total"].as_u64().unwrap() > most, "{problem}");
    }
}

#[tokio::test]
async fn labels_and_priorities_over_their_limits() {
    let app = App::new().await;
    let mut labelled = study(&[short("proposed")]);
    labelled["label"] = json!("x".repeat(201));
    let problem = app.post(JOBS, labelled.to_string()).await.problem(422, "/problems/too-long");
    assert_eq!((&problem["pointer"], &problem["most"]), (&json!("/label"), &json!(200)));
    labelled["label"] = json!("two\nlines");
    assert_eq!(app.post(JOBS, labelled.to_string()).await.problem(422, "/problems/malformed")["pointer"], "/label");
    labelled["priority"] = json!(11);
    labelled["label"] = json!("é".repeat(200));
    let problem = app.post(JOBS, labelled.to_string()).await.problem(422, "/problems/out-of-range");
    assert_eq!((&problem["pointer"], &problem["max"]), (&json!("/priority"), &json!(10.0)));
    labelled["priority"] = json!(-10);
    assert_eq!(app.post(JOBS, labelled.to_string()).await.status, 202);
}

#[tokio::test]
async fn bodies_over_the_limit() {
    let app = App::with(|config| config.limits.request_bytes = 1 << 20).await;
    let problem = app.post(JOBS, vec![b' '; (1 << 20) + 1]).await.problem(413, "/problems/too-large");
    assert_eq!(problem["max_bytes"], 1 << 20);
    let declared =
        request("POST", JOBS).header("content-type", "application/json").header("content-length", 100_000_000);
    app.call(declared.body(Body::empty()).unwrap()).await.problem(413, "/problems/too-large");
    app.post(JOBS, vec![b' '; 1 << 20]).await.problem(400, "/problems/malformed-json");
}
