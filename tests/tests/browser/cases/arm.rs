//! The arm: drawn in 3-D, played, scrubbed, side by side; without WebGL, and when its context is lost.

use crate::bench::Bench;
use crate::page::{Graphics, Page, Screen};
use anyhow::{Context, Result, ensure};
use fantoccini::key::Key;
use serde_json::{Value, json};

/// Where drawings are slow, things rest a third of a second before they are drawn finely.
const RESTED: &str = "const view = document.querySelector('arm-view'); return view.drawings > 0 && \
    view.canvas.getAttribute('aria-label').includes(' mm ')";

/// Draws the arm again and answers with what its canvas then shows: for each third of the width, the share of pixels that
/// differ from the first by much, and of those that are blue, orange or green as the schemes are. Read at once: what was
/// drawn is gone once it is on the screen.
const LOOK: &str = "const done = arguments[0]; const view = document.querySelector('arm-view'); \
    view.addEventListener('drawn', () => { \
        const { width, height } = view.canvas; const gl = view.canvas.getContext('webgl2'); \
        const pixels = new Uint8Array(4 * width * height); \
        gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels); \
        done([0, 1, 2].map((third) => { \
            const seen = { solid: 0, blue: 0, orange: 0, green: 0 }; \
            for (let y = 0; y < height; y += 1) for (let x = Math.floor(third * width / 3); x < Math.floor((third + 1) * width / 3); x += 1) { \
                const [r, g, b, a] = pixels.subarray(4 * (y * width + x)); \
                seen.solid += a === 255 ? 1 : 0; \
                seen.blue += a === 255 && b > r + 60 && b > g + 25 ? 1 : 0; \
                seen.orange += a === 255 && r > b + 70 && r > g + 40 ? 1 : 0; \
                seen.green += a === 255 && g > r + 50 && g > b + 10 ? 1 : 0; } \
            return seen; })); \
    }, { once: true }); \
    view.redraw()";

const TIME: &str = "return document.querySelector('transport-bar input[type=range]').valueAsNumber";

pub fn three_arms_are_drawn_side_by_side(bench: &Bench) -> Result<()> {
    let page = shown(bench, Screen::Desktop, Graphics::Software)?;
    let seen = page.run_async(LOOK, &[])?;
    let count = |third: usize, what: &str| seen[third][what].as_u64().unwrap_or_default();
    for (third, own) in ["blue", "orange", "green"].into_iter().enumerate() {
        ensure!(count(third, "solid") > 3000, "there is no arm in third {third}: {seen}");
        for color in ["blue", "orange", "green"] {
            let expected = if color == own { 60..=u64::MAX } else { 0..=20 };
            ensure!(expected.contains(&count(third, color)), "third {third} has the wrong colours: {seen}");
        }
    }
    let labels = page.run("return [...document.querySelectorAll('.arm-name')].map((node) => node.textContent)", &[])?;
    ensure!(labels == json!(["Proposed", "Tang and Arteaga", "Slotine and Li"]), "the labels are {labels}");

    // One scheme less is one arm less; one arm is alone.
    page.click("scheme-card[data-scheme=tang_arteaga] input")?;
    let labels = page.run("return [...document.querySelectorAll('.arm-name')].map((node) => node.textContent)", &[])?;
    ensure!(labels == json!(["Proposed", "Slotine and Li"]), "after hiding one the labels are {labels}");
    page.click(".stage-modes button")?;
    let seen = page.run_async(LOOK, &[])?;
    let all = |what: &str| (0..3).map(|third| seen[third][what].as_u64().unwrap_or_default()).sum::<u64>();
    ensure!(all("blue") > 60 && all("green") < 20, "one arm is not alone: {seen}");
    Ok(())
}

pub fn the_arm_plays_and_is_scrubbed_by_keyboard(bench: &Bench) -> Result<()> {
    let page = shown(bench, Screen::Desktop, Graphics::Software)?;
    ensure!(page.run(TIME, &[])? == 0.0, "it plays by itself");
    page.run("document.querySelector('arm-view canvas').focus()", &[])?;
    page.press(" ")?;
    page.wait_for(&format!("{TIME} > 0.3"))?;
    page.press(" ")?;
    let paused = page.run(TIME, &[])?;
    page.wait_for("return document.querySelector('transport-bar .play').getAttribute('aria-label') === 'Play'")?;
    let at = format!("At {:.2} s", paused.as_f64().context("no time")?);
    page.wait_for(&format!(
        "return document.querySelector('arm-view canvas').getAttribute('aria-label').includes({})",
        json!(at)
    ))?;

    page.run("document.querySelector('transport-bar input').focus()", &[])?;
    page.press(&char::from(Key::End).to_string())?;
    ensure!(page.run(TIME, &[])? == 12.0, "End does not lead to the end");
    page.press(&char::from(Key::Left).to_string())?;
    let back = page.run(TIME, &[])?.as_f64().context("no time")?;
    ensure!((back - 11.9).abs() < 0.02, "an arrow key leads to {back} s");
    page.wait_for("return document.querySelector('.clock').textContent === '11.90 / 12.00 s'")?;

    // New results while it plays: it goes on.
    page.press(&char::from(Key::Home).to_string())?;
    page.click("transport-bar .play")?;
    page.run(
        "const slider = document.querySelector('[role=tabpanel] input[type=range]'); \
         slider.value = Number(slider.value) + 5; slider.dispatchEvent(new Event('input', { bubbles: true }))",
        &[],
    )?;
    page.ready()?;
    let then = page.run(TIME, &[])?;
    page.wait_for(&format!("{TIME} > {then}"))
}

pub fn the_view_turns_and_zooms_within_limits(bench: &Bench) -> Result<()> {
    let page = shown(bench, Screen::Desktop, Graphics::Software)?;
    let camera = || page.run("return { ...document.querySelector('arm-view').orbit.camera }", &[]);
    let home = camera()?;
    page.run("document.querySelector('arm-view canvas').focus()", &[])?;
    page.press(&char::from(Key::Left).to_string())?;
    ensure!(camera()?["yaw_rad"] != home["yaw_rad"], "an arrow key does not turn the view");
    for _ in 0..30 {
        page.press(&char::from(Key::Up).to_string())?;
        page.press("+")?;
    }
    let far = camera()?;
    ensure!(far["pitch_rad"].as_f64() < Some(1.57) && far["zoom"].as_f64() < Some(3.1), "there are no limits: {far}");
    page.press("0")?;
    ensure!(camera()? == home, "0 does not lead back");

    page.run(
        "const canvas = document.querySelector('arm-view canvas'); \
         const send = (type, x) => canvas.dispatchEvent(new PointerEvent(type, \
             { pointerId: 1, clientX: x, clientY: 100, button: 0, bubbles: true })); \
         canvas.setPointerCapture = () => {}; send('pointerdown', 100); send('pointermove', 160); send('pointerup', 160); \
         send('pointermove', 300)",
        &[],
    )?;
    let turned = camera()?["yaw_rad"].as_f64().context("no yaw")? - home["yaw_rad"].as_f64().context("no yaw")?;
    ensure!((turned + 0.48).abs() < 1e-6, "60 pixels turn the view by {turned} rad");
    let prevented = page.run(
        "const wheel = (ctrlKey) => !document.querySelector('arm-view canvas').dispatchEvent( \
             new WheelEvent('wheel', { deltaY: -50, ctrlKey, cancelable: true })); return [wheel(false), wheel(true)]",
        &[],
    )?;
    ensure!(prevented == json!([false, true]), "a wheel without ctrl must scroll the page: {prevented}");
    ensure!(camera()?["zoom"].as_f64() > home["zoom"].as_f64(), "ctrl and wheel do not zoom");
    Ok(())
}

pub fn without_webgl_the_arm_is_drawn_flat(bench: &Bench) -> Result<()> {
    for screen in [Screen::Desktop, Screen::Phone] {
        let page = shown(bench, screen, Graphics::Off)?;
        let message = page.run("return document.querySelector('.arm-message').textContent", &[])?;
        ensure!(message.as_str().is_some_and(|text| text.contains("no WebGL2")), "the message is {message}");
        let blank = "const { canvas } = document.querySelector('arm-view'); \
            const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height); \
            let [blue, ink] = [0, 0]; \
            for (let at = 0; at < data.length; at += 4) { \
                blue += data[at + 3] > 200 && data[at + 2] > data[at] + 60 ? 1 : 0; ink += data[at + 3] > 0 ? 1 : 0; } \
            return [blue, ink]";
        let drawn = page.run(blank, &[])?;
        let count = |n: usize| drawn[n].as_u64().unwrap_or_default();
        ensure!(count(0) > 500 && count(1) > 5000, "the flat drawing is nearly blank: {drawn}");
        page.run("document.querySelector('transport-bar input').focus()", &[])?;
        page.press(&char::from(Key::End).to_string())?;
        page.wait_for(
            "return document.querySelector('arm-view canvas').getAttribute('aria-label').includes('12.00 s')",
        )?;
    }
    Ok(())
}

pub fn a_lost_context_comes_back_or_is_explained(bench: &Bench) -> Result<()> {
    let page = shown(bench, Screen::Desktop, Graphics::Software)?;
    page.run(
        "window.loss = document.querySelector('arm-view canvas').getContext('webgl2').getExtension('WEBGL_lose_context'); \
         window.loss.loseContext()",
        &[],
    )?;
    page.wait_for("return document.querySelector('.arm-message').textContent.includes('interrupted')")?;
    page.run("window.loss.restoreContext()", &[])?;
    page.wait_for("return document.querySelector('.arm-message').textContent === ''")?;
    let seen = page.run_async(LOOK, &[])?;
    ensure!(seen[0]["solid"].as_u64() > Some(3000), "after the context came back nothing is drawn: {seen}");

    page.run("window.loss.loseContext()", &[])?;
    page.wait_for("return document.querySelector('arm-view').isFlat")?;
    let message = page.run("return document.querySelector('.arm-message').textContent", &[])?;
    ensure!(message.as_str().is_some_and(|text| text.contains("did not come back")), "the message is {message}");
    Ok(())
}

/// Asking for a drawing must cost the page little, even while it plays, and nothing when nothing moves or it is out of view.
pub fn the_arm_takes_little_of_the_main_thread(bench: &Bench) -> Result<()> {
    let page = shown(bench, Screen::Desktop, Graphics::Software)?;
    let measure = "const done = arguments[0]; const view = document.querySelector('arm-view'); const times = []; \
        const note = () => { times.push(view.drawMs); if (times.length === 15) { view.removeEventListener('drawn', note); \
            document.querySelector('transport-bar .play').click(); done(times.sort((a, b) => a - b)); } }; \
        view.addEventListener('drawn', note); document.querySelector('transport-bar .play').click()";
    let times = page.run_async(measure, &[])?;
    // The lower quartile: where a processor draws, it takes the page's thread its time as it pleases.
    let quartile = times[3].as_f64().context("no time")?;
    println!("main thread per drawing of three arms: lower quartile {quartile:.1} ms of {times}");
    ensure!(quartile < 3.0, "a drawing takes {quartile} ms: {times}");

    page.run_async("setTimeout(arguments[0], 1500)", &[])?;
    let drawings = || page.run("return document.querySelector('arm-view').drawings", &[]);
    let before = drawings()?;
    page.run_async("setTimeout(arguments[0], 600)", &[])?;
    ensure!(drawings()? == before, "it draws though nothing moves");
    page.run("scrollTo({ top: document.documentElement.scrollHeight, behavior: 'instant' })", &[])?;
    page.run_async("setTimeout(arguments[0], 600)", &[])?;
    let before = drawings()?;
    page.click("transport-bar .play")?;
    page.run_async("setTimeout(arguments[0], 600)", &[])?;
    ensure!(page.run(TIME, &[])?.as_f64() > Some(0.1), "it does not play");
    ensure!(drawings()? == before, "it draws out of view");
    Ok(())
}

/// A page whose arm is in view, drawn and described.
fn shown(bench: &Bench, screen: Screen, graphics: Graphics) -> Result<Page<'_>> {
    let page = Page::open_with(bench, screen, graphics)?;
    page.run("document.getElementById('stage').scrollIntoView({ behavior: 'instant', block: 'center' })", &[])?;
    page.wait_for(RESTED)?;
    let flat: Value = page.run("return document.querySelector('arm-view').isFlat", &[])?;
    ensure!(flat == (graphics == Graphics::Off), "with graphics {graphics:?}, drawn flat: {flat}");
    Ok(page)
}
