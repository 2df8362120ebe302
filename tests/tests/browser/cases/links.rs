//! Links and files: settings that leave the page and come back, and what does not look like settings.

use crate::bench::Bench;
use crate::native::{edited, expect_study, field_value, gain_field, shown_hash, slide};
use crate::page::{Page, Screen};
use crate::pictures::settle;
use adaptarm_core::scenario::{Scenario, Scheme};
use anyhow::{Context, Result, ensure};
use serde_json::{Value, json};

const GAIN: &str = "/scheme/gains/k_v/0";
const DURATION: &str = "#setup [data-pointer=\"/integration/duration_s\"]";

fn hashes(page: &Page<'_>) -> Result<Vec<String>> {
    Scheme::ALL.into_iter().map(|scheme| shown_hash(page, scheme)).collect()
}

fn fragment(page: &Page<'_>) -> Result<String> {
    // The address follows once things have been quiet for a moment.
    settle(page)?;
    Ok(page.run("return location.hash", &[])?.as_str().context("no fragment")?.to_owned())
}

fn notices(page: &Page<'_>) -> Result<String> {
    Ok(page.run("return document.querySelector('#notices').textContent", &[])?.as_str().context("no text")?.to_owned())
}

/// Which schemes are shown.
fn shown(page: &Page<'_>) -> Result<Value> {
    page.run("return [...document.querySelectorAll('scheme-card input')].map((box) => box.checked)", &[])
}

pub fn a_link_opens_the_same_bits_in_a_fresh_profile(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Desktop)?;
    ensure!(fragment(&page)?.is_empty(), "the paper's study needs no fragment");
    slide(&page, &gain_field(Scheme::Proposed, GAIN), 33)?;
    slide(&page, DURATION, 12)?;
    page.click("scheme-card[data-scheme=tang_arteaga] input")?;
    let link = fragment(&page)?;
    ensure!(link.starts_with("#1.") && link.len() < 400, "the link is {link}");
    let (bits, cards) = (hashes(&page)?, shown(&page)?);

    let copied = "const done = arguments[0]; Object.defineProperty(navigator, 'clipboard', \
        { value: { writeText: async (text) => done(text) }, configurable: true }); document.querySelector('#copy-link').click()";
    let copied = page.run_async(copied, &[])?;
    ensure!(copied.as_str().is_some_and(|text| text.ends_with(&link)), "copied {copied}, the address has {link}");

    // Where the page may not copy, the link is there to be copied by hand.
    let by_hand = "const done = arguments[0]; Object.defineProperty(navigator, 'clipboard', { value: undefined, configurable: true }); \
        document.querySelector('#copy-link').click(); \
        setTimeout(() => { const field = document.querySelector('#link-text'); \
            done([field.value, field.selectionStart, field.selectionEnd]); }, 300)";
    let by_hand = page.run_async(by_hand, &[])?;
    ensure!(by_hand == json!([copied, 0, copied.as_str().map(str::len)]), "by hand: {by_hand}");

    let fresh = Page::blank(bench, Screen::Desktop)?;
    fresh.visit_path(&link)?;
    ensure!(hashes(&fresh)? == bits, "a fresh profile computes other bits");
    ensure!(shown(&fresh)? == cards, "a fresh profile shows other schemes");
    ensure!(fragment(&fresh)? == link, "the same settings have another link");
    ensure!(notices(&fresh)?.is_empty(), "a good link is met with: {}", notices(&fresh)?);
    fresh.click("#undo")?;
    fresh.ready()?;
    expect_study(&fresh, |_| Vec::new())?;
    // Everything as in the paper: no fragment; what was undone can still be had.
    ensure!(fragment(&fresh)?.is_empty(), "the paper's study still has a fragment");
    fresh.click("#redo")?;
    fresh.ready()?;
    ensure!(hashes(&fresh)? == bits, "redo does not open the link again");
    ensure!(fresh.log("browser")?.is_empty(), "the browser complains");
    Ok(())
}

pub fn back_and_reload_keep_their_settings(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Desktop)?;
    let gain = gain_field(Scheme::Proposed, GAIN);
    slide(&page, &gain, 33)?;
    let (first, first_bits) = (fragment(&page)?, hashes(&page)?);
    slide(&page, &gain, -20)?;
    let (second, second_bits) = (fragment(&page)?, hashes(&page)?);
    ensure!(first != second && first_bits != second_bits, "the link does not follow the settings");
    // Pasted into the same tab.
    page.run("location.hash = arguments[0]", &[json!(first)])?;
    settle(&page)?;
    page.ready()?;
    ensure!(hashes(&page)? == first_bits, "a link pasted into the same tab is not opened");
    page.run("history.back()", &[])?;
    settle(&page)?;
    page.ready()?;
    ensure!(hashes(&page)? == second_bits, "back does not bring the settings back");
    // Places on the page are not settings, and going to one leaves the link alone.
    page.click(".skip-link")?;
    ensure!(page.run("return document.activeElement.id", &[])? == "results", "the skip link does not lead anywhere");
    ensure!(fragment(&page)? == second, "a jump loses the link");
    page.reload()?;
    ensure!(hashes(&page)? == second_bits, "a reload changes the settings");
    // Reloaded before the address has caught up: what counts is what was set.
    slide(&page, &gain, 50)?;
    let newest = hashes(&page)?;
    page.reload()?;
    ensure!(hashes(&page)? == newest, "a reload right after a change loses it");
    // Elsewhere and back.
    page.run("location.href = 'api/docs'", &[])?;
    settle(&page)?;
    page.run("history.back()", &[])?;
    settle(&page)?;
    page.ready()?;
    ensure!(hashes(&page)? == newest, "coming back from another page changes the settings");
    Ok(())
}

/// `name fragment scenario-hash...` per line, the hashes in the order of `Scheme::ALL`.
const GOLDEN: &str = include_str!("links_v1.txt");

pub fn links_of_version_1_are_read_forever(bench: &Bench) -> Result<()> {
    let mut read = 0;
    for line in GOLDEN.lines().filter(|line| !line.is_empty() && !line.starts_with("//")) {
        let mut words = line.split_whitespace();
        let (name, link) = (words.next().context("no name")?, words.next().context("no link")?);
        let expected: Vec<&str> = words.collect();
        let page = Page::blank(bench, Screen::Desktop)?;
        page.visit_path(link)?;
        ensure!(notices(&page)?.is_empty(), "{name}: {}", notices(&page)?);
        for (scheme, expected) in Scheme::ALL.into_iter().zip(&expected) {
            let hash = page.run(
                "return document.querySelector(`scheme-card[data-scheme=${arguments[0]}]`).dataset.scenarioHash",
                &[json!(scheme.id())],
            )?;
            ensure!(hash == *expected, "{name}: {} has scenario {hash}, not {expected}", scheme.id());
        }
        ensure!(expected.len() == Scheme::ALL.len(), "{name} has {} hashes", expected.len());
        read += 1;
    }
    ensure!(read >= 5, "only {read} links were read");
    Ok(())
}

/// Packs text as a link's body, in the page.
const PACK: &str = "const [text, done] = arguments; \
    new Response(new Blob([text]).stream().pipeThrough(new CompressionStream('deflate-raw'))).arrayBuffer() \
    .then((bytes) => done(btoa(Array.from(new Uint8Array(bytes), (byte) => String.fromCharCode(byte)).join('')) \
    .replaceAll('+', '-').replaceAll('/', '_').replaceAll('=', '')))";

pub fn a_broken_link_changes_nothing(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Desktop)?;
    slide(&page, &gain_field(Scheme::Proposed, GAIN), 33)?;
    let (good, bits) = (fragment(&page)?, hashes(&page)?);
    let pack = |text: &str| -> Result<String> {
        let body = page.run_async(PACK, &[json!(text)])?;
        Ok(format!("#1.{}", body.as_str().context("not packed")?))
    };
    let patch = |change: &str| pack(&format!(r#"{{"each":{{"proposed":[{change}]}}}}"#));
    let bomb = format!(r#"{{"hashes":{{}},"all":[["/seed","{}"]]}}"#, " ".repeat(3_000_000));
    let cases = [
        ("#1.%%%".to_owned(), "damaged"),
        (good[..good.len() - 12].to_owned(), "damaged"),
        ("#1.".to_owned(), "damaged"),
        (pack("not JSON")?, "damaged"),
        (pack("[1, 2]")?, "damaged"),
        (pack(r#"{"colour":"red"}"#)?, "damaged"),
        (pack(r#"{"each":{"nobodys":[["/seed",1]]}}"#)?, "a scheme that this page does not know, “nobodys”"),
        (pack(r#"{"shown":["nobodys"]}"#)?, "a scheme that this page does not know"),
        (patch(r#"["/scheme/gains/k_v/0",-5]"#)?, "100000 N·m·s; -5 is not. Everything"),
        (patch(r#"["/scheme/kind","slotine_li"]"#)?, "unknown field `k_v`"),
        (
            patch(r#"["/scheme/gains/nothing/0",5]"#)?,
            "sets something that does not exist: there is no /scheme/gains/nothing/0",
        ),
        (patch(r#"["/__proto__/polluted",5]"#)?, "sets something that does not exist"),
        (pack(&bomb)?, "more than any settings need"),
        (format!("#1.{}", "A".repeat(100_000)), "more than any settings need"),
        ("#2.q1YqVrKKrgYA".to_owned(), "version 2, from a newer adaptarm"),
    ];
    for (n, (link, needle)) in cases.iter().enumerate() {
        let short = &link[..link.len().min(60)];
        // Half of them pasted, half of them opened anew.
        if n % 2 == 0 {
            page.run(
                "document.querySelector('#notices').replaceChildren(); location.hash = arguments[0]",
                &[json!(link)],
            )?;
            page.wait_for("return document.querySelector('#notices').textContent !== ''")?;
        } else {
            page.run("location.href = 'about:blank'", &[])?;
            page.visit_path(link)?;
        }
        page.ready()?;
        let said = notices(&page)?;
        ensure!(said.contains("The link was not opened") && said.contains(needle), "{short}: the page says {said:?}");
        ensure!(hashes(&page)? == bits, "{short} changed something");
        ensure!(fragment(&page)? == good, "{short}: the address is not the settings' again");
    }
    ensure!(page.run("return ({}).polluted === undefined", &[])? == true, "a link reached into the page");
    // A hash that differs is no refusal, but it is said.
    let other = pack(r#"{"all":[["/integration/duration_s",5]],"hashes":{"proposed":"00000000"}}"#)?;
    page.run("location.hash = arguments[0]", &[json!(other)])?;
    page.wait_for("return document.querySelector('#notices').textContent.includes('made by another version')")?;
    page.ready()?;
    ensure!(field_value(&page, DURATION)? == 5.0, "a link with another hash is not opened");
    let complaints = page.log("browser")?;
    ensure!(complaints.is_empty(), "the browser complains: {complaints:?}");
    Ok(())
}

/// Gives the page files, `[[name, text]]`: picked, or dropped.
const PICK: &str = "const [files, dropped] = arguments; const transfer = new DataTransfer(); \
    document.querySelector('#notices').replaceChildren(); \
    for (const [name, text] of files) transfer.items.add(new File([text], name)); \
    if (dropped) { document.querySelector('#gains').dispatchEvent( \
        new DragEvent('drop', { dataTransfer: transfer, bubbles: true, cancelable: true })); } \
    else { const picker = document.querySelector('#import-file'); picker.files = transfer.files; \
        picker.dispatchEvent(new Event('change')); }";

fn give(page: &Page<'_>, files: &[(&str, &str)], dropped: bool) -> Result<String> {
    page.run(PICK, &[json!(files), json!(dropped)])?;
    page.wait_for("return document.querySelector('#notices').textContent !== ''")?;
    page.ready()?;
    notices(page)
}

pub fn a_broken_file_changes_nothing(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Desktop)?;
    slide(&page, &gain_field(Scheme::Proposed, GAIN), 33)?;
    let bits = hashes(&page)?;
    let scenario = |scheme: &str| format!(r#"{{"format":"adaptarm.scenario/1","scheme":{scheme}}}"#);
    let study = |scenarios: &[String]| format!(r#"{{"scenarios":[{}]}}"#, scenarios.join(","));
    let plain = scenario(r#"{"kind":"proposed"}"#);
    let cases = [
        (r#"{"format":"adaptarm.scenario/1""#.to_owned(), "x.json is not JSON"),
        ("[]".to_owned(), "neither a scenario nor a study"),
        (plain.replace("/1", "/2"), "newer version (adaptarm.scenario/2)"),
        (r#"{"format":"adaptarm.scenario/3","robot":{"kind":"new"},"scheme":7}"#.to_owned(), "newer version"),
        (plain.replace("scenario", "report"), "format cannot be “adaptarm.report/1”"),
        (scenario(r#"{"kind":"proposed","gains":{"betta":1}}"#), "scheme.gains.betta: unknown field `betta`"),
        (scenario(r#"{"kind":"nobodys"}"#), "scheme.kind: unknown variant `nobodys`"),
        (scenario(r#"{"kind":"proposed","gains":{"k_v":[1,2,-3]}}"#), "100000 N·m·s; -3 is not. Everything"),
        (r#"{"scenarios":[]}"#.to_owned(), "not a list of scenarios"),
        (r#"{"scenarios":[null]}"#.to_owned(), "scenario 1"),
        (r#"{"scenarios":[],"label":"x"}"#.to_owned(), "not “label”"),
        (study(&[plain.clone(), plain.clone()]), "scenario 2 is the second one of proposed"),
        // All or none: the first would be good.
        (
            study(&[scenario(r#"{"kind":"slotine_li","gains":{"k_s":[1,1,1]}}"#), plain.replace("/1", "/2")]),
            "scenario 2",
        ),
        (format!("{plain}{}", " ".repeat(1_000_001)), "1.0 MB"),
    ];
    for (n, (text, needle)) in cases.iter().enumerate() {
        let said = give(&page, &[("x.json", text)], n % 2 == 1)?;
        let short: String = text.chars().take(80).collect();
        ensure!(said.contains("Not imported") && said.contains(needle), "{short}: the page says {said:?}");
        ensure!(hashes(&page)? == bits, "{short} changed something");
    }
    ensure!(page.log("browser")?.is_empty(), "the browser complains");
    Ok(())
}

/// Exports by the menu and returns `[file name, text]`.
const EXPORT: &str = "const [which, done] = arguments; const create = URL.createObjectURL; let blob = null; \
    URL.createObjectURL = (made) => { blob = made; return create(made); }; \
    const click = HTMLAnchorElement.prototype.click; \
    HTMLAnchorElement.prototype.click = function () { blob.text().then((text) => done([this.download, text])); }; \
    document.querySelector('[popovertarget=export-menu]').click(); \
    document.querySelector(`[data-export=${which}]`).click(); \
    HTMLAnchorElement.prototype.click = click; URL.createObjectURL = create";

pub fn exported_files_open_to_the_same_bits(bench: &Bench) -> Result<()> {
    let page = Page::open(bench, Screen::Desktop)?;
    let gain = gain_field(Scheme::Proposed, GAIN);
    slide(&page, &gain, 33)?;
    slide(&page, DURATION, 12)?;
    let value = field_value(&page, &gain)?;
    let bits = hashes(&page)?;
    let one = page.run_async(EXPORT, &[json!("proposed")])?;
    let all = page.run_async(EXPORT, &[json!("all")])?;
    let (one, all) = (one[1].as_str().context("no file")?, all[1].as_str().context("no file")?);
    let document: Value = serde_json::from_str(one)?;
    let expected = edited(Scheme::Proposed, &[(GAIN, value), ("/integration/duration_s", 7.0)])?;
    ensure!(Scenario::read(&document)?.hash() == Scenario::read(&expected)?.hash(), "the file is not the document");
    let study: Value = serde_json::from_str(all)?;
    ensure!(study["scenarios"].as_array().is_some_and(|list| list.len() == 3), "not a study: {all}");

    let other = Page::open(bench, Screen::Desktop)?;
    let said = give(&other, &[("one.json", one)], false)?;
    // The other schemes keep their 12 s.
    ensure!(said.contains("one.json opened: Proposed") && said.contains("different setups"), "the page says {said:?}");
    ensure!(shown_hash(&other, Scheme::Proposed)? == bits[0], "the file gives other bits");
    other.click("#undo")?;
    other.ready()?;
    expect_study(&other, |_| Vec::new())?;
    let said = give(&other, &[("all.json", all)], true)?;
    ensure!(said.contains("all.json opened") && !said.contains("different setups"), "the page says {said:?}");
    ensure!(hashes(&other)? == bits, "the study gives other bits");
    // What a file leaves out is as in the paper.
    let short = r#"{"format":"adaptarm.scenario/1","scheme":{"kind":"slotine_li"}}"#;
    give(&other, &[("short.json", short)], false)?;
    let native = crate::native::report(&edited(Scheme::SlotineLi, &[])?)?.trajectory_hash;
    ensure!(shown_hash(&other, Scheme::SlotineLi)? == native, "a short scenario is not filled in as the core does");
    Ok(())
}
