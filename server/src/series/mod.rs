//! Samples over HTTP: which of them, as what file, and the answer to a request for it.
//!
//! A handler calls [`SeriesRequest::new`] on the query, asks [`SeriesRequest::not_modified`] before it loads anything, and
//! hands the recording to [`SeriesRequest::respond`]. [`parquet::encode`] and [`parquet::decode`] are how it is stored.

mod csv;
mod npz;
pub mod parquet;
mod selection;
mod table;

pub use selection::{Format, Selection, SelectionError, SeriesQuery};
pub use table::Table;

use crate::download::{Disposition, Download};
use crate::error::Problem;
use adaptarm_core::recording::Recording;
use adaptarm_core::scenario::Report;
use axum::http::{HeaderMap, StatusCode};
use axum::response::Response;
use std::sync::Arc;
use tokio::task::spawn_blocking;

/// A request for the samples of one run.
#[derive(Debug, Clone)]
pub struct SeriesRequest {
    format: Format,
    selection: Selection,
    trajectory_hash: String,
    download: Download,
}

impl SeriesRequest {
    /// What a query asks of the run with this report.
    pub fn new(query: &SeriesQuery, report: &Report) -> Result<Self, SelectionError> {
        let format = query.format.as_deref().map_or(Ok(Format::Csv), Format::parse)?;
        let selection = Selection::parse(query.columns.as_deref(), query.every.as_deref())?;
        let columns = selection.columns().map_or_else(|| "*".to_owned(), |columns| columns.join(","));
        let (hash, every) = (report.trajectory_hash.clone(), selection.every().to_string());
        let name = format!("{}-{}.{}", report.scheme, hash.get(..12).unwrap_or(&hash), format.id());
        let content = [hash.as_str(), format.id(), &columns, &every];
        let download = Download::new(format.media_type(), Disposition::Attachment, &name, &content);
        Ok(Self { format, selection, trajectory_hash: hash, download })
    }

    /// 304 if the client has these samples already; known from the report alone.
    pub fn not_modified(&self, request: &HeaderMap) -> Option<Response> {
        self.download.not_modified(request)
    }

    /// The samples in the format and range that are asked for. All writing down happens beside the async threads.
    pub async fn respond(self, recording: Arc<Recording>, request: &HeaderMap) -> Result<Response, Problem> {
        let Self { format, selection, trajectory_hash, download } = self;
        let table = Arc::new(Table::new(recording, &selection)?);
        if format == Format::Csv {
            let Some(part) = download.part(request) else {
                return Ok(download.whole(csv::body(table)));
            };
            // How long the text is, only writing it down tells.
            let measured = table.clone();
            let ends = spawn_blocking(move || csv::ends(&measured)).await.map_err(|error| failed(&error))?;
            let length = ends.last().copied().unwrap_or_default();
            return Ok(download.partial(part, length, |range| csv::part(table, &ends, range)));
        }
        // Takes the table along: once the file is made, nobody holds the recording any more.
        let encode = move || match format {
            Format::Npz => npz::from_table(&table).map_err(|error| failed(&error)),
            _ => parquet::from_table(&table, &trajectory_hash).map_err(|error| failed(&error)),
        };
        let bytes = spawn_blocking(encode).await.map_err(|error| failed(&error))??;
        Ok(download.bytes(request, bytes.into()))
    }
}

fn failed(error: &dyn std::error::Error) -> Problem {
    tracing::error!("samples could not be written down: {error}");
    Problem::status(StatusCode::INTERNAL_SERVER_ERROR, "the samples could not be written down; the log says why")
}

#[cfg(test)]
mod tests {
    use super::table::tests::recording;
    use super::*;
    use adaptarm_core::scenario::{Scenario, Scheme};
    use axum::body::Bytes;
    use axum::http::{HeaderValue, header};
    use http_body_util::BodyExt;

    fn report(trajectory_hash: String) -> Report {
        let mut document = Scheme::Proposed.paper();
        (document.integration.duration_s, document.recording.samples) = (0.002, 1);
        Report { trajectory_hash, ..Scenario::new(document).unwrap().run().report }
    }

    async fn body(response: Response) -> Bytes {
        response.into_body().collect().await.unwrap().to_bytes()
    }

    #[tokio::test]
    async fn the_answer_to_no_wishes_is_the_core_s_csv() {
        let recording = recording(600);
        let request = SeriesRequest::new(&SeriesQuery::default(), &report(recording.hash())).unwrap();
        let answer = request.respond(recording.clone(), &HeaderMap::new()).await.unwrap();
        assert_eq!(answer.headers()[header::CONTENT_TYPE], "text/csv; charset=utf-8; header=present");
        let name = format!("attachment; filename=\"proposed-{}.csv\"", &recording.hash()[..12]);
        assert_eq!(answer.headers()[header::CONTENT_DISPOSITION], name);
        assert!(body(answer).await == recording.to_csv());
    }

    #[tokio::test]
    async fn every_format_can_be_continued_and_need_not_be_sent_again() {
        let recording = recording(600);
        for format in Format::ALL {
            let columns = Some("t_s,e_deg_1".to_owned());
            let query = SeriesQuery { format: Some(format.id().to_owned()), columns, ..SeriesQuery::default() };
            let request = SeriesRequest::new(&query, &report(recording.hash())).unwrap();
            let whole = request.clone().respond(recording.clone(), &HeaderMap::new()).await.unwrap();
            assert_eq!(whole.headers()[header::ACCEPT_RANGES], "bytes");
            let tag = whole.headers()[header::ETAG].clone();
            let whole = body(whole).await;

            let again = HeaderMap::from_iter([(header::IF_NONE_MATCH, tag.clone())]);
            assert_eq!(request.not_modified(&again).unwrap().status(), StatusCode::NOT_MODIFIED);

            let range = HeaderValue::from_static("bytes=1000-");
            let rest = HeaderMap::from_iter([(header::RANGE, range), (header::IF_RANGE, tag)]);
            let rest = request.clone().respond(recording.clone(), &rest).await.unwrap();
            assert_eq!(rest.status(), StatusCode::PARTIAL_CONTENT);
            let length = whole.len();
            assert_eq!(rest.headers()[header::CONTENT_RANGE], format!("bytes 1000-{}/{length}", length - 1));
            assert_eq!(rest.headers()[header::CONTENT_LENGTH], (length - 1000).to_string());
            assert!(body(rest).await == whole.slice(1000..), "{format:?}");

            let behind = HeaderMap::from_iter([(header::RANGE, HeaderValue::from_static("bytes=99999999-"))]);
            let behind = request.respond(recording.clone(), &behind).await.unwrap();
            assert_eq!(behind.status(), StatusCode::RANGE_NOT_SATISFIABLE);
            assert_eq!(behind.headers()[header::CONTENT_RANGE], format!("bytes */{length}"));
        }
    }

    #[tokio::test]
    async fn other_wishes_have_other_tags_and_unknown_columns_are_refused() {
        let recording = recording(2);
        let report = report(recording.hash());
        let tag = |columns: Option<&str>, every: Option<&str>, format: Option<&str>| {
            let [columns, every, format] = [columns, every, format].map(|text| text.map(str::to_owned));
            let request = SeriesRequest::new(&SeriesQuery { scenario: 0, format, columns, every }, &report).unwrap();
            let recording = recording.clone();
            async move { request.respond(recording, &HeaderMap::new()).await.map(|it| it.headers()[header::ETAG].clone()) }
        };
        let wishes =
            [(None, None, None), (Some("t_s"), None, None), (None, Some("2"), None), (None, None, Some("npz"))];
        let mut tags = Vec::new();
        for (columns, every, format) in wishes {
            let tag = tag(columns, every, format).await.unwrap();
            assert!(!tags.contains(&tag));
            tags.push(tag);
        }
        assert_eq!(tag(None, Some("1"), Some("csv")).await.as_ref(), Ok(&tags[0]));
        let problem = tag(Some("q_deg_1"), None, None).await.unwrap_err();
        assert_eq!((problem.status, problem.kind), (422, "/problems/unknown"));
    }
}
