//! Everything without a mouse: the skip link, a slider, its reset, the tabs.

use crate::bench::Bench;
use crate::native::expect_study;
use crate::page::{Page, Screen};
use adaptarm_core::scenario::Scheme;
use anyhow::{Context, Result, ensure};
use fantoccini::key::Key;

const FOCUSED: &str = "const at = document.activeElement; return [at.tagName, at.type ?? '', \
    at.closest('number-field')?.dataset.pointer ?? '', at.className, at.getAttribute('role') ?? '']";

pub fn the_keyboard_is_enough(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Desktop)?;
    let press = |key: Key| page.press(&char::from(key).to_string());
    press(Key::Tab)?;
    ensure!(page.run(FOCUSED, &[])?[3] == "skip-link", "the first stop is not the skip link");
    let visible = page.run("return document.activeElement.getBoundingClientRect().top >= 0", &[])?;
    ensure!(visible == true, "the skip link cannot be seen when it has the focus");

    let pointer = tab_to(&page, |stop| stop[1] == "range" && stop[2].as_str().is_some_and(|p| p.contains("k_v")))?;
    let outline = page.run("return getComputedStyle(document.activeElement).outlineStyle", &[])?;
    ensure!(outline != "none", "the focus cannot be seen on a slider");
    for _ in 0..5 {
        press(Key::Right)?;
    }
    page.ready()?;
    let value = page.run("return Number(document.activeElement.closest('number-field').value)", &[])?;
    let value = value.as_f64().context("no value")?;
    ensure!(value > 40.0, "the arrow keys do not move the slider");
    expect_study(&page, |scheme| match scheme {
        Scheme::Proposed => vec![(pointer.clone(), value)],
        _ => Vec::new(),
    })?;

    tab_to(&page, |stop| stop[3] == "reset")?;
    press(Key::Space)?;
    page.ready()?;
    expect_study(&page, |_| Vec::new())?;

    page.run("document.querySelector('[role=tab][aria-selected=true]').focus()", &[])?;
    press(Key::Right)?;
    let open = page.run("return document.querySelector('[role=tabpanel]:not([hidden])').dataset.scheme", &[])?;
    ensure!(open == "tang_arteaga", "the arrow keys do not change the tab: {open}");
    Ok(())
}

/// Presses the tabulator until the focus is where `found` says; returns the JSON pointer of the field there.
fn tab_to(page: &Page<'_>, found: impl Fn(&serde_json::Value) -> bool) -> Result<String> {
    for _ in 0..60 {
        page.press(&char::from(Key::Tab).to_string())?;
        let stop = page.run(FOCUSED, &[])?;
        if found(&stop) {
            return Ok(stop[2].as_str().unwrap_or_default().to_owned());
        }
    }
    anyhow::bail!("sixty presses of the tabulator do not lead there");
}
