//! Runs on the server from the playground, each trial with a server of its own.

use super::jobs::{go, playground, text};
use crate::bench::Bench;
use crate::native::{edited, expect_study, gain_field, report};
use crate::page::{Page, Screen};
use crate::pictures::save;
use adaptarm_core::scenario::Scheme;
use adaptarm_tests::client::Client;
use adaptarm_tests::{Launch, Server};
use anyhow::{Context, Result, ensure};
use serde_json::{Value, json};

const DURATION: &str = "[data-pointer='/integration/duration_s'] input[type=text]";
const ENDED: &str = "return document.querySelector('#server-panel')?.dataset.phase === 'ended'";
const MESSAGE: &str = "return document.querySelector('.message p')?.textContent ?? ''";

/// What the panel says about each scheme: verdict, hash in the browser, hash on the server.
fn verdicts(page: &Page<'_>) -> Result<Value> {
    page.run(
        "return Object.fromEntries([...document.querySelectorAll('#server-panel tbody tr')].map((row) => \
         [row.dataset.scheme, [row.dataset.verdict, ...[1, 2].map((n) => \
         row.cells[n].querySelector('[data-hash]')?.dataset.hash ?? null)]]))",
        &[],
    )
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

pub fn a_run_is_followed_without_a_stream(bench: &Bench) -> Result<()> {
    let server = Server::start(&[])?;
    let page = playground(bench, &server)?;
    page.devtools("Network.enable", &json!({}))?;
    page.devtools("Network.setBlockedURLs", &json!({ "urls": ["*/events"] }))?;
    page.type_into(DURATION, "200")?;
    page.click("#run-on-server")?;
    page.wait_for(ENDED)?;
    page.ready()?;
    page.wait_for("return document.querySelectorAll('#server-panel tr[data-verdict=same]').length === 3")?;
    let asked = page.run(
        "return performance.getEntriesByType('resource').filter(({ name }) => name.endsWith('/events')).length",
        &[],
    )?;
    ensure!(asked.as_u64().is_some_and(|times| (1..=4).contains(&times)), "the stream was asked for {asked} times");
    Ok(())
}

pub fn a_phone_shows_the_run_on_the_server(bench: &Bench) -> Result<()> {
    let server = Server::start(&[])?;
    let page = Page::blank(bench, Screen::Phone)?;
    go(&page, &format!("{}/", server.url))?;
    page.ready()?;
    page.click("#run-on-server")?;
    page.wait_for("return document.querySelectorAll('#server-panel tr[data-verdict=same]').length === 3")?;
    page.wait_for(ENDED)?;
    let wrong = page.run(
        "return [...document.querySelectorAll('#server-panel *')].filter((node) => { \
         const { left, right, width, height } = node.getBoundingClientRect(); \
         return width > 0 && (right > innerWidth + 1 || left < -1 || \
         node.matches('button, a') && (height < 43.9 || width < 43.9)); }).map((node) => node.outerHTML.slice(0, 120))",
        &[],
    )?;
    ensure!(wrong == json!([]), "cut off, or too small for a finger: {wrong}");
    let wide = page.run("return document.documentElement.scrollWidth > innerWidth", &[])?;
    ensure!(wide == false, "the page scrolls sideways");
    page.run("document.querySelector('#server-panel').scrollIntoView({ behavior: 'instant' })", &[])?;
    save(&page, "server-run-phone")
}
