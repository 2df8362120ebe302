//! The page without a server, and a new version of it: whole, or not at all.

use crate::bench::Bench;
use crate::native::{expect_study, gain_field, shown_hash};
use crate::page::{Page, Screen};
use crate::relay::Relay;
use adaptarm_core::scenario::Scheme;
use adaptarm_tests::Server;
use anyhow::{Context, Result, ensure};
use serde_json::{Value, json};

const BETA: &str = "/scheme/gains/beta";
const SHEET: &str = "css/layout.css";
const SCRIPT: &str = "js/notice.js";

/// Waits until the service worker says that everything is kept.
fn kept(page: &Page<'_>) -> Result<String> {
    page.wait_for("return Boolean(document.documentElement.dataset.keptVersion)")?;
    let version = page.run("return document.documentElement.dataset.keptVersion", &[])?;
    Ok(version.as_str().context("no version")?.to_owned())
}

pub fn it_works_after_the_server_is_gone(bench: &Bench) -> Result<()> {
    let mut server = Server::start(&[])?;
    let page = Page::blank(bench, Screen::Desktop)?;
    page.go(&server.url)?;
    page.ready()?;
    page.run_async("const done = arguments[0]; fetch('api/v1/limits').then(() => done())", &[])?;
    kept(&page)?;
    let shown = page.run("return document.getElementById('offline-state').textContent", &[])?;
    ensure!(shown == "Ready to work offline.", "it is not said: {shown}");
    let held = page.run_async(
        "const done = arguments[0]; (async () => { \
            const list = await (await fetch('files.json')).json(); \
            const names = await caches.keys(); const found = []; \
            for (const name of names) for (const { url } of await (await caches.open(name)).keys()) found.push(url); \
            const wanted = Object.keys(list.files).map((path) => new URL(path, location.href).href); \
            done({ caches: names.length, files: wanted.length, \
                missing: wanted.filter((url) => !found.includes(url)), \
                more: found.filter((url) => !wanted.includes(url)).map((url) => new URL(url).pathname) }); })()",
        &[],
    )?;
    ensure!(held["missing"] == json!([]), "not kept: {held}");
    ensure!(held["more"] == json!(["/files.json"]) && held["caches"] == 1, "kept without being a file of it: {held}");

    page.type_into(&format!("{} .exact input", gain_field(Scheme::Proposed, BETA)), "3.25")?;
    page.ready()?;
    let before = shown_hash(&page, Scheme::Proposed)?;
    server.kill()?;
    page.reload()?;
    let controlled = page.run("return navigator.serviceWorker.controller !== null", &[])?;
    ensure!(controlled == true, "the page came from somewhere else");
    ensure!(shown_hash(&page, Scheme::Proposed)? == before, "the settings are gone");
    expect_study(&page, |scheme| match scheme {
        Scheme::Proposed => vec![(BETA.to_owned(), 3.25)],
        _ => Vec::new(),
    })?;
    // Another language's texts are files of the page too.
    page.go(&format!("{}/?lang=es", server.url))?;
    page.ready()?;
    ensure!(page.run("return document.documentElement.lang", &[])? == "es", "another language needs the server");
    Ok(())
}

pub fn a_new_version_replaces_the_old_one_whole(bench: &Bench) -> Result<()> {
    let relay = Relay::start(&bench.server.url)?;
    let page = Page::blank(bench, Screen::Desktop)?;
    page.go(&relay.url)?;
    page.ready()?;
    let first = kept(&page)?;
    ensure!(marks(&page)? == json!(["", ""]), "the first version is marked already");

    // While the page is open, a new version appears on the server.
    let second = publish(&page, &relay, "two", true)?;
    page.run("document.dispatchEvent(new Event('visibilitychange'))", &[])?;
    page.wait_for("return document.querySelector('.notice.info')?.textContent.includes('new version') === true")?;
    ensure!(marks(&page)? == json!(["", ""]), "an open page gets files of another version");
    page.run("document.documentElement.dataset.state = 'leaving'", &[])?;
    page.click(".notice.info button")?;
    page.ready()?;
    ensure!(marks(&page)? == json!(["two", "two"]), "after the reload: {}", marks(&page)?);
    ensure!(kept(&page)? == second && first != second, "the old version is kept");

    // Without any notice: a plain reload is never stale.
    let third = publish(&page, &relay, "three", true)?;
    page.reload()?;
    ensure!(marks(&page)? == json!(["three", "three"]), "a reload is stale: {}", marks(&page)?);
    ensure!(kept(&page)? == third, "the old version is kept");

    // In the middle of an update the list names what the files are not yet.
    publish(&page, &relay, "four", false)?;
    page.reload()?;
    ensure!(marks(&page)? == json!(["three", "three"]), "half a version is shown: {}", marks(&page)?);
    let caches = page.run_async(
        "const done = arguments[0]; (async () => { const complete = []; for (const name of await caches.keys()) \
         if (await (await caches.open(name)).match('files.json')) complete.push(name); done(complete.length); })()",
        &[],
    )?;
    ensure!(caches == 1, "{caches} versions are kept");
    Ok(())
}

pub fn another_tab_follows_to_the_new_version(bench: &Bench) -> Result<()> {
    let relay = Relay::start(&bench.server.url)?;
    let page = Page::blank(bench, Screen::Desktop)?;
    page.go(&relay.url)?;
    page.ready()?;
    kept(&page)?;
    let first = page.tab()?;
    page.open_tab(&relay.url)?;
    page.ready()?;
    publish(&page, &relay, "two", true)?;
    page.reload()?;
    ensure!(marks(&page)? == json!(["two", "two"]), "a reload is stale beside another tab");
    page.switch_to(&first)?;
    page.wait_for("return getComputedStyle(document.documentElement).getPropertyValue('--mark').trim() === 'two'")?;
    page.ready()?;
    ensure!(marks(&page)? == json!(["two", "two"]), "the other tab mixes two versions: {}", marks(&page)?);
    Ok(())
}

pub fn it_can_be_installed(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Desktop)?;
    kept(&page)?;
    let manifest = page.devtools("Page.getAppManifest", &json!({}))?;
    ensure!(manifest["errors"] == json!([]), "the manifest has errors: {}", manifest["errors"]);
    let errors = page.devtools("Page.getInstallabilityErrors", &json!({}))?;
    let errors: Vec<&Value> = errors["installabilityErrors"].as_array().context("no answer")?.iter().collect();
    ensure!(errors.is_empty(), "the browser would not install it: {errors:?}");
    Ok(())
}

/// The marks of the style sheet in use and of the script as the page would get it now.
fn marks(page: &Page<'_>) -> Result<Value> {
    page.run_async(
        "const [script, done] = arguments; fetch(script).then((answer) => answer.text()).then((text) => done([ \
            getComputedStyle(document.documentElement).getPropertyValue('--mark').trim(), \
            text.match(/mark (\\w+)/)?.[1] ?? '']))",
        &[json!(SCRIPT)],
    )
}

/// Puts another version on the server, with a mark in two of its files; returns its name. Unless `whole`, only its list is
/// there yet, and one file of the two.
fn publish(page: &Page<'_>, relay: &Relay, mark: &str, whole: bool) -> Result<String> {
    relay.replace([]);
    let made = page.run_async(
        "const [mark, sheet, script, done] = arguments; (async () => { \
            const text = async (path) => (await fetch(path, { cache: 'reload' })).text(); \
            const hash = async (text) => [...new Uint8Array(await crypto.subtle.digest('SHA-256', \
                new TextEncoder().encode(text)))].map((byte) => byte.toString(16).padStart(2, '0')).join(''); \
            const plain = (text) => text.replace(/\\n[^\\n]*mark [^\\n]*\\n$/, ''); \
            const css = `${plain(await text(sheet))}\\n/* mark ${mark} */ html { --mark: ${mark} }\\n`; \
            const js = `${plain(await text(script))}\\n// mark ${mark}\\n`; \
            const list = await (await fetch('files.json', { cache: 'reload' })).json(); \
            list.files[sheet] = await hash(css); list.files[script] = await hash(js); list.version = await hash(mark); \
            done({ css, js, list: JSON.stringify(list), version: list.version }); })()",
        &[json!(mark), json!(SHEET), json!(SCRIPT)],
    )?;
    let text = |name: &str| made[name].as_str().map(str::to_owned).with_context(|| format!("no {name}"));
    let mut contents = vec![("files.json", text("list")?), (SHEET, text("css")?)];
    if whole {
        contents.push((SCRIPT, text("js")?));
    }
    relay.replace(contents);
    text("version")
}
