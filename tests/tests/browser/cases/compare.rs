//! Undo, redo, history, and pinned runs with their table.

use crate::bench::Bench;
use crate::native::{edited, expect_study, field_value, gain_field, report, shown_hash, slide};
use crate::page::{Page, Screen};
use crate::pictures::{canvas, save, settle};
use adaptarm_core::scenario::Scheme;
use anyhow::{Context, Result, ensure};
use fantoccini::key::Key;
use serde_json::{Value, json};

const GAIN: &str = "/scheme/gains/k_v/0";
const DURATION: &str = "/integration/duration_s";

fn keys(modifiers: &[Key], letter: char) -> String {
    modifiers.iter().map(|&key| char::from(key)).chain([letter, char::from(Key::Null)]).collect()
}

fn text(page: &Page<'_>, selector: &str) -> Result<String> {
    let text = page.run("return document.querySelector(arguments[0])?.textContent ?? null", &[json!(selector)])?;
    Ok(text.as_str().with_context(|| format!("no {selector}"))?.to_owned())
}

/// What the button would undo or redo, once the page has had a frame to say it.
fn title(page: &Page<'_>, button: &str) -> Result<String> {
    settle(page)?;
    let title = page.run("return document.querySelector(arguments[0]).title", &[json!(button)])?;
    Ok(title.as_str().context("no title")?.to_owned())
}

/// Drags a slider with the mouse by 60 px in twenty moves, with a rest in the middle.
fn drag(page: &Page<'_>, field: &str) -> Result<()> {
    let place = "const slider = document.querySelector(arguments[0] + ' input[type=range]'); \
        slider.scrollIntoView({ block: 'center', behavior: 'instant' }); \
        const { left, top, width, height } = slider.getBoundingClientRect(); \
        return [left + width / 2, top + height / 2]";
    let place = page.run(place, &[json!(field)])?;
    let (x, y) = (place[0].as_f64().context("no x")?, place[1].as_f64().context("no y")?);
    let mouse = |kind: &str, x: f64| {
        let event = json!({ "type": kind, "x": x, "y": y, "button": "left", "buttons": 1, "clickCount": 1 });
        page.devtools("Input.dispatchMouseEvent", &event)
    };
    mouse("mousePressed", x)?;
    for n in 1..=20 {
        if n == 10 {
            // Longer than the pause that ends a step when keys make it.
            std::thread::sleep(std::time::Duration::from_millis(1700));
        }
        mouse("mouseMoved", x + 3.0 * f64::from(n))?;
    }
    mouse("mouseReleased", x + 60.0)?;
    page.ready()
}

pub fn every_change_can_be_undone(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Desktop)?;
    let gain = gain_field(Scheme::Proposed, GAIN);
    let expect = |edits: &[(&str, f64)]| {
        let edits: Vec<_> = edits.iter().map(|&(pointer, value)| (pointer.to_owned(), value)).collect();
        expect_study(&page, |scheme| if scheme == Scheme::Proposed { edits.clone() } else { Vec::new() })
    };
    ensure!(title(&page, "#undo")? == "Undo", "there is something to undo before anything is done");
    drag(&page, &gain)?;
    let dragged = field_value(&page, &gain)?;
    ensure!(dragged > 40.0, "the drag changed nothing");
    let said = title(&page, "#undo")?;
    ensure!(said == format!("Undo: K_v joint 1: 40 → {dragged}, Proposed"), "the button says {said:?}");
    page.click("scheme-card[data-scheme=slotine_li] input")?;
    let shown = "return document.querySelector('scheme-card[data-scheme=slotine_li] input').checked";
    ensure!(title(&page, "#undo")? == "Undo: Hide Slotine and Li", "hiding is no step");

    page.press(&keys(&[Key::Control], 'z'))?;
    ensure!(page.run(shown, &[])? == true, "undo does not show the scheme again");
    page.press(&keys(&[Key::Control], 'z'))?;
    page.ready()?;
    // The whole drag at once.
    expect(&[])?;
    ensure!(field_value(&page, &gain)? == 40.0, "the field keeps the value that was undone");
    ensure!(title(&page, "#undo")? == "Undo", "the drag was more than one step");
    page.press(&keys(&[Key::Control, Key::Shift], 'z'))?;
    page.ready()?;
    expect(&[(GAIN, dragged)])?;
    page.press(&keys(&[Key::Control], 'y'))?;
    ensure!(page.run(shown, &[])? == false, "Ctrl+Y does not hide the scheme again");

    // Where text is typed, the keys belong to the text.
    page.type_into(&format!("{gain} .exact input"), "55")?;
    page.ready()?;
    page.press(&keys(&[Key::Control], 'z'))?;
    page.ready()?;
    ensure!(page.run(shown, &[])? == false, "Ctrl+Z in a text field undid a step of the page");
    page.run("document.activeElement.blur()", &[])?;
    page.click("#undo")?;
    page.ready()?;
    // A new change ends what could have been redone.
    slide(&page, &gain, -30)?;
    ensure!(title(&page, "#redo")? == "Redo", "there is something to redo after a new change");
    page.click("#reset-all")?;
    page.ready()?;
    expect(&[])?;
    page.click("#undo")?;
    page.ready()?;
    expect(&[(GAIN, field_value(&page, &gain)?)])
}

pub fn the_history_survives_a_reload(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Desktop)?;
    let gain = gain_field(Scheme::Proposed, GAIN);
    slide(&page, &gain, 20)?;
    let first = field_value(&page, &gain)?;
    slide(&page, &gain_field(Scheme::SlotineLi, "/scheme/gains/k_s/1"), -40)?;
    slide(&page, &format!("#setup [data-pointer=\"{DURATION}\"]"), 10)?;
    page.click("#undo")?;
    page.ready()?;
    let hashes = |page: &Page<'_>| -> Result<Vec<String>> {
        Scheme::ALL.into_iter().map(|scheme| shown_hash(page, scheme)).collect()
    };
    let before = hashes(&page)?;
    page.reload()?;
    ensure!(hashes(&page)? == before, "a reload changes the settings");
    page.click("[popovertarget=history-list]")?;
    settle(&page)?;
    save(&page, "history")?;
    let steps = "return [...document.querySelectorAll('#history-list .step')].map((step) => \
        [step.firstElementChild.textContent, step.getAttribute('aria-current')])";
    let steps = page.run(steps, &[])?;
    let expected = json!([
        ["Duration: 12 → 6 s", null],
        [steps[1][0], "step"],
        [format!("Kv joint 1: 40 → {first}, Proposed"), null],
        ["Start: The paper's study", null],
    ]);
    ensure!(steps == expected, "the list is {steps}");
    page.run("document.querySelectorAll('#history-list .step')[2].click()", &[])?;
    page.ready()?;
    expect_study(&page, |scheme| if scheme == Scheme::Proposed { vec![(GAIN.to_owned(), first)] } else { Vec::new() })?;
    page.run("document.querySelectorAll('#history-list .step')[0].click()", &[])?;
    page.ready()?;
    ensure!(field_value(&page, &format!("#setup [data-pointer=\"{DURATION}\"]"))? == 6.0, "the last step is gone");
    Ok(())
}

fn pins_ready(page: &Page<'_>) -> Result<()> {
    page.wait_for("return document.querySelector('#compare').dataset.state === 'ready'")
}

/// Brings the table into view and waits until it is filled.
fn see_table(page: &Page<'_>) -> Result<()> {
    page.run("document.querySelector('#compare').scrollIntoView({ behavior: 'instant' })", &[])?;
    settle(page)
}

fn number(text: &str) -> Result<f64> {
    text.replace('−', "-").parse().with_context(|| format!("{text:?} is no number"))
}

pub fn pinned_runs_are_compared_and_kept(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Desktop)?;
    let gain = gain_field(Scheme::Proposed, GAIN);
    page.click("#pin-runs")?;
    pins_ready(&page)?;
    slide(&page, &gain, 40)?;
    let value = field_value(&page, &gain)?;
    see_table(&page)?;
    save(&page, "compare")?;
    let pinned = report(&edited(Scheme::Proposed, &[])?)?.metrics;
    let now = report(&edited(Scheme::Proposed, &[(GAIN, value)])?)?.metrics;
    for (metric, now, pinned) in [
        ("index_e_deg/0", now.index_e_deg[0], pinned.index_e_deg[0]),
        ("index_de_deg_s/0", now.index_de_deg_s[0], pinned.index_de_deg_s[0]),
        ("tau_peak_nm/0", now.tau_peak_nm[0], pinned.tau_peak_nm[0]),
    ] {
        let row = format!("#pin-table [data-metric=\"{metric}\"]");
        let shown = number(&text(&page, &format!("{row} .ours"))?)?;
        let kept = number(&text(&page, &format!("{row} .pinned-value"))?)?;
        ensure!((shown / now - 1.0).abs() < 1e-3, "{metric}: now {shown}, the core computes {now}");
        ensure!((kept / pinned - 1.0).abs() < 1e-3, "{metric}: pinned {kept}, the core computes {pinned}");
        let difference = text(&page, &format!("{row} .difference"))?;
        let verdict = if now < pinned { "✓\u{a0}better" } else { "✗\u{a0}worse" };
        ensure!(difference.contains(verdict), "{metric}: {now} after {pinned} is called {difference:?}");
        let absolute = number(difference.split_whitespace().next().context("no difference")?)?;
        ensure!((absolute - (now - pinned)).abs() <= 0.01 * (now - pinned).abs(), "{metric}: {difference:?}");
    }
    let settings = page.run(
        "return [...document.querySelectorAll('#pin-settings tbody tr')].map((row) => \
         [row.dataset.pointer, ...[...row.cells].map((cell) => cell.textContent)])",
        &[],
    )?;
    let expected = json!([[GAIN, "Kv joint 1, Proposed", value.to_string(), "40"]]);
    ensure!(settings == expected, "what differs in the settings: {settings}");

    page.type_into(".pin-name", "Paper")?;
    page.press(&char::from(Key::Enter).to_string())?;
    page.click(".pin-toggle input")?;
    page.reload()?;
    pins_ready(&page)?;
    let pin = page.run(
        "const pin = document.querySelector('.pin'); return [pin.querySelector('.pin-name').value, \
         pin.querySelector('input[type=checkbox]').checked, pin.querySelector('.pin-standing').textContent]",
        &[],
    )?;
    ensure!(pin == json!(["Paper", false, "same bits as when pinned"]), "after a reload the pin is {pin}");
    page.click(".pin-use")?;
    page.ready()?;
    expect_study(&page, |_| Vec::new())?;
    ensure!(title(&page, "#undo")?.starts_with("Undo: Pin “Paper”: "), "using a pin is no step");
    page.click(".pin-remove")?;
    page.reload()?;
    ensure!(page.run("return document.querySelectorAll('.pin').length", &[])? == 0, "a removed pin came back");
    ensure!(page.log("browser")?.is_empty(), "the browser complains");
    Ok(())
}

pub fn other_bits_and_a_seventh_pin_are_said(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Phone)?;
    for _ in 0..7 {
        page.click("#pin-runs")?;
    }
    pins_ready(&page)?;
    ensure!(text(&page, "#notices")?.contains("There are 6 pins already"), "a seventh pin is not refused");
    see_table(&page)?;
    save(&page, "compare-phone")?;
    ensure!(page.run("return document.documentElement.scrollWidth > innerWidth", &[])? == false, "scrolls sideways");
    let small = page.run(
        "return [...document.querySelectorAll('#compare :is(button, select, input[type=text], .pin-toggle), .toolbar button')] \
         .filter((node) => { const { width, height } = node.getBoundingClientRect(); \
         return width > 0 && (height < 44 || width < 44); }).map((node) => node.outerHTML.slice(0, 120))",
        &[],
    )?;
    ensure!(small == json!([]), "too small for a finger: {small}");
    // As if this version computed another trajectory than the one that was pinned, and could not read the next pin.
    page.run(
        "const saved = JSON.parse(localStorage['adaptarm.pins']); saved.pins[1].hashes.proposed = '0'.repeat(64); \
         saved.pins[2].documents.proposed.scheme.gains.k_v = 'none'; \
         localStorage['adaptarm.pins'] = JSON.stringify(saved)",
        &[],
    )?;
    page.reload()?;
    pins_ready(&page)?;
    let standing =
        page.run("return [...document.querySelectorAll('.pin-standing')].map((node) => node.textContent)", &[])?;
    let standing: Vec<&str> = standing.as_array().context("no pins")?.iter().filter_map(Value::as_str).collect();
    ensure!(standing.len() == 5 && standing[1].contains("Other bits"), "the pins say {standing:?}");
    ensure!(standing[0].contains("same bits"), "the pins say {standing:?}");
    ensure!(text(&page, "#notices")?.contains("A pin of an earlier visit"), "a dropped pin is not mentioned");
    Ok(())
}

pub fn a_slider_does_not_wait_for_pins(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Desktop)?;
    slide(&page, &format!("#setup [data-pointer=\"{DURATION}\"]"), 118)?;
    page.click("#pin-runs")?;
    // Stops the pin's first run, which starts again behind this one.
    slide(&page, &gain_field(Scheme::SlotineLi, "/scheme/gains/k_s/1"), -40)?;
    let waiting = page.run("return document.querySelector('#compare').dataset.state", &[])?;
    ensure!(waiting == "running", "the pin's three runs of 60 s are done before a slider's one");
    page.click("#undo")?;
    page.ready()?;
    pins_ready(&page)?;
    ensure!(
        text(&page, ".pin-standing")? == "same bits as when pinned",
        "the pin is {}",
        text(&page, ".pin-standing")?
    );
    Ok(())
}

pub fn a_pinned_run_is_drawn_beside_the_new_one(bench: &Bench) -> Result<()> {
    const FIGURE: &str = "tracking_errors";
    let page = Page::open(bench, Screen::Desktop)?;
    page.click("#pin-runs")?;
    pins_ready(&page)?;
    slide(&page, &gain_field(Scheme::Proposed, GAIN), -60)?;
    page.run("document.querySelector('[data-figure=tracking_errors]').scrollIntoView({ behavior: 'instant' })", &[])?;
    settle(&page)?;
    save(&page, "overlay")?;
    let both = canvas(&page, FIGURE)?;
    page.click(".pin-toggle input")?;
    settle(&page)?;
    let alone = canvas(&page, FIGURE)?;
    ensure!(both != alone, "a pinned run is not drawn");
    page.click(".pin-toggle input")?;
    settle(&page)?;
    ensure!(canvas(&page, FIGURE)? == both, "a pinned run that is shown again is drawn otherwise");
    page.click(".pin-remove")?;
    settle(&page)?;
    ensure!(canvas(&page, FIGURE)? == alone, "a removed pin is still drawn");
    Ok(())
}
