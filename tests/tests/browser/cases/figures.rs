//! The figures under pointer and keys: zoom shared by all, values read where they were recorded, sharp at any resolution.

use crate::bench::Bench;
use crate::page::{Page, Screen};
use crate::pictures::{canvas, picture, settle};
use adaptarm_core::recording::{Columns, Signal};
use adaptarm_core::scenario::{Scenario, Scheme};
use anyhow::{Context, Result, ensure};
use fantoccini::key::Key;
use serde_json::{Value, json};

/// The duration of the paper's study, s.
const WHOLE_S: f64 = 12.0;

/// The layer of a figure that takes the pointer.
const LAYER: &str = "#figures [data-figure=tracking_errors] .figure-overlay";

/// Brings a figure's layer to the middle of the window and gives its place: left, top, width, height.
const PLACE: &str = "const layer = document.querySelector(arguments[0]); \
    layer.scrollIntoView({ block: 'center', behavior: 'instant' }); \
    const { left, top, width, height } = layer.getBoundingClientRect(); return [left, top, width, height]";

/// What is zoomed into, as the slider of the cursor and the bar's text say it.
const WINDOW: &str = "return document.querySelector('.figure-window').textContent.match(/[\\d.]+/g).map(Number)";

pub fn zoom_is_shared_and_values_are_those_recorded(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Desktop)?;
    let [left, top, width, height] = place(&page, LAYER)?;
    settle(&page)?;
    let at = |x: f64, y: f64| (left + x * width, top + y * height);
    let whole = [canvas(&page, "tracking_errors")?, canvas(&page, "velocity_errors")?];

    // Pointing reads values in every figure in view and redraws none.
    mouse(&page, "mouseMoved", at(0.4, 0.3), 0)?;
    settle(&page)?;
    expect_reading(&page, "tracking_errors", Signal::Error)?;
    expect_reading(&page, "velocity_errors", Signal::ErrorRate)?;
    ensure!(canvas(&page, "tracking_errors")? == whole[0], "pointing at a figure draws it anew");
    let covered = page.run(
        "const { x, y } = arguments[0]; const card = document.querySelector('#figures [data-figure=tracking_errors]'); \
         const box = card.getBoundingClientRect(); \
         return [...card.querySelectorAll('.reading')].map((node) => node.getBoundingClientRect()).filter((place) => \
            place.width === 0 || place.left < box.left || place.right > box.right || place.bottom > box.bottom || \
            (place.left <= x && x <= place.right && place.top <= y && y <= place.bottom)).length",
        &[json!({ "x": at(0.4, 0.3).0, "y": at(0.4, 0.3).1 })],
    )?;
    ensure!(covered == 0, "{covered} read-outs leave the card or lie under the pointer");

    // Dragging across a stretch zooms into it, in all figures.
    mouse(&page, "mousePressed", at(0.4, 0.3), 1)?;
    mouse(&page, "mouseMoved", at(0.5, 0.3), 1)?;
    mouse(&page, "mouseMoved", at(0.6, 0.3), 1)?;
    mouse(&page, "mouseReleased", at(0.6, 0.3), 0)?;
    settle(&page)?;
    let [from, to] = window(&page)?;
    ensure!((1.5..4.0).contains(&(to - from)), "a fifth of the width is zoomed into as {from} to {to} s");
    for (figure, before) in [("tracking_errors", &whole[0]), ("velocity_errors", &whole[1])] {
        ensure!(canvas(&page, figure)? != *before, "{figure} does not follow the zoom");
    }
    mouse(&page, "mouseMoved", at(0.5, 0.3), 0)?;
    settle(&page)?;
    expect_reading(&page, "tracking_errors", Signal::Error)?;

    // A wheel alone is the page's; with Ctrl it zooms; a double click shows everything again.
    let wheel = |modifiers: u32| {
        let (x, y) = at(0.5, 0.3);
        let event = json!({ "type": "mouseWheel", "x": x, "y": y, "deltaX": 0, "deltaY": 100, "modifiers": modifiers });
        page.devtools("Input.dispatchMouseEvent", &event)
    };
    let scrolled = page.run("return scrollY", &[])?;
    wheel(2)?;
    settle(&page)?;
    let [wider_from, wider_to] = window(&page)?;
    ensure!(wider_to - wider_from > 1.2 * (to - from), "Ctrl and the wheel do not zoom: {wider_from} to {wider_to} s");
    ensure!(page.run("return scrollY", &[])? == scrolled, "zooming scrolls the page");
    wheel(0)?;
    settle(&page)?;
    ensure!(page.run("return scrollY", &[])? != scrolled, "the wheel alone does not scroll the page");
    ensure!(window(&page)? == [wider_from, wider_to], "the wheel alone zooms");
    page.run("document.querySelector(arguments[0]).dispatchEvent(new MouseEvent('dblclick'))", &[json!(LAYER)])?;
    place(&page, LAYER)?;
    mouse(&page, "mouseMoved", (1.0, 1.0), 0)?;
    settle(&page)?;
    ensure!(window(&page)? == [0.0, WHOLE_S], "a double click does not show everything");
    ensure!(canvas(&page, "tracking_errors")? == whole[0], "the whole run looks different after a zoom");

    // A click leaves the cursor where it was, over all figures, when the pointer has gone.
    let layers = || -> Result<[String; 2]> {
        let layer = |figure| picture(&page, &format!("#figures [data-figure={figure}] .figure-overlay"));
        Ok([layer("tracking_errors")?, layer("velocity_errors")?])
    };
    let bare = layers()?;
    mouse(&page, "mousePressed", at(0.5, 0.3), 1)?;
    mouse(&page, "mouseReleased", at(0.5, 0.3), 0)?;
    mouse(&page, "mouseMoved", (1.0, 1.0), 0)?;
    settle(&page)?;
    let marked = layers()?;
    ensure!(marked[0] != bare[0] && marked[1] != bare[1], "a click leaves no cursor");
    Ok(())
}

pub fn keys_move_the_cursor_and_zoom(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Desktop)?;
    let slider = "const { ariaValueNow, ariaValueText, role, ariaLabel } = document.activeElement; \
        return { now: Number(ariaValueNow), text: ariaValueText, role, name: ariaLabel }";
    let press = |key: Key| -> Result<Value> {
        page.press(&char::from(key).to_string())?;
        settle(&page)?;
        page.run(slider, &[])
    };
    page.run("document.querySelector(arguments[0]).focus()", &[json!(LAYER)])?;
    let outline = page.run("return document.querySelector(':focus-visible') === document.activeElement", &[])?;
    ensure!(outline == true, "the focus cannot be seen on a figure");
    let end = press(Key::End)?;
    ensure!(end["now"] == WHOLE_S && end["role"] == "slider", "the end key leads to {end}");
    let back = press(Key::Left)?;
    let step = WHOLE_S - back["now"].as_f64().context("no value")?;
    ensure!(step > 0.0 && step <= 0.02 * WHOLE_S, "an arrow key moves by {step} s");
    expect_reading(&page, "tracking_errors", Signal::Error)?;
    page.wait_for(
        "const text = document.getElementById('announcements').textContent; \
         return text.startsWith('At 11.9 s.') && text.includes('Proposed') && text.includes('Slotine and Li')",
    )?;

    let whole = canvas(&page, "velocity_errors")?;
    page.press("+")?;
    settle(&page)?;
    let [from, to] = window(&page)?;
    ensure!(from > 0.0 && to == WHOLE_S, "plus shows {from} to {to} s");
    ensure!(canvas(&page, "velocity_errors")? != whole, "the other figures do not follow the zoom");
    let start = press(Key::Home)?;
    ensure!((start["now"].as_f64().context("no value")? - from).abs() < 0.01, "home leads to {start}, not {from}");
    page.press("-")?;
    page.press("-")?;
    settle(&page)?;
    ensure!(window(&page)? == [0.0, WHOLE_S], "minus does not zoom out");
    page.press("++++")?;
    settle(&page)?;
    ensure!(window(&page)? != [0.0, WHOLE_S], "plus does not zoom in");
    page.press("0")?;
    settle(&page)?;
    ensure!(window(&page)? == [0.0, WHOLE_S], "0 does not show everything");
    Ok(())
}

pub fn fingers_scrub_zoom_and_scroll(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Phone)?;
    let [left, top, width, height] = place(&page, LAYER)?;
    settle(&page)?;
    let at = |x: f64, y: f64| json!({ "x": left + x * width, "y": top + y * height });
    let touch = |kind: &str, points: Value| {
        page.devtools("Input.dispatchTouchEvent", &json!({ "type": kind, "touchPoints": points }))
    };
    let finger = |n: u32, mut point: Value| {
        point["id"] = json!(n);
        point
    };
    // Sideways: the cursor follows, values are shown.
    touch("touchStart", json!([finger(0, at(0.4, 0.5))]))?;
    for n in 0..10 {
        touch("touchMove", json!([finger(0, at(0.4 + 0.02 * f64::from(n), 0.5))]))?;
    }
    touch("touchEnd", json!([]))?;
    settle(&page)?;
    expect_reading(&page, "tracking_errors", Signal::Error)?;
    // Apart: all figures zoom.
    let before = canvas(&page, "tracking_errors")?;
    touch("touchStart", json!([finger(0, at(0.45, 0.5)), finger(1, at(0.65, 0.5))]))?;
    for n in 0..10 {
        let by = 0.02 * f64::from(n);
        touch("touchMove", json!([finger(0, at(0.45 - by, 0.5)), finger(1, at(0.65 + by, 0.5))]))?;
    }
    touch("touchEnd", json!([]))?;
    settle(&page)?;
    let [from, to] = window(&page)?;
    ensure!((2.0..7.0).contains(&(to - from)), "spread fingers show {from} to {to} s");
    ensure!(canvas(&page, "tracking_errors")? != before, "the figure does not follow the fingers");
    // Up: the page scrolls, nothing else happens.
    let scrolled = page.run("return scrollY", &[])?.as_f64().context("no scroll")?;
    touch("touchStart", json!([finger(0, at(0.5, 0.8))]))?;
    for n in 0..12 {
        touch("touchMove", json!([finger(0, at(0.5, 0.8 - 0.05 * f64::from(n)))]))?;
    }
    touch("touchEnd", json!([]))?;
    settle(&page)?;
    let now = page.run("return scrollY", &[])?.as_f64().context("no scroll")?;
    ensure!(now > scrolled + 50.0, "a finger that moves up does not scroll the page: {scrolled} to {now}");
    ensure!(window(&page)? == [from, to], "scrolling zooms");
    Ok(())
}

pub fn errors_are_seen_on_a_symmetric_logarithmic_axis(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Desktop)?;
    page.run("document.getElementById('figures').scrollIntoView({ behavior: 'instant' })", &[])?;
    settle(&page)?;
    let seen = || -> Result<[String; 2]> { Ok([canvas(&page, "tracking_errors")?, canvas(&page, "positions")?]) };
    let linear = seen()?;
    page.click(".figure-bar [data-axis=symlog]")?;
    settle(&page)?;
    let symlog = seen()?;
    ensure!(symlog[0] != linear[0], "the axis of the errors does not change");
    ensure!(symlog[1] == linear[1], "the axis of the positions changes, too");
    let pressed = "return [...document.querySelectorAll('.figure-bar [aria-pressed]')].map((node) => node.ariaPressed)";
    ensure!(page.run(pressed, &[])? == json!(["false", "true"]), "the buttons do not say which axis it is");
    page.reload()?;
    page.run("document.getElementById('figures').scrollIntoView({ behavior: 'instant' })", &[])?;
    settle(&page)?;
    ensure!(canvas(&page, "tracking_errors")? == symlog[0], "a reload does not keep the axis");
    page.click(".figure-bar [data-axis=linear]")?;
    settle(&page)?;
    ensure!(seen()? == linear, "the linear axis is not what it was");
    Ok(())
}

pub fn figures_stay_sharp_at_any_pixel_ratio(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Desktop)?;
    // As zooming does it: the larger the pixels, the fewer of them fit into the window.
    for (width, ratio) in [(1440, 2.0), (1200, 1.5), (1600, 1.0)] {
        let metrics = json!({ "width": width, "height": 1000, "deviceScaleFactor": ratio, "mobile": false });
        page.devtools("Emulation.setDeviceMetricsOverride", &metrics)?;
        place(&page, LAYER)?;
        settle(&page)?;
        let blurred = page.run(
            "return [...document.querySelectorAll('figure-card')].filter((card) => { \
                const { top, bottom, height } = card.getBoundingClientRect(); \
                return height > 0 && top < innerHeight && bottom > 0; \
             }).flatMap((card) => [...card.querySelectorAll('canvas')]).map((canvas) => { \
                const { width, height } = canvas.getBoundingClientRect(); \
                return [canvas.width - width * devicePixelRatio, canvas.height - height * devicePixelRatio]; \
             })",
            &[],
        )?;
        let differences: Vec<[f64; 2]> = serde_json::from_value(blurred)?;
        ensure!(!differences.is_empty(), "no figure is in view");
        let sharp = differences.iter().flatten().all(|difference| difference.abs() <= 1.0);
        ensure!(sharp, "at {ratio} device pixels a pixel the canvases are off by {differences:?}");
        let drawn = page.run(
            "const { width, height } = document.querySelector('#figures [data-figure=tracking_errors] canvas'); \
             return document.createElement('canvas').toDataURL() && [width, height]",
            &[],
        )?;
        let empty = page.run(
            "const canvas = document.createElement('canvas'); [canvas.width, canvas.height] = arguments[0]; \
             return canvas.toDataURL()",
            &[drawn],
        )?;
        ensure!(empty != canvas(&page, "tracking_errors")?.as_str(), "the figure is not drawn after the change");
    }
    Ok(())
}

pub fn a_spike_of_one_sample_is_seen(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Desktop)?;
    // The page's own module draws a run that is at rest but for one sample of ten thousand.
    let script = "const done = arguments[arguments.length - 1]; const scenario = arguments[0]; const columns = arguments[1]; \
        const error = arguments[2]; (async () => { \
            const bindings = await import('/generated/adaptarm_web.js'); \
            const count = 10001; const rows = new Float64Array(count * columns); \
            for (let n = 0; n < count; n += 1) rows[n * columns] = n * 12 / (count - 1); \
            const draw = (spike, view) => { \
                const runs = new bindings.Runs(); \
                const own = rows.slice(); if (spike) own[spike * columns + error] = 1; \
                runs.set('a', scenario, own, true); \
                const canvas = document.createElement('canvas'); canvas.width = 500; canvas.height = 360; \
                const shown = [{ id: 'a', label: null, faded: false, color: null }]; \
                const panels = bindings.draw_figure(runs, canvas, 'tracking_errors', JSON.stringify({ shown, dark: false, \
                    scale: 1, from_s: null, to_s: null, axis: 'linear', focus: null, true_value: '', time_axis: '', ...view })); \
                runs.free(); \
                const [left, top, right, bottom] = panels; \
                const pixels = canvas.getContext('2d').getImageData(left, top, right - left, 0.4 * (bottom - top)).data; \
                let ink = 0; \
                for (let n = 0; n < pixels.length; n += 4) ink += pixels[n + 2] - pixels[n] > 60 ? 1 : 0; \
                return ink; \
            }; \
            const whole = {}; const near = { from_s: 3, to_s: 9 }; const beside = { from_s: 8, to_s: 10 }; \
            return [draw(0, whole), draw(4567, whole), draw(4567, near), draw(4567, beside)]; \
        })().then(done, (error) => done(String(error)))";
    let document = json!(Scenario::new(Scheme::Proposed.paper())?.document());
    let columns = Columns { joints: 3, parameters: 18 };
    let arguments = [json!(document.to_string()), json!(columns.width()), json!(columns.start(Signal::Error))];
    let ink = page.run_async(script, &arguments)?;
    let counts: [u32; 4] = serde_json::from_value(ink.clone()).with_context(|| format!("the script says {ink}"))?;
    let [without, whole, near, beside] = counts;
    ensure!(without == 0 && beside == 0, "where there is no spike {without} and {beside} pixels are inked");
    ensure!(whole > 10 && near > 10, "a spike inside the window leaves {whole} and {near} pixels of ink");
    Ok(())
}

/// Checks the values written in a figure against the recordings of the paper's study, at the instant written beside them.
pub fn expect_reading(page: &Page<'_>, figure: &str, signal: Signal) -> Result<()> {
    let read = page.run(
        "const card = document.querySelector(`#figures [data-figure=${arguments[0]}]`); \
         return [card.querySelector('.figure-readings').hidden, card.querySelector('.reading-time')?.textContent ?? '', \
             [...card.querySelectorAll('.reading')].map((panel) => \
                 Object.fromEntries([...panel.children].map((row) => [row.dataset.line, row.textContent])))]",
        &[json!(figure)],
    )?;
    ensure!(read[0] == false, "{figure}: no values are shown");
    let number = |text: &Value| -> Result<f64> {
        let text = text.as_str().context("no text")?.trim_end_matches(" s").replace('−', "-");
        text.parse().with_context(|| format!("{text:?} is no number"))
    };
    let time_s = number(&read[1])?;
    for scheme in Scheme::ALL {
        let recording = Scenario::new(scheme.paper())?.run().recording;
        for joint in 0..3 {
            let shown = number(&read[2][joint][scheme.id()])?;
            let factor = signal.exported().1;
            // The instant is written with four digits; samples are 4 ms apart.
            let near: Vec<f64> = recording
                .times_s()
                .zip(recording.signal(signal, joint))
                .filter(|(t, _)| (t - time_s).abs() <= 0.011)
                .map(|(_, value)| value * factor)
                .collect();
            let (low, high) = near.iter().fold((f64::MAX, f64::MIN), |(a, b), x| (a.min(*x), b.max(*x)));
            let rounding = 6e-4 * shown.abs() + 1e-9;
            ensure!(
                shown >= low - rounding && shown <= high + rounding,
                "{figure}, {}, joint {}: {shown} is written at {time_s} s; recorded is {low} to {high}",
                scheme.id(),
                joint + 1
            );
        }
    }
    Ok(())
}

fn place(page: &Page<'_>, layer: &str) -> Result<[f64; 4]> {
    Ok(serde_json::from_value(page.run(PLACE, &[json!(layer)])?)?)
}

fn window(page: &Page<'_>) -> Result<[f64; 2]> {
    Ok(serde_json::from_value(page.run(WINDOW, &[])?)?)
}

fn mouse(page: &Page<'_>, kind: &str, (x, y): (f64, f64), buttons: u32) -> Result<()> {
    let button = if kind == "mouseMoved" && buttons == 0 { "none" } else { "left" };
    let event = json!({ "type": kind, "x": x, "y": y, "button": button, "buttons": buttons, "clickCount": 1 });
    page.devtools("Input.dispatchMouseEvent", &event)?;
    Ok(())
}
