//! The page's speed as `cargo xtask bench` prints it: a slider's way to the screen, the study's runs alone, the longest task while dragging, a first
//! visit, its size, its module against the same core compiled for this machine. Limits stand beside; timing fails nothing,
//! because machines differ and others may use this one.

use super::transfer;
use crate::bench::Bench;
use crate::moves::{DRAG, FRICTION, MOVE};
use crate::page::{Page, Screen};
use adaptarm_core::scenario::{Report, Scenario, Scheme, SideBySide};
use adaptarm_tests::timing::median;
use anyhow::{Context, Result, ensure};
use serde_json::{Value, json};
use std::time::Instant;

const MOVES: usize = 60;
const WARM_UP: usize = 5;
const VISITS: usize = 7;
const DRAGGED: u32 = 120;
const ROUNDS: usize = 15;

/// Runs a scenario in the page's module, on the main thread and nothing beside it, twice, and answers with the time of the second run
/// in ms, report and all, and the trajectory's hash.
const RUN: &str = "const [scenario, done] = arguments; (async () => { \
        const script = document.querySelector('script[type=module]').src; \
        const { default: init, Run } = await import(new URL('../generated/adaptarm_web.js', script)); \
        await init(); const timed = () => { \
            const start = performance.now(); const run = new Run(scenario); run.advance(0xffffffff); \
            const report = JSON.parse(run.report()); const elapsed = performance.now() - start; \
            run.free(); return [elapsed, report.trajectory_hash]; }; \
        timed(); done(timed()); })()";

/// Runs all scenarios of a list in a pool of two workers of its own, as often as is said and a few times before to warm up;
/// answers with the times in ms until the last has ended, hashed and measured, and its samples are there, and with the hashes.
/// Their arrays are used again, as the page does.
const STUDY: &str = "const [scenarios, warmUp, rounds, done] = arguments; (async () => { \
        const script = document.querySelector('script[type=module]').src; \
        const [{ RunPool }, { loadModule }] = await Promise.all(['pool.js', 'wasm.js'].map((file) => import(new URL(file, script)))); \
        const { module } = await loadModule(); let ended; const fail = (failure) => done(JSON.stringify(failure)); \
        const pool = new RunPool(module, 2, { failed: fail, gaveUp: fail, progress() {}, stopped() {}, restarted() {}, \
            done({ scheme, report, rows }) { pool.takeBack(rows); ended(scheme, report.trajectory_hash); } }); \
        const times = []; const hashes = {}; \
        for (let round = -warmUp; round < rounds; round += 1) { \
            const start = performance.now(); let left = scenarios.length; \
            await new Promise((resolve) => { ended = (run, hash) => { hashes[run] = hash; if ((left -= 1) === 0) resolve(); }; \
                scenarios.forEach((scenario, n) => pool.submit(n, round, scenario)); }); \
            if (round >= 0) times.push(performance.now() - start); \
        } \
        pool.end(); done([times, scenarios.map((_, n) => hashes[n])]); })()";

/// Notes when the first results were on the screen.
const FIRST_READY: &str = "new MutationObserver((_, observer) => { \
        if (document.documentElement?.dataset.state !== 'ready') return; \
        observer.disconnect(); const { port1, port2 } = new MessageChannel(); \
        port1.onmessage = () => { window.firstReady = performance.now(); }; port2.postMessage(null); \
    }).observe(document, { attributes: true, childList: true, subtree: true, attributeFilter: ['data-state'] })";

/// Measures everything and prints it as a table.
pub fn run(bench: &Bench) -> Result<()> {
    println!("The page in Chromium, default study, 12 s at 1 ms, three schemes, {} processors", processors());
    println!("{:<44}{:>10}{:>10}{:>10}{:>10}", "", "median", "p95", "worst", "limit");
    slider(bench)?;
    computed(bench)?;
    dragging(bench)?;
    first_visit(bench)?;
    against_native(bench)
}

/// The module of the page and the core of this program take turns over the default study; their hashes must be the same. The
/// core computes as it does for people, with neighbours in vectors where the machine has AVX2, and with numbers one by one. Each runs
/// twice and the second time counts: what the one before left in the caches is no property of either's code.
fn against_native(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Desktop)?;
    let mut times = Scheme::ALL.map(|_| [Vec::new(), Vec::new(), Vec::new()]);
    // One round more than counted: the first compiles the module.
    for round in 0..=ROUNDS {
        for (scheme, times) in Scheme::ALL.into_iter().zip(&mut times) {
            let scenario = Scenario::new(scheme.paper())?;
            let answer = page.run_async(RUN, &[json!(serde_json::to_string(scenario.document())?)])?;
            let (native_ms, native) = timed(|| scenario.run().report);
            let (scalar_ms, scalar) = timed(|| one_by_one(&scenario));
            let expected = [native.trajectory_hash, scalar?.trajectory_hash];
            ensure!(expected.iter().all(|hash| answer[1] == *hash), "{}: {answer}, {expected:?}", scheme.name());
            if round > 0 {
                let page_ms = answer[0].as_f64().context("no time")?;
                for (list, time) in times.iter_mut().zip([page_ms, native_ms, scalar_ms]) {
                    list.push(time);
                }
            }
        }
    }
    println!(
        "\nOne run in the page's module against the same natively, {ROUNDS} rounds in turns, equal hashes; limit 1.25"
    );
    println!(
        "{:<18}{:>10}{:>12}{:>10}{:>16}{:>10}",
        "median", "page ms", "native ms", "ratio", "one by one ms", "ratio"
    );
    for (scheme, times) in Scheme::ALL.into_iter().zip(times) {
        let against = |other: &[f64]| median(times[0].iter().zip(other).map(|(page, native)| page / native).collect());
        let ratios = [against(&times[1]), against(&times[2])];
        let [page_ms, native_ms, scalar_ms] = times.map(median);
        let [native, scalar] = ratios;
        println!("{:<18}{page_ms:>10.2}{native_ms:>12.2}{native:>10.2}{scalar_ms:>16.2}{scalar:>10.2}", scheme.name());
    }
    Ok(())
}

/// What `work` gives, and the time that it took when done once more, ms.
fn timed<T>(work: impl Fn() -> T) -> (f64, T) {
    work();
    let start = Instant::now();
    let result = work();
    (start.elapsed().as_secs_f64() * 1e3, result)
}

/// A scenario in one lane, the plain number.
fn one_by_one(scenario: &Scenario) -> Result<Report> {
    let mut alone = SideBySide::start(&[scenario], 1).context("a lane alone")?;
    while !alone.advance(u64::MAX) {}
    Ok(alone.finish().remove(0).report)
}

fn slider(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Desktop)?;
    let (mut canvas, mut frame, mut told) = (Vec::new(), Vec::new(), Vec::new());
    for n in 0..WARM_UP + MOVES {
        // Never the same value twice in a row, and no pattern that caches could know.
        let step = [3, -5, 4, -2, 6, -6][n % 6];
        let times = page.run_async(MOVE, &[json!(FRICTION), json!(step)])?;
        if n >= WARM_UP {
            for (at, list) in [&mut canvas, &mut frame, &mut told].into_iter().enumerate() {
                list.push(times[at].as_f64().context("no time")?);
            }
        }
    }
    row("slider to canvases, by the page itself, ms", told, "");
    row("slider to canvases, ms", canvas, "");
    row("slider to the end of the frame, ms", frame, "40 / 70");
    Ok(())
}

/// The runs alone, without a page that draws them.
fn computed(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Desktop)?;
    let scenarios = Scheme::ALL.map(|scheme| Scenario::new(scheme.paper()));
    let (mut texts, mut hashes) = (Vec::new(), Vec::new());
    for scenario in scenarios {
        let scenario = scenario?;
        texts.push(serde_json::to_string(scenario.document())?);
        hashes.push(scenario.run().report.trajectory_hash);
    }
    let answer = page.run_async(STUDY, &[json!(texts), json!(WARM_UP), json!(MOVES)])?;
    ensure!(answer[1] == json!(hashes), "{answer} instead of {hashes:?}");
    // The limit is what the study alone may take of a move's forty.
    row("the study's runs on two workers, ms", numbers(&answer[0])?, "35");
    Ok(())
}

fn dragging(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Desktop)?;
    let tasks = numbers(&page.run_async(DRAG, &[json!(FRICTION), json!(DRAGGED)])?[1])?;
    let longest = tasks.iter().copied().fold(f64::NAN, f64::max);
    let longest = if tasks.is_empty() { "below 50".to_owned() } else { format!("{longest:.0}") };
    let what = format!("longest task of {DRAGGED} moves, ms ({} of 50 and more)", tasks.len());
    println!("{what:<44}{:>10}{:>10}{longest:>10}{:>10}", "", "", 50);
    Ok(())
}

fn first_visit(bench: &Bench) -> Result<()> {
    let (mut paint, mut useful, mut sizes) = (Vec::new(), Vec::new(), None);
    for _ in 0..VISITS {
        let page = Page::blank(bench, Screen::Desktop)?;
        page.before_each_page(FIRST_READY)?;
        page.visit()?;
        page.wait_for("return window.firstReady !== undefined")?;
        let times = page.run(
            "return [performance.getEntriesByName('first-contentful-paint')[0]?.startTime ?? null, window.firstReady]",
            &[],
        )?;
        paint.push(times[0].as_f64().context("nothing was painted")?);
        useful.push(times[1].as_f64().context("no time")?);
        sizes = Some(transfer::measure(&page)?);
    }
    row("cold visit to first paint of content, ms", paint, "");
    row("cold visit to first results drawn, ms", useful, "1500");
    let (kinds, compressed) = sizes.context("no visit")?;
    for (kind, bytes) in &kinds {
        println!("{:<44}{:>10.1}", format!("transfer, {kind}, kB"), bytes / 1000.0);
    }
    let total = kinds.values().sum::<f64>() / 1000.0;
    let note = if compressed { "" } else { " (uncompressed)" };
    println!("{:<44}{total:>10.1}{:>30.0}", format!("transfer, total, kB{note}"), transfer::LIMIT / 1000.0);
    ensure!(total > 10.0, "nothing was transferred");
    Ok(())
}

fn row(what: &str, mut values: Vec<f64>, limit: &str) {
    values.sort_by(f64::total_cmp);
    let at = |share: f64| values[((values.len() - 1) as f64 * share).round() as usize];
    println!("{what:<44}{:>10.1}{:>10.1}{:>10.1}{limit:>10}", at(0.5), at(0.95), at(1.0));
}

fn numbers(list: &Value) -> Result<Vec<f64>> {
    list.as_array().and_then(|all| all.iter().map(Value::as_f64).collect()).context("not a list of numbers")
}

fn processors() -> usize {
    std::thread::available_parallelism().map_or(1, std::num::NonZero::get)
}
