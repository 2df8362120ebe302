//! The page: `static/` as the build found it, with compressed forms, entity tags and conditional requests.
//!
//! `/files.json` lists every file with its hash, so that the service worker (`static/sw.js`) can keep the whole page for
//! use without a server, and never mixes files of two versions. The list is made from what is served: nothing can be
//! forgotten in it. Exercises stand in the same folder and are no part of the page: they hold what students may not see.

use axum::Router;
use axum::http::{HeaderMap, HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Response};
use axum::routing::get;
use memory_serve::{CacheControl, MemoryServe};
use serde::Serialize;
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::sync::LazyLock;

/// Where the list is.
const LIST: &str = "/files.json";

/// Every file of the page. A version is one set of contents.
#[derive(Debug, Serialize)]
struct Files {
    /// SHA-256 over all paths and hashes.
    version: String,
    /// Path from the page's root, without a slash in front, to the content's SHA-256.
    files: BTreeMap<&'static str, String>,
}

/// Routes of the page and its files. Made once: memory-serve keeps its bytes for the life of the process.
pub fn router<S: Clone + Send + Sync + 'static>() -> Router<S> {
    MemoryServe::new(assets())
        // A new version must not run an old one's scripts: browsers keep files, but ask each time whether they changed.
        .html_cache_control(CacheControl::NoCache)
        .cache_control(CacheControl::NoCache)
        // A debug build compresses at each request, which takes seconds unoptimised.
        .enable_brotli(!cfg!(debug_assertions))
        .enable_gzip(!cfg!(debug_assertions))
        .into_router()
        .route(LIST, get(list))
}

/// Where exercises are; solutions and hidden variants among them.
const NOT_SERVED: &str = "/exercises/";

fn assets() -> &'static [memory_serve::Asset] {
    static PAGE: LazyLock<Vec<memory_serve::Asset>> = LazyLock::new(|| {
        let folders: &[(&str, &'static [memory_serve::Asset])] =
            include!(concat!(env!("OUT_DIR"), "/memory_serve_assets.rs"));
        let all = folders.iter().flat_map(|(_, assets)| assets.iter());
        let served = all.filter(|asset| !asset.route.starts_with(NOT_SERVED));
        served.map(|asset| memory_serve::Asset { ..*asset }).collect()
    });
    &PAGE
}

/// The list, which browsers ask for at each visit: a tag spares its repetition.
async fn list(headers: HeaderMap) -> Response {
    static EMBEDDED: LazyLock<Files> = LazyLock::new(Files::of_page);
    // A debug build serves files as they are on disk now.
    let files = if cfg!(debug_assertions) { &Files::of_page() } else { &*EMBEDDED };
    let tag = format!("\"{}\"", files.version);
    let known = headers.get(header::IF_NONE_MATCH).is_some_and(|known| known.as_bytes() == tag.as_bytes());
    let status = if known { StatusCode::NOT_MODIFIED } else { StatusCode::OK };
    let body = if known { String::new() } else { serde_json::json!(files).to_string() };
    let headers = [(header::CONTENT_TYPE, "application/json"), (header::CACHE_CONTROL, "no-cache")];
    let tag = HeaderValue::from_str(&tag).map(|tag| [(header::ETAG, tag)]);
    (status, headers, tag.ok(), body).into_response()
}

impl Files {
    fn of_page() -> Self {
        let hash = |asset: &'static memory_serve::Asset| match asset.bytes {
            // The tag of an embedded file is the hash of its content before compression.
            Some(_) => Some(asset.etag.to_owned()),
            // Gone since the build: not served, so not listed.
            None => std::fs::read(asset.path).ok().map(|bytes| hex::encode(Sha256::digest(bytes))),
        };
        let file = |asset: &'static memory_serve::Asset| Some((asset.route.trim_start_matches('/'), hash(asset)?));
        let files: BTreeMap<_, _> = assets().iter().filter_map(file).collect();
        let mut version = Sha256::new();
        for (path, hash) in &files {
            version.update(format!("{path}\n{hash}\n"));
        }
        Self { version: hex::encode(version.finalize()), files }
    }
}
