//! The jobs page, each trial with a server of its own: what one trial submits no other sees.

use crate::bench::Bench;
use crate::native::{edited, gain_field, report, shown_hash};
use crate::page::{Page, Screen};
use crate::pictures::save;
use adaptarm_core::scenario::Scheme;
use adaptarm_tests::Server;
use adaptarm_tests::client::Client;
use anyhow::{Context, Result, ensure};
use serde_json::{Value, json};
use std::time::Duration;

/// Goes to an address and waits until that page has started.
pub(super) fn go(page: &Page<'_>, url: &str) -> Result<()> {
    page.devtools("Page.navigate", &json!({ "url": url }))?;
    page.wait_for(&format!(
        "return location.href === {} && ['ready', 'failed'].includes(document.documentElement.dataset.state)",
        json!(url)
    ))
}

/// The playground of a server in a new browser.
pub(super) fn playground<'a>(bench: &'a Bench, server: &Server) -> Result<Page<'a>> {
    let page = Page::blank(bench, Screen::Desktop)?;
    go(&page, &format!("{}/", server.url))?;
    page.ready()?;
    Ok(page)
}

pub(super) fn text(page: &Page<'_>, script: &str) -> Result<String> {
    Ok(page.run(script, &[])?.as_str().context("no text")?.to_owned())
}

/// A study of runs so short that they are done at once; another seed is another scenario.
pub(super) fn short(label: &str, seed: usize) -> Value {
    json!({ "kind": "study", "label": label, "spec": { "scenarios": [{ "format": "adaptarm.scenario/1", "seed": seed,
        "scheme": { "kind": "slotine_li" }, "integration": { "duration_s": 0.1 }, "recording": { "samples": 10 } }] } })
}

/// A study that outlasts every trial.
pub(super) fn long(label: &str) -> Value {
    json!({ "kind": "study", "label": label, "spec": { "scenarios": [{ "format": "adaptarm.scenario/1",
        "scheme": { "kind": "proposed" }, "integration": { "duration_s": 50_000 } }] } })
}

pub fn the_jobs_page_lists_filters_cancels_and_deletes(bench: &Bench) -> Result<()> {
    let server = Server::start(&[])?;
    let client = Client::new(&server.url);
    let page = Page::blank(bench, Screen::Desktop)?;
    go(&page, &format!("{}/jobs.html", server.url))?;
    let empty = text(&page, "return document.querySelector('.empty').textContent")?;
    ensure!(empty.contains("No jobs yet"), "{empty}");

    // What is submitted elsewhere is seen without asking once something moves; now it is asked for.
    for n in 0..23 {
        client.submit(&short(&format!("short {n}"), n))?;
    }
    let running = client.submit(&long("a long one"))?;
    page.click("#refresh")?;
    page.wait_for("return document.querySelectorAll('.job-row').length === 20")?;
    let row = format!("document.querySelector('.job-row[data-job=\"{running}\"]')");
    let first = text(&page, "return document.querySelector('.job-name').textContent")?;
    ensure!(first == "a long one", "the newest is not first: {first}");
    page.wait_for(&format!("return {row}.querySelector('progress').value > 0"))?;
    page.click(".more")?;
    page.wait_for(
        "return document.querySelectorAll('.job-row').length === 24 && document.querySelector('.more').hidden",
    )?;
    let order =
        page.run("return [...document.querySelectorAll('.job-name')].slice(1).map((name) => name.textContent)", &[])?;
    let expected: Vec<_> = (0..23).rev().map(|n| format!("short {n}")).collect();
    ensure!(order == json!(expected), "{order}");

    page.run(
        "const filter = document.querySelector('#filter-state'); filter.value = 'running'; \
         filter.dispatchEvent(new Event('change'))",
        &[],
    )?;
    page.wait_for("return document.querySelectorAll('.job-row').length === 1")?;
    // A no keeps it, a yes stops it, and the list, which shows what runs, is empty.
    page.click(".cancel-job > button")?;
    page.click(".cancel-job .confirm-box .quiet")?;
    ensure!(client.job(&running)?["state"] == "running", "a no stopped it");
    page.click(".cancel-job > button")?;
    page.click(".cancel-job .danger")?;
    page.wait_for("return document.querySelectorAll('.job-row').length === 0")?;
    ensure!(client.job(&running)?["state"] == "canceled", "not stopped");
    ensure!(text(&page, "return document.querySelector('.empty').textContent")?.contains("No job is like this"));

    page.run(
        "const filter = document.querySelector('#filter-state'); filter.value = 'canceled'; \
         filter.dispatchEvent(new Event('change'))",
        &[],
    )?;
    page.wait_for(&format!("return {row}?.querySelector('.state-badge').textContent.includes('canceled')"))?;
    page.click(".delete-job > button")?;
    page.click(".delete-job .danger")?;
    page.wait_for("return document.querySelectorAll('.job-row').length === 0")?;
    client.get(&format!("/api/v1/jobs/{running}"))?.expect_status(404)?;

    // A hidden tab asks nothing.
    page.run("Object.defineProperty(document, 'hidden', { value: true, configurable: true })", &[])?;
    std::thread::sleep(Duration::from_millis(300));
    let asked = "return performance.getEntriesByType('resource').filter(({ name }) => name.includes('/jobs?')).length";
    client.submit(&long("unseen"))?;
    let before = page.run(asked, &[])?;
    std::thread::sleep(Duration::from_secs(4));
    ensure!(page.run(asked, &[])? == before, "a hidden tab asks");
    Ok(())
}

pub fn a_job_opens_in_the_playground(bench: &Bench) -> Result<()> {
    let server = Server::start(&[])?;
    let client = Client::new(&server.url);
    let documents = [
        edited(Scheme::SlotineLi, &[("/integration/duration_s", 6.0)])?,
        edited(Scheme::Proposed, &[("/integration/duration_s", 6.0), ("/scheme/gains/beta", 9.5)])?,
    ];
    let id = client.submit(&json!({ "kind": "study", "label": "two", "spec": { "scenarios": documents } }))?;
    client.wait(&id, Duration::from_mins(1))?;
    let page = playground(bench, &server)?;
    page.click("scheme-card[data-scheme=proposed] input")?;
    go(&page, &format!("{}/jobs.html", server.url))?;
    page.click(".job-name")?;
    page.wait_for("return document.querySelectorAll('.scenario-table [data-scenario]').length === 2")?;
    for (n, document) in documents.iter().enumerate() {
        page.click(&format!("[data-scenario='{n}'] a"))?;
        page.wait_for(&format!("return document.querySelector('.scenario').dataset.scenario === '{n}'"))?;
        let report = report(document)?;
        let shown = page.run(
            "const { scenarioHash, trajectoryHash } = document.querySelector('.scenario').dataset; \
             return [scenarioHash, trajectoryHash]",
            &[],
        )?;
        ensure!(shown == json!([report.scenario_hash, report.trajectory_hash]), "scenario {n}: {shown}");
        let name = if n == 0 { "estimates_2" } else { "observer_errors" };
        page.run(
            "const choice = document.querySelector('#figure-choice'); choice.value = arguments[0]; \
             choice.dispatchEvent(new Event('change'))",
            &[json!(name)],
        )?;
        page.wait_for(&format!(
            "const picture = document.querySelector('.server-figure img'); \
             return picture.src.includes('/{name}.svg?scenario={n}') && picture.naturalWidth > 0 && picture.alt !== ''"
        ))?;
    }
    let files = page.run_async(
        "const done = arguments[0]; Promise.all([...document.querySelectorAll('[data-download]')].map(async (link) => \
         [link.dataset.download, (await fetch(link.href)).status, link.download !== ''])).then(done)",
        &[],
    )?;
    let files = files.as_array().context("no downloads")?;
    ensure!(files.len() == 7 && files.iter().all(|file| file[1] == 200 && file[2] == true), "{files:?}");
    save(&page, "jobs-details")?;

    page.click("#open-study")?;
    page.wait_for("return location.pathname === '/' && document.documentElement.dataset.state === 'ready'")?;
    for (scheme, document) in [(Scheme::SlotineLi, &documents[0]), (Scheme::Proposed, &documents[1])] {
        let expected = report(document)?;
        ensure!(shown_hash(&page, scheme)? == expected.trajectory_hash, "{}: other bits", scheme.id());
        let shown = page.run(
            "const card = document.querySelector(`scheme-card[data-scheme=${arguments[0]}]`); \
             return [card.dataset.scenarioHash, card.querySelector('input').checked]",
            &[json!(scheme.id())],
        )?;
        ensure!(shown == json!([expected.scenario_hash, true]), "{}: {shown}", scheme.id());
    }
    let width = page.run("return document.querySelector('.notice.info').getBoundingClientRect().width", &[])?;
    ensure!(width.as_f64().is_some_and(|width| width > 500.0), "what was taken over is said in {width} px");
    // Taken once: what is changed after that is not undone by a reload.
    page.type_into(&format!("{} .exact input", gain_field(Scheme::Proposed, "/scheme/gains/beta")), "2.5")?;
    page.ready()?;
    let changed = shown_hash(&page, Scheme::Proposed)?;
    page.reload()?;
    ensure!(shown_hash(&page, Scheme::Proposed)? == changed, "the reload brought the job's settings back");

    // What cannot be used is said and changes nothing.
    for (document, said) in [
        (json!({ "format": "adaptarm.scenario/9", "scheme": { "kind": "proposed" } }), "adaptarm.scenario/9"),
        (json!({ "format": "adaptarm.scenario/1", "robot": "pendulum", "scheme": { "kind": "proposed" } }), "Pendulum"),
    ] {
        page.run(
            "sessionStorage.setItem('adaptarm.handover', JSON.stringify({ scenarios: [arguments[0]] }))",
            &[document],
        )?;
        page.reload()?;
        let notice = text(&page, "return document.querySelector('.notice.error')?.textContent ?? ''")?;
        ensure!(notice.contains("nothing was changed") && notice.contains(said), "{notice}");
        ensure!(shown_hash(&page, Scheme::Proposed)? == changed, "something was changed");
    }
    Ok(())
}

pub fn a_study_is_submitted_by_hand(bench: &Bench) -> Result<()> {
    let server = Server::start(&[])?;
    let page = Page::blank(bench, Screen::Desktop)?;
    go(&page, &format!("{}/jobs.html", server.url))?;
    page.click(".submit-study summary")?;
    let submit = |document: &str| -> Result<()> {
        page.run("document.querySelector('#submit-text').value = arguments[0]", &[json!(document)])?;
        page.click(".submit-study button[type=submit]")
    };
    let wrong = "return document.querySelector('#submit-error').textContent";
    submit("{ \"scenarios\": ")?;
    page.wait_for(&format!("{wrong}.includes('not JSON')"))?;
    submit(r#"{ "format": "adaptarm.scenario/1", "scheme": { "kind": "proposed", "gains": { "beta": -8 } } }"#)?;
    page.wait_for(&format!("{wrong}.includes('/spec/scenarios/0/scheme/gains/beta')"))?;
    let range = text(&page, wrong)?;
    ensure!(range.contains("0 to 10000"), "the range is not said: {range}");
    let focus = text(&page, "return document.activeElement.id")?;
    ensure!(focus == "submit-text", "the focus is on {focus}");
    submit(&short("", 1)["spec"].to_string())?;
    page.wait_for("return document.querySelector('.job-view')?.dataset.state === 'succeeded'")?;
    ensure!(Client::new(&server.url).jobs("")?.len() == 1, "not one job");
    Ok(())
}

pub fn the_jobs_page_fits_a_phone(bench: &Bench) -> Result<()> {
    let server = Server::start(&[])?;
    let client = Client::new(&server.url);
    client.submit(&long(&"a name without an end ".repeat(5)))?;
    let id = client.submit(&short(&"W".repeat(200), 1))?;
    client.wait(&id, Duration::from_mins(1))?;
    let page = Page::blank(bench, Screen::Phone)?;
    for address in ["jobs.html".to_owned(), format!("jobs.html#{id}")] {
        // From elsewhere: a changed fragment alone loads no page.
        page.devtools("Page.navigate", &json!({ "url": "about:blank" }))?;
        go(&page, &format!("{}/{address}", server.url))?;
        page.run("for (const details of document.querySelectorAll('details')) details.open = true", &[])?;
        for theme in ["light", "dark"] {
            let outside = page.run(
                "return [document.documentElement.scrollWidth - innerWidth, ...[...document.querySelectorAll('main *')] \
                 .filter((node) => { const box = node.getBoundingClientRect(); return box.width > 0 && \
                 !node.closest('.picture-box') && (box.right > innerWidth + 1 || box.left < -1); }) \
                 .map((node) => node.outerHTML.slice(0, 120))]",
                &[],
            )?;
            ensure!(outside == json!([0]), "{address} is too wide: {outside}");
            let small = page.run(
                "return [...document.querySelectorAll('main :is(button, select, summary, input, textarea, a)')] \
                 .filter((node) => { const { width, height } = node.getBoundingClientRect(); \
                 return width > 0 && (height < 43.9 || width < 43.9); }).map((node) => node.outerHTML.slice(0, 120))",
                &[],
            )?;
            ensure!(small == json!([]), "too small for a finger: {small}");
            let view = if address.contains('#') { "details" } else { "list" };
            save(&page, &format!("jobs-{view}-phone-{theme}"))?;
            page.click("#theme-toggle")?;
        }
    }
    Ok(())
}
