//! How long a slider move takes until all its results are on the canvases, and that they are drawn once. Prints what it measures.
//!
//! How fast a machine is, and what else it does, is not the page's: only the long form, which runs alone, has a bound.

use crate::bench::Bench;
use crate::moves::{DRAG, FRICTION, MOVE};
use crate::native::gain_field;
use crate::page::{Graphics, Page, Screen};
use adaptarm_core::scenario::Scheme;
use adaptarm_tests::machine;
use adaptarm_tests::timing::median;
use anyhow::{Context, Result, ensure};
use serde_json::json;
use std::time::Duration;

const SAMPLES: usize = 9;
const DRAGGED: u32 = 120;
/// The bound that the study promises: all three schemes, default study.
const BOUND_MS: f64 = 250.0;

/// Counts drawings from now on.
const COUNT: &str = "for (const card of document.querySelectorAll('figure-card')) { \
        let at = card.drawnAt; card.drawings = 0; \
        Object.defineProperty(card, 'drawnAt', { get: () => at, set: (now) => { at = now; card.drawings += 1; } }); \
    } window.armsBefore = document.querySelector('arm-view').drawings";
/// How often each figure in view was drawn since the last call, and the arms; then how long the last results took, ms.
const COUNTED: &str = "const arms = document.querySelector('arm-view').drawings; \
    const shown = [...document.querySelectorAll('figure-card')].filter(({ inView }) => inView); \
    const counted = [shown.map(({ drawings }) => drawings), arms - window.armsBefore, \
        Number(document.documentElement.dataset.lastLatencyMs)]; \
    shown.forEach((card) => { card.drawings = 0; }); window.armsBefore = arms; return counted";
/// Results that take longer than this are drawn before all of them are there; see `static/js/gather.js`.
const LATE_MS: f64 = 100.0;
/// After this nothing more follows from results; see `static/js/calm.js`.
const CALM: Duration = Duration::from_millis(300);

pub fn a_slider_move_is_drawn_in_time(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Desktop)?;
    let one = gain_field(Scheme::Proposed, "/scheme/gains/k_v/0");
    let all_ms = measure(&page, FRICTION)?;
    let one_ms = measure(&page, &one)?;
    for (what, times_ms) in [("all three schemes", &all_ms), ("one scheme", &one_ms)] {
        let list: Vec<_> = times_ms.iter().map(|time| format!("{time:.0}")).collect();
        println!("slider to canvas, {what}: median {:.0} ms of {}", median(times_ms.clone()), list.join(" "));
    }
    ensure!(
        !machine::soak() || median(all_ms.clone()) < BOUND_MS,
        "the median is {:.0} ms; promised are {BOUND_MS}",
        median(all_ms.clone())
    );
    Ok(())
}

pub fn a_move_is_drawn_once(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Desktop)?;
    // Shorter than the study, so that a busy machine is not late, and longer than a frame.
    page.type_into("#setup [data-pointer=\"/integration/duration_s\"] .exact input", "6")?;
    page.ready()?;
    std::thread::sleep(CALM);
    page.run(COUNT, &[])?;
    let mut in_time = 0;
    for n in 0..12 {
        page.run_async(MOVE, &[json!(FRICTION), json!(if n % 2 == 0 { 4 } else { -4 })])?;
        page.ready()?;
        page.wait_for("return document.querySelector('arm-view').drawings > window.armsBefore")?;
        // What is drawn too often is drawn soon after.
        std::thread::sleep(CALM);
        let counted = page.run(COUNTED, &[])?;
        let figures: Vec<f64> = serde_json::from_value(counted[0].clone())?;
        let (arms, took_ms) = (counted[1].as_f64().context("no arms")?, counted[2].as_f64().context("no time")?);
        ensure!(!figures.is_empty() && figures.iter().all(|drawings| *drawings > 0.0), "not drawn: {figures:?}");
        in_time += i32::from(took_ms < LATE_MS);
        // Per 100 ms one showing of late results, and one message on the way from each of two workers.
        let most = 1.0 + 3.0 * (took_ms / LATE_MS).floor();
        ensure!(figures.iter().all(|drawings| *drawings <= most), "move {n}, {took_ms} ms: figures {figures:?} times");
        ensure!(arms <= most, "move {n}, {took_ms} ms: arms {arms} times");
    }
    println!("{in_time} of 12 moves were drawn within {LATE_MS} ms");
    Ok(())
}

/// How often figures and arms were drawn while a field was dragged without a rest.
fn drawn_while_dragged(page: &Page<'_>, field: &str) -> Result<[u64; 2]> {
    let drawn: [u64; 2] = serde_json::from_value(page.run_async(DRAG, &[json!(field), json!(DRAGGED)])?[0].take())?;
    println!("{DRAGGED} moves without a rest: figures drawn {} times, arms {} times", drawn[0], drawn[1]);
    Ok(drawn)
}

/// Notes for each option that a script chooses how many fields its form has; those without a form share the page's.
const NOTE_CHOICES: &str = "window.chosen = []; \
    const { set, get } = Object.getOwnPropertyDescriptor(HTMLSelectElement.prototype, 'value'); \
    Object.defineProperty(HTMLSelectElement.prototype, 'value', { get, set(value) { \
        window.chosen.push(this.form?.elements.length ?? document.querySelectorAll('input, select').length); \
        set.call(this, value); } })";

/// Where a script chooses an option, Chromium goes over all fields of its form, in a process that takes as long as a run.
pub fn a_move_does_not_make_the_browser_read_all_fields(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Desktop)?;
    page.run(NOTE_CHOICES, &[])?;
    // To other studies than the paper's and back to it, with what follows when it is calm.
    for step in [4, -4, 4] {
        page.run_async(MOVE, &[json!(FRICTION), json!(step)])?;
        page.ready()?;
        std::thread::sleep(CALM);
    }
    let chosen: Vec<u32> = serde_json::from_value(page.run("return window.chosen", &[])?)?;
    ensure!(chosen.len() == 3, "the study is chosen once a move: {chosen:?}");
    ensure!(chosen.iter().all(|fields| *fields == 1), "fields beside the one chosen: {chosen:?}");
    Ok(())
}

pub fn a_finger_that_never_rests_sees_results(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Desktop)?;
    std::thread::sleep(CALM);
    for field in [FRICTION, &gain_field(Scheme::Proposed, "/scheme/gains/k_v/0")] {
        let drawn = drawn_while_dragged(&page, field)?;
        ensure!(
            drawn.iter().all(|times| *times >= 3),
            "while {field} is dragged, figures and arms are drawn {drawn:?} times"
        );
        page.ready()?;
    }
    Ok(())
}

pub fn where_a_processor_draws_arms_wait_for_rest(bench: &Bench) -> Result<()> {
    let page = Page::open_with(bench, Screen::Desktop, Graphics::Software)?;
    // The fine drawing of the first results.
    page.wait_for("return document.querySelector('arm-view').drawings > 0")?;
    std::thread::sleep(Duration::from_secs(2));
    page.run("window.armsBefore = document.querySelector('arm-view').drawings", &[])?;
    let [figures, arms] = drawn_while_dragged(&page, FRICTION)?;
    ensure!(figures >= 3 && arms <= 1, "figures drawn {figures} times, arms {arms} times");
    page.ready()?;
    page.wait_for("return document.querySelector('arm-view').drawings > window.armsBefore")
}

/// Sorted times, after one move to warm up.
fn measure(page: &Page<'_>, field: &str) -> Result<Vec<f64>> {
    let mut times_ms = Vec::new();
    for n in 0..=SAMPLES {
        let step = if n % 2 == 0 { 4 } else { -4 };
        let time = page.run_async(MOVE, &[json!(field), json!(step)])?[0].as_f64().context("no time")?;
        if n > 0 {
            times_ms.push(time);
        }
    }
    times_ms.sort_by(f64::total_cmp);
    Ok(times_ms)
}
