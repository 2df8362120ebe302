//! Reading what jobs gave: reports, samples, figures.

use super::experiments;
use super::jobs::find;
use super::problems::{database, not_ready, stored};
use crate::api::{Name, Query};
use crate::auth::Reader;
use crate::download::{Disposition, Download};
use crate::error::Problem;
use crate::figures::FigureRequest;
use crate::jobs::{Job, JobState, ScenarioRow, StoreError};
use crate::openapi::AnyResult;
use crate::results::ResultError;
use crate::series::{SeriesQuery, SeriesRequest};
use crate::state::AppState;
use adaptarm_core::recording::Recording;
use adaptarm_core::scenario::{Report, Scenario};
use axum::body::{Body, Bytes};
use axum::extract::State;
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::{IntoResponse, Response};
use futures_util::{Stream, stream};
use serde::Deserialize;
use std::sync::Arc;
use tokio::task::spawn_blocking;
use uuid::Uuid;

/// Scenarios read at a time.
const PAGE: i64 = 200;

/// The result of a job: of a study that has ended, whole or as far as it came; of an experiment at any time what is known by
/// then.
///
/// Needs the scope `jobs:read`.
#[utoipa::path(
    get, path = "/api/v1/jobs/{id}/result", operation_id = "result", tag = "results",
    params(
        ("id" = uuid::Uuid, Path, description = "The job's identifier."),
        ("If-None-Match" = Option<String>, Header, description = "Tag of the file that you have."),
    ),
    responses(
        (
            status = 200, description = "The reports of a study, or what an experiment says.", body = AnyResult,
            headers(("ETag" = String, description = "Stands for these very bytes.")),
        ),
        (status = 304, description = "You have this file."),
    ),
)]
pub(super) async fn result(
    State(state): State<AppState>,
    Reader(owner): Reader,
    Name(id): Name,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    let job = find(&state, owner.as_str(), &id).await?;
    if job.kind.is_experiment() {
        return experiments::result(&state, &job, &headers).await;
    }
    if !job.state.is_final() {
        return Err(not_ready(&job, "its result"));
    }
    // What has ended does not change any more.
    let id = job.id.to_string();
    let download =
        Download::new("application/json", Disposition::Inline, &format!("{id}.json"), &[&id, job.state.id()]);
    if let Some(response) = download.not_modified(&headers) {
        return Ok(response);
    }
    let mut response = download.whole(Body::from_stream(reports(state, job.id, job.state, job.scenarios)));
    // Nobody can read a part of a JSON document.
    response.headers_mut().remove(header::ACCEPT_RANGES);
    Ok(response)
}

/// A result piece by piece: ten thousand reports are large.
fn reports(state: AppState, id: Uuid, ended: JobState, count: i64) -> impl Stream<Item = Result<Bytes, StoreError>> {
    let complete = ended == JobState::Succeeded;
    let head = format!(r#"{{"format":"adaptarm.study/1","complete":{complete},"state":"{}","reports":["#, ended.id());
    stream::try_unfold((state, 0, Some(head)), move |(state, from, head)| async move {
        if from > count {
            return Ok(None);
        }
        let rows = state.store.scenarios(id, from, PAGE).await?;
        let mut text = head.unwrap_or_default();
        for row in &rows {
            if row.n > 0 {
                text.push(',');
            }
            text.push_str(row.report.as_deref().unwrap_or("null"));
        }
        let reached = from + rows.len() as i64;
        if reached == count {
            text.push_str("]}");
            return Ok(Some((Bytes::from(text), (state, count + 1, None))));
        }
        if rows.is_empty() {
            // Deleted meanwhile: an answer that breaks off is better than one that seems whole.
            return Err(StoreError::Damaged(format!("{reached} of {count} scenarios of the job {id}")));
        }
        Ok(Some((Bytes::from(text), (state, reached, None))))
    })
}

/// One scenario of a job as it runs: checked, with everything filled in.
///
/// Needs the scope `jobs:read`.
#[utoipa::path(
    get, path = "/api/v1/jobs/{id}/scenarios/{n}", operation_id = "scenario", tag = "results",
    params(
        ("id" = uuid::Uuid, Path, description = "The job's identifier."),
        ("n" = u32, Path, description = "Number of the scenario; the first is 0.", example = 0),
    ),
    responses((status = 200, description = "The scenario's document.", body = crate::openapi::Scenario)),
)]
pub(super) async fn scenario(
    State(state): State<AppState>,
    Reader(owner): Reader,
    Name((id, n)): Name<(String, String)>,
) -> Result<impl IntoResponse, Problem> {
    let job = find(&state, owner.as_str(), &id).await?;
    let unknown = || Problem::not_found("scenario in this job called", &n);
    let number = n.parse().map_err(|_| unknown())?;
    let (_, document) = state.store.scenario(job.id, number).await.map_err(database)?.ok_or_else(unknown)?;
    Ok(([(header::CONTENT_TYPE, "application/json")], document))
}

/// The samples of one scenario, also while others are still computed.
///
/// Needs the scope `jobs:read`.
#[utoipa::path(
    get, path = "/api/v1/jobs/{id}/result/series", operation_id = "series", tag = "results",
    params(("id" = uuid::Uuid, Path, description = "The job's identifier."), SeriesQuery, ("If-None-Match" = Option<String>, Header, description = "Tag of the file that you have."), ("Range" = Option<String>, Header, example = "bytes=0-999", description = "The part of the file that you want.")),
    responses(
        (
            status = 200, description = "The samples.",
            content(
                (String = "text/csv"),
                (Vec<u8> = "application/octet-stream"),
                (Vec<u8> = "application/vnd.apache.parquet"),
            ),
            headers(("ETag" = String, description = "Stands for these very bytes.")),
        ),
        (
            status = 206, description = "The part that is asked for.",
            content(
                (String = "text/csv"),
                (Vec<u8> = "application/octet-stream"),
                (Vec<u8> = "application/vnd.apache.parquet"),
            ),
            headers(("Content-Range" = String, description = "Which part it is.")),
        ),
        (status = 304, description = "You have this file."),
    ),
)]
pub(super) async fn series(
    State(state): State<AppState>,
    Reader(owner): Reader,
    Name(id): Name,
    Query(query): Query<SeriesQuery>,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    let job = find(&state, owner.as_str(), &id).await?;
    let (row, _, report) = find_report(&state, &job, query.scenario).await?;
    let request = SeriesRequest::new(&query, &report)?;
    if let Some(response) = request.not_modified(&headers) {
        return Ok(response);
    }
    request.respond(samples(&state, &row).await?, &headers).await
}

/// Which scenario's figure or diagnostics.
#[derive(Debug, Clone, Default, Deserialize, utoipa::IntoParams)]
#[serde(deny_unknown_fields, default)]
#[into_params(parameter_in = Query)]
pub(super) struct FigureQuery {
    /// Number of the scenario; the first is 0.
    #[param(required = false, maximum = 99_999)]
    scenario: usize,
    /// Of an experiment: the metric that is drawn, such as `tau_rms_nm`.
    metric: Option<String>,
}

/// A file of an experiment: the same bytes as `adaptarm experiment` writes. Rows can be read while they come in.
///
/// Needs the scope `jobs:read`.
#[utoipa::path(
    get, path = "/api/v1/jobs/{id}/result/files/{name}", operation_id = "file", tag = "results",
    params(
        ("id" = uuid::Uuid, Path, description = "The job's identifier."),
        ("name" = String, Path, description = "The file; a wrong name is answered with all that there are.", example = "runs.csv"),
        ("If-None-Match" = Option<String>, Header, description = "Tag of the file that you have."),
        ("Range" = Option<String>, Header, example = "bytes=0-999", description = "The part of the file that you want."),
    ),
    responses(
        (
            status = 200, description = "The file.",
            content((String = "text/csv"), (String = "application/json"), (Vec<u8> = "application/vnd.apache.parquet")),
            headers(("ETag" = String, description = "Stands for these very bytes.")),
        ),
        (
            status = 206, description = "The part that is asked for.",
            content((String = "text/csv"), (String = "application/json"), (Vec<u8> = "application/vnd.apache.parquet")),
            headers(("Content-Range" = String, description = "Which part it is.")),
        ),
        (status = 304, description = "You have this file."),
    ),
)]
pub(super) async fn file(
    State(state): State<AppState>,
    Reader(owner): Reader,
    Name((id, name)): Name<(String, String)>,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    let job = find(&state, owner.as_str(), &id).await?;
    experiments::file(&state, &job, &name, &headers).await
}

/// A figure of one scenario: those of the published study, and more; or of an experiment.
///
/// Needs the scope `jobs:read`.
#[utoipa::path(
    get, path = "/api/v1/jobs/{id}/result/figures/{name}", operation_id = "figure", tag = "results",
    params(
        ("id" = uuid::Uuid, Path, description = "The job's identifier."),
        ("name" = String, Path, description = "The figure's file; a wrong name is answered with all that there are.", example = "torques.svg"),
        FigureQuery,
        ("If-None-Match" = Option<String>, Header, description = "Tag of the file that you have."),
        ("Range" = Option<String>, Header, example = "bytes=0-999", description = "The part of the file that you want."),
    ),
    responses(
        (
            status = 200, description = "The picture.",
            content((String = "image/svg+xml"), (Vec<u8> = "image/png")),
            headers(("ETag" = String, description = "Stands for these very bytes.")),
        ),
        (
            status = 206, description = "The part that is asked for.",
            content((String = "image/svg+xml"), (Vec<u8> = "image/png")),
            headers(("Content-Range" = String, description = "Which part it is.")),
        ),
        (status = 304, description = "You have this picture."),
    ),
)]
pub(super) async fn figure(
    State(state): State<AppState>,
    Reader(owner): Reader,
    Name((id, name)): Name<(String, String)>,
    Query(query): Query<FigureQuery>,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    let job = find(&state, owner.as_str(), &id).await?;
    if job.kind.is_experiment() {
        return experiments::figure(&state, &job, &name, query.metric, &headers).await;
    }
    if query.metric.is_some() {
        return Err(Problem::status(
            StatusCode::BAD_REQUEST,
            "query: only figures of experiments have the parameter `metric`",
        ));
    }
    let (row, document, report) = find_report(&state, &job, query.scenario).await?;
    let request = FigureRequest::new(&name, &report)?;
    if let Some(response) = request.not_modified(&headers) {
        return Ok(response);
    }
    request.respond(report, document, samples(&state, &row).await?, &headers).await
}

/// What the samples of one scenario tell: excitation, Lyapunov function, violated assumptions, energy, chatter.
///
/// Needs the scope `jobs:read`.
#[utoipa::path(
    get, path = "/api/v1/jobs/{id}/result/diagnostics", operation_id = "diagnostics", tag = "results",
    params(
        ("id" = uuid::Uuid, Path, description = "The job's identifier."),
        FigureQuery,
        ("If-None-Match" = Option<String>, Header, description = "Tag of the file that you have."),
    ),
    responses(
        (
            status = 200, description = "The diagnostics.", body = crate::openapi::Diagnostics,
            headers(("ETag" = String, description = "Stands for these very bytes.")),
        ),
        (status = 304, description = "You have this file."),
    ),
)]
pub(super) async fn diagnostics(
    State(state): State<AppState>,
    Reader(owner): Reader,
    Name(id): Name,
    Query(query): Query<FigureQuery>,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    let job = find(&state, owner.as_str(), &id).await?;
    let (row, document, report) = find_report(&state, &job, query.scenario).await?;
    let content = ["diagnostics", report.scenario_hash.as_str(), report.trajectory_hash.as_str()];
    let name = format!("{}-diagnostics.json", report.scheme);
    let download = Download::new("application/json", Disposition::Inline, &name, &content);
    if let Some(response) = download.not_modified(&headers) {
        return Ok(response);
    }
    let recording = samples(&state, &row).await?;
    let found = spawn_blocking(move || {
        let scenario: Scenario = Scenario::read(&mut serde_json::Deserializer::from_str(&document))
            .map_err(|error| super::internal(error))?;
        serde_json::to_vec(&scenario.diagnose(&recording).0).map_err(super::internal)
    });
    let bytes = found.await.map_err(super::internal)??;
    let mut response = download.whole(Body::from(bytes));
    // Nobody can read a part of a JSON document.
    response.headers_mut().remove(header::ACCEPT_RANGES);
    Ok(response)
}

/// One scenario of a job with its document and the report on it.
async fn find_report(state: &AppState, job: &Job, n: usize) -> Result<(ScenarioRow, String, Report), Problem> {
    let number = i64::try_from(n).unwrap_or(i64::MAX);
    let found = state.store.scenario(job.id, number).await.map_err(database)?;
    let (row, document) = found.ok_or_else(|| Problem::not_found("scenario in this job called", &n.to_string()))?;
    let Some(report) = &row.report else {
        if row.core_version.is_none() {
            return Err(not_ready(job, "this scenario's samples"));
        }
        let detail = "this result is not kept any more; the same scenario gives the same one again";
        return Err(Problem::new(StatusCode::GONE, "/problems/gone", "No longer kept", detail));
    };
    let report = serde_json::from_str(report).map_err(super::internal)?;
    Ok((row, document, report))
}

/// The samples of one scenario that has a report.
async fn samples(state: &AppState, row: &ScenarioRow) -> Result<Arc<Recording>, Problem> {
    let (version, checksum) =
        (row.core_version.as_deref().unwrap_or_default(), row.checksum.as_deref().unwrap_or_default());
    let samples = state.results.get(&row.hash, version, checksum).await;
    if let Err(ResultError::Missing(_) | ResultError::Damaged(_)) = &samples {
        // So that the same scenario is computed again, as the answer says.
        state.store.forget_lost_result(&row.hash, version).await.map_err(database)?;
    }
    samples.map(Arc::new).map_err(|error| stored(&error))
}
