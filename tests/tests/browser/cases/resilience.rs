//! What survives: settings and theme a reload, the page a missing module and a dead worker.

use crate::bench::Bench;
use crate::native::{expect_study, gain_field, shown_hash};
use crate::page::{Page, Screen};
use adaptarm_core::scenario::Scheme;
use anyhow::{Context, Result, ensure};
use serde_json::json;

pub fn a_reload_keeps_state_and_theme(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Desktop)?;
    page.type_into(&format!("{} .exact input", gain_field(Scheme::Proposed, "/scheme/gains/beta")), "3.25")?;
    page.click("#theme-toggle")?;
    page.click("#tab-slotine_li")?;
    page.click("scheme-card[data-scheme=tang_arteaga] input")?;
    page.ready()?;
    let before = shown_hash(&page, Scheme::Proposed)?;
    page.reload()?;
    ensure!(shown_hash(&page, Scheme::Proposed)? == before, "the gains are gone");
    expect_study(&page, |scheme| match scheme {
        Scheme::Proposed => vec![("/scheme/gains/beta".to_owned(), 3.25)],
        _ => Vec::new(),
    })?;
    let kept = page.run(
        "return [document.documentElement.dataset.theme, \
         document.querySelector('[role=tabpanel]:not([hidden])').dataset.scheme, \
         document.querySelector('scheme-card[data-scheme=tang_arteaga] input').checked]",
        &[],
    )?;
    ensure!(kept == json!(["dark", "slotine_li", false]), "not kept: {kept}");
    Ok(())
}

pub fn a_missing_module_is_explained(bench: &Bench) -> Result<()> {
    let page = Page::blank(bench, Screen::Desktop)?;
    page.devtools("Network.enable", &json!({}))?;
    page.devtools("Network.setBlockedURLs", &json!({ "urls": ["*adaptarm_web_bg.wasm"] }))?;
    page.visit()?;
    page.wait_for("return document.documentElement.dataset.state === 'failed'")?;
    let notice = page.run("return document.querySelector('.notice.error').textContent", &[])?;
    ensure!(notice.as_str().is_some_and(|text| text.contains("cargo xtask dist")), "the notice says {notice}");
    Ok(())
}

pub fn a_dead_worker_is_replaced(bench: &Bench) -> Result<()> {
    // In the middle of a run, the worker ends and the browser reports an error.
    let report = "worker.dispatchEvent(new ErrorEvent('error', { message: 'killed', cancelable: true }));";
    workers_end(bench, report)
}

pub fn a_silent_worker_is_replaced(bench: &Bench) -> Result<()> {
    // The browser took the worker away, for its memory say, and tells nobody.
    workers_end(bench, "")
}

/// Ends all workers in the middle of a run; the run must be started again, and its result be the right one.
fn workers_end(bench: &Bench, report: &str) -> Result<()> {
    let page = Page::blank(bench, Screen::Desktop)?;
    page.before_each_page(
        "window.workers = []; const Real = Worker; \
         window.Worker = class extends Real { constructor(...all) { super(...all); window.workers.push(this); } }",
    )?;
    page.visit()?;
    page.ready()?;
    let kill = format!(
        "const slider = document.querySelector(arguments[0] + ' input[type=range]'); \
         slider.value = 30; slider.dispatchEvent(new Event('input', {{ bubbles: true }})); \
         for (const worker of [...window.workers]) {{ worker.terminate(); {report} }}"
    );
    let pointer = "/scheme/gains/k_v/0";
    let field = gain_field(Scheme::Proposed, pointer);
    page.run(&kill, &[json!(field)])?;
    page.ready()?;
    let notices = page.run("return document.querySelector('#notices').textContent", &[])?;
    ensure!(notices.as_str().is_some_and(|text| text.contains("restarted")), "nothing is said: {notices}");
    let value = page.run("return document.querySelector(arguments[0]).value", &[json!(field)])?;
    let value = value.as_f64().context("no value")?;
    expect_study(&page, |scheme| match scheme {
        Scheme::Proposed => vec![(pointer.to_owned(), value)],
        _ => Vec::new(),
    })
}
