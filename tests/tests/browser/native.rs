//! What the page should show: the same scenarios run by the core in this process, and the page's state read from its DOM.

use crate::page::Page;
use adaptarm_core::scenario::{Report, Scenario, Scheme};
use anyhow::{Context, Result, ensure};
use serde_json::{Value, json};

/// The paper's document of a scheme with `edits` (JSON pointer, value) made to it.
pub fn edited(scheme: Scheme, edits: &[(&str, f64)]) -> Result<Value> {
    let mut document = json!(Scenario::new(scheme.paper())?.document());
    for (pointer, value) in edits {
        *document.pointer_mut(pointer).with_context(|| format!("no {pointer}"))? = json!(value);
    }
    Ok(document)
}

/// The report on a document.
pub fn report(document: &Value) -> Result<Report> {
    Ok(Scenario::read(document)?.run().report)
}

/// The trajectory hash that the page shows for a scheme.
pub fn shown_hash(page: &Page<'_>, scheme: Scheme) -> Result<String> {
    let hash = page.run(
        "return document.querySelector(`scheme-card[data-scheme=${arguments[0]}]`).dataset.trajectoryHash",
        &[json!(scheme.id())],
    )?;
    Ok(hash.as_str().context("the page shows no trajectory hash")?.to_owned())
}

/// Checks that the page shows what the core computes here for each scheme with `edits`, as far as it has their fields.
pub fn expect_study(page: &Page<'_>, edits: impl Fn(Scheme) -> Vec<(String, f64)>) -> Result<()> {
    for scheme in Scheme::ALL {
        let edits = edits(scheme);
        let edits: Vec<_> = edits.iter().map(|(pointer, value)| (pointer.as_str(), *value)).collect();
        let expected = report(&edited(scheme, &edits)?)?.trajectory_hash;
        let shown = shown_hash(page, scheme)?;
        ensure!(
            shown == expected,
            "{}: the page shows {shown}, the core computes {expected} for {edits:?}",
            scheme.id()
        );
    }
    Ok(())
}

/// The exact value in the field of a scheme's gain, or of the setup.
pub fn field_value(page: &Page<'_>, field: &str) -> Result<f64> {
    let text = page.run("return document.querySelector(arguments[0] + ' .exact input').value", &[json!(field)])?;
    Ok(text.as_str().context("no such field")?.parse()?)
}

/// Selector of the field of a scheme's gain.
pub fn gain_field(scheme: Scheme, pointer: &str) -> String {
    format!("[role=tabpanel][data-scheme={}] number-field[data-pointer=\"{pointer}\"]", scheme.id())
}

/// Puts a field's slider at a position, as a hand does that lets go at once.
pub fn slide(page: &Page<'_>, field: &str, position: i32) -> Result<()> {
    page.run(
        "const slider = document.querySelector(arguments[0] + ' input[type=range]'); slider.value = arguments[1]; \
         slider.dispatchEvent(new Event('input', { bubbles: true }))",
        &[json!(field), json!(position)],
    )?;
    page.ready()
}
