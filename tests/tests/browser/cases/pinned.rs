//! The pinned figure of narrow screens: in view above the sliders, alive, chosen and hidden by keyboard, out of the way.

use crate::bench::Bench;
use crate::page::{Page, Screen};
use crate::pictures::{picture, save, settle};
use adaptarm_core::scenario::Scheme;
use anyhow::{Context, Result, ensure};
use fantoccini::key::Key;
use serde_json::{Value, json};

const PINNED: &str = "#pinned canvas";

/// Scrolls a field's slider to where focusing takes it, and says whether a finger would meet it, and the panel, there.
const REACH: &str = "const slider = document.querySelector(arguments[0] + ' input[type=range]'); \
    const pinned = document.getElementById('pinned'); \
    slider.focus(); slider.scrollIntoView({ block: 'nearest', behavior: 'instant' }); \
    const at = (node) => { const { left, top, width, height } = node.getBoundingClientRect(); \
        return node.contains(document.elementFromPoint(left + width / 2, top + height / 2)); }; \
    const { top, bottom, left, right } = pinned.getBoundingClientRect(); \
    return { slider: at(slider), pinned: at(pinned), top, bottom, left, right, \
        sideways: document.documentElement.scrollWidth > innerWidth }";

/// Moves the slider that has the focus.
const MOVE: &str = "const slider = document.activeElement; slider.value = Number(slider.value) + 30; \
    slider.dispatchEvent(new Event('input', { bubbles: true }))";

pub fn a_phone_sees_the_figure_follow_the_slider(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Phone)?;
    for scheme in Scheme::ALL {
        page.click(&format!("#tab-{}", scheme.id()))?;
        let there = reach(&page, scheme)?;
        let (top, bottom) = (number(&there, "top")?, number(&there, "bottom")?);
        ensure!(top >= 0.0 && bottom - top > 200.0, "{}: too little of the figure is in view: {there}", scheme.id());
        ensure!(bottom < 0.5 * 844.0, "{}: the figure leaves too little room: {there}", scheme.id());
        settle(&page)?;
        let before = picture(&page, PINNED)?;
        page.run(MOVE, &[])?;
        page.ready()?;
        ensure!(picture(&page, PINNED)? != before, "{}: the slider moves nothing that can be seen", scheme.id());
    }
    page.click(".jump-bar a[href='#results']")?;
    // It must not cover the results. The way there is long, and a busy machine scrolls slowly.
    page.wait_for("return document.getElementById('pinned').getBoundingClientRect().bottom <= 45")?;
    page.click(".jump-bar a[href='#gains']")?;
    // A jump to the gains must not end beneath it.
    page.wait_for(
        "const { left, top } = document.getElementById('gains-title').getBoundingClientRect(); \
         return document.elementFromPoint(left + 2, top + 2)?.id === 'gains-title'",
    )
}

pub fn it_is_chosen_and_hidden_by_keyboard(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Phone)?;
    let press = |key: Key| page.press(&char::from(key).to_string());
    let drawn = picture(&page, PINNED)?;
    page.run("document.querySelector('.jump-bar a:last-child').focus()", &[])?;
    press(Key::Tab)?;
    let label = page.run("return document.activeElement.labels[0].textContent", &[])?;
    ensure!(label == "Pinned figure", "the choice does not follow the jump bar: {label}");
    // The first letters of a choice, as a native list takes them.
    page.press("Joint torques")?;
    settle(&page)?;
    let chosen = page.run("return document.querySelector('#pinned figure-card').dataset.figure", &[])?;
    ensure!(chosen == "torques", "typing chose {chosen}");
    let torques = picture(&page, PINNED)?;
    ensure!(torques != drawn, "another figure is not drawn");

    press(Key::Tab)?;
    press(Key::Space)?;
    let state = "const toggle = document.activeElement; const card = document.getElementById(toggle.getAttribute('aria-controls')); \
        return [toggle.getAttribute('aria-expanded'), card.getBoundingClientRect().height > 0]";
    ensure!(page.run(state, &[])? == json!(["false", false]), "the space bar does not hide the figure");
    page.run(
        "document.querySelector(arguments[0] + ' input[type=range]').focus({ preventScroll: true })",
        &[json!(first_gain(Scheme::Proposed))],
    )?;
    page.run(MOVE, &[])?;
    page.ready()?;
    ensure!(picture(&page, PINNED)? == torques, "a hidden figure is drawn");

    page.reload()?;
    let kept = page.run(
        "return [document.getElementById('pinned-choice').value, document.getElementById('pinned-card').hidden]",
        &[],
    )?;
    ensure!(kept == json!(["torques", true]), "a reload does not keep {kept}");
    page.run("document.getElementById('pinned-toggle').focus()", &[])?;
    press(Key::Enter)?;
    ensure!(page.run(state, &[])? == json!(["true", true]), "the enter key does not show the figure");
    settle(&page)?;
    ensure!(picture(&page, PINNED)? != torques, "the figure shown again is not the latest");
    Ok(())
}

pub fn a_phone_held_sideways_keeps_room(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Phone)?;
    for (width, height) in [(844_u32, 390_u32), (667, 375), (568, 320), (320, 568)] {
        page.resize(width, height)?;
        let there = reach(&page, Scheme::Proposed)?;
        let covered_width = number(&there, "right")? - number(&there, "left")?;
        let covered_height = number(&there, "bottom")?.min(f64::from(height)) - number(&there, "top")?;
        let free = covered_width < 0.5 * f64::from(width) || covered_height <= 0.5 * f64::from(height);
        ensure!(free, "{width}x{height}: the pinned figure covers too much: {there}");
        settle(&page)?;
        save(&page, &format!("phone-{width}x{height}"))?;
    }
    let page = Page::open(bench, Screen::Desktop)?;
    let shown = page.run("return document.getElementById('pinned').getClientRects().length", &[])?;
    ensure!(shown == 0, "a wide screen has no need of a pinned figure");
    Ok(())
}

/// Brings a gain's slider into view; slider and pinned figure must both be there, side by side or one above the other.
fn reach(page: &Page<'_>, scheme: Scheme) -> Result<Value> {
    let there = page.run(REACH, &[json!(first_gain(scheme))])?;
    ensure!(there["slider"] == true && there["pinned"] == true, "{}: one covers the other: {there}", scheme.id());
    ensure!(there["sideways"] == false, "{}: the page scrolls sideways", scheme.id());
    Ok(there)
}

/// Selector of a scheme's first field.
fn first_gain(scheme: Scheme) -> String {
    format!("[role=tabpanel][data-scheme={}] number-field", scheme.id())
}

fn number(object: &Value, name: &str) -> Result<f64> {
    object[name].as_f64().with_context(|| format!("no {name} in {object}"))
}
