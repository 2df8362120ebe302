//! Screenshots of the whole page, and canvases as data.

use crate::bench::screenshots;
use crate::page::Page;
use anyhow::{Context, Result, ensure};
use serde_json::json;

/// Saves the whole page as `NAME.png`, with every figure drawn. The window stays that high.
pub fn save_whole(page: &Page<'_>, name: &str, width: u32, scale: u32) -> Result<()> {
    let height = page.run("return document.documentElement.scrollHeight", &[])?;
    let metrics = json!({ "width": width, "height": height, "deviceScaleFactor": scale, "mobile": false });
    page.devtools("Emulation.setDeviceMetricsOverride", &metrics)?;
    settle(page)?;
    save(page, name)
}

/// Waits until scrolling has ended and the figures that came into view are drawn.
pub fn settle(page: &Page<'_>) -> Result<()> {
    page.run_async("const done = arguments[0]; setTimeout(() => requestAnimationFrame(() => done()), 600)", &[])?;
    Ok(())
}

/// Saves what the window shows as `NAME.png`.
pub fn save(page: &Page<'_>, name: &str) -> Result<()> {
    let png = page.devtools("Page.captureScreenshot", &json!({}))?;
    let base64 = png["data"].as_str().context("no picture")?;
    let bytes = decode_base64(base64).context("the picture is not base64")?;
    ensure!(bytes.len() > 10_000, "{name} is nearly empty: {} bytes", bytes.len());
    Ok(std::fs::write(screenshots()?.join(format!("{name}.png")), bytes)?)
}

/// A figure's canvas among the results as a data URL.
pub fn canvas(page: &Page<'_>, figure: &str) -> Result<String> {
    picture(page, &format!("#results [data-figure={figure}] canvas"))
}

/// The canvas that a selector finds, as a data URL.
pub fn picture(page: &Page<'_>, canvas: &str) -> Result<String> {
    let script = "return document.querySelector(arguments[0]).toDataURL()";
    Ok(page.run(script, &[json!(canvas)])?.as_str().context("no picture")?.to_owned())
}

fn decode_base64(text: &str) -> Option<Vec<u8>> {
    let value = |byte: u8| match byte {
        b'A'..=b'Z' => Some(u32::from(byte - b'A')),
        b'a'..=b'z' => Some(u32::from(byte - b'a') + 26),
        b'0'..=b'9' => Some(u32::from(byte - b'0') + 52),
        b'+' => Some(62),
        b'/' => Some(63),
        _ => None,
    };
    let mut bytes = Vec::with_capacity(text.len() / 4 * 3);
    for group in text.trim_end_matches('=').as_bytes().chunks(4) {
        let bits = group.iter().try_fold(0, |bits, byte| Some(bits << 6 | value(*byte)?))?;
        let bits: u32 = bits << (6 * (4 - group.len()));
        bytes.extend_from_slice(&bits.to_be_bytes()[1..group.len()]);
    }
    Some(bytes)
}
