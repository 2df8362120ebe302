//! Pages of which a part does not arrive: they say so, in each language, and come to life once they can.

use crate::bench::Bench;
use crate::page::{Page, Screen};
use crate::pictures::save;
use crate::relay::Relay;
use adaptarm_tests::machine;
use anyhow::{Result, ensure};
use std::time::Duration;

/// A page's path, and a file that it cannot do without.
const PAGES: [(&str, &str); 4] = [
    ("", "generated/adaptarm_web_bg.wasm"),
    ("teach.html", "js/strings/en/index.js"),
    ("jobs.html", "js/jobs/follow.js"),
    ("learn.html", "js/learn/enter.js"),
];

const NOTE: &str = "return document.querySelector('#not-alive')?.textContent ?? ''";

/// Waits for the note and gives its text.
fn note(page: &Page<'_>) -> Result<String> {
    // A page that is being left has its note still.
    page.wait_for("return !window.isLeft && document.querySelector('#not-alive button') !== null")?;
    Ok(page.run(NOTE, &[])?.to_string())
}

/// Follows the note's advice.
fn load_again(page: &Page<'_>) -> Result<()> {
    page.run("window.isLeft = true; document.querySelector('#not-alive button').click()", &[])?;
    Ok(())
}

fn says_that_a_part_is_missing(page: &Page<'_>) -> Result<()> {
    let note = note(page)?;
    ensure!(note.contains("did not arrive") && note.contains("no ha llegado"), "it says {note}");
    Ok(())
}

pub fn a_page_that_waits_for_a_file_says_so(bench: &Bench) -> Result<()> {
    let relay = Relay::start(&bench.server.url)?;
    // Each takes as long as the page is patient.
    for (path, file) in PAGES.into_iter().take(if machine::soak() { PAGES.len() } else { 2 }) {
        // Each in a browser that has kept nothing of another.
        let page = Page::impatient(bench, Screen::Phone)?;
        relay.withhold(file);
        page.go(&format!("{}/{path}", relay.url))?;
        let note = note(&page)?;
        ensure!(note.contains("long to load") && note.contains("tarda en cargar"), "{path}: it says {note}");
        save(&page, &format!("late-{}", path.split('.').next().unwrap_or_default()))?;
        // What was late comes after all.
        relay.replace([]);
        page.ready()?;
        ensure!(page.run(NOTE, &[])? == "", "{path}: the note stays");
    }
    Ok(())
}

pub fn a_page_without_a_script_says_so(bench: &Bench) -> Result<()> {
    let relay = Relay::start(&bench.server.url)?;
    let page = Page::impatient(bench, Screen::Desktop)?;
    relay.hang_up("js/dom.js", u32::MAX);
    page.go(&format!("{}/teach.html", relay.url))?;
    // The first failure is mended by the page itself if it can be; this one cannot.
    says_that_a_part_is_missing(&page)?;
    if machine::soak() {
        // Longer than the page is patient: what is missing is not merely late.
        std::thread::sleep(Duration::from_secs(14));
        says_that_a_part_is_missing(&page)?;
    }
    save(&page, "missing-teach")?;
    // A script that does not fit the others, as in the middle of a server's update, is as good as none.
    relay.replace([("js/dom.js", "export const nothing = 0;".to_owned())]);
    load_again(&page)?;
    says_that_a_part_is_missing(&page)?;
    relay.replace([]);
    load_again(&page)?;
    page.ready()?;
    ensure!(page.run(NOTE, &[])? == "", "the note stays");
    Ok(())
}

pub fn a_script_that_fails_once_is_asked_for_again(bench: &Bench) -> Result<()> {
    let relay = Relay::start(&bench.server.url)?;
    let page = Page::impatient(bench, Screen::Desktop)?;
    relay.hang_up("js/timeline.js", 1);
    page.go(&relay.url)?;
    page.ready()?;
    ensure!(relay.is_honest(), "nobody asked for the script");
    let how = page.run("return performance.getEntriesByType('navigation')[0].type", &[])?;
    ensure!(how == "reload", "the page came by {how}");
    Ok(())
}
