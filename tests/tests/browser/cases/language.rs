//! Two languages: the same texts in both, chosen by address, browser or visitor, and nothing lost by switching.

use crate::bench::Bench;
use crate::native::{expect_study, gain_field};
use crate::page::{Page, Screen};
use adaptarm_core::scenario::Scheme;
use anyhow::{Context, Result, ensure};
use serde_json::json;

const BETA: &str = "/scheme/gains/beta";

/// Compares the two trees of texts of a folder; `open` are groups that a language fills as it needs.
pub(super) const COMPARE: &str = "const [folder, open, done] = arguments; (async () => { \
    const [english, spanish] = await Promise.all(['en', 'es'].map((code) => import(`/js/strings/${code}/${folder}index.js`))); \
    const en = english.en ?? english.classroom; const es = spanish.es ?? spanish.classroom; \
    const differences = []; let texts = 0; \
    const kind = (value) => (Array.isArray(value) ? 'list' : value === null ? 'null' : typeof value); \
    const compare = (path, a, b) => { \
        if (open.includes(path) || /^tour\\.claims\\.\\w+\\.(claim|criterion)$/.test(path)) return; \
        if (kind(a) !== kind(b)) { differences.push(`${path}: ${kind(a)} and ${kind(b)}`); return; } \
        if (kind(a) === 'function') { texts += 1; if (a.length !== b.length) differences.push(`${path}: parameters`); return; } \
        if (kind(a) === 'string') { texts += 1; if (b.trim() === '' && a.trim() !== '') differences.push(`${path}: empty`); return; } \
        if (kind(a) === 'list' || kind(a) === 'object') \
            for (const key of new Set([...Object.keys(a), ...Object.keys(b)])) compare(path ? `${path}.${key}` : key, a[key], b[key]); \
    }; \
    compare('', en, es); done({ differences, texts }); })().catch((error) => done({ differences: [String(error)], texts: 0 }))";

/// The English texts of the core that Spanish must cover, and those that it covers for nothing.
const COVERAGE: &str = "const done = arguments[0]; (async () => { \
    const bindings = await import('/generated/adaptarm_web.js'); await bindings.default(); \
    const { es } = await import('/js/strings/es/index.js'); const description = JSON.parse(bindings.describe()); \
    const wanted = { schemes: description.schemes.map(({ id }) => id), \
        presets: description.presets.map(({ id }) => id), presetDescriptions: description.presets.map(({ id }) => id), \
        gains: description.schemes.flatMap(({ gains }) => gains.map(({ name }) => name)), \
        robots: description.robots.map(({ id }) => id), joints: description.robots.flatMap(({ joints }) => joints), \
        parameters: description.robots.flatMap(({ parameters }) => parameters.map(({ symbol }) => symbol)) }; \
    const wrong = []; \
    for (const [group, ids] of Object.entries(wanted)) { \
        for (const id of ids) if (!es.core[group][id]) wrong.push(`${group}.${id} is missing`); \
        for (const id of Object.keys(es.core[group])) if (!ids.includes(id.split('.').pop())) wrong.push(`${group}.${id} is of nothing`); \
    } done(wrong); })().catch((error) => done([String(error)]))";

pub fn both_languages_have_the_same_texts(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Desktop)?;
    // Translations of the core's English texts: English has none. So it is with the tour's claims and their criteria.
    let open = ["core.schemes", "core.gains", "core.parameters", "core.joints", "core.robots", "core.presets"];
    let open: Vec<_> = open.into_iter().chain(["core.presetDescriptions"]).collect();
    let found = page.run_async(COMPARE, &[json!(""), json!(open)])?;
    ensure!(found["differences"] == json!([]), "the languages differ: {}", found["differences"]);
    ensure!(found["texts"].as_u64().is_some_and(|texts| texts > 90), "hardly a text was compared: {found}");
    let wrong = page.run_async(COVERAGE, &[])?;
    ensure!(wrong == json!([]), "the core's texts: {wrong}");
    Ok(())
}

pub fn switching_keeps_everything_but_the_words(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Desktop)?;
    ensure!(page.run(LANGUAGE, &[])? == json!(["en", "Setup"]), "the page is not in the browser's language");
    let beta = gain_field(Scheme::Proposed, BETA);
    page.type_into(&format!("{beta} .exact input"), "3.25")?;
    page.ready()?;
    page.run("document.documentElement.dataset.state = 'leaving'", &[])?;
    page.run(
        "const choice = document.getElementById('language'); choice.value = 'es'; choice.dispatchEvent(new Event('change'))",
        &[],
    )?;
    page.ready()?;
    ensure!(page.run(LANGUAGE, &[])? == json!(["es", "Ajustes"]), "the page is not in Spanish");
    let title = page.run("return [document.title, document.querySelector('meta[name=description]').content]", &[])?;
    let (title, description) = (title[0].as_str().context("no title")?, title[1].as_str().context("none")?);
    ensure!(title.contains("brazo") && description.contains("brazo"), "title and description: {title}, {description}");
    let study = |scheme| if scheme == Scheme::Proposed { vec![(BETA.to_owned(), 3.25)] } else { Vec::new() };
    expect_study(&page, study)?;
    let meaning =
        page.run("return document.querySelector(arguments[0]).closest('.gain').textContent", &[json!(beta)])?;
    ensure!(meaning.as_str().is_some_and(|text| text.contains("Peso del error")), "the core's text: {meaning}");

    page.type_into(&format!("{beta} .exact input"), "-1")?;
    let refused =
        page.run("return document.querySelector(arguments[0] + ' .field-error').textContent", &[json!(beta)])?;
    ensure!(refused == "β debe estar entre 0 y 10000; -1 no lo está", "the refusal is {refused}");

    // The choice lasts, and an address counts more than it.
    page.reload()?;
    ensure!(page.run(LANGUAGE, &[])? == json!(["es", "Ajustes"]), "a reload forgets the language");
    page.go(&format!("{}/?lang=en", bench.server.url))?;
    page.ready()?;
    ensure!(page.run(LANGUAGE, &[])? == json!(["en", "Setup"]), "the address does not count");
    expect_study(&page, study)
}

pub fn the_browser_s_language_is_the_first_choice(bench: &Bench) -> Result<()> {
    let page = Page::blank(bench, Screen::Phone)?;
    let agent = page.run("return navigator.userAgent", &[])?;
    let override_language = json!({ "userAgent": agent, "acceptLanguage": "fr-CH,es-MX" });
    page.devtools("Emulation.setUserAgentOverride", &override_language)?;
    page.visit()?;
    page.ready()?;
    ensure!(page.run(LANGUAGE, &[])? == json!(["es", "Ajustes"]), "the browser's second choice is not spoken");
    let wide = page.run("return document.documentElement.scrollWidth > innerWidth", &[])?;
    ensure!(wide == false, "in Spanish the page scrolls sideways on a phone");
    Ok(())
}

/// The language that the page declares, and one of its words.
const LANGUAGE: &str = "return [document.documentElement.lang, document.getElementById('setup-title').textContent]";
