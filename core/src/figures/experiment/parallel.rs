//! Every point of a sweep as a line across its fields to the metric: the best tenth in dark blue above all others, so that one
//! sees where good values come from.

use super::super::path::{Frame, Path};
use super::super::style::{Dash, Line};
use super::super::surface::{Anchor, DrawError, Pen, Surface};
use super::chart::{NOTES, TICKS, cut, extent, say, short};
use super::{Sheet, names};
use crate::experiments::Results;
use crate::scalar::logarithm;

/// Most lines; of more, every second or third is drawn.
const MOST: usize = 1500;
/// Most fields; what is beyond is left out, and said.
const FIELDS: usize = 12;
/// More fields than this need two rows of names.
const CROWDED: usize = 6;
/// Of how many lines one counts as good.
const GOOD: usize = 10;

pub(super) fn draw<S: Surface>(pen: &mut Pen<'_, S>, sheet: &Sheet<'_>, results: &Results) -> Result<(), DrawError> {
    let experiment = sheet.experiment;
    let all = experiment.fields().len();
    let fields = all.min(FIELDS);
    let mut lines: Vec<Vec<f64>> = Vec::new();
    for row in results.rows() {
        let (Some(place), Some(value)) = (experiment.place(row.index), row.metrics[sheet.column]) else { continue };
        let mut line: Vec<_> = experiment.values(place.point).into_iter().take(fields).collect();
        line.push(value);
        lines.push(line);
    }
    if lines.is_empty() {
        return say(pen, &sheet.whole, "no run has this metric");
    }
    // The worst first, so that the best lie on top.
    lines.sort_by(|a, b| b[fields].total_cmp(&a[fields]));
    let good = lines.len() - lines.len().div_ceil(GOOD);
    let frame = Frame {
        left: pen.px(60.0),
        top: pen.px(44.0),
        right: sheet.whole.right - pen.px(70.0),
        bottom: sheet.whole.bottom - pen.px(74.0),
    };
    let ranges: Vec<_> = (0..=fields).map(|n| extent(lines.iter().map(|line| line[n])).unwrap_or((0.0, 1.0))).collect();
    let x = |n: usize| frame.left + (frame.right - frame.left) * n as f64 / fields as f64;
    let y = |n: usize, value: f64| frame.bottom + (frame.top - frame.bottom) * share(value, ranges[n]);
    let stride = lines.len().div_ceil(MOST);
    for (n, line) in lines.iter().enumerate().filter(|(n, _)| n % stride == 0 || *n >= good) {
        let style = if n >= good {
            Line { color: (0, 84, 166), dash: Dash(None), width: 1.3 }
        } else {
            Line { color: (196, 202, 210), dash: Dash(None), width: 0.8 }
        };
        for m in 0..fields {
            pen.curve(&Path::straight((x(m), y(m, line[m])), (x(m + 1), y(m + 1, line[m + 1]))), style)?;
        }
    }
    axes(pen, sheet, &frame, &ranges, &x)?;
    let more = if all > fields { format!("; {} more fields are not shown", all - fields) } else { String::new() };
    let metric = names::metric(sheet.metric);
    let note =
        format!("{} runs; dark: the tenth with the smallest {metric}; wide ranges by decades{more}", lines.len());
    pen.text(&note, (frame.left, sheet.whole.bottom - pen.px(14.0)), NOTES, pen.style.theme.ink(), Anchor::Left)
}

/// Where a value is in its range: by decades where that is wide and positive.
fn share(value: f64, (low, high): (f64, f64)) -> f64 {
    if high <= low {
        0.5
    } else if low > 0.0 && high >= 10.0 * low {
        logarithm(value / low) / logarithm(high / low)
    } else {
        (value - low) / (high - low)
    }
}

fn axes<S: Surface>(
    pen: &mut Pen<'_, S>,
    sheet: &Sheet<'_>,
    frame: &Frame,
    ranges: &[(f64, f64)],
    x: &dyn Fn(usize) -> f64,
) -> Result<(), DrawError> {
    let ink = pen.style.theme.ink();
    let fields = names::fields(sheet.experiment);
    let last = ranges.len() - 1;
    let room = (frame.right - frame.left) / last.max(1) as f64;
    for (n, (low, high)) in ranges.iter().enumerate() {
        let at = x(n).round();
        pen.hairline((at, frame.top), (at, frame.bottom), ink)?;
        pen.text(&short(*low), (at, frame.bottom + pen.px(4.0)), TICKS, ink, Anchor::Top)?;
        pen.text(&short(*high), (at, frame.top - pen.px(16.0)), TICKS, ink, Anchor::Top)?;
        // Where there are many, neighbours' names stand above and below each other in turn.
        let name = if n == last { sheet.metric.to_owned() } else { fields.get(n).cloned().unwrap_or_default() };
        let crowded = last > CROWDED;
        let name = cut(pen, &name, TICKS, if crowded { 1.9 } else { 0.95 } * room);
        let below = if crowded && n % 2 == 1 { 32.0 } else { 19.0 };
        pen.text(&name, (at, frame.bottom + pen.px(below)), TICKS, ink, Anchor::Top)?;
    }
    Ok(())
}
