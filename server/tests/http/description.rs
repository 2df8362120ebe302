//! The API's description of itself: complete, closed, and true where it gives examples.

use crate::support::{App, JOBS, short, study};
use serde_json::{Value, json};

/// Calls `visit` on every object in a document.
fn walk(value: &Value, visit: &mut impl FnMut(&serde_json::Map<String, Value>)) {
    match value {
        Value::Object(object) => {
            visit(object);
            object.values().for_each(|value| walk(value, visit));
        }
        Value::Array(list) => list.iter().for_each(|value| walk(value, visit)),
        _ => {}
    }
}

#[tokio::test]
async fn every_operation_is_there_with_examples_and_errors() {
    let app = App::new().await;
    let document = app.get("/api/v1/openapi.json").await.json();
    assert_eq!(document["openapi"], "3.1.0");
    let mut operations = 0;
    for (path, item) in document["paths"].as_object().unwrap() {
        for (method, operation) in item.as_object().unwrap() {
            operations += 1;
            let name = format!("{method} {path}");
            assert!(operation["summary"].is_string() && operation["operationId"].is_string(), "{name}");
            let (mut examples, mut problems) = (0, 0);
            for (status, response) in operation["responses"].as_object().unwrap() {
                for (media_type, content) in response["content"].as_object().into_iter().flatten() {
                    examples += usize::from(content.get("example").is_some());
                    problems += usize::from(
                        media_type == "application/problem+json"
                            && content["example"]["status"] == json!(status.parse::<u16>().unwrap()),
                    );
                }
            }
            assert!(problems >= 3 && examples >= problems, "{name}: {examples} examples, {problems} problems");
            let guarded = path.starts_with(JOBS) || path == "/metrics";
            assert_eq!(operation["responses"].get("401").is_some(), guarded, "{name}");
            assert_eq!(operation["security"].as_array().unwrap().len(), 1 + usize::from(guarded), "{name}");
        }
    }
    assert_eq!(operations, 24);
    walk(&document, &mut |object| {
        if let Some(reference) = object.get("$ref").and_then(Value::as_str) {
            assert!(document.pointer(reference.trim_start_matches('#')).is_some(), "{reference} leads nowhere");
        }
    });
    let printed = serde_json::to_value(adaptarm::openapi::document()).unwrap();
    assert_eq!(printed, document);
}

#[tokio::test]
async fn the_example_of_a_request_is_accepted() {
    let app = App::new().await;
    let document = app.get("/api/v1/openapi.json").await.json();
    let body = &document["paths"][JOBS]["post"]["requestBody"]["content"]["application/json"]["example"];
    let answer = app.post_with(JOBS, body.to_string(), &[("prefer", "wait=30")]).await;
    assert_eq!(answer.status, 200);
    let example = &document["paths"][JOBS]["post"]["responses"]["200"]["content"]["application/json"]["example"];
    let names = |value: &Value| value.as_object().unwrap().keys().cloned().collect::<Vec<_>>();
    assert_eq!(names(&answer.json()), names(example));
}

#[tokio::test]
async fn a_scenario_s_schema_knows_ranges_and_lengths() {
    let app = App::new().await;
    let schemas = app.get("/api/v1/openapi.json").await.json()["components"]["schemas"].take();
    let gains = &schemas["ProposedGains"]["properties"];
    assert_eq!((&gains["k_v"]["maxItems"], &gains["k_v"]["items"]["maximum"]), (&json!(3), &json!(1e5)));
    assert_eq!(gains["k_v"]["default"], json!([40.0, 80.0, 75.0]));
    assert_eq!((&gains["gamma_adapt"]["maxItems"], &gains["rho"]["minimum"]), (&json!(18), &json!(1.0)));
    assert_eq!(schemas["IntegrationDocument"]["properties"]["step_s"]["maximum"], 0.1);
    assert_eq!(schemas["SchemeDocument"]["oneOf"][0]["required"], json!(["kind"]));
    let schema = app.get("/api/v1/schema/scenario").await.json();
    assert_eq!(schema["properties"]["robot"]["enum"], json!(["crs_a465", "two_link", "pendulum"]));
    for (n, (joints, parameters)) in [(3, 18), (2, 11), (1, 4)].into_iter().enumerate() {
        let of_robot = &schema["allOf"][n]["then"]["properties"];
        assert_eq!(of_robot["scheme"]["properties"]["gains"]["properties"]["k_v"]["minItems"], joints);
        assert_eq!(of_robot["plant"]["properties"]["theta_scale"]["maxItems"], parameters);
    }
}

#[tokio::test]
async fn the_page_needs_nothing_from_elsewhere() {
    let app = App::new().await;
    for path in ["/api/docs", "/api/docs/"] {
        let page = String::from_utf8(app.get(path).await.body).unwrap();
        let mut files = 0;
        for (at, _) in page.match_indices("\"/api/") {
            let link = page[at + 1..].split('"').next().unwrap();
            let file = app.get(link).await;
            assert_eq!(file.status, 200, "{link}");
            files += 1;
        }
        assert_eq!(files, 4, "{page}");
        assert!(!page.contains("<script>") && !page.contains("style=") && !page.contains("http"), "{page}");
    }
    let script = app.get("/api/docs/swagger-ui-bundle.js").await;
    assert_eq!(
        (script.header("content-type"), script.body.len() > 1_000_000),
        ("text/javascript; charset=utf-8", true)
    );
    app.get("/api/docs/nothing.js").await.problem(404, "/problems/http");
}

#[tokio::test]
async fn requests_are_counted() {
    let app = App::new().await;
    app.post_with(JOBS, study(&[short("proposed")]).to_string(), &[("prefer", "wait=30")]).await;
    let metrics = app.get("/metrics").await;
    assert_eq!(metrics.header("content-type"), "text/plain; version=0.0.4; charset=utf-8");
    let text = String::from_utf8(metrics.body).unwrap();
    assert!(
        text.contains(r#"adaptarm_http_requests_total{method="POST",route="/api/v1/jobs",status="200"}"#),
        "{text}"
    );
}

/// Everything in quotes or backticks that looks like a problem's type.
fn kinds(text: &str) -> std::collections::BTreeSet<String> {
    let end = |rest: &str| rest.find(|c: char| !(c.is_ascii_lowercase() || c == '-')).unwrap_or(rest.len());
    let kinds = text.split("/problems/").skip(1).map(|rest| rest[..end(rest)].to_owned());
    kinds.filter(|kind| !kind.is_empty()).collect()
}

#[test]
fn the_manual_names_every_type_of_problem_and_no_other() {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    let (mut folders, mut used) = (vec![root.join("src")], std::collections::BTreeSet::new());
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else {
                used.extend(kinds(&std::fs::read_to_string(path).unwrap()));
            }
        }
    }
    let manual = std::fs::read_to_string(root.join("../docs/api.md")).unwrap();
    let table = manual.split("| type | status |").nth(1).unwrap();
    assert_eq!(kinds(table), used);
}
