//! What exists, told well enough to build a form from it.

use crate::support::{App, request};
use adaptarm_core::scenario::{PRESETS, Scenario};
use axum::body::Body;

#[tokio::test]
async fn presets_come_with_documents_that_run() {
    let app = App::new().await;
    let presets = app.get("/api/v1/presets").await.json();
    assert_eq!(presets.as_array().unwrap().len(), PRESETS.len());
    for (view, preset) in presets.as_array().unwrap().iter().zip(PRESETS) {
        let scenario = Scenario::read(&view["document"]).unwrap();
        assert_eq!(scenario, Scenario::new(preset.document()).unwrap());
        assert_eq!(&app.get(&format!("/api/v1/presets/{}", preset.id)).await.json(), view);
    }
}

#[tokio::test]
async fn every_gain_has_a_range_that_holds_its_default() {
    let schemes = App::new().await.get("/api/v1/schemes").await.json();
    let mut count = 0;
    for scheme in schemes.as_array().unwrap() {
        let groups = scheme["groups"].as_array().unwrap().iter().map(|group| &group["gains"]);
        for gain in groups.chain([&scheme["gains"]]).flat_map(|gains| gains.as_array().unwrap()) {
            let (min, max) = (gain["min"].as_f64().unwrap(), gain["max"].as_f64().unwrap());
            let default = match &gain["default"] {
                serde_json::Value::Array(numbers) => numbers.clone(),
                number => vec![number.clone()],
            };
            assert!(default.iter().all(|x| (min..=max).contains(&x.as_f64().unwrap())), "{gain}");
            assert!(!gain["meaning"].as_str().unwrap().is_empty());
            count += 1;
        }
    }
    assert_eq!(count, 11 + 3 + 7 + 3 + 3 * 2);
}

#[tokio::test]
async fn robots_limits_and_schema() {
    let app = App::new().await;
    let robot = app.get("/api/v1/robots").await.json()[0].take();
    assert_eq!(robot["id"], "crs_a465");
    assert_eq!(robot["parameters"].as_array().unwrap().len(), 18);
    let limits = app.get("/api/v1/limits").await.json();
    assert_eq!(limits["job"]["scenarios"], 10_000);
    assert_eq!(limits["user"]["unfinished_jobs"], 10_000);
    assert_eq!((&limits["request_bytes"], &limits["wait_s"]), (&(8 << 20).into(), &60.into()));
    assert_eq!(limits["scenario"]["step_s"], serde_json::json!([1e-6, 0.1]));
    let schema = app.get("/api/v1/schema/scenario").await.json();
    assert_eq!(schema["additionalProperties"], false);
    assert!(schema["properties"]["scheme"].is_object());
}

#[tokio::test]
async fn the_index_leads_everywhere() {
    let app = App::new().await;
    let index = app.get("/api/v1").await.json();
    let slashed = app.get("/api/v1/").await;
    assert_eq!((slashed.json(), slashed.header("cache-control")), (index.clone(), "no-store"));
    for (name, link) in index["links"].as_object().unwrap() {
        assert_eq!(app.get(link.as_str().unwrap()).await.status, 200, "{name}");
    }
}

#[tokio::test]
async fn health_and_compression() {
    let app = App::new().await;
    assert_eq!(app.get("/healthz").await.json()["status"], "alive");
    assert_eq!(app.get("/readyz").await.json()["status"], "ready");
    let compressed = request("GET", "/api/v1/presets").header("accept-encoding", "gzip").body(Body::empty()).unwrap();
    let compressed = app.call(compressed).await;
    assert_eq!(compressed.header("content-encoding"), "gzip");
    assert!(compressed.body.len() < app.get("/api/v1/presets").await.body.len() / 3);
}
