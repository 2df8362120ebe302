//! How the main page looks, compared with how it looked when someone last approved of it.
//!
//! Fonts, and how browsers smooth them, differ between machines, so pixels are not compared: each cell of a coarse grid has a
//! brightness, and few cells may differ by much. `ADAPTARM_BLESS=1` writes the present look as the one to compare with.

use crate::bench::Bench;
use crate::page::{Page, Screen};
use crate::pictures::{Grid, grid, settle};
use anyhow::{Context, Result, ensure};
use serde_json::json;
use std::path::PathBuf;

/// Brightness, of 255, by which a cell may differ before it counts.
const CELL_TOLERANCE: f64 = 10.0;
/// Share of cells that may count.
const SHARE: f64 = 0.02;

pub fn the_main_page_looks_as_approved(bench: &Bench) -> Result<()> {
    let bless = std::env::var("ADAPTARM_BLESS").is_ok_and(|value| value == "1");
    for screen in [Screen::Desktop, Screen::Phone] {
        let page = Page::open(bench, screen)?;
        for theme in ["light", "dark"] {
            let name = format!("{}-{theme}", if screen == Screen::Desktop { "desktop" } else { "phone" });
            let now = look(&page, screen)?;
            let path = reference(&name);
            if bless {
                std::fs::create_dir_all(path.parent().context("no folder")?)?;
                std::fs::write(&path, now.to_csv())?;
            }
            let text = std::fs::read_to_string(&path).with_context(|| {
                format!("{} is missing; look at the page and run with ADAPTARM_BLESS=1", path.display())
            })?;
            let share = now.share_beyond(&Grid::from_csv(&text)?, CELL_TOLERANCE)?;
            println!("{name}: {:.2} % of the cells differ", 100.0 * share);
            if share > SHARE {
                crate::pictures::save(&page, &format!("look-{name}"))?;
            }
            ensure!(
                share <= SHARE,
                "{name} looks different in {:.1} % of its cells (screenshot look-{name}); if that is meant, run with \
                 ADAPTARM_BLESS=1 and commit {}",
                100.0 * share,
                path.display()
            );
            page.click("#theme-toggle")?;
        }
    }
    Ok(())
}

/// The comparison is worth something only if it fails when it should.
pub fn a_change_of_looks_would_be_seen(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Desktop)?;
    let before = look(&page, Screen::Desktop)?;
    let same = look(&page, Screen::Desktop)?.share_beyond(&before, CELL_TOLERANCE)?;
    ensure!(same <= 0.001, "the page differs from itself in {:.2} % of its cells", 100.0 * same);
    let figure =
        "[...document.querySelectorAll('#results figure-card')].find((card) => card.getClientRects().length > 0)";
    let changes = [
        ("a hidden figure", format!("{figure}.style.visibility = 'hidden'"), format!("{figure}.style.visibility = ''")),
        (
            "hidden controls",
            "document.querySelector('.controls').style.visibility = 'hidden'".to_owned(),
            "document.querySelector('.controls').style.visibility = ''".to_owned(),
        ),
        (
            "a result that is pushed down",
            "document.querySelector('.results').style.setProperty('padding-top', '40px')".to_owned(),
            "document.querySelector('.results').style.removeProperty('padding-top')".to_owned(),
        ),
        (
            "a curve that is gone",
            "document.querySelectorAll('scheme-card input').forEach((box) => box.click())".to_owned(),
            "document.querySelectorAll('scheme-card input').forEach((box) => box.click())".to_owned(),
        ),
    ];
    for (what, change, restore) in changes {
        page.run(&change, &[])?;
        let share = look(&page, Screen::Desktop)?.share_beyond(&before, CELL_TOLERANCE)?;
        println!("{what}: {:.2} % of the cells differ", 100.0 * share);
        ensure!(share > SHARE, "{what} changes only {:.2} % of the cells: the comparison is blind", 100.0 * share);
        page.run(&restore, &[])?;
    }
    Ok(())
}

/// Whoever drags a slider must not see it wander because a sentence in the head became longer.
pub fn what_the_head_says_moves_nothing(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Phone)?;
    for width in [320, 360, 375, 390, 430, 640] {
        let metrics = json!({ "width": width, "height": 844, "deviceScaleFactor": 1, "mobile": true });
        page.devtools("Emulation.setDeviceMetricsOverride", &metrics)?;
        let heights = page.run(
            "const said = document.getElementById('run-state'); \
             return ['computing…', 'up\\u00a0to\\u00a0date · 84\\u00a0ms', 'up\\u00a0to\\u00a0date · 18472\\u00a0ms'].map((text) => { \
                said.textContent = text; return document.querySelector('header').offsetHeight; })",
            &[],
        )?;
        ensure!(heights[0] == heights[1] && heights[1] == heights[2], "{width} px: the head is {heights} px high");
    }
    Ok(())
}

/// What a high window shows from the top of the page, at rest: with the first figures, which a usual one leaves out.
fn look(page: &Page<'_>, screen: Screen) -> Result<Grid> {
    let (width, height, mobile) = if screen == Screen::Desktop { (1440, 2000, false) } else { (390, 2400, true) };
    let metrics = json!({ "width": width, "height": height, "deviceScaleFactor": 1, "mobile": mobile });
    page.devtools("Emulation.setDeviceMetricsOverride", &metrics)?;
    page.run("scrollTo({ top: 0, behavior: 'instant' }); document.activeElement.blur()", &[])?;
    page.ready()?;
    // Sentences with milliseconds are another length each time.
    page.run(
        "document.getElementById('run-state').style.visibility = 'hidden'; \
         for (const text of document.querySelectorAll('scheme-card .outcome')) text.style.visibility = 'hidden'",
        &[],
    )?;
    settle(page)?;
    let size = page.run("return [innerWidth, innerHeight]", &[])?;
    let cells = |at: usize| -> Result<u32> { Ok((size[at].as_f64().context("no size")? / 24.0).round() as u32) };
    grid(page, cells(0)?, cells(1)?).with_context(|| json!(size).to_string())
}

fn reference(name: &str) -> PathBuf {
    crate::bench::repository().join(format!("tests/tests/browser/looks/{name}.csv"))
}
