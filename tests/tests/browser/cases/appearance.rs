//! How it looks: phone width, contrast, and pictures of both themes at both widths for people to look at.

use crate::bench::Bench;
use crate::contrast::ratio;
use crate::page::{Page, Screen};
use crate::pictures::{save, save_whole, settle};
use anyhow::{Context, Result, ensure};
use serde_json::json;

const MINIMUM_CONTRAST: f64 = 4.5;

pub fn a_phone_shows_everything(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Phone)?;
    ensure!(page.run("return innerWidth", &[])? == 390, "the screen is not 390 px wide");
    for section in ["setup", "gains", "results", "tables"] {
        page.click(&format!(".jump-bar a[href='#{section}']"))?;
        let there = format!(
            "const box = document.getElementById('{section}').getBoundingClientRect(); \
             return box.top < innerHeight && box.bottom > 0"
        );
        page.wait_for(&there)?;
        let wide = page.run("return document.documentElement.scrollWidth > innerWidth", &[])?;
        ensure!(wide == false, "the page scrolls sideways at {section}");
    }
    page.run("for (const details of document.querySelectorAll('details')) details.open = true", &[])?;
    let outside = page.run(
        "return [...document.querySelectorAll('main *')].filter((node) => { const box = node.getBoundingClientRect(); \
         return box.width > 0 && !node.closest('.visually-hidden') && (box.right > innerWidth + 1 || box.left < -1); }) \
         .map((node) => node.outerHTML.slice(0, 120))",
        &[],
    )?;
    ensure!(outside == json!([]), "cut off at the side: {outside}");
    let small = page.run(
        "return [...document.querySelectorAll('.controls :is(button, select, summary, input[type=range], \
         input[type=text], .choice)')].filter((node) => { const { width, height } = node.getBoundingClientRect(); \
         return width > 0 && (height < 44 || width < 44) && getComputedStyle(node).visibility === 'visible'; }) \
         .map((node) => node.outerHTML.slice(0, 120))",
        &[],
    )?;
    ensure!(small == json!([]), "too small for a finger: {small}");
    Ok(())
}

pub fn every_colour_of_text_has_enough_contrast(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Desktop)?;
    let pairs = [
        ("--ink", "--page"),
        ("--ink", "--surface"),
        ("--muted", "--page"),
        ("--muted", "--surface"),
        ("--accent", "--page"),
        ("--accent", "--surface"),
        ("--on-accent", "--accent"),
        ("--danger", "--surface"),
        ("--ink", "--danger-surface"),
        ("--muted", "--plot-background"),
    ];
    for theme in ["light", "dark"] {
        ensure!(page.run("return document.documentElement.dataset.theme", &[])? == theme, "the theme is not {theme}");
        for (text, background) in pairs {
            let color = |name: &str| -> Result<String> {
                let value = page.run(
                    "return getComputedStyle(document.documentElement).getPropertyValue(arguments[0])",
                    &[json!(name)],
                )?;
                Ok(value.as_str().context("no such property")?.to_owned())
            };
            let contrast = ratio(&color(text)?, &color(background)?)?;
            ensure!(contrast >= MINIMUM_CONTRAST, "{theme}: {text} on {background} has {contrast:.2}:1");
        }
        page.click("#theme-toggle")?;
    }
    Ok(())
}

pub fn screenshots(bench: &Bench) -> Result<()> {
    for (screen, name, width, scale) in [(Screen::Desktop, "desktop", 1440, 1), (Screen::Phone, "phone", 390, 2)] {
        let page = Page::open(bench, screen)?;
        // Two rounds: a whole page's window cannot be made small again where the screen is a phone's.
        for theme in ["light", "dark"] {
            save(&page, &format!("{name}-{theme}"))?;
            if screen == Screen::Phone {
                page.click(".jump-bar a[href='#gains']")?;
                settle(&page)?;
                save(&page, &format!("{name}-{theme}-gains"))?;
                page.run("scrollTo({ top: 0, behavior: 'instant' })", &[])?;
            }
            page.click("#theme-toggle")?;
        }
        for theme in ["light", "dark"] {
            save_whole(&page, &format!("{name}-{theme}-whole"), width, scale)?;
            page.click("#theme-toggle")?;
        }
    }
    Ok(())
}
