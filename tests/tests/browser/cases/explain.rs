//! Explanations: info buttons, trying a gain, the glossary, why the worst joint is worst, both languages.

use crate::bench::Bench;
use crate::native::{edited, expect_study, report};
use crate::page::{Page, Screen};
use adaptarm_core::metrics::performance_index;
use adaptarm_core::recording::Signal;
use adaptarm_core::scenario::{GainSet, ProjectionBounds, Scenario, Scheme};
use anyhow::{Context, Result, ensure};
use fantoccini::key::Key;
use serde_json::json;

const STATE: &str = "const info = document.querySelector('#info'); const button = document.querySelector(arguments[0]); \
    return { open: info?.matches(':popover-open') ?? false, expanded: button.getAttribute('aria-expanded'), \
    math: info?.querySelectorAll('math').length ?? 0, letters: info?.textContent.length ?? 0, \
    inside: info?.contains(document.activeElement) ?? false, back: document.activeElement === button, \
    fits: info ? (({ left, right, top, bottom }) => left >= 0 && top >= 0 && right <= innerWidth && bottom <= innerHeight) \
    (info.getBoundingClientRect()) : false }";

fn press(page: &Page<'_>, key: Key) -> Result<()> {
    page.press(&char::from(key).to_string())
}

fn button(kind: &str, id: &str) -> String {
    format!(".results [data-info=\"{kind}/{id}\"], .controls [data-info=\"{kind}/{id}\"]")
}

pub fn everything_has_an_info_button_with_an_equation(bench: &Bench) -> Result<()> {
    for screen in [Screen::Desktop, Screen::Phone] {
        let page = Page::open(bench, screen)?;
        page.run("document.querySelectorAll('.controls details').forEach((details) => { details.open = true })", &[])?;
        for scheme in Scheme::ALL {
            page.click(&format!("#tab-{}", scheme.id()))?;
            for gain in scheme.gains() {
                opens_and_closes(&page, &button("gain", &format!("{}/{}", scheme.id(), gain.name)))?;
            }
            opens_and_closes(&page, &button("scheme", scheme.id()))?;
        }
        page.click("#tab-proposed")?;
        for gain in ProjectionBounds::default().table() {
            opens_and_closes(&page, &button("gain", &format!("proposed/{}", gain.name)))?;
        }
        let figures = page.run(
            "return [...document.querySelectorAll('.results figure-card')].map((card) => card.dataset.figure)",
            &[],
        )?;
        let figures = figures.as_array().context("no figures")?.clone();
        ensure!(figures.len() >= 5, "{figures:?}");
        for figure in figures {
            opens_and_closes(&page, &button("figure", figure.as_str().unwrap_or_default()))?;
        }
        let logged = page.log("browser")?;
        ensure!(logged.is_empty(), "{logged:?}");
    }
    Ok(())
}

/// By keyboard: Enter opens and moves the focus in, Escape closes and moves it back.
fn opens_and_closes(page: &Page<'_>, selector: &str) -> Result<()> {
    let here = [json!(selector)];
    let is_there = page.run(
        "const node = document.querySelector(arguments[0]); node?.focus(); return node === document.activeElement",
        &here,
    )?;
    ensure!(is_there == true, "{selector} cannot have the focus");
    let label = page.run("return document.activeElement.getAttribute('aria-label')", &[])?;
    ensure!(label.as_str().is_some_and(|label| label.starts_with("About ") && label.len() > 7), "{selector}: {label}");
    press(page, Key::Enter)?;
    let state = page.run(STATE, &here)?;
    let math = state["math"].as_u64().unwrap_or_default();
    ensure!(
        state["open"] == true && state["expanded"] == "true" && state["inside"] == true && state["fits"] == true,
        "{selector} does not open: {state}"
    );
    ensure!(math > 0 && state["letters"].as_u64() > Some(100), "{selector} explains too little: {state}");
    press(page, Key::Escape)?;
    let state = page.run(STATE, &here)?;
    ensure!(state["open"] == false && state["expanded"] == "false" && state["back"] == true, "{selector}: {state}");
    Ok(())
}

pub fn a_gain_is_tried_and_put_back(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Desktop)?;
    let own = vec![("/scheme/gains/k_v/1".to_owned(), 60.0)];
    page.type_into("[data-scheme=proposed] [data-pointer='/scheme/gains/k_v/1'] input[type=text]", "60")?;
    page.ready()?;
    page.run("document.querySelector(arguments[0]).focus()", &[json!(button("gain", "proposed/k_v"))])?;
    press(&page, Key::Enter)?;
    // Close, then the three buttons.
    let press_button = |tabs: usize| -> Result<()> {
        page.run("document.querySelector('#info').focus()", &[])?;
        for _ in 0..=tabs {
            press(&page, Key::Tab)?;
        }
        press(&page, Key::Enter)?;
        page.ready()
    };
    press_button(1)?;
    let tenth = [("/scheme/gains/k_v/0", 4.0), ("/scheme/gains/k_v/1", 8.0), ("/scheme/gains/k_v/2", 7.5)];
    expect_study(&page, |scheme| {
        of_proposed(scheme, tenth.map(|(pointer, value)| (pointer.to_owned(), value)).to_vec())
    })?;
    let index = report(&edited(Scheme::Proposed, &tenth)?)?.metrics.index_e_deg;
    let said = page.run("return document.querySelector('.try-outcome').textContent", &[])?;
    let said = said.as_str().unwrap_or_default();
    ensure!(said.contains(&format!("{:.3}", index[1])), "{said} does not say {index:?}");
    press_button(3)?;
    expect_study(&page, |scheme| of_proposed(scheme, own.clone()))?;

    // A press beside it closes it, too.
    for kind in ["mousePressed", "mouseReleased"] {
        let at = json!({ "type": kind, "x": 1200, "y": 700, "button": "left", "clickCount": 1 });
        page.devtools("Input.dispatchMouseEvent", &at)?;
    }
    page.wait_for("return !document.querySelector('#info').matches(':popover-open')")
}

fn of_proposed(scheme: Scheme, edits: Vec<(String, f64)>) -> Vec<(String, f64)> {
    if scheme == Scheme::Proposed { edits } else { Vec::new() }
}

pub fn the_glossary_lists_every_symbol(bench: &Bench) -> Result<()> {
    for screen in [Screen::Desktop, Screen::Phone] {
        let page = Page::open(bench, screen)?;
        page.run("document.querySelector('#glossary-open').focus()", &[])?;
        press(&page, Key::Enter)?;
        let rows = page.run(
            "return [...document.querySelectorAll('#glossary[open] th[scope=row]')].map((head) => \
                [head.querySelectorAll('math').length, head.nextElementSibling.textContent.length])",
            &[],
        )?;
        let rows = rows.as_array().context("no rows")?;
        ensure!(rows.len() >= 38, "{} symbols", rows.len());
        ensure!(rows.iter().all(|row| row[0] == 1 && row[1].as_u64() > Some(5)), "{rows:?}");
        let sideways = page.run(
            "const body = document.querySelector('.glossary-body'); return body.scrollWidth > body.clientWidth",
            &[],
        )?;
        ensure!(sideways == false, "the glossary scrolls sideways");
        press(&page, Key::Escape)?;
        let back = page.run("return !document.querySelector('#glossary').open && document.activeElement.id", &[])?;
        ensure!(back == "glossary-open", "{back}");
    }
    Ok(())
}

pub fn why_a_joint_is_worst_follows_the_run(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Desktop)?;
    let title = || page.run("return document.querySelector('#why-title').textContent", &[]);
    page.wait_for("return document.querySelector('#why table') !== null")?;
    ensure!(title()? == "Why is joint 2 worst?", "{}", title()?);
    page.type_into("[data-scheme=proposed] [data-pointer='/scheme/gains/k_v/0'] input[type=text]", "4")?;
    page.ready()?;
    page.wait_for("return document.querySelector('#why-title').textContent === 'Why is joint 1 worst?'")?;
    let run = Scenario::read(&edited(Scheme::Proposed, &[("/scheme/gains/k_v/0", 4.0)])?)?.run();
    let table = page.run(
        "return [...document.querySelectorAll('#why tbody tr')].map((row) => \
            [...row.querySelectorAll('td')].map((cell) => Number(cell.textContent)))",
        &[],
    )?;
    let near = |row: usize, joint: usize, expected: f64| {
        let shown = table[row][joint].as_f64().unwrap_or(f64::NAN);
        ensure!((shown / expected - 1.0).abs() < 0.006, "row {row}, joint {joint}: {shown} instead of {expected}");
        Ok(())
    };
    let gains = [(4.0, 60.0), (80.0, 80.0), (75.0, 70.0)];
    for (joint, (feedback, slope)) in gains.into_iter().enumerate() {
        let sliding = performance_index(run.recording.signal(Signal::SlidingVariable, joint).take(run.report.samples));
        near(0, joint, run.report.metrics.index_e_deg[joint])?;
        near(1, joint, feedback * sliding)?;
        near(2, joint, feedback * slope)?;
        near(3, joint, (sliding / slope).to_degrees())?;
        near(4, joint, run.report.metrics.tau_rms_nm[joint])?;
        // What the section rests on: the error is about the missing torque over K Λ.
        let quotient = (sliding / slope).to_degrees() / run.report.metrics.index_e_deg[joint];
        ensure!((0.9..1.1).contains(&quotient), "joint {joint}: {quotient}");
    }
    let answer = page.run("return document.querySelector('#why').textContent", &[])?;
    ensure!(answer.as_str().is_some_and(|text| text.contains("softest feedback")), "{answer}");
    Ok(())
}

pub fn explanations_are_in_both_languages(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Desktop)?;
    let shapes = page.run_async(
        "const done = arguments[0]; \
         const load = (language) => Promise.all(['explain', 'tour'].map((name) => \
             import(`/js/strings/${language}/${name}.js`).then((module) => module[name]))); \
         const shape = (value) => typeof value === 'object' \
             ? Object.fromEntries(Object.keys(value).sort().map((key) => [key, shape(value[key])])) : typeof value; \
         Promise.all([load('en'), load('es')]).then(([en, es]) => done([en.map(shape), es.map(shape), es[1].claims]))",
        &[],
    )?;
    let (english, mut spanish) = (shapes[0].clone(), shapes[1].clone());
    // The core speaks English: its claims need a Spanish text, and no English one.
    let claims = super::tour::claims(|_| {})?;
    for claim in &claims {
        let text = &shapes[2][claim.id];
        ensure!(text["claim"].is_string() && text["criterion"].is_string(), "{} has no Spanish text", claim.id);
        let shape = spanish[1]["claims"][claim.id].as_object_mut().context("no such claim")?;
        shape.remove("claim");
        shape.remove("criterion");
    }
    ensure!(english == spanish, "the languages differ:\n{english}\n{spanish}");
    for claim in claims {
        let said = page.run_async(
            "const [text, done] = arguments; import('/js/strings/es/tour.js').then(({ tour }) => done(tour.evidence(text)))",
            &[json!(claim.evidence)],
        )?;
        let said = said.as_str().unwrap_or_default();
        let english = said.split(|c: char| !c.is_alphabetic()).find(|word| {
            [
                "half", "first", "largest", "smallest", "and", "time", "last", "run", "peak", "of", "within",
                "nearest", "never",
            ]
            .contains(word)
        });
        ensure!(english.is_none(), "{english:?} is left in {said}");
    }
    Ok(())
}
