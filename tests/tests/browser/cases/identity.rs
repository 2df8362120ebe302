//! The same bits in the browser, in this process, in the release binary and in the committed hashes; and nobody else asked.

use crate::bench::{Bench, repository};
use crate::native::{edited, report, shown_hash};
use crate::page::{Page, Screen};
use adaptarm_core::scenario::Scheme;
use anyhow::{Context, Result, ensure};
use serde_json::Value;
use std::process::Command;

pub fn the_default_study_has_the_same_bits_everywhere(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Desktop)?;
    let golden = std::fs::read_to_string(repository().join("core/tests/trajectory_hashes.json")).ok();
    let golden: Option<Value> = golden.map(|text| serde_json::from_str(&text)).transpose()?;
    for scheme in Scheme::ALL {
        let shown = shown_hash(&page, scheme)?;
        let here = report(&edited(scheme, &[])?)?.trajectory_hash;
        ensure!(shown == here, "{}: the browser has {shown}, this process {here}", scheme.id());
        let output = Command::new(adaptarm_tests::binary()?).args(["run", "--preset", scheme.id()]).output()?;
        let printed: Value = serde_json::from_slice(&output.stdout).context("the binary printed no report")?;
        ensure!(printed["trajectory_hash"] == shown.as_str(), "{}: the binary has other bits", scheme.id());
        if let Some(golden) = &golden {
            ensure!(golden[scheme.id()] == shown.as_str(), "{}: the committed hash is another", scheme.id());
        }
    }
    Ok(())
}

pub fn nothing_is_asked_of_other_origins(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Desktop)?;
    page.click("#theme-toggle")?;
    let origin = format!("{}/", bench.server.url.trim_end_matches('/'));
    let mut requests = 0;
    for entry in page.log("performance")? {
        let message: Value = serde_json::from_str(entry["message"].as_str().unwrap_or_default())?;
        let message = &message["message"];
        if message["method"] == "Network.requestWillBeSent" {
            let url = message["params"]["request"]["url"].as_str().unwrap_or_default();
            // Data in the page are no requests.
            if url.starts_with("data:") {
                continue;
            }
            ensure!(url.starts_with(&origin), "the page asked for {url}");
            requests += 1;
        }
    }
    ensure!(requests > 10, "only {requests} requests were logged: the log does not work");
    let complaints = page.log("browser")?;
    if let Some(first) = complaints.first() {
        anyhow::bail!("the browser complains {} times, first: {}", complaints.len(), first["message"]);
    }
    Ok(())
}
