//! How a tuning gets on: the best objective of each generation and the best so far, beside that of the start; and below how
//! wide it searches. Restarts are dashed lines.

use super::super::legend::draw_legend;
use super::super::path::{Frame, Path};
use super::super::style::{Dash, Line};
use super::super::surface::{Anchor, DrawError, Pen, Surface};
use super::Sheet;
use super::chart::{LABELS, across, extent, padded, say, upwards};
use crate::experiments::TuningSummary;

/// An objective above so many times the start's is the price of runs that fail: it would flatten all others.
const HIGHEST: f64 = 3.0;

pub(super) fn draw<S: Surface>(
    pen: &mut Pen<'_, S>,
    sheet: &Sheet<'_>,
    summary: &TuningSummary,
) -> Result<(), DrawError> {
    let Some(start) = summary.start.as_ref().filter(|_| !summary.history.is_empty()) else {
        return say(pen, &sheet.whole, "no generation has been tried yet");
    };
    let theme = pen.style.theme;
    let best_line = Line { color: (0, 84, 166), dash: Dash(None), width: 2.2 };
    let generation_line = Line { color: (196, 74, 0), dash: Dash(None), width: 1.2 };
    let start_line = Line::of_reference(theme);
    let entries = [
        ("best so far", best_line),
        ("best of the generation", generation_line),
        ("start", start_line),
        ("restart", Line::of_limit(theme)),
    ];
    let shown =
        if summary.history.iter().any(|generation| generation.restart > 0) { &entries[..] } else { &entries[..3] };
    let top = draw_legend(pen, sheet.whole.right, shown)?;
    let (left, right) = (pen.px(84.0), sheet.whole.right - pen.px(24.0));
    let middle = top + 0.62 * (sheet.whole.bottom - top);
    let upper = Frame { left, top: top + pen.px(6.0), right, bottom: (middle - pen.px(10.0)).round() };
    let lower = Frame { left, top: middle.round(), right, bottom: sheet.whole.bottom - pen.px(46.0) };

    let mut tried = 1.0;
    let mut so_far = start.objective;
    let (mut generations, mut best) = (Vec::new(), vec![(1.0, so_far)]);
    for generation in &summary.history {
        tried += generation.population as f64;
        so_far = so_far.min(generation.best);
        generations.push((tried, generation.best));
        best.push((tried, so_far));
    }
    let ceiling = HIGHEST * start.objective.abs();
    let within = generations.iter().chain(&best).map(|(_, value)| *value).filter(|value| *value <= ceiling);
    let Some(range) = padded(within.chain([start.objective])) else {
        return say(pen, &sheet.whole, "no objective is a number");
    };
    let x_range = (0.0, 1.02 * tried);
    let y = upwards(pen, &upper, range, "objective")?;
    let x = across(pen, &lower, x_range, "candidates tried")?;
    let sigmas = || summary.history.iter().map(|generation| generation.sigma);
    let widest = extent(sigmas()).map_or(1.0, |(_, high)| high);
    let wide = upwards(pen, &lower, (0.0, 1.1 * widest), "σ [ranges]")?;
    pen.hairline((upper.left, upper.bottom), (upper.right, upper.bottom), theme.ink())?;

    for pair in summary.history.windows(2).zip(&generations).filter(|(pair, _)| pair[0].restart != pair[1].restart) {
        let at = x.pixel(pair.1.0);
        for frame in [&upper, &lower] {
            pen.curve(&Path::straight((at, frame.top), (at, frame.bottom)), Line::of_limit(theme))?;
        }
    }
    let at = |(n, value): (f64, f64)| (x.pixel(n), y.pixel(value));
    pen.curve(&Path::straight(at((0.0, start.objective)), at((x_range.1, start.objective))), start_line)?;
    trace(pen, &generations.iter().copied().map(at).collect::<Vec<_>>(), &upper, generation_line)?;
    trace(pen, &best.iter().copied().map(at).collect::<Vec<_>>(), &upper, best_line)?;
    let widths: Vec<_> =
        generations.iter().zip(sigmas()).map(|((n, _), sigma)| (x.pixel(*n), wide.pixel(sigma))).collect();
    trace(pen, &widths, &lower, Line { color: (0, 122, 94), dash: Dash(None), width: 1.6 })?;
    if let Some(validation) = &summary.validation {
        let text =
            format!("on plants not used in the search: start {:.4}, best {:.4}", validation.start, validation.best);
        let place = (right - pen.text_width(&text, LABELS) - pen.px(8.0), upper.top + pen.px(36.0));
        pen.text(&text, place, LABELS, theme.ink(), Anchor::Left)?;
    }
    Ok(())
}

/// A line through points, as far as it is within the frame; one point alone is a short dash.
fn trace<S: Surface>(pen: &mut Pen<'_, S>, points: &[(f64, f64)], frame: &Frame, line: Line) -> Result<(), DrawError> {
    let mut path = Path::default();
    if let [(x, y)] = *points {
        path.add_clipped(&[(x - pen.px(4.0), y), (x + pen.px(4.0), y)], frame);
    } else {
        path.add_clipped(points, frame);
    }
    pen.curve(&path, line)
}
