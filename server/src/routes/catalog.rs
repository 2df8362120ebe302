//! What exists: presets, robots, schemes, the scenario's schema, limits.

use super::internal;
use crate::api::Name;
use crate::api::catalog::{LimitsView, PresetView, RobotView, SchemeView};
use crate::error::Problem;
use crate::state::AppState;
use adaptarm_core::robots::ROBOTS;
use adaptarm_core::scenario::{PRESETS, ScenarioDocument, Scheme, preset as find_preset};
use axum::Json;
use axum::extract::State;
use schemars::Schema;
use serde_json::{Value, json};

pub(super) async fn index() -> Json<Value> {
    Json(json!({
        "name": "adaptarm",
        "version": env!("CARGO_PKG_VERSION"),
        "links": {
            "presets": "/api/v1/presets",
            "robots": "/api/v1/robots",
            "schemes": "/api/v1/schemes",
            "scenario_schema": "/api/v1/schema/scenario",
            "limits": "/api/v1/limits",
            "submit_job": "/api/v1/jobs",
        },
    }))
}

pub(super) async fn presets() -> Result<Json<Vec<PresetView>>, Problem> {
    PRESETS.iter().map(PresetView::new).collect::<Result<_, _>>().map(Json).map_err(internal)
}

pub(super) async fn preset(Name(id): Name) -> Result<Json<PresetView>, Problem> {
    let preset = find_preset(&id).ok_or_else(|| Problem::not_found("preset", &id))?;
    PresetView::new(preset).map(Json).map_err(internal)
}

pub(super) async fn robots() -> Json<Vec<RobotView>> {
    Json(ROBOTS.iter().map(|robot| RobotView::from(*robot)).collect())
}

pub(super) async fn schemes() -> Result<Json<Vec<SchemeView>>, Problem> {
    Scheme::ALL.into_iter().map(SchemeView::new).collect::<Result<_, _>>().map(Json).map_err(internal)
}

pub(super) async fn scenario_schema() -> Json<Schema> {
    Json(schemars::schema_for!(ScenarioDocument))
}

pub(super) async fn limits(State(state): State<AppState>) -> Json<LimitsView> {
    Json(LimitsView::from(&state.config.limits))
}
