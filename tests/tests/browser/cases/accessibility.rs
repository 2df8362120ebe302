//! What axe-core finds on every page, in both themes at both widths; and that nothing moves for those who asked for less.
//!
//! axe-core comes with a Python package that `cargo xtask setup` installs; `ADAPTARM_AXE` is its path.

use crate::bench::Bench;
use crate::page::{Page, Screen};
use anyhow::{Context, Result, ensure};
use serde_json::{Value, json};

/// Runs axe and tells each violation with its first elements. Its rule on empty table heads does not see formulas, which screen
/// readers do read: heads with one in them do not count.
const AXE: &str = "const [context, done] = arguments; \
    const isFormula = (id, { target }) => id === 'empty-table-header' \
        && Boolean(document.querySelector(target.join(' '))?.querySelector('math')?.textContent.trim()); \
    const say = ({ target, any, all }) => \
        `${target.join(' ')}: ${[...any, ...all].map(({ message }) => message).join('; ').slice(0, 200)}`; \
    axe.run(context, { resultTypes: ['violations'] }).then(({ passes, violations }) => done({ passes: passes.length, \
        violations: violations.map(({ id, help, nodes }) => ({ id, help, nodes: nodes.filter((node) => !isFormula(id, node)) })) \
            .filter(({ nodes }) => nodes.length > 0) \
            .map(({ id, help, nodes }) => `${id} (${help}) at ${nodes.slice(0, 4).map(say).join(' | ')}`) }), \
        (error) => done({ passes: 0, violations: [String(error)] }))";

/// Path of axe-core's script, where it is installed.
pub fn axe() -> Option<std::path::PathBuf> {
    std::env::var_os("ADAPTARM_AXE").map(Into::into).filter(|path: &std::path::PathBuf| path.is_file())
}

pub fn axe_finds_nothing_on_the_playground(bench: &Bench) -> Result<()> {
    for screen in [Screen::Desktop, Screen::Phone] {
        let page = Page::open(bench, screen)?;
        for theme in ["light", "dark"] {
            examine(&page, &format!("playground, {screen:?}, {theme}"))?;
            // Everything that is folded, and what a wrong number brings.
            page.run("for (const details of document.querySelectorAll('details')) details.open = true", &[])?;
            page.type_into("[role=tabpanel]:not([hidden]) number-field .exact input", "-1")?;
            examine(&page, &format!("playground unfolded, {screen:?}, {theme}"))?;
            dialogs(&page, &format!("{screen:?}, {theme}"))?;
            page.reload()?;
            page.click("#theme-toggle")?;
        }
        page.go(&format!("{}/?lang=es", bench.server.url))?;
        page.ready()?;
        examine(&page, &format!("playground in Spanish, {screen:?}"))?;
    }
    Ok(())
}

pub fn axe_finds_nothing_on_the_other_pages(bench: &Bench) -> Result<()> {
    for screen in [Screen::Desktop, Screen::Phone] {
        let page = Page::blank(bench, screen)?;
        for path in pages() {
            for theme in ["light", "dark"] {
                page.go(&format!("{}/{path}", bench.server.url))?;
                page.wait_for("return document.readyState === 'complete' && document.body.innerText.length > 100")?;
                page.run("localStorage.setItem('adaptarm.theme', arguments[0]); location.reload()", &[json!(theme)])?;
                page.wait_for("return document.readyState === 'complete' && document.body.innerText.length > 100")?;
                examine(&page, &format!("{path}, {screen:?}, {theme}"))?;
            }
        }
    }
    Ok(())
}

/// The page's documents beside the playground.
fn pages() -> Vec<String> {
    let folder = crate::bench::repository().join("static");
    let documents = std::fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    let documents = documents.filter(|path| path.extension().is_some_and(|ending| ending == "html"));
    let names = documents.filter_map(|path| Some(path.file_name()?.to_str()?.to_owned()));
    names.filter(|name| name != "index.html").collect()
}

/// What is wrong with Swagger UI itself, by axe's names: the page around it is ours, this is not.
const SWAGGER_UI: [&str; 4] = ["color-contrast", "heading-order", "nested-interactive", "select-name"];

pub fn axe_finds_only_swagger_ui_s_own_on_the_api_s_page(bench: &Bench) -> Result<()> {
    let page = Page::blank(bench, Screen::Desktop)?;
    page.go(&format!("{}/api/docs", bench.server.url))?;
    page.wait_for("return document.querySelectorAll('.opblock').length > 10")?;
    let found = run(&page)?;
    ensure!(found["passes"].as_u64().is_some_and(|passes| passes > 10), "axe did not run: {found}");
    let list: Vec<_> = found["violations"].as_array().context("no answer")?.iter().filter_map(Value::as_str).collect();
    let ours = list.iter().filter(|one| !SWAGGER_UI.contains(&one.split(' ').next().unwrap_or_default()));
    let ours: Vec<_> = ours.collect();
    ensure!(ours.is_empty(), "{ours:#?}");
    Ok(())
}

/// The buttons that open something, in the order of the page; of those made alike, such as the many that explain a gain, one.
const OPENERS: &str = "const seen = new Set(); const openers = [...document.querySelectorAll( \
    '[aria-haspopup=dialog], [aria-haspopup=menu], [popovertarget]')].filter((button) => { \
        const like = button.id || button.className; \
        if (seen.has(like) || button.disabled || button.getClientRects().length === 0) return false; \
        seen.add(like); return true; });";

/// Opens each dialog by its button, and examines the page with it.
fn dialogs(page: &Page<'_>, what: &str) -> Result<()> {
    let count = page.run(&format!("{OPENERS} return openers.length"), &[])?.as_u64().context("no number")?;
    for n in 0..count {
        let press = "const button = openers[arguments[0]]; button?.click(); \
            return button ? (button.ariaLabel ?? button.textContent) : null";
        let name = page.run(&format!("{OPENERS} {press}"), &[json!(n)])?;
        if name.is_null() {
            break;
        }
        examine(page, &format!("{name} open, {what}"))?;
        page.run(
            "for (const dialog of document.querySelectorAll('dialog[open]')) dialog.close(); \
             for (const open of document.querySelectorAll(':popover-open')) open.hidePopover(); \
             document.dispatchEvent(new KeyboardEvent('keydown', { key: 'Escape', bubbles: true }))",
            &[],
        )?;
    }
    Ok(())
}

pub(super) fn examine(page: &Page<'_>, what: &str) -> Result<()> {
    let found = run(page)?;
    ensure!(found["passes"].as_u64().is_some_and(|passes| passes > 0), "{what}: axe did not run: {found}");
    let violations = found["violations"].as_array().context("no answer")?;
    let list: Vec<_> = violations.iter().filter_map(Value::as_str).collect();
    ensure!(list.is_empty(), "{what}: {} violations:\n{}", list.len(), list.join("\n"));
    Ok(())
}

fn run(page: &Page<'_>) -> Result<Value> {
    if page.run("return typeof axe", &[])? == "undefined" {
        let script = std::fs::read_to_string(axe().context("ADAPTARM_AXE names no file")?)?;
        // The browser's own protocol is not bound by the page's policy.
        page.devtools("Runtime.evaluate", &json!({ "expression": script, "returnByValue": true }))?;
    }
    page.run_async(AXE, &[json!({ "exclude": [] })])
}

pub fn axe_would_find_a_mistake(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Desktop)?;
    page.run("document.getElementById('study').removeAttribute('id')", &[])?;
    let found = run(&page)?;
    let named = |id: &str| {
        found["violations"]
            .as_array()
            .is_some_and(|all| all.iter().any(|one| one.as_str().is_some_and(|one| one.starts_with(id))))
    };
    ensure!(named("select-name"), "a choice without a name is not found: {found}");
    Ok(())
}

pub fn nothing_moves_for_who_asked_for_less_motion(bench: &Bench) -> Result<()> {
    let page = Page::blank(bench, Screen::Desktop)?;
    let reduce = json!({ "features": [{ "name": "prefers-reduced-motion", "value": "reduce" }] });
    page.devtools("Emulation.setEmulatedMedia", &reduce)?;
    page.before_each_page(
        "window.smooth = []; for (const name of ['scrollTo', 'scrollBy', 'scrollIntoView']) \
         for (const owner of [window, Element.prototype]) { const real = owner[name]; if (real) owner[name] = function (...all) { \
            if (all.some((one) => one?.behavior === 'smooth')) window.smooth.push(name); return real.apply(this, all); }; } \
         window.moved = new Set(); addEventListener('transitionrun', ({ target }) => moved.add(target.outerHTML.slice(0, 100)), true); \
         addEventListener('animationstart', ({ target }) => moved.add(target.outerHTML.slice(0, 100)), true)",
    )?;
    page.visit()?;
    page.ready()?;
    ensure!(page.run("return matchMedia('(prefers-reduced-motion: reduce)').matches", &[])? == true, "not emulated");
    // What scrolls, unfolds, changes colour or redraws.
    page.run(
        "for (const details of document.querySelectorAll('details')) details.open = true; \
         for (const tab of document.querySelectorAll('[role=tab]')) tab.click(); \
         for (const link of document.querySelectorAll('.jump-bar a, .skip-link')) link.click(); \
         document.getElementById('theme-toggle').click(); \
         const slider = document.querySelector('[role=tabpanel]:not([hidden]) input[type=range]'); \
         slider.focus(); slider.value = 20; slider.dispatchEvent(new Event('input', { bubbles: true }))",
        &[],
    )?;
    page.ready()?;
    let state = page.run(
        "return { smooth, moved: [...moved], scroll: getComputedStyle(document.documentElement).scrollBehavior, \
         running: document.getAnimations().filter(({ playState }) => playState === 'running').length, \
         declared: [...document.querySelectorAll('*')].filter((node) => { const style = getComputedStyle(node); \
            return style.transitionDuration.split(',').some((one) => parseFloat(one) > 0.01) \
                || style.animationName !== 'none' || style.scrollBehavior === 'smooth'; }) \
            .map((node) => node.outerHTML.slice(0, 100)) }",
        &[],
    )?;
    let still = json!({ "smooth": [], "moved": [], "scroll": "auto", "running": 0, "declared": [] });
    ensure!(state == still, "something moves: {state}");
    Ok(())
}
