//! Reading what experiments gave, so far or in the end: result, files, figures.

use super::internal;
use super::problems::{database, not_ready};
use crate::document::brief;
use crate::download::{Disposition, Download};
use crate::error::Problem;
use crate::experiment::{File, Found, Picture};
use crate::jobs::{ExperimentRow, Job, JobState, StoreError, read_experiment, read_rows, read_search};
use crate::state::AppState;
use adaptarm_core::experiments::{Experiment, Results, Summary};
use adaptarm_core::figures::{ExperimentFigure, experiment_metrics};
use axum::body::{Body, Bytes};
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::Response;
use serde_json::json;
use std::sync::Arc;
use tokio::task::spawn_blocking;

/// Packed parts of rows read at a time.
const PAGE: i64 = 100;

/// What is known by now.
pub(super) async fn result(state: &AppState, job: &Job, headers: &HeaderMap) -> Result<Response, Problem> {
    let row = row(state, job).await?;
    let summary = row.summary.unwrap_or_else(|| "null".to_owned());
    let id = job.id.to_string();
    let said = blake3::hash(summary.as_bytes()).to_hex();
    let content = [&id, job.state.id(), said.as_str()];
    let download = Download::new("application/json", Disposition::Inline, &format!("{id}.json"), &content);
    if let Some(response) = download.not_modified(headers) {
        return Ok(response);
    }
    let document = row.document;
    let experiment = blocking(move || Ok(read_experiment(&document)?)).await?;
    let files: Vec<_> = File::of(&experiment).iter().map(|file| file.name()).collect();
    let shown = ExperimentFigure::ALL.into_iter().filter(|figure| figure.shows(&experiment));
    let figures: Vec<_> = shown.map(ExperimentFigure::id).collect();
    let metrics: Vec<_> = experiment_metrics(&experiment).collect();
    // The summary is JSON already, and may be long.
    let text = format!(
        r#"{{"format":"adaptarm.experiment_result/1","complete":{},"state":"{}","files":{},"figures":{},"metrics":{},"summary":{}}}"#,
        job.state == JobState::Succeeded,
        job.state.id(),
        json!(files),
        json!(figures),
        json!(metrics),
        summary.trim_end(),
    );
    let mut response = download.whole(Body::from(text));
    // Nobody can read a part of a JSON document.
    response.headers_mut().remove(header::ACCEPT_RANGES);
    Ok(response)
}

/// One of its files.
pub(super) async fn file(state: &AppState, job: &Job, name: &str, headers: &HeaderMap) -> Result<Response, Problem> {
    if !job.kind.is_experiment() {
        let detail = format!("the job is a {}; only experiments have files", job.kind.id());
        return Err(Problem::status(StatusCode::NOT_FOUND, detail));
    }
    let row = row(state, job).await?;
    let document = row.document.clone();
    let experiment = Arc::new(blocking(move || Ok(read_experiment(&document)?)).await?);
    let files = File::of(&experiment);
    let Some(file) = files.iter().copied().find(|file| file.name() == name) else {
        let allowed = files.iter().map(|file| file.name()).collect::<Vec<_>>().join(", ");
        return Err(Problem::not_found("file of this job called", name).with("allowed", allowed));
    };
    let tag = tag(&row, name);
    let download = Download::new(
        file.media_type(),
        Disposition::Attachment,
        &format!("{}-{name}", &job.id.to_string()[..13]),
        &tag.each_ref().map(String::as_str),
    );
    if let Some(response) = download.not_modified(headers) {
        return Ok(response);
    }
    let found = found(state, job, experiment.clone(), row).await?;
    let bytes = blocking(move || file.bytes(&experiment, &found).map_err(failed)).await?;
    let bytes = bytes.ok_or_else(|| not_ready(job, "this file"))?;
    Ok(download.bytes(headers, Bytes::from(bytes)))
}

/// All that the bytes of a file depend on.
fn tag(row: &ExperimentRow, name: &str) -> [String; 5] {
    let summary = blake3::hash(row.summary.as_deref().unwrap_or_default().as_bytes()).to_hex().to_string();
    [name.to_owned(), row.hash.clone(), row.core_version.clone(), format!("{}.{}", row.step, row.done), summary]
}

async fn row(state: &AppState, job: &Job) -> Result<ExperimentRow, Problem> {
    let row = state.store.experiment(job.id).await.map_err(database)?;
    // Deleted a moment ago.
    row.ok_or_else(|| Problem::not_found("job", &job.id.to_string()))
}

/// What is known: all rows that there are with what they say, or the search of a tuning.
async fn found(
    state: &AppState,
    job: &Job,
    experiment: Arc<Experiment>,
    row: ExperimentRow,
) -> Result<Arc<Found>, Problem> {
    if experiment.runs().is_none() {
        let search = blocking(move || match row.state {
            Some(search) => Ok(Some(read_search(&experiment, &search)?)),
            None => Ok(experiment.tuning()),
        });
        let search = search.await?.ok_or_else(|| not_ready(job, "its search"))?;
        return Ok(Arc::new(Found::Search(Box::new(search))));
    }
    let (mut packed, mut from) = (Vec::new(), 0);
    loop {
        let page = state.store.packed_rows(job.id, row.step, from, PAGE).await.map_err(database)?;
        let whole = (page.len() as i64) < PAGE;
        from = page.last().map_or(from, |(first, _)| first + 1);
        packed.extend(page.into_iter().map(|(_, rows)| rows));
        if whole {
            break;
        }
    }
    blocking(move || {
        let mut results = Results::new();
        for row in read_rows(&packed)? {
            results.insert(&experiment, row).map_err(failed)?;
        }
        let stored: Option<Summary> = row.summary.as_deref().and_then(|text| serde_json::from_str(text).ok());
        let current = stored.filter(|summary| summary.done == results.len() as u64);
        let summary = current.unwrap_or_else(|| Summary::of(&experiment, &results));
        Ok(Arc::new(Found::Rows(results, Box::new(summary))))
    })
    .await
}

/// Why something stored could not be read or written down.
struct Failed(String);

fn failed(error: impl std::fmt::Display) -> Failed {
    Failed(error.to_string())
}

impl<T> From<(T, String)> for Failed {
    fn from((_, reason): (T, String)) -> Self {
        Self(reason)
    }
}

/// Does what takes a processor a while beside the async threads.
async fn blocking<T: Send + 'static>(work: impl FnOnce() -> Result<T, Failed> + Send + 'static) -> Result<T, Problem> {
    let done = spawn_blocking(work).await.map_err(internal)?;
    done.map_err(|Failed(reason)| database(StoreError::Damaged(reason)))
}

/// One of its figures.
pub(super) async fn figure(
    state: &AppState,
    job: &Job,
    name: &str,
    metric: Option<String>,
    headers: &HeaderMap,
) -> Result<Response, Problem> {
    let row = row(state, job).await?;
    let document = row.document.clone();
    let experiment = Arc::new(blocking(move || Ok(read_experiment(&document)?)).await?);
    let Some(picture) = Picture::of(&experiment).find(|picture| picture.name() == name) else {
        let allowed = Picture::of(&experiment).map(Picture::name).collect::<Vec<_>>().join(", ");
        let detail = format!("there is no figure {:?}; of this experiment there are: {allowed}", brief(name));
        return Err(Problem::status(StatusCode::NOT_FOUND, detail).with("allowed", allowed));
    };
    if let Some(metric) = metric.as_deref().filter(|metric| experiment_metrics(&experiment).all(|it| it != *metric)) {
        return Err(unknown_metric(&experiment, metric));
    }
    let tag = tag(&row, &format!("{name} {}", metric.as_deref().unwrap_or_default()));
    let saved_as = format!("{}-{name}", &job.id.to_string()[..13]);
    let tag = tag.each_ref().map(String::as_str);
    let download = Download::new(picture.format.media_type(), Disposition::Inline, &saved_as, &tag);
    if let Some(response) = download.not_modified(headers) {
        return Ok(response);
    }
    let found = found(state, job, experiment.clone(), row).await?;
    let drawn = blocking(move || picture.bytes(&experiment, &found, metric.as_deref()).map_err(failed));
    Ok(download.bytes(headers, Bytes::from(drawn.await?)))
}

fn unknown_metric(experiment: &Experiment, metric: &str) -> Problem {
    let allowed = experiment_metrics(experiment).collect::<Vec<_>>().join(", ");
    let value = brief(metric);
    let detail = format!("metric: {value:?} is not known; allowed: {allowed}");
    Problem::new(StatusCode::UNPROCESSABLE_ENTITY, "/problems/unknown", "A name is not known", detail)
        .with("parameter", "metric")
        .with("value", value)
        .with("allowed", allowed)
}
