//! Pages of which a part does not arrive: they say so, in the reader's language, and come to life once they can.

use crate::bench::Bench;
use crate::page::{Page, Screen};
use crate::pictures::save;
use crate::relay::Relay;
use adaptarm_tests::machine;
use anyhow::{Result, ensure};

/// A page's path, and a file that it cannot do without.
const PAGES: [(&str, &str); 4] = [
    ("", "generated/adaptarm_web_bg.wasm"),
    ("teach.html", "js/strings/en/index.js"),
    ("jobs.html", "js/jobs/follow.js"),
    ("learn.html", "js/learn/enter.js"),
];

const NOTE: &str = "return document.querySelector('#not-alive')?.textContent ?? ''";

pub fn a_page_that_waits_for_a_file_says_so(bench: &Bench) -> Result<()> {
    let relay = Relay::start(&bench.server.url)?;
    // Each takes as long as the page is patient.
    for (path, file) in PAGES.into_iter().take(if machine::soak() { PAGES.len() } else { 2 }) {
        // Each in a browser that has kept nothing of another.
        let page = Page::impatient(bench, Screen::Phone)?;
        relay.withhold(file);
        page.go(&format!("{}/{path}", relay.url))?;
        page.wait_for("return document.querySelector('#not-alive button') !== null")?;
        let note = page.run(NOTE, &[])?.to_string();
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
    page.wait_for("return document.querySelector('#not-alive button') !== null")?;
    let note = page.run(NOTE, &[])?.to_string();
    ensure!(note.contains("did not arrive") && note.contains("no ha llegado"), "it says {note}");
    save(&page, "missing-teach")?;
    // A script that does not fit the others, as in the middle of a server's update, is as good as none.
    relay.replace([("js/dom.js", "export const nothing = 0;".to_owned())]);
    page.click("#not-alive button")?;
    page.wait_for("return document.querySelector('#not-alive button') !== null")?;
    relay.replace([]);
    page.click("#not-alive button")?;
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
