//! The tour of the paper: by keyboard from start to end, with the replication's verdicts, and back to the visitor's settings.

use crate::bench::Bench;
use crate::native::expect_study;
use crate::page::{Page, Screen};
use adaptarm_core::experiments::replication::{Claim, Verdict, check_claims, study};
use adaptarm_core::scenario::{Scenario, ScenarioDocument, Scheme};
use anyhow::{Context, Result, anyhow, ensure};
use fantoccini::key::Key;
use serde_json::{Value, json};

const OWN: &str = "[data-scheme=proposed] [data-pointer='/scheme/gains/k_v/0'] input[type=text]";
const HIDDEN: &str = "scheme-card[data-scheme=slotine_li] input[type=checkbox]";
const STEPS: usize = 16;
/// What the tour shows: its place, the verdict, the focus, and whether panel and marked part of the page keep apart.
const SHOWN: &str = "const panel = document.querySelector('#tour'); const target = document.querySelector('.tour-target'); \
    const badge = panel.querySelector('.badge'); const box = panel.getBoundingClientRect(); const at = target.getBoundingClientRect(); \
    const sideways = Math.min(box.right, at.right) - Math.max(box.left, at.left); \
    return { progress: panel.querySelector('.tour-progress').textContent, title: panel.querySelector('h2').textContent, \
    claim: badge?.dataset.claim ?? null, verdict: badge?.dataset.verdict ?? null, text: panel.textContent, \
    focus: document.activeElement.id, apart: sideways <= 0, top: at.top, low: box.top, high: innerHeight }";

/// The replication's verdicts.
pub(super) fn claims(adjust: impl Fn(&mut ScenarioDocument)) -> Result<Vec<Claim>> {
    let runs: Vec<_> = study(adjust)?.iter().map(Scenario::run).collect();
    let runs = runs.try_into().map_err(|_| anyhow!("not three runs"))?;
    Ok(check_claims(&runs))
}

/// As the page names it.
fn verdict(claim: &Claim) -> Value {
    json!(claim.verdict)
}

fn press(page: &Page<'_>, key: Key) -> Result<()> {
    page.press(&char::from(key).to_string())
}

/// Presses the tabulator until an element has the focus.
fn tab_to(page: &Page<'_>, id: &str) -> Result<()> {
    for _ in 0..12 {
        if page.run("return document.activeElement.id", &[])? == id {
            return Ok(());
        }
        press(page, Key::Tab)?;
    }
    anyhow::bail!("the tabulator does not lead to {id}")
}

/// Makes settings that are not the paper's: a gain, and a scheme hidden.
fn set_own(page: &Page<'_>) -> Result<()> {
    page.type_into(OWN, "77")?;
    page.click(HIDDEN)?;
    page.ready()
}

fn expect_own(page: &Page<'_>) -> Result<()> {
    page.ready()?;
    expect_study(page, |scheme| match scheme {
        Scheme::Proposed => vec![("/scheme/gains/k_v/0".to_owned(), 77.0)],
        _ => Vec::new(),
    })?;
    let hidden = page.run("return document.querySelector(arguments[0]).checked", &[json!(HIDDEN)])?;
    ensure!(hidden == false, "the hidden scheme is not hidden again");
    Ok(())
}

fn start(page: &Page<'_>) -> Result<()> {
    page.run("document.querySelector('#tour-open').focus()", &[])?;
    press(page, Key::Enter)?;
    page.ready()
}

pub fn the_tour_goes_by_keyboard_and_judges_as_the_replication(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Desktop)?;
    set_own(&page)?;
    start(&page)?;
    ensure!(page.run(SHOWN, &[])?["focus"] == "tour-title", "the focus is not on the first step");
    let expected = claims(|_| {})?;
    let mut judged = Vec::new();
    tab_to(&page, "tour-next")?;
    for step in 1..=STEPS {
        page.ready()?;
        expect_study(&page, |_| Vec::new())?;
        page.wait_for("return !document.querySelector('#tour').textContent.includes('computing…')")?;
        let shown = page.run(SHOWN, &[])?;
        ensure!(shown["progress"] == format!("{step} of {STEPS}"), "{shown}");
        ensure!(shown["focus"] == "tour-next", "the focus does not stay: {shown}");
        ensure!(shown["apart"] == true, "the panel covers what it speaks of: {shown}");
        page.wait_for(
            "const { top, bottom } = document.querySelector('.tour-target').getBoundingClientRect(); \
             return bottom > 0 && top < innerHeight",
        )?;
        if shown["claim"].is_string() {
            let claim = expected.iter().find(|claim| shown["claim"] == claim.id).context("an unknown claim")?;
            ensure!(shown["verdict"] == verdict(claim), "{} is {} here: {shown}", claim.id, verdict(claim));
            let text = shown["text"].as_str().unwrap_or_default();
            for said in [claim.claim, claim.criterion, &claim.evidence] {
                ensure!(text.contains(said), "{said:?} is missing in {text}");
            }
            judged.push(claim.id);
        }
        if step < STEPS {
            press(&page, Key::Enter)?;
        }
    }
    ensure!(judged.len() == expected.len(), "judged were {judged:?}");
    let holding = expected.iter().filter(|claim| claim.verdict == Verdict::Holds).count();
    let sum = page.run("return document.querySelector('.tour-sum').textContent", &[])?;
    ensure!(sum.as_str().is_some_and(|sum| sum.starts_with(&format!("{holding} of {}", expected.len()))), "{sum}");

    // Back to one's own settings, still by keyboard: the button stands before Back and Finish.
    for _ in 0..2 {
        press_shift_tab(&page)?;
    }
    ensure!(page.run("return document.activeElement.id", &[])? == "tour-return", "no way back to one's settings");
    press(&page, Key::Enter)?;
    expect_own(&page)?;
    ensure!(page.run("return document.activeElement.id", &[])? == "tour-next", "the focus is lost");
    press(&page, Key::Enter)?;
    let after = page.run("return [document.querySelector('#tour').hidden, document.activeElement.id, document.querySelectorAll('.tour-target, .notice').length]", &[])?;
    ensure!(after == json!([true, "tour-open", 0]), "{after}");
    let logged = page.log("browser")?;
    ensure!(logged.is_empty(), "{logged:?}");
    Ok(())
}

fn press_shift_tab(page: &Page<'_>) -> Result<()> {
    page.press(&format!("{}{}{}", char::from(Key::Shift), char::from(Key::Tab), char::from(Key::Null)))
}

pub fn escape_ends_the_tour_and_the_settings_come_back(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Desktop)?;
    set_own(&page)?;
    start(&page)?;
    press(&page, Key::Escape)?;
    let after = page.run("return [document.querySelector('#tour').hidden, document.activeElement.id]", &[])?;
    ensure!(after == json!([true, "tour-open"]), "{after}");
    expect_study(&page, |_| Vec::new())?;
    page.click("#tour-restore")?;
    expect_own(&page)?;

    // A reload in the midst of it loses nothing either.
    start(&page)?;
    expect_study(&page, |_| Vec::new())?;
    page.reload()?;
    page.click("#tour-restore")?;
    expect_own(&page)?;
    page.reload()?;
    let offered = page.run("return document.querySelector('#tour-restore') !== null", &[])?;
    ensure!(offered == false, "settings that are back are offered again");

    // Who changes nothing is asked nothing.
    page.click("#setup button.wide")?;
    page.run(
        "document.querySelector(arguments[0]).checked || document.querySelector(arguments[0]).click()",
        &[json!(HIDDEN)],
    )?;
    page.ready()?;
    start(&page)?;
    press(&page, Key::Escape)?;
    let offered = page.run("return document.querySelector('#tour-restore') !== null", &[])?;
    ensure!(offered == false, "settings that never changed are offered back");
    Ok(())
}

pub fn the_tour_judges_longer_runs(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Desktop)?;
    start(&page)?;
    let expected = claims(|document| document.integration.duration_s = 600.0)?;
    let similar = expected.iter().position(|claim| claim.id == "similar_to_tang_arteaga").context("no such claim")?;
    for _ in 0..3 + similar {
        page.click("#tour-next")?;
    }
    page.ready()?;
    page.wait_for("return document.querySelector('.badge')?.dataset.verdict === 'does_not_hold'")?;
    page.click("[data-seconds='600']")?;
    page.ready()?;
    page.wait_for("return document.querySelector('.badge') !== null")?;
    let shown = page.run(SHOWN, &[])?;
    ensure!(shown["claim"] == expected[similar].id, "{shown}");
    ensure!(expected[similar].verdict == Verdict::Holds && shown["verdict"] == "holds", "{shown}");
    // What the texts say of 600 s.
    let holding: Vec<_> =
        expected.iter().filter(|claim| claim.verdict == Verdict::Holds).map(|claim| claim.id).collect();
    for id in ["ultimately_bounded", "slotine_li_converges", "slotine_li_settles_last", "observer_replaces_the_sensor"]
    {
        ensure!(holding.contains(&id), "{id} does not hold over 600 s");
    }
    ensure!(!holding.contains(&"third_joint_velocity_stays") && !holding.contains(&"proposed_best"), "{holding:?}");
    let evidence = |id: &str| expected.iter().find(|claim| claim.id == id).map(|claim| claim.evidence.clone());
    for (id, said) in [
        ("estimates_become_constant", "Proposed 14; Tang and Arteaga 6; Slotine and Li 11"),
        ("closest_estimates", "within 10 %: Proposed 5; Tang and Arteaga 1; Slotine and Li 5"),
        ("proposed_best", "smallest in 3 of 6"),
    ] {
        ensure!(evidence(id).is_some_and(|evidence| evidence.contains(said)), "{id}: {:?}", evidence(id));
    }
    Ok(())
}

pub fn on_a_phone_the_tour_is_a_sheet_below_what_it_speaks_of(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Phone)?;
    page.devtools(
        "Emulation.setEmulatedMedia",
        &json!({ "features": [{ "name": "prefers-reduced-motion", "value": "reduce" }] }),
    )?;
    start(&page)?;
    for step in 1..=STEPS {
        page.ready()?;
        page.wait_for(
            "const sheet = document.querySelector('#tour').getBoundingClientRect(); \
             const { top } = document.querySelector('.tour-target').getBoundingClientRect(); \
             return sheet.bottom <= innerHeight + 1 && sheet.top > innerHeight / 2 && top >= 0 && top < sheet.top - 100",
        )
        .with_context(|| format!("step {step}"))?;
        let small = page.run(
            "return [...document.querySelectorAll('#tour button')].filter((button) => button.getClientRects().length > 0) \
                .map((button) => button.getBoundingClientRect()).filter(({ height }) => height < 44).length",
            &[],
        )?;
        ensure!(small == 0, "step {step}: {small} buttons are too low for a finger");
        let width = page.run("return document.documentElement.scrollWidth", &[])?;
        ensure!(width == 390, "step {step}: the page is {width} px wide");
        page.click("#tour-next")?;
    }
    Ok(())
}
