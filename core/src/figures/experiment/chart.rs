//! Parts that these figures share: axes with round ticks along one side, row labels, lines of text.

use super::super::axes::Axis;
use super::super::path::Frame;
use super::super::surface::{Anchor, DrawError, Pen, Surface};
use super::super::ticks::ticks;
use super::super::view::AxisKind;

/// Sizes of letters, layout pixels: of ticks, of labels, of what is said below.
pub(super) const TICKS: f64 = 11.0;
pub(super) const LABELS: f64 = 12.5;
pub(super) const NOTES: f64 = 11.0;

/// Smallest and largest finite number, with a margin; `None` of none.
pub(super) fn padded(values: impl IntoIterator<Item = f64>) -> Option<(f64, f64)> {
    let (low, high) = extent(values)?;
    let margin = if high > low { 0.05 * (high - low) } else { 0.1 * high.abs().max(1e-3) };
    Some((low - margin, high + margin))
}

/// Smallest and largest finite number.
pub(super) fn extent(values: impl IntoIterator<Item = f64>) -> Option<(f64, f64)> {
    let wider = |found: Option<(f64, f64)>, x: f64| Some(found.map_or((x, x), |(low, high)| (low.min(x), high.max(x))));
    values.into_iter().filter(|x| x.is_finite()).fold(None, wider)
}

/// An axis along the bottom of a frame, with a grid, ticks and a label.
pub(super) fn across<S: Surface>(
    pen: &mut Pen<'_, S>,
    frame: &Frame,
    range: (f64, f64),
    label: &str,
) -> Result<Axis, DrawError> {
    let axis = Axis::new(AxisKind::Linear, range, frame.left, frame.right);
    let (ink, grid) = (pen.style.theme.ink(), pen.style.theme.grid());
    let tick = pen.px(4.0);
    for (value, text) in ticks(&axis, 8, pen.style.scale) {
        let at = axis.pixel(value);
        pen.hairline((at, frame.top), (at, frame.bottom), grid)?;
        pen.hairline((at, frame.bottom), (at, frame.bottom + tick), ink)?;
        pen.text(&text, (at, frame.bottom + tick + pen.px(2.0)), TICKS, ink, Anchor::Top)?;
    }
    pen.hairline((frame.left, frame.bottom), (frame.right, frame.bottom), ink)?;
    let middle = f64::midpoint(frame.left, frame.right);
    pen.text(label, (middle, frame.bottom + pen.px(22.0)), LABELS, ink, Anchor::Top)?;
    Ok(axis)
}

/// An axis along the left of a frame, with a grid, ticks and a label.
pub(super) fn upwards<S: Surface>(
    pen: &mut Pen<'_, S>,
    frame: &Frame,
    range: (f64, f64),
    label: &str,
) -> Result<Axis, DrawError> {
    let axis = Axis::new(AxisKind::Linear, range, frame.bottom, frame.top);
    let (ink, grid) = (pen.style.theme.ink(), pen.style.theme.grid());
    let tick = pen.px(4.0);
    for (value, text) in ticks(&axis, 6, pen.style.scale) {
        let at = axis.pixel(value);
        pen.hairline((frame.left, at), (frame.right, at), grid)?;
        pen.hairline((frame.left - tick, at), (frame.left, at), ink)?;
        pen.text(&text, (frame.left - tick - pen.px(3.0), at), TICKS, ink, Anchor::Right)?;
    }
    pen.hairline((frame.left, frame.top), (frame.left, frame.bottom), ink)?;
    let middle = f64::midpoint(frame.top, frame.bottom);
    pen.text(label, (frame.left - pen.px(66.0), middle), LABELS, ink, Anchor::TurnedTop)?;
    Ok(axis)
}

/// A text cut to a width, device pixels.
pub(super) fn cut<S: Surface>(pen: &Pen<'_, S>, text: &str, size: f64, width: f64) -> String {
    if pen.text_width(text, size) <= width {
        return text.to_owned();
    }
    let mut short: Vec<char> = text.chars().collect();
    while short.len() > 1 && pen.text_width(&short.iter().collect::<String>(), size) + pen.text_width("…", size) > width
    {
        short.pop();
    }
    short.into_iter().chain(['…']).collect()
}

/// What a figure has to say instead of numbers.
pub(super) fn say<S: Surface>(pen: &mut Pen<'_, S>, frame: &Frame, what: &str) -> Result<(), DrawError> {
    let at = (f64::midpoint(frame.left, frame.right), f64::midpoint(frame.top, frame.bottom));
    pen.text(what, at, LABELS, pen.style.theme.ink(), Anchor::Top)
}

/// A number of few digits.
pub(super) fn short(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let decade = value.abs().log10().floor();
    if !(-4.0..6.0).contains(&decade) {
        return format!("{value:.2e}");
    }
    let decimals = (2.0 - decade).max(0.0) as usize;
    let text = format!("{value:.decimals$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_right() {
        let texts = [0.0, 1.0, 0.085_61, 123.46, 1e-7, 40.0, -2.5, 99_999.0].map(short);
        assert_eq!(texts, ["0", "1", "0.0856", "123", "1.00e-7", "40", "-2.5", "99999"]);
    }

    #[test]
    fn ranges_hold_all_that_is_finite() {
        assert_eq!(padded([f64::NAN, f64::INFINITY]), None);
        assert_eq!(extent([2.0, f64::NAN, -1.0]), Some((-1.0, 2.0)));
        let (low, high) = padded([0.0]).unwrap();
        assert!(low < 0.0 && high > 0.0);
    }
}
