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

/// Brightness of a picture's cells, 0 to 255, row by row.
#[derive(Debug, Clone, PartialEq)]
pub struct Grid {
    rows: Vec<Vec<f64>>,
}

impl Grid {
    /// One line per row, whole numbers.
    pub fn to_csv(&self) -> String {
        let line = |row: &Vec<f64>| row.iter().map(|cell| format!("{cell:.0}")).collect::<Vec<_>>().join(",") + "\n";
        self.rows.iter().map(line).collect()
    }

    /// What [`Self::to_csv`] wrote.
    pub fn from_csv(text: &str) -> Result<Self> {
        let row = |line: &str| line.split(',').map(str::parse).collect::<Result<Vec<f64>, _>>();
        Ok(Self { rows: text.lines().map(row).collect::<Result<_, _>>()? })
    }

    /// The share of cells whose brightness differs by more than `tolerance`.
    pub fn share_beyond(&self, other: &Self, tolerance: f64) -> Result<f64> {
        let widths = |grid: &Self| grid.rows.iter().map(Vec::len).collect::<Vec<_>>();
        ensure!(widths(self) == widths(other), "the pictures have different sizes");
        let pairs = || self.rows.iter().flatten().zip(other.rows.iter().flatten());
        Ok(pairs().filter(|(a, b)| (**a - **b).abs() > tolerance).count() as f64 / pairs().count().max(1) as f64)
    }
}

/// What the window shows, as a grid of this many cells; each is the mean of its pixels' brightness.
pub fn grid(page: &Page<'_>, columns: u32, rows: u32) -> Result<Grid> {
    const MEANS: &str = "const [data, columns, rows, done] = arguments; const picture = new Image(); \
        picture.onerror = () => done(null); \
        picture.onload = () => { const canvas = document.createElement('canvas'); \
            const [width, height] = [picture.naturalWidth, picture.naturalHeight]; \
            canvas.width = width; canvas.height = height; \
            const context = canvas.getContext('2d', { willReadFrequently: true }); context.drawImage(picture, 0, 0); \
            const { data: pixels } = context.getImageData(0, 0, width, height); \
            const sums = Array.from({ length: rows }, () => new Array(columns).fill(0)); \
            const counts = Array.from({ length: rows }, () => new Array(columns).fill(0)); \
            for (let y = 0; y < height; y += 1) for (let x = 0; x < width; x += 1) { \
                const [row, column] = [Math.floor(y * rows / height), Math.floor(x * columns / width)]; \
                const at = 4 * (y * width + x); counts[row][column] += 1; \
                sums[row][column] += 0.2126 * pixels[at] + 0.7152 * pixels[at + 1] + 0.0722 * pixels[at + 2]; } \
            done(sums.map((row, r) => row.map((sum, c) => sum / counts[r][c]))); }; \
        picture.src = `data:image/png;base64,${data}`";
    let png = page.devtools("Page.captureScreenshot", &json!({}))?;
    let means = page.run_async(MEANS, &[png["data"].clone(), json!(columns), json!(rows)])?;
    let row =
        |row: &serde_json::Value| row.as_array()?.iter().map(serde_json::Value::as_f64).collect::<Option<Vec<_>>>();
    let rows = means.as_array().and_then(|all| all.iter().map(row).collect()).context("the picture cannot be read")?;
    Ok(Grid { rows })
}
