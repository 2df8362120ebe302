//! What exists: presets, robots, schemes, the scenario's schema, limits.

use super::internal;
use crate::api::Name;
use crate::api::catalog::{ExampleView, LimitsView, PresetView, RobotView, SchemeView, examples};
use crate::error::Problem;
use crate::openapi::Index;
use crate::state::AppState;
use adaptarm_core::experiments::ExperimentDocument;
use adaptarm_core::robots::ROBOTS;
use adaptarm_core::scenario::{PRESETS, ScenarioDocument, Scheme, preset as find_preset};
use axum::Json;
use axum::extract::State;
use schemars::Schema;
use serde_json::{Value, json};

/// What the API offers.
#[utoipa::path(
    get, path = "/api/v1", operation_id = "index", tag = "catalog",
    responses((status = 200, description = "Where to go.", body = Index)),
)]
pub(super) async fn index() -> Json<Value> {
    Json(json!({
        "name": "adaptarm",
        "version": env!("CARGO_PKG_VERSION"),
        "links": {
            "presets": "/api/v1/presets",
            "robots": "/api/v1/robots",
            "schemes": "/api/v1/schemes",
            "scenario_schema": "/api/v1/schema/scenario",
            "experiments": "/api/v1/experiments",
            "experiment_schema": "/api/v1/schema/experiment",
            "limits": "/api/v1/limits",
            "jobs": "/api/v1/jobs",
            "openapi": "/api/v1/openapi.json",
            "docs": "/api/docs",
        },
    }))
}

/// Scenarios that have a name.
#[utoipa::path(
    get, path = "/api/v1/presets", operation_id = "presets", tag = "catalog",
    responses((status = 200, description = "All presets, each with its whole scenario.", body = [PresetView])),
)]
pub(super) async fn presets() -> Result<Json<Vec<PresetView>>, Problem> {
    PRESETS.iter().map(PresetView::new).collect::<Result<_, _>>().map(Json).map_err(internal)
}

/// One scenario that has a name.
#[utoipa::path(
    get, path = "/api/v1/presets/{id}", operation_id = "preset", tag = "catalog",
    params(("id" = String, Path, description = "The preset's identifier.", example = "proposed")),
    responses((status = 200, description = "The preset.", body = PresetView)),
)]
pub(super) async fn preset(Name(id): Name) -> Result<Json<PresetView>, Problem> {
    let preset = find_preset(&id).ok_or_else(|| Problem::not_found("preset", &id))?;
    PresetView::new(preset).map(Json).map_err(internal)
}

/// Experiments to begin with: those of the manual.
#[utoipa::path(
    get, path = "/api/v1/experiments", operation_id = "experiments", tag = "catalog",
    responses((status = 200, description = "All examples, each with its whole document.", body = [ExampleView])),
)]
pub(super) async fn experiments() -> Result<Json<Vec<ExampleView>>, Problem> {
    examples().map(Json).map_err(internal)
}

/// Robots, with their parameters.
#[utoipa::path(
    get, path = "/api/v1/robots", operation_id = "robots", tag = "catalog",
    responses((status = 200, description = "All robots.", body = [RobotView])),
)]
pub(super) async fn robots() -> Json<Vec<RobotView>> {
    Json(ROBOTS.iter().map(|robot| RobotView::from(*robot)).collect())
}

/// Control schemes, with the range, default and meaning of every gain.
#[utoipa::path(
    get, path = "/api/v1/schemes", operation_id = "schemes", tag = "catalog",
    responses((status = 200, description = "All schemes.", body = [SchemeView])),
)]
pub(super) async fn schemes() -> Result<Json<Vec<SchemeView>>, Problem> {
    let schemes = Scheme::ALL.into_iter().chain(Scheme::YARDSTICKS);
    schemes.map(SchemeView::new).collect::<Result<_, _>>().map(Json).map_err(internal)
}

/// The JSON Schema of a scenario.
#[utoipa::path(
    get, path = "/api/v1/schema/scenario", operation_id = "scenario_schema", tag = "catalog",
    responses((status = 200, description = "The schema.", body = Value)),
)]
pub(super) async fn scenario_schema() -> Json<Schema> {
    Json(schemars::schema_for!(ScenarioDocument))
}

/// The JSON Schema of an experiment.
#[utoipa::path(
    get, path = "/api/v1/schema/experiment", operation_id = "experiment_schema", tag = "catalog",
    responses((status = 200, description = "The schema.", body = Value)),
)]
pub(super) async fn experiment_schema() -> Json<Schema> {
    Json(schemars::schema_for!(ExperimentDocument))
}

/// Every limit on what can be asked.
#[utoipa::path(
    get, path = "/api/v1/limits", operation_id = "limits", tag = "catalog",
    responses((status = 200, description = "The limits of this server.", body = LimitsView)),
)]
pub(super) async fn limits(State(state): State<AppState>) -> Json<LimitsView> {
    Json(LimitsView::from(&state.config.limits))
}
