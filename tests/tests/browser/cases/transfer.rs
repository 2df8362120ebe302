//! How much a first visit takes over the wire, by kind of file. A debug server compresses nothing, so there it is only printed.

use crate::bench::Bench;
use crate::page::{Page, Screen};
use anyhow::{Result, ensure};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};

/// Bytes, headers included.
pub const LIMIT: f64 = 600_000.0;

pub fn a_first_visit_is_small(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Desktop)?;
    let (kinds, compressed) = measure(&page)?;
    let total: f64 = kinds.values().sum();
    for (kind, bytes) in &kinds {
        println!("{kind:<12}{:>8.1} kB", bytes / 1000.0);
    }
    println!("{:<12}{:>8.1} kB{}", "total", total / 1000.0, if compressed { "" } else { ", uncompressed" });
    ensure!(kinds.contains_key("wasm") && kinds.contains_key("js"), "not everything was counted: {kinds:?}");
    ensure!(!compressed || total < LIMIT, "{total} bytes; the limit is {LIMIT}");
    Ok(())
}

/// Bytes that came over the wire since the page was opened, by the file's ending, and whether they were compressed.
pub fn measure(page: &Page<'_>) -> Result<(BTreeMap<String, f64>, bool)> {
    let mut address = BTreeMap::new();
    let mut kinds: BTreeMap<String, f64> = BTreeMap::new();
    let mut encodings = BTreeSet::new();
    for entry in page.log("performance")? {
        let message: Value = serde_json::from_str(entry["message"].as_str().unwrap_or_default())?;
        let (method, parameters) = (&message["message"]["method"], &message["message"]["params"]);
        let id = parameters["requestId"].as_str().unwrap_or_default().to_owned();
        if method == "Network.responseReceived" {
            let response = &parameters["response"];
            let url = response["url"].as_str().unwrap_or_default().to_owned();
            let encoding = |name: &str| response["headers"][name].as_str().map(str::to_owned);
            encodings.extend(encoding("content-encoding").or_else(|| encoding("Content-Encoding")));
            if url.starts_with("http") {
                address.insert(id, url);
            }
        } else if method == "Network.loadingFinished"
            && let Some(url) = address.get(&id)
        {
            *kinds.entry(kind(url)).or_default() += parameters["encodedDataLength"].as_f64().unwrap_or_default();
        }
    }
    Ok((kinds, encodings.contains("br") || encodings.contains("gzip")))
}

fn kind(url: &str) -> String {
    let path = url.split(['?', '#']).next().unwrap_or_default();
    let name = path.rsplit('/').next().unwrap_or_default();
    name.rsplit_once('.').map_or("html", |(_, ending)| ending).to_owned()
}
