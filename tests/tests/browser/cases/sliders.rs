//! Sliders and studies: what is shown after a change is what the core computes for it, however fast the changes came.

use crate::bench::Bench;
use crate::native::{expect_study, field_value, gain_field};
use crate::page::{Page, Screen};
use crate::pictures::canvas;
use adaptarm_core::scenario::Scheme;
use anyhow::{Result, ensure};
use serde_json::json;

const GAIN: &str = "/scheme/gains/k_v/0";
const FRICTION: &str = "/plant/friction/width_rad_s";

/// Moves a slider by `arguments[1]` positions.
const MOVE: &str = "const slider = document.querySelector(arguments[0] + ' input[type=range]'); \
    slider.value = Number(slider.value) + arguments[1]; slider.dispatchEvent(new Event('input', { bubbles: true }))";

pub fn a_slider_changes_its_scheme_and_no_other(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Desktop)?;
    let field = gain_field(Scheme::Proposed, GAIN);
    page.run(MOVE, &[json!(field), json!(25)])?;
    page.ready()?;
    let value = field_value(&page, &field)?;
    ensure!(value > 40.0, "the slider changed nothing: {value}");
    expect_study(&page, |scheme| match scheme {
        Scheme::Proposed => vec![(GAIN.to_owned(), value)],
        _ => Vec::new(),
    })
}

pub fn after_sixty_rapid_moves_the_last_one_is_shown(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Desktop)?;
    let gain = gain_field(Scheme::Proposed, GAIN);
    let friction = format!("#setup [data-pointer=\"{FRICTION}\"]");
    // Sixty moves at the rate of a hand on a mouse, of one scheme's gain and of all schemes' friction by turns.
    let script = "const [gain, friction, done] = arguments; let n = 0; \
        const timer = setInterval(() => { \
            const slider = document.querySelector((n % 3 ? gain : friction) + ' input[type=range]'); \
            slider.value = (n * 37) % 121 - 60; \
            slider.dispatchEvent(new Event('input', { bubbles: true })); \
            if (++n === 60) { clearInterval(timer); done(); } \
        }, 12)";
    page.run_async(script, &[json!(gain), json!(friction)])?;
    page.ready()?;
    let generation = page.run("return document.documentElement.dataset.generation", &[])?;
    ensure!(generation == "61", "sixty moves and the start made generation {generation}");
    let (gain, friction) = (field_value(&page, &gain)?, field_value(&page, &friction)?);
    expect_study(&page, |scheme| {
        let mut edits = vec![(FRICTION.to_owned(), friction)];
        if scheme == Scheme::Proposed {
            edits.push((GAIN.to_owned(), gain));
        }
        edits
    })?;
    let picture = canvas(&page, "tracking_errors")?;
    // Saving waits for quiet; leaving the page saves too.
    page.reload()?;
    ensure!(canvas(&page, "tracking_errors")? == picture, "a fresh run of the same settings gives another picture");
    Ok(())
}

pub fn a_study_replaces_all_settings(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Desktop)?;
    page.run(MOVE, &[json!(gain_field(Scheme::SlotineLi, "/scheme/gains/k_s/1")), json!(-40)])?;
    let chosen = "return document.querySelector('#study').value";
    ensure!(page.run(chosen, &[])? == "custom", "own settings are not a study");
    let choose = "const study = document.querySelector('#study'); study.value = arguments[0]; \
        study.dispatchEvent(new Event('change'))";
    page.run(choose, &[json!("heavier_arm")])?;
    page.ready()?;
    let heavier = (7..10).map(|n| (n, 1.3)).chain((16..18).map(|n| (n, 1.5)));
    let edits: Vec<_> = heavier.map(|(n, factor)| (format!("/plant/theta_scale/{n}"), factor)).collect();
    expect_study(&page, |_| edits.clone())?;
    ensure!(page.run(chosen, &[])? == "heavier_arm", "the study shown is not the study chosen");
    page.click("#reset-all")?;
    page.ready()?;
    expect_study(&page, |_| Vec::new())
}
