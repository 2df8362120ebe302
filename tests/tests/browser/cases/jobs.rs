//! Runs on the server and the jobs page, each trial with a server of its own: what one trial submits no other sees.

use crate::bench::Bench;
use crate::native::{edited, expect_study, gain_field, report, shown_hash};
use crate::page::{Page, Screen};
use crate::pictures::save;
use adaptarm_core::scenario::Scheme;
use adaptarm_tests::client::Client;
use adaptarm_tests::{Launch, Server};
use anyhow::{Context, Result, ensure};
use serde_json::{Value, json};
use std::time::Duration;

const DURATION: &str = "[data-pointer='/integration/duration_s'] input[type=text]";
const ENDED: &str = "return document.querySelector('#server-panel')?.dataset.phase === 'ended'";
const MESSAGE: &str = "return document.querySelector('.message p')?.textContent ?? ''";

/// Goes to an address and waits until that page has started.
fn go(page: &Page<'_>, url: &str) -> Result<()> {
    page.devtools("Page.navigate", &json!({ "url": url }))?;
    page.wait_for(&format!(
        "return location.href === {} && ['ready', 'failed'].includes(document.documentElement.dataset.state)",
        json!(url)
    ))
}

/// The playground of a server in a new browser.
fn playground<'a>(bench: &'a Bench, server: &Server) -> Result<Page<'a>> {
    let page = Page::blank(bench, Screen::Desktop)?;
    go(&page, &format!("{}/", server.url))?;
    page.ready()?;
    Ok(page)
}

/// What the panel says about each scheme: verdict, hash in the browser, hash on the server.
fn verdicts(page: &Page<'_>) -> Result<Value> {
    page.run(
        "return Object.fromEntries([...document.querySelectorAll('#server-panel tbody tr')].map((row) => \
         [row.dataset.scheme, [row.dataset.verdict, ...[1, 2].map((n) => \
         row.cells[n].querySelector('[data-hash]')?.dataset.hash ?? null)]]))",
        &[],
    )
}

fn text(page: &Page<'_>, script: &str) -> Result<String> {
    Ok(page.run(script, &[])?.as_str().context("no text")?.to_owned())
}

/// A study of runs so short that they are done at once; another seed is another scenario.
fn short(label: &str, seed: usize) -> Value {
    json!({ "kind": "study", "label": label, "spec": { "scenarios": [{ "format": "adaptarm.scenario/1", "seed": seed,
        "scheme": { "kind": "slotine_li" }, "integration": { "duration_s": 0.1 }, "recording": { "samples": 10 } }] } })
}

/// A study that outlasts every trial.
fn long(label: &str) -> Value {
    json!({ "kind": "study", "label": label, "spec": { "scenarios": [{ "format": "adaptarm.scenario/1",
        "scheme": { "kind": "proposed" }, "integration": { "duration_s": 50_000 } }] } })
}

pub fn the_server_gives_the_same_bits(bench: &Bench) -> Result<()> {
    let server = Server::start(&[])?;
    let page = playground(bench, &server)?;
    page.click("#run-on-server")?;
    page.wait_for(ENDED)?;
    page.wait_for("return document.querySelectorAll('#server-panel [data-verdict=same] .verdict').length === 3")?;
    let shown = verdicts(&page)?;
    for scheme in Scheme::ALL {
        let expected = report(&edited(scheme, &[])?)?.trajectory_hash;
        ensure!(shown[scheme.id()] == json!(["same", expected, expected]), "{}: {shown}", scheme.id());
    }
    let jobs = Client::new(&server.url).jobs("")?;
    ensure!(jobs.len() == 1 && jobs[0]["label"] == "Playground: The paper's study", "{jobs:?}");
    save(&page, "server-run")?;

    // A hidden scheme is not submitted, and that is said.
    page.click("scheme-card[data-scheme=tang_arteaga] input")?;
    page.click("#run-on-server")?;
    page.wait_for(
        "return document.querySelector('#server-panel tr[data-scheme=tang_arteaga]')?.dataset.verdict === 'hidden'",
    )?;
    page.wait_for(ENDED)?;
    page.wait_for("return document.querySelectorAll('#server-panel tr[data-verdict=same]').length === 2")?;
    let jobs = Client::new(&server.url).jobs("")?;
    ensure!(jobs.len() == 2 && jobs[0]["scenarios"] == 2 && jobs[0]["cached"] == true, "{jobs:?}");

    page.click("#server-dismiss")?;
    page.wait_for("return document.querySelector('#server-panel').hidden")?;
    page.reload()?;
    ensure!(page.run("return document.querySelector('#server-panel').hidden", &[])? == true, "it comes back");
    let complaints = page.log("browser")?;
    ensure!(complaints.is_empty(), "the browser complains: {complaints:?}");
    Ok(())
}

pub fn other_settings_are_explained(bench: &Bench) -> Result<()> {
    let server = Server::start(&[])?;
    let page = playground(bench, &server)?;
    page.click("#run-on-server")?;
    page.wait_for(ENDED)?;
    let beta = "/scheme/gains/beta";
    page.type_into(&format!("{} .exact input", gain_field(Scheme::Proposed, beta)), "3.25")?;
    page.ready()?;
    page.wait_for("return document.querySelector('#server-panel .changed').checkVisibility()")?;
    let shown = verdicts(&page)?;
    let names: Vec<_> = Scheme::ALL.iter().map(|scheme| (scheme.id(), shown[scheme.id()][0].clone())).collect();
    for (scheme, verdict) in &names {
        let expected = if *scheme == "proposed" { "changed" } else { "same" };
        ensure!(verdict == expected, "{scheme}: {shown}");
    }
    ensure!(shown["proposed"][1].is_null(), "bits of other settings stand beside the server's: {shown}");

    page.click("#server-again")?;
    page.wait_for("return document.querySelectorAll('#server-panel tr[data-verdict=same]').length === 3")?;
    let expected = report(&edited(Scheme::Proposed, &[(beta, 3.25)])?)?.trajectory_hash;
    ensure!(verdicts(&page)?["proposed"][2] == expected.as_str(), "not what was submitted again");

    page.type_into(&format!("{} .exact input", gain_field(Scheme::Proposed, beta)), "4.5")?;
    page.wait_for("return document.querySelector('#server-return').checkVisibility()")?;
    page.click("#server-return")?;
    page.ready()?;
    expect_study(&page, |scheme| match scheme {
        Scheme::Proposed => vec![(beta.to_owned(), 3.25)],
        _ => Vec::new(),
    })?;
    page.wait_for("return document.querySelectorAll('#server-panel tr[data-verdict=same]').length === 3")
}

pub fn a_run_survives_server_and_page(bench: &Bench) -> Result<()> {
    let mut server = Server::start(&[])?;
    let client = Client::new(&server.url);
    let page = playground(bench, &server)?;
    page.type_into(DURATION, "30000")?;
    page.click("#run-on-server")?;
    let going = "const panel = document.querySelector('#server-panel'); return panel?.dataset.phase === 'following' && \
        panel.querySelector('.state-badge')?.dataset.state === 'running' && panel.querySelector('progress').value > 0";
    page.wait_for(going)?;
    let id = text(&page, "return document.querySelector('#server-panel').dataset.job")?;

    // The server dies: that is said, and taken back once it is there again.
    server.kill()?;
    page.wait_for("return document.querySelector('#server-panel .trouble').textContent.includes('does not answer')")?;
    server.restart()?;
    page.wait_for("return document.querySelector('#server-panel .trouble').textContent === ''")?;
    let moved = "window.seen ??= document.querySelector('#server-panel progress').value; \
        return document.querySelector('#server-panel progress').value > window.seen";
    page.wait_for(moved)?;

    // The page is left and opened again.
    go(&page, &format!("{}/jobs.html", server.url))?;
    page.wait_for(&format!(
        "return document.querySelector('.job-row[data-job=\"{id}\"]')?.dataset.state === 'running'"
    ))?;
    page.devtools("Page.navigate", &json!({ "url": format!("{}/", server.url) }))?;
    page.wait_for(going)?;
    ensure!(text(&page, "return document.querySelector('#server-panel').dataset.job")? == id, "another job");

    // Cancelling asks first.
    page.click("#server-panel .confirm > button")?;
    let focus = text(&page, "return document.activeElement.textContent")?;
    ensure!(focus == "Keep it running", "the focus is on {focus}");
    ensure!(client.job(&id)?["state"] == "running", "stopped without being asked");
    page.click("#server-panel .confirm .danger")?;
    page.wait_for(ENDED)?;
    ensure!(client.job(&id)?["state"] == "canceled", "not cancelled");
    page.wait_for(
        "return document.querySelector('#server-panel').textContent.includes('before the scheme had a result')",
    )
}

pub fn a_server_that_is_gone_loses_nothing(bench: &Bench) -> Result<()> {
    let mut server = Server::start(&[])?;
    let page = playground(bench, &server)?;
    let beta = "/scheme/gains/beta";
    page.type_into(&format!("{} .exact input", gain_field(Scheme::Proposed, beta)), "7.5")?;
    page.ready()?;
    server.kill()?;
    page.click("#run-on-server")?;
    page.wait_for("return document.querySelector('#server-panel .message')?.textContent.includes('Nothing is lost')")?;
    let settings = |scheme| match scheme {
        Scheme::Proposed => vec![(beta.to_owned(), 7.5)],
        _ => Vec::new(),
    };
    expect_study(&page, settings)?;
    // Still gone: still said.
    page.click("#server-panel .retry")?;
    page.wait_for("return document.querySelector('#server-panel .retry') !== null")?;
    server.restart()?;
    page.click("#server-panel .retry")?;
    page.wait_for(ENDED)?;
    page.wait_for("return document.querySelectorAll('#server-panel tr[data-verdict=same]').length === 3")?;
    expect_study(&page, settings)?;
    ensure!(Client::new(&server.url).jobs("")?.len() == 1, "trying again made another job");

    // The jobs page keeps what it shows, too.
    go(&page, &format!("{}/jobs.html", server.url))?;
    server.kill()?;
    page.click("#refresh")?;
    page.wait_for("return document.querySelector('.jobs .message') !== null")?;
    ensure!(page.run("return document.querySelectorAll('.job-row').length", &[])? == 1, "the list is gone");
    server.restart()?;
    page.click(".jobs .retry")?;
    page.wait_for("return document.documentElement.dataset.state === 'ready' && !document.querySelector('.message')")
}

pub fn what_the_server_refuses_is_said(bench: &Bench) -> Result<()> {
    let server = Launch::new().variable("ADAPTARM_LIMITS_UNFINISHED_JOBS_PER_USER", "1").serve()?;
    let page = playground(bench, &server)?;
    page.type_into(DURATION, "30000")?;
    page.click("#run-on-server")?;
    page.wait_for("return document.querySelector('#server-panel .state-badge')?.dataset.state === 'running'")?;
    let id = text(&page, "return document.querySelector('#server-panel').dataset.job")?;
    page.type_into(DURATION, "12")?;
    page.ready()?;
    page.click("#run-on-server")?;
    page.wait_for("return document.querySelector('#server-panel .message')?.dataset.status === '429'")?;
    let said = text(&page, MESSAGE)?;
    ensure!(said.contains("more than the server allows one user"), "{said}");
    // Dismissed, the run before it is shown again.
    page.click("#server-panel .message .quiet")?;
    page.wait_for(&format!("return document.querySelector('#server-panel').dataset.job === '{id}'"))?;
    page.wait_for("return document.querySelector('#server-panel .state-badge')?.dataset.state === 'running'")?;
    // With room on the server, trying again does it.
    page.click("#run-on-server")?;
    page.wait_for("return document.querySelector('#server-panel .retry') !== null")?;
    Client::new(&server.url).cancel(&id)?.expect_status(200)?;
    page.click("#server-panel .retry")?;
    page.wait_for(ENDED)?;
    page.wait_for("return document.querySelectorAll('#server-panel tr[data-verdict=same]').length === 3")
}

pub fn a_token_is_asked_for(bench: &Bench) -> Result<()> {
    let server = Launch::new().bind("0.0.0.0:0").serve()?;
    let token = server.token("ada", &[])?;
    let page = playground(bench, &server)?;
    page.click("#run-on-server")?;
    page.wait_for("return document.querySelector('#server-panel .token-form') !== null")?;
    page.type_into(".token-form input", "adaptarm_wrong\u{e007}")?;
    page.wait_for("return document.querySelector('.token-form .field-error')?.textContent.includes('did not take')")?;
    page.type_into(".token-form input", &format!("{token}\u{e007}"))?;
    page.wait_for(ENDED)?;
    page.wait_for("return document.querySelectorAll('#server-panel tr[data-verdict=same]').length === 3")?;
    let jobs = Client::new(&server.url).with_token(&token).jobs("")?;
    ensure!(jobs.len() == 1, "{} jobs", jobs.len());
    let kept = page.run("return [JSON.stringify({ ...localStorage }), location.href].join()", &[])?;
    ensure!(!kept.to_string().contains(&token), "the token outlives the tab: {kept}");

    // The same tab's other page has it, for pictures too.
    let id = jobs[0]["id"].as_str().context("no id")?;
    go(&page, &format!("{}/jobs.html#{id}", server.url))?;
    page.wait_for(
        "const picture = document.querySelector('.server-figure img'); \
        return picture.src.startsWith('blob:') && picture.naturalWidth > 0",
    )?;
    page.click(".forget-token")?;
    page.wait_for("return document.querySelector('.token-form') !== null")?;
    let forgotten = page.run("return JSON.stringify({ ...sessionStorage })", &[])?;
    ensure!(!forgotten.to_string().contains(&token), "not forgotten: {forgotten}");
    Ok(())
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
    // Taken once: what is changed after that is not undone by a reload.
    page.type_into(&format!("{} .exact input", gain_field(Scheme::Proposed, "/scheme/gains/beta")), "2.5")?;
    page.ready()?;
    let changed = shown_hash(&page, Scheme::Proposed)?;
    page.reload()?;
    ensure!(shown_hash(&page, Scheme::Proposed)? == changed, "the reload brought the job's settings back");

    // What cannot be used is said and changes nothing.
    page.run(
        "sessionStorage.setItem('adaptarm.handover', JSON.stringify({ scenarios: [{ format: 'adaptarm.scenario/9', \
         scheme: { kind: 'proposed' } }] }))",
        &[],
    )?;
    page.reload()?;
    let notice = text(&page, "return document.querySelector('.notice.error')?.textContent ?? ''")?;
    ensure!(notice.contains("nothing was changed"), "{notice}");
    ensure!(shown_hash(&page, Scheme::Proposed)? == changed, "something was changed");
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
