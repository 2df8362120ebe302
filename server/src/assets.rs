//! The page: `static/` as the build found it, with compressed forms, entity tags and conditional requests.

use axum::Router;
use memory_serve::{CacheControl, MemoryServe};

/// Routes of the page and its files. Made once: memory-serve keeps its bytes for the life of the process.
pub fn router<S: Clone + Send + Sync + 'static>() -> Router<S> {
    let files: &[(&str, &'static [memory_serve::Asset])] =
        include!(concat!(env!("OUT_DIR"), "/memory_serve_assets.rs"));
    let page = files.first().map_or::<&'static [memory_serve::Asset], _>(&[], |(_, assets)| assets);
    MemoryServe::new(page)
        // A new version must not run an old one's scripts: browsers keep files, but ask each time whether they changed.
        .html_cache_control(CacheControl::NoCache)
        .cache_control(CacheControl::NoCache)
        // A debug build compresses at each request, which takes seconds unoptimised.
        .enable_brotli(!cfg!(debug_assertions))
        .enable_gzip(!cfg!(debug_assertions))
        .into_router()
}
