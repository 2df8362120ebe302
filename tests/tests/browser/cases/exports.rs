//! What a figure's export menu saves: a picture of the screen's pixels, a drawing, every sample of each run.

use crate::bench::Bench;
use crate::native::{edited, field_value, slide};
use crate::page::{Page, Screen};
use adaptarm_core::scenario::{Scenario, Scheme};
use anyhow::{Context, Result, ensure};
use fantoccini::key::Key;
use serde_json::{Value, json};
use std::path::Path;
use std::time::{Duration, Instant};
use tempfile::TempDir;

const PATIENCE: Duration = Duration::from_secs(20);

pub fn a_figure_is_saved_as_shown(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Desktop)?;
    let folder = accept_downloads(&page)?;
    save(&page, "Joint tracking errors as PNG")?;
    let png = saved(&folder, "adaptarm-tracking-errors-light.png")?;
    let size = page.run(
        "const { width, height } = document.querySelector('#figures [data-figure=tracking_errors] canvas'); \
         return [width, height]",
        &[],
    )?;
    let number = |at: usize| -> Result<u32> { Ok(u32::from_be_bytes(png[at..at + 4].try_into()?)) };
    ensure!(png.starts_with(b"\x89PNG") && json!([number(16)?, number(20)?]) == size, "the PNG is not {size} pixels");

    save(&page, "Joint tracking errors as SVG")?;
    let svg = String::from_utf8(saved(&folder, "adaptarm-tracking-errors-light.svg")?)?;
    let seen = drawing(&page, &svg)?;
    ensure!(seen["root"] == "svg" && seen["curves"].as_u64() >= Some(9), "the drawing holds {seen}");
    ensure!(seen["text"].as_str().is_some_and(|text| text.contains("Slotine and Li")), "the drawing says {seen}");

    expect_samples(&page, &folder, &[])?;

    // What is saved is what is shown: dark, zoomed and with one scheme less.
    page.click("#theme-toggle")?;
    page.click("scheme-card[data-scheme=slotine_li] input")?;
    page.run("document.querySelector('#figures [data-figure=tracking_errors] .figure-overlay').focus()", &[])?;
    page.press("+")?;
    page.ready()?;
    save(&page, "Joint tracking errors as SVG")?;
    let svg = String::from_utf8(saved(&folder, "adaptarm-tracking-errors-0.000s-to-8.000s-dark.svg")?)?;
    let text = drawing(&page, &svg)?["text"].as_str().unwrap_or_default().to_owned();
    ensure!(text.contains("Tang") && !text.contains("Slotine"), "the drawing does not show what the page does: {text}");
    Ok(())
}

/// Workers write samples into arrays that earlier runs are done with; what is saved then must be the last run's, all of it.
pub fn samples_in_used_arrays_are_those_of_the_last_run(bench: &Bench) -> Result<()> {
    const FRICTION: &str = "/plant/friction/width_rad_s";
    let page = Page::open(bench, Screen::Desktop)?;
    let folder = accept_downloads(&page)?;
    let count = "window.usedArrays = 0; const post = Worker.prototype.postMessage; \
        Worker.prototype.postMessage = function (message, ...rest) { \
            if (message.spare) { window.usedArrays += 1 } \
            return post.call(this, message, ...rest); \
        }";
    page.run(count, &[])?;
    let field = format!("#setup [data-pointer=\"{FRICTION}\"]");
    for position in [10, -20, 30, -40] {
        slide(&page, &field, position)?;
    }
    let used = page.run("return window.usedArrays", &[])?;
    ensure!(used.as_u64() >= Some(6), "of twelve runs {used} wrote into arrays that were there");
    let friction = field_value(&page, &field)?;
    expect_samples(&page, &folder, &[(FRICTION, friction)])
}

/// Saves every scheme's samples from the menu of the tracking errors; they must be what the core writes for the paper's scenario with `edits`.
fn expect_samples(page: &Page<'_>, folder: &TempDir, edits: &[(&str, f64)]) -> Result<()> {
    for scheme in Scheme::ALL {
        save(page, &format!("{} as CSV", scheme.name()))?;
        let name = format!("adaptarm-{}-samples.csv", scheme.name().to_lowercase().replace(' ', "-"));
        let csv = String::from_utf8(saved(folder, &name)?)?;
        let expected = Scenario::read(&edited(scheme, edits)?)?.run().recording.to_csv();
        let head = csv.lines().next().unwrap_or_default();
        ensure!(csv == expected, "{name} is not what the core writes with {edits:?}: {head}");
    }
    Ok(())
}

/// Saves something from the menu of the tracking errors.
fn save(page: &Page<'_>, label: &str) -> Result<()> {
    let menu = "#figures [data-figure=tracking_errors] .figure-export";
    page.click(&format!("{menu} > button"))?;
    page.click(&format!("{menu} [aria-label=\"{label}\"]"))
}

pub fn the_paper_s_figures_of_estimates_are_saved(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Desktop)?;
    let folder = accept_downloads(&page)?;
    let menu = "#figures [data-figure=estimates] .figure-export";
    for (n, range) in ["θ1 to θ6", "θ7 to θ12", "θ13 to θ18"].iter().enumerate() {
        for kind in ["PNG", "SVG"] {
            page.click(&format!("{menu} > button"))?;
            page.click(&format!("{menu} [aria-label=\"Estimates {range} as {kind}\"]"))?;
        }
        let svg = String::from_utf8(saved(&folder, &format!("adaptarm-estimates-{}-light.svg", n + 1))?)?;
        let seen = drawing(&page, &svg)?;
        ensure!(
            seen["text"].as_str().is_some_and(|text| text.contains("true value")),
            "{range}: the drawing says {seen}"
        );
        let png = saved(&folder, &format!("adaptarm-estimates-{}-light.png", n + 1))?;
        ensure!(png.len() > 10_000, "{range}: the picture is nearly empty");
    }
    Ok(())
}

pub fn the_menu_opens_and_closes_by_keyboard(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Desktop)?;
    let menu = "#figures [data-figure=torques] .figure-export";
    let state = || {
        page.run(
            "const wrap = document.querySelector(arguments[0]); const [button, menu] = wrap.children; \
             return [button.ariaExpanded, menu.getClientRects().length, document.activeElement === button, \
                menu.contains(document.activeElement)]",
            &[json!(menu)],
        )
    };
    let press = |key: Key| page.press(&char::from(key).to_string());
    page.run("document.querySelector(arguments[0] + ' > button').focus()", &[json!(menu)])?;
    press(Key::Enter)?;
    ensure!(state()? == json!(["true", 1, false, true]), "the enter key opens {}", state()?);
    press(Key::Escape)?;
    ensure!(state()? == json!(["false", 0, true, false]), "escape leaves {}", state()?);
    press(Key::Space)?;
    ensure!(state()?[0] == "true", "the space bar opens nothing");
    let outside = json!({ "type": "mousePressed", "x": 700, "y": 5, "button": "left", "buttons": 1, "clickCount": 1 });
    page.devtools("Input.dispatchMouseEvent", &outside)?;
    ensure!(state()?[0] == "false", "a click elsewhere does not close the menu");
    Ok(())
}

/// Makes the browser save what it downloads, without asking, into a folder of its own.
fn accept_downloads(page: &Page<'_>) -> Result<TempDir> {
    let folder = tempfile::tempdir()?;
    let behaviour = json!({ "behavior": "allow", "downloadPath": folder.path() });
    page.devtools("Browser.setDownloadBehavior", &behaviour)?;
    Ok(folder)
}

/// The bytes of a file once it is wholly there.
fn saved(folder: &TempDir, name: &str) -> Result<Vec<u8>> {
    let path = folder.path().join(name);
    let start = Instant::now();
    // A name without content is a place that the browser has reserved.
    while std::fs::metadata(&path).map_or(true, |file| file.len() == 0) {
        ensure!(start.elapsed() < PATIENCE, "{name} was not saved; there are {:?}", names(folder.path())?);
        std::thread::sleep(Duration::from_millis(20));
    }
    std::fs::read(&path).with_context(|| format!("cannot read {name}"))
}

fn names(folder: &Path) -> Result<Vec<String>> {
    let entries = std::fs::read_dir(folder)?.map(|entry| Ok(entry?.file_name().to_string_lossy().into_owned()));
    entries.collect()
}

/// What the browser's own parser finds in a drawing.
fn drawing(page: &Page<'_>, svg: &str) -> Result<Value> {
    page.run(
        "const document = new DOMParser().parseFromString(arguments[0], 'image/svg+xml'); \
         return { root: document.documentElement.tagName, text: document.documentElement.textContent.replace(/\\s+/g, ' '), \
            curves: document.querySelectorAll('polyline, path').length }",
        &[json!(svg)],
    )
}
