//! What is typed: values that make a run diverge, and values that are refused.

use crate::bench::Bench;
use crate::native::{edited, expect_study, gain_field, report, shown_hash};
use crate::page::{Page, Screen};
use crate::pictures::save;
use adaptarm_core::scenario::Scheme;
use anyhow::{Context, Result, ensure};
use fantoccini::key::Key;
use serde_json::json;

pub fn a_diverging_run_says_when_and_why(bench: &Bench) -> Result<()> {
    const GAIN: &str = "/scheme/gains/k_d/0";
    let page = Page::open(bench, Screen::Desktop)?;
    page.type_into(&format!("{} .exact input", gain_field(Scheme::Proposed, GAIN)), "5000")?;
    page.ready()?;
    let expected = report(&edited(Scheme::Proposed, &[(GAIN, 5000.0)])?)?;
    let at_s = expected.at_s.context("this gain should make the run diverge")?;
    let reason = expected.reason.context("a diverged run has a reason")?;
    for place in ["scheme-card[data-scheme=proposed] .outcome", "[data-table=index_e_deg] tr[data-scheme=proposed]"] {
        let text = page.run("return document.querySelector(arguments[0]).textContent", &[json!(place)])?;
        let text = text.as_str().context("no text")?;
        ensure!(text.contains(&format!("diverged at {at_s} s")), "{place} does not say when: {text}");
        ensure!(text.contains(&reason), "{place} does not say why: {text}");
    }
    ensure!(shown_hash(&page, Scheme::Proposed)? == expected.trajectory_hash, "another trajectory");
    let native = report(&edited(Scheme::SlotineLi, &[])?)?.trajectory_hash;
    ensure!(shown_hash(&page, Scheme::SlotineLi)? == native, "another scheme's run was touched");
    save(&page, "diverged")
}

pub fn nonsense_is_refused_and_the_last_good_run_stays(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Desktop)?;
    let gain = gain_field(Scheme::Proposed, "/scheme/gains/k_v/0");
    let duration = "#setup [data-pointer=\"/integration/duration_s\"]".to_owned();
    for (field, text, needle) in [
        (&gain, "abc", "K_v, joint 1 must be a number; “abc” is not"),
        (&gain, "-5", "K_v, joint 1 must be between 0 and 100000 N·m·s; -5 is not"),
        (&gain, "1e999", "must be a number"),
        (&duration, "-", "Duration must be a number; “-” is not"),
        (&duration, "1e9", "Duration must be between"),
    ] {
        let input = format!("{field} .exact input");
        page.type_into(&input, text)?;
        let state = "const input = document.querySelector(arguments[0]); \
            const error = document.getElementById(input.getAttribute('aria-describedby')); \
            return [input.getAttribute('aria-invalid'), error.hidden, error.textContent]";
        let state = page.run(state, &[json!(input)])?;
        ensure!(state[0] == "true" && state[1] == false, "{text:?} is not marked: {state}");
        ensure!(state[2].as_str().is_some_and(|message| message.contains(needle)), "{text:?} is explained by {state}");
        page.ready()?;
        page.press(&char::from(Key::Escape).to_string())?;
        let invalid = page.run("return document.querySelectorAll('[aria-invalid=true]').length", &[])?;
        ensure!(invalid == 0, "Escape does not bring the last good value back");
    }
    page.ready()?;
    // "1e9" and "1e999" pass through "1" on their way, which is allowed: the last good values are that.
    expect_study(&page, |scheme| {
        let mut edits = vec![("/integration/duration_s".to_owned(), 1.0)];
        if scheme == Scheme::Proposed {
            edits.push(("/scheme/gains/k_v/0".to_owned(), 1.0));
        }
        edits
    })
}
