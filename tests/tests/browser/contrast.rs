//! Contrast of two colours as WCAG 2 defines it.

use anyhow::{Context, Result, ensure};

/// Contrast ratio of two colours written `#rrggbb`, 1 to 21.
pub fn ratio(a: &str, b: &str) -> Result<f64> {
    let (a, b) = (luminance(a)?, luminance(b)?);
    Ok((a.max(b) + 0.05) / (a.min(b) + 0.05))
}

/// Relative luminance.
fn luminance(color: &str) -> Result<f64> {
    let digits = color.trim().strip_prefix('#').with_context(|| format!("{color:?} is not a hexadecimal colour"))?;
    ensure!(digits.len() == 6, "{color:?} is not a colour of six digits");
    let channel = |at: usize| -> Result<f64> {
        let value = f64::from(u8::from_str_radix(&digits[at..at + 2], 16)?) / 255.0;
        Ok(if value <= 0.040_45 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) })
    };
    Ok(0.2126 * channel(0)? + 0.7152 * channel(2)? + 0.0722 * channel(4)?)
}
