//! The classroom's forms and addresses: what is sent and what is refused at its field, and the way out of places that are none.

use super::jobs::text;
use super::school::{School, api, change, place};
use crate::bench::Bench;
use crate::page::{Page, Screen};
use anyhow::{Result, ensure};
use serde_json::json;

/// Conditions that another page has changed since stay; what is no value is said at its field and not sent.
pub fn forms_send_what_was_changed(bench: &Bench) -> Result<()> {
    let school = School::open(bench)?;
    let School { teacher: page, server, assignment, .. } = &school;
    let path = format!("assignments/{assignment}");
    place(page, server, &format!("teach.html#assignment/{assignment}"))?;
    page.run("document.getElementById('conditions').open = true", &[])?;
    let (status, moved) = change(page, "PATCH", &path, &json!({ "deadline": "2088-01-01T00:00:30Z" }))?;
    ensure!(status == 200, "{moved}");
    for (field, typed) in [("attempts", "1e999"), ("attempts", "1.5"), ("points", "")] {
        page.run(
            "const [field, typed] = arguments; document.getElementById(field).value = typed",
            &[json!(format!("change-assignment-{field}")), json!(typed)],
        )?;
        page.click("#change-assignment > button")?;
        let invalid =
            text(page, "return document.querySelector('#change-assignment [aria-invalid=true]')?.id ?? 'nothing'")?;
        ensure!(invalid.ends_with(field), "{field} as {typed:?} is not refused, but {invalid}");
        page.run("document.getElementById(arguments[0]).value = '2'", &[json!(format!("change-assignment-{field}"))])?;
    }
    page.run("document.getElementById('change-assignment-points').value = '50'", &[])?;
    page.click("#change-assignment > button")?;
    page.wait_for("return document.querySelector('#conditions')?.open === false")?;
    let now = api(page, &path)?;
    ensure!(now["points"] == 50.0 && now["attempts"] == 2, "{now}");
    ensure!(now["deadline"] == "2088-01-01T00:00:30Z", "the other page's deadline is undone: {now}");
    Ok(())
}

/// An address that names nothing, and an invitation that a reload must not lose.
pub fn places_that_are_none_lead_back(bench: &Bench) -> Result<()> {
    let school = School::open(bench)?;
    let School { teacher: page, server, .. } = &school;
    page.go(&format!("{}/teach.html#class/none", server.url))?;
    page.wait_for("return document.querySelector('.failure a.back') !== null")?;
    page.click(".failure a.back")?;
    page.wait_for("return document.getElementById('new-class') !== null")?;
    place(page, server, "teach.html#%E0")?;
    ensure!(text(page, "return document.documentElement.dataset.state")? == "ready");
    let visitor = Page::blank(bench, Screen::Desktop)?;
    visitor.go(&format!("{}/teach.html#invitation=abcd", server.url))?;
    visitor.wait_for("return document.getElementById('redeem') !== null")?;
    visitor.run("location.reload()", &[])?;
    visitor.wait_for("return document.readyState === 'complete' && document.getElementById('redeem') !== null")?;
    visitor.click(".actions .quiet")?;
    visitor.wait_for("return document.getElementById('by-link') !== null")
}
