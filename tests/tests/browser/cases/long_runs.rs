//! Long runs: drawn while they compute, stopped, started again.

use crate::bench::Bench;
use crate::page::{Page, Screen};
use crate::pictures::canvas;
use anyhow::{Result, ensure};
use serde_json::json;

const DURATION: &str = "[data-pointer='/integration/duration_s'] input[type=text]";

pub fn a_long_run_is_drawn_while_it_computes_and_can_be_stopped(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Desktop)?;
    let outcome =
        |scheme: &str| page.run("return document.querySelector(arguments[0]).dataset.outcome", &[json!(card(scheme))]);
    page.type_into(DURATION, "3000")?;
    page.wait_for("return document.querySelectorAll('scheme-card[data-outcome=running]').length >= 2")?;
    let early = canvas(&page, "tracking_errors")?;
    std::thread::sleep(std::time::Duration::from_millis(400));
    ensure!(canvas(&page, "tracking_errors")? != early, "nothing new was drawn while the runs went on");
    page.click(&format!("{} .stop", card("proposed")))?;
    page.wait_for("return document.querySelector('scheme-card[data-scheme=proposed]').dataset.outcome === 'stopped'")?;
    // The worker is free again: an edit of the stopped scheme runs at once, beside the others.
    page.type_into(DURATION, "12")?;
    page.ready()?;
    for scheme in ["proposed", "tang_arteaga", "slotine_li"] {
        ensure!(outcome(scheme)? == json!("completed"), "{scheme}");
    }
    Ok(())
}

pub fn a_stopped_run_can_be_started_again(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Desktop)?;
    page.type_into(DURATION, "300")?;
    // In one go: between two calls the run of what was typed before may end, and then there is nothing to stop.
    page.wait_for(
        "const card = document.querySelector('scheme-card[data-scheme=proposed]'); \
        if (card.dataset.outcome !== 'running') return false; \
        card.querySelector('.stop').click(); return true",
    )?;
    page.ready()?;
    let text = page.run("return document.querySelector('scheme-card .outcome').textContent", &[])?;
    ensure!(text.as_str().is_some_and(|text| text.starts_with("stopped at")), "{text}");
    page.click(&format!("{} .stop", card("proposed")))?;
    page.wait_for(
        "return document.querySelector('scheme-card[data-scheme=proposed]').dataset.outcome === 'completed'",
    )?;
    page.ready()
}

fn card(scheme: &str) -> String {
    format!("scheme-card[data-scheme={scheme}]")
}
