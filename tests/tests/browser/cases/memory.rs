//! A long and hasty visit leaves no trace: not in the picture, not in the memory.

use crate::bench::Bench;
use crate::page::{Page, Screen};
use anyhow::{Context, Result, ensure};
use serde_json::{Value, json};

const MOVES: u32 = 200;
/// Ten seconds in all.
const EVERY_MS: u32 = 50;
/// Share by which memory may have grown.
const GROWTH: f64 = 0.2;

/// Moves random sliders of all schemes' gains and of the friction; the seed makes the moves the same each time.
const SCRAMBLE: &str = "const [moves, every, seed, done] = arguments; let state = seed; let n = 0; \
    const random = () => (state = (Math.imul(state, 1664525) + 1013904223) >>> 0) / 4294967296; \
    const sliders = [...document.querySelectorAll('[role=tabpanel] .gain:not(.parameter) number-field input[type=range], \
        #setup [data-pointer=\"/plant/friction/width_rad_s\"] input[type=range]')] \
        .filter((slider) => !slider.closest('details')); \
    const timer = setInterval(() => { \
        const slider = sliders[Math.floor(random() * sliders.length)]; \
        const [min, max, now] = [slider.min, slider.max, slider.value].map(Number); \
        slider.value = Math.min(max, Math.max(min, now + (random() - 0.5) * 0.3 * (max - min))); \
        slider.dispatchEvent(new Event('input', { bubbles: true })); \
        if (++n === moves) { clearInterval(timer); done(sliders.length); } \
    }, every)";

/// Every figure that is drawn, by name and place.
const PICTURES: &str = "return Object.fromEntries([...document.querySelectorAll('#results figure-card')] \
    .map((card, n) => [`${card.dataset.figure} ${n}`, card.querySelector('canvas')?.toDataURL() ?? '']))";

pub fn after_two_hundred_random_moves_nothing_is_left_over(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Desktop)?;
    // Once around: code is compiled, buffers have found their size, and the history is full, which keeps 200 steps.
    scramble(&page, MOVES + 20, EVERY_MS / 2, 7)?;
    let before = memory(&page)?;
    let sliders = scramble(&page, MOVES, EVERY_MS, 42)?;
    let within = |(objects, modules)| objects <= before.0 * (1.0 + GROWTH) && modules <= before.1 * (1.0 + GROWTH);
    let after = memory_at_rest(&page, within)?;
    println!(
        "{MOVES} moves of {sliders} sliders: memory {before:?} before, {after:?} after (bytes of objects, of modules)"
    );
    ensure!(within(after), "memory grew from {before:?} to {after:?} bytes of objects, of modules");

    let kept = page.run_async(
        "const done = arguments[0]; setTimeout(() => done({ path: location.pathname + location.search + location.hash, \
         storage: JSON.stringify(Object.entries(localStorage)) }), 1000)",
        &[],
    )?;
    let pictures = settled_pictures(&page)?;
    let fresh = Page::blank(bench, Screen::Desktop)?;
    let restore = format!(
        "for (const [key, value] of JSON.parse({})) localStorage.setItem(key, value)",
        json!(kept["storage"].as_str().context("no storage")?)
    );
    fresh.before_each_page(&format!("if (location.protocol === 'http:') {{ {restore} }}"))?;
    let base = bench.server.url.trim_end_matches('/');
    fresh.go(&format!("{base}{}", kept["path"].as_str().context("no path")?))?;
    fresh.ready()?;
    let hashes = "return [...document.querySelectorAll('scheme-card')].map((card) => card.dataset.trajectoryHash)";
    ensure!(page.run(hashes, &[])? == fresh.run(hashes, &[])?, "a fresh run gives other trajectories");
    let again = settled_pictures(&fresh)?;
    let (old, new) = (pictures.as_object().context("none")?, again.as_object().context("none")?);
    ensure!(old.len() >= 3, "only {} figures were compared", old.len());
    let different: Vec<_> =
        old.iter().filter(|(name, picture)| new.get(*name) != Some(picture)).map(|(name, _)| name).collect();
    ensure!(different.is_empty() && old.len() == new.len(), "a fresh run looks different: {different:?}");
    Ok(())
}

/// Moves sliders, waits for the last result, and answers how many sliders took part.
fn scramble(page: &Page<'_>, moves: u32, every_ms: u32, seed: u32) -> Result<Value> {
    let sliders = page.run_async(SCRAMBLE, &[json!(moves), json!(every_ms), json!(seed)])?;
    page.ready()?;
    Ok(sliders)
}

/// The figures in view once nothing is drawn any more, from the top of the page.
fn settled_pictures(page: &Page<'_>) -> Result<Value> {
    page.run("scrollTo({ top: 0, behavior: 'instant' })", &[])?;
    page.ready()?;
    crate::pictures::settle(page)?;
    page.run(PICTURES, &[])
}

/// The page's memory once it is as wished, or after some seconds: what a busy machine has yet to do is nothing left over.
fn memory_at_rest(page: &Page<'_>, wished: impl Fn((f64, f64)) -> bool) -> Result<(f64, f64)> {
    let mut now = memory(page)?;
    for _ in 0..15 {
        if wished(now) {
            break;
        }
        crate::pictures::settle(page)?;
        now = memory(page)?;
    }
    Ok(now)
}

/// Bytes of the page's objects after collecting what is garbage, and of the modules' memories.
fn memory(page: &Page<'_>) -> Result<(f64, f64)> {
    for _ in 0..2 {
        page.devtools("HeapProfiler.collectGarbage", &json!({}))?;
    }
    let heap = page.devtools("Runtime.getHeapUsage", &json!({}))?;
    let prototype = page.devtools("Runtime.evaluate", &json!({ "expression": "WebAssembly.Memory.prototype" }))?;
    let memories =
        page.devtools("Runtime.queryObjects", &json!({ "prototypeObjectId": prototype["result"]["objectId"] }))?;
    let sum = "function () { return this.reduce((sum, memory) => sum + memory.buffer.byteLength, 0) }";
    let call =
        json!({ "objectId": memories["objects"]["objectId"], "functionDeclaration": sum, "returnByValue": true });
    let modules = page.devtools("Runtime.callFunctionOn", &call)?;
    let used = heap["usedSize"].as_f64().context("no size of the heap")?;
    let modules = modules["result"]["value"].as_f64().filter(|bytes| *bytes > 0.0).context("no module has a memory")?;
    Ok((used, modules))
}
