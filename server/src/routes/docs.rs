//! The description of the API: as a document, and as a page on which it can be tried (Swagger UI, without any network).
//!
//! The page is ours, because the one that Swagger UI brings has scripts in it, which our policy forbids.

use super::internal;
use crate::api::Name;
use crate::download::{Disposition, Download};
use crate::error::Problem;
use crate::openapi;
use axum::Json;
use axum::http::{HeaderMap, header};
use axum::response::{Html, IntoResponse, Response};
use serde_json::Value;
use std::sync::Arc;
use utoipa_swagger_ui::Config;

const PAGE: &str = r#"<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>adaptarm API</title>
<link rel="stylesheet" href="/api/docs/swagger-ui.css">
<link rel="icon" href="data:,">
</head>
<body>
<nav aria-label="adaptarm"><a href="/">← adaptarm</a></nav>
<main id="swagger-ui"></main>
<noscript>This page needs JavaScript; the document behind it is <a href="/api/v1/openapi.json">openapi.json</a>.</noscript>
<script src="/api/docs/swagger-ui-bundle.js"></script>
<script src="/api/docs/start.js"></script>
</body>
</html>
"#;

const START: &str = r##"SwaggerUIBundle({
  url: "/api/v1/openapi.json",
  dom_id: "#swagger-ui",
  deepLinking: true,
  docExpansion: "list",
  defaultModelsExpandDepth: 0,
  displayRequestDuration: true,
  // It would ask a server of others whether the document is valid.
  validatorUrl: null,
});
"##;

/// Files of Swagger UI that the page loads.
const FILES: [(&str, &str); 2] =
    [("swagger-ui.css", "text/css; charset=utf-8"), ("swagger-ui-bundle.js", "text/javascript; charset=utf-8")];

/// This description, as OpenAPI 3.1.
#[utoipa::path(
    get, path = "/api/v1/openapi.json", operation_id = "openapi", tag = "catalog",
    responses((status = 200, description = "The document.", body = Value)),
)]
pub(super) async fn document() -> Json<&'static Value> {
    Json(openapi::document())
}

pub(super) async fn page() -> Html<&'static str> {
    Html(PAGE)
}

/// What the page loads.
pub(super) async fn file(Name(name): Name, headers: HeaderMap) -> Result<Response, Problem> {
    if name == "start.js" {
        return Ok(([(header::CONTENT_TYPE, "text/javascript; charset=utf-8")], START).into_response());
    }
    let unknown = || Problem::not_found("file of this page called", &name);
    let (file, media_type) = FILES.iter().find(|(file, _)| *file == name).ok_or_else(unknown)?;
    let found = utoipa_swagger_ui::serve(file, Arc::new(Config::from("/api/v1/openapi.json"))).map_err(internal)?;
    let bytes = found.ok_or_else(unknown)?.bytes.into_owned();
    let download = Download::new(media_type, Disposition::Inline, file, &[&blake3::hash(&bytes).to_hex()]);
    Ok(download.not_modified(&headers).unwrap_or_else(|| download.bytes(&headers, bytes.into())))
}
