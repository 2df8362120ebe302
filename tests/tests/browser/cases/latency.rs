//! How long a slider move takes until all its results are on the canvases. Prints what it measures.
//!
//! How fast a machine is, and what else it does, is not the page's: only the long form, which runs alone, has a bound.

use crate::bench::Bench;
use crate::native::gain_field;
use crate::page::{Page, Screen};
use adaptarm_core::scenario::Scheme;
use adaptarm_tests::machine;
use anyhow::{Context, Result, ensure};
use serde_json::json;

const SAMPLES: usize = 9;
/// The bound that the study promises: all three schemes, default study.
const BOUND_MS: f64 = 250.0;

/// Moves a slider once and answers with the milliseconds until everything is drawn.
const MEASURE: &str = "const [field, step, done] = arguments; const root = document.documentElement; \
    const slider = document.querySelector(field + ' input[type=range]'); \
    const start = performance.now(); \
    slider.value = Number(slider.value) + step; slider.dispatchEvent(new Event('input', { bubbles: true })); \
    new MutationObserver((_, observer) => { \
        if (root.dataset.state === 'ready') { observer.disconnect(); done(performance.now() - start); } \
    }).observe(root, { attributes: true, attributeFilter: ['data-state'] })";

pub fn a_slider_move_is_drawn_in_time(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Desktop)?;
    let all = "#setup [data-pointer=\"/plant/friction/width_rad_s\"]";
    let one = gain_field(Scheme::Proposed, "/scheme/gains/k_v/0");
    let all_ms = measure(&page, all)?;
    let one_ms = measure(&page, &one)?;
    for (what, times_ms) in [("all three schemes", &all_ms), ("one scheme", &one_ms)] {
        let list: Vec<_> = times_ms.iter().map(|time| format!("{time:.0}")).collect();
        println!("slider to canvas, {what}: median {:.0} ms of {}", median(times_ms), list.join(" "));
    }
    ensure!(
        !machine::soak() || median(&all_ms) < BOUND_MS,
        "the median is {:.0} ms; promised are {BOUND_MS}",
        median(&all_ms)
    );
    Ok(())
}

/// Sorted times, after one move to warm up.
fn measure(page: &Page<'_>, field: &str) -> Result<Vec<f64>> {
    let mut times_ms = Vec::new();
    for n in 0..=SAMPLES {
        let step = if n % 2 == 0 { 4 } else { -4 };
        let time = page.run_async(MEASURE, &[json!(field), json!(step)])?.as_f64().context("no time")?;
        if n > 0 {
            times_ms.push(time);
        }
    }
    times_ms.sort_by(f64::total_cmp);
    Ok(times_ms)
}

fn median(sorted: &[f64]) -> f64 {
    sorted[sorted.len() / 2]
}
