//! Experiments on the jobs page: submitted by hand, followed to their end, shown with table, figures and files.

use super::jobs::{go, text};
use crate::bench::Bench;
use crate::page::{Page, Screen};
use crate::pictures::save;
use adaptarm_tests::Server;
use adaptarm_tests::client::Client;
use anyhow::{Context, Result, ensure};
use serde_json::{Value, json};
use std::time::Duration;

const WITHIN: Duration = Duration::from_mins(1);

fn base(name: &str, scheme: &str) -> Value {
    json!({ "name": name, "scenario": { "format": "adaptarm.scenario/1", "scheme": { "kind": scheme },
        "integration": { "duration_s": 1.0 }, "recording": { "samples": 100 } } })
}

fn experiment(kind: &str, bases: Value, section: Value) -> Value {
    let mut document =
        json!({ "format": "adaptarm.experiment/1", "kind": kind, "title": format!("a {kind}"), "bases": bases });
    document[kind] = section;
    document
}

fn sweep() -> Value {
    let axis =
        |field: &str, min: f64, max: f64| json!({ "field": field, "min": min, "max": max, "points": 5, "log": true });
    let axes = [axis("/scheme/gains/k_v/0", 10.0, 160.0), axis("/scheme/gains/k_d/0", 75.0, 600.0)];
    experiment("sweep", json!([base("Proposed", "proposed")]), json!({ "design": "grid", "axes": axes }))
}

fn compare() -> Value {
    let set = json!([{ "field": "/plant/theta_scale/*", "value": 1.2, "relative": true }]);
    let conditions = json!([{ "name": "as in the paper", "set": [] }, { "name": "heavier", "set": set }]);
    let field =
        json!({ "field": "/plant/theta_scale/*", "distribution": { "kind": "lognormal", "median": 1, "log_sd": 0.1 } });
    let bases = json!([
        base("Proposed", "proposed"),
        base("Tang and Arteaga", "tang_arteaga"),
        base("Slotine and Li", "slotine_li")
    ]);
    experiment("compare", bases, json!({ "conditions": conditions, "draws": 20, "fields": [field] }))
}

fn tuning() -> Value {
    let variable = json!({ "field": "/scheme/gains/k_v/*", "min": 0.25, "max": 4, "log": true, "relative": true });
    let section =
        json!({ "variables": [variable], "objective": [{ "metric": "index_e_deg", "weight": 1 }], "evaluations": 40 });
    experiment("tuning", json!([base("Proposed", "proposed")]), section)
}

fn submit(client: &Client, document: &Value) -> Result<String> {
    let id = client.submit(&json!({ "kind": document["kind"], "spec": document, "label": document["title"] }))?;
    ensure!(client.wait(&id, WITHIN)?["state"] == "succeeded", "{}", client.job(&id)?);
    Ok(id)
}

fn show(page: &Page<'_>, server: &Server, id: &str) -> Result<()> {
    page.devtools("Page.navigate", &json!({ "url": "about:blank" }))?;
    go(page, &format!("{}/jobs.html#{id}", server.url))?;
    page.wait_for("return document.querySelector('.experiment')?.dataset.complete === 'true'")?;
    page.wait_for("return (document.querySelector('.experiment img')?.naturalWidth ?? 0) > 0")
}

/// An example is one click away, errors name their place, and the result comes without a reload.
pub fn an_experiment_is_submitted_by_hand(bench: &Bench) -> Result<()> {
    let server = Server::start(&[])?;
    let page = Page::blank(bench, Screen::Desktop)?;
    go(&page, &format!("{}/jobs.html", server.url))?;
    page.click(".submit-study summary")?;
    page.wait_for("return document.querySelectorAll('[data-example]').length === 5")?;
    page.click("[data-example=gains]")?;
    let value = text(&page, "return document.querySelector('#submit-text').value")?;
    let mut document: Value = serde_json::from_str(&value)?;
    ensure!(document["kind"] == "sweep", "{document}");
    let send = |document: &Value| -> Result<()> {
        page.run("document.querySelector('#submit-text').value = arguments[0]", &[json!(document.to_string())])?;
        page.click(".submit-study button[type=submit]")
    };
    document["sweep"]["axes"][0]["points"] = json!(1);
    send(&document)?;
    page.wait_for("return document.querySelector('#submit-error').textContent.includes('/spec/sweep/axes/0/points')")?;
    document["sweep"]["axes"][0]["points"] = json!(4);
    document["bases"][0]["scenario"]["integration"] = json!({ "duration_s": 1.0 });
    send(&document)?;
    page.wait_for("return document.querySelector('.experiment')?.dataset.complete === 'true'")?;
    let title = text(&page, "return document.querySelector('h1').textContent")?;
    ensure!(title == document["title"], "{title}");
    Ok(())
}

/// Every kind shows its numbers as the server has them, all its figures, and files that can be had.
pub fn experiments_show_tables_figures_and_files(bench: &Bench) -> Result<()> {
    let server = Server::start(&[])?;
    let client = Client::new(&server.url);
    let page = Page::blank(bench, Screen::Desktop)?;
    for (document, figures) in [(sweep(), 3), (compare(), 2), (tuning(), 1)] {
        let kind = document["kind"].as_str().context("no kind")?.to_owned();
        let id = submit(&client, &document)?;
        show(&page, &server, &id)?;
        let names =
            page.run("return [...document.querySelector('#figure-choice').options].map(({ value }) => value)", &[])?;
        let names = names.as_array().context("no figures")?;
        ensure!(names.len() == figures, "{kind}: {names:?}");
        for name in names {
            page.run(
                "const choice = document.querySelector('#figure-choice'); choice.value = arguments[0]; \
                 choice.dispatchEvent(new Event('change'))",
                &[name.clone()],
            )?;
            page.wait_for(&format!(
                "const picture = document.querySelector('.experiment img'); \
                 return picture.dataset.key?.includes('/{}.svg') && picture.complete && picture.naturalWidth > 0 && picture.alt !== ''",
                name.as_str().unwrap_or_default()
            ))?;
        }
        let files = page.run_async(
            "const done = arguments[0]; Promise.all([...document.querySelectorAll('[data-download]')].map(async (link) => \
             [link.dataset.download, (await fetch(link.href)).status, link.download !== ''])).then(done)",
            &[],
        )?;
        let files = files.as_array().context("no downloads")?;
        ensure!(files.len() == 6 && files.iter().all(|file| file[1] == 200 && file[2] == true), "{files:?}");
        save(&page, &format!("experiment-{kind}"))?;
    }
    // The numbers of the table are the summary's.
    let id = submit(&client, &compare())?;
    show(&page, &server, &id)?;
    let rows = page.run("return document.querySelectorAll('.experiment tbody tr').length", &[])?;
    ensure!(rows == 6, "{rows}");
    let summary = client.result(&id)?["summary"].take();
    let mean = summary["groups"][0]["metrics"][0]["mean"].as_f64().context("no mean")?;
    let shown = text(&page, "return document.querySelector('.experiment tbody td.number').textContent")?;
    let difference = shown.parse::<f64>()? / mean - 1.0;
    ensure!(difference.abs() < 1e-3, "{shown} for {mean}");
    Ok(())
}

/// The best of a tuning becomes the playground's settings.
pub fn the_best_of_a_tuning_opens_in_the_playground(bench: &Bench) -> Result<()> {
    let server = Server::start(&[])?;
    let client = Client::new(&server.url);
    let id = submit(&client, &tuning())?;
    let best = client.get(&format!("/api/v1/jobs/{id}/result/files/best.json"))?.json()?;
    let page = Page::blank(bench, Screen::Desktop)?;
    show(&page, &server, &id)?;
    page.click("#open-best")?;
    page.wait_for("return location.pathname === '/' && document.documentElement.dataset.state === 'ready'")?;
    let expected = adaptarm_core::scenario::Scenario::read(&best)?.hash();
    let shown = text(&page, "return document.querySelector('scheme-card[data-scheme=proposed]').dataset.scenarioHash")?;
    ensure!(shown == expected, "{shown} for {expected}");
    Ok(())
}

/// A phone shows experiments without scrolling sideways, in both languages; nothing is missing in the other one.
pub fn experiments_fit_a_phone_in_both_languages(bench: &Bench) -> Result<()> {
    let server = Server::start(&[])?;
    let client = Client::new(&server.url);
    let (comparison, tuning) = (submit(&client, &compare())?, submit(&client, &tuning())?);
    let page = Page::blank(bench, Screen::Phone)?;
    for language in ["en", "es"] {
        for (name, id) in [("compare", &comparison), ("tuning", &tuning)] {
            page.devtools("Page.navigate", &json!({ "url": "about:blank" }))?;
            go(&page, &format!("{}/jobs.html?lang={language}#{id}", server.url))?;
            page.wait_for("return (document.querySelector('.experiment img')?.naturalWidth ?? 0) > 0")?;
            let outside = page.run(
                "return [document.documentElement.scrollWidth - innerWidth, ...[...document.querySelectorAll('main *')] \
                 .filter((node) => { const box = node.getBoundingClientRect(); return box.width > 0 && \
                 !node.closest('.picture-box, .experiment-numbers') && (box.right > innerWidth + 1 || box.left < -1); }) \
                 .map((node) => node.outerHTML.slice(0, 120))]",
                &[],
            )?;
            ensure!(outside == json!([0]), "{name} is too wide: {outside}");
            let small = page.run(
                "return [...document.querySelectorAll('main :is(button, select, summary, input, textarea, a)')] \
                 .filter((node) => { const { width, height } = node.getBoundingClientRect(); \
                 return width > 0 && (height < 43.9 || width < 43.9); }).map((node) => node.outerHTML.slice(0, 120))",
                &[],
            )?;
            ensure!(small == json!([]), "too small for a finger: {small}");
            save(&page, &format!("experiment-{name}-phone-{language}"))?;
        }
    }
    let same = page.run_async(
        "const done = arguments[0]; const names = (texts, path = '') => Object.entries(texts).flatMap(([key, value]) => \
         typeof value === 'object' ? names(value, `${path}/${key}`) : [`${path}/${key}`]); \
         Promise.all(['en', 'es'].map((code) => import(`/js/strings/${code}/experiments.js`))) \
         .then(([en, es]) => done(names(en.experiments).join() === names(es.experiments).join()))",
        &[],
    )?;
    ensure!(same == true, "the two languages have different texts");
    Ok(())
}
