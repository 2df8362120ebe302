//! A metric over the two axes of a grid: a cell per point, a map per base, one scale of colours for all. The best cell has a
//! frame; runs without a number are crossed out.

use super::super::path::{Frame, Path};
use super::super::style::{Dash, Line};
use super::super::surface::{Anchor, DrawError, Pen, Surface};
use super::chart::{LABELS, NOTES, TICKS, cut, extent, say, short};
use super::shades::{is_dark, shade};
use super::{Sheet, names};
use crate::experiments::{Experiment, Results};

/// Most maps below each other; what is beyond is left out, and said.
const MOST: usize = 4;
/// Height of a map and what is around it, layout pixels.
const MAP: u32 = 330;
/// Room for the scale on the right, layout pixels.
const SCALE: f64 = 110.0;

/// A cell's numbers: places on the two axes and the metric, if there is one.
type Cell = ([f64; 2], Option<f64>);

/// Height of the figure, layout pixels.
pub(super) fn height(experiment: &Experiment) -> u32 {
    MAP * experiment.base_names().len().clamp(1, MOST) as u32 + 24
}

pub(super) fn draw<S: Surface>(pen: &mut Pen<'_, S>, sheet: &Sheet<'_>, results: &Results) -> Result<(), DrawError> {
    let experiment = sheet.experiment;
    let count = experiment.base_names().len();
    let mut maps = vec![Vec::new(); count];
    for row in results.rows() {
        let Some(place) = experiment.place(row.index) else { continue };
        if let [x, y] = experiment.values(place.point)[..] {
            maps[place.base].push(([x, y], row.metrics[sheet.column]));
        }
    }
    let values = || maps.iter().take(MOST).flatten().filter_map(|(_, value): &Cell| *value);
    let Some(range) = extent(values()) else { return say(pen, &sheet.whole, "no run has this metric") };
    let step = (sheet.whole.bottom - pen.px(24.0)) / count.clamp(1, MOST) as f64;
    for (n, (name, cells)) in experiment.base_names().zip(&maps).take(MOST).enumerate() {
        let top = step * n as f64;
        let frame = Frame {
            left: pen.px(84.0),
            top: (top + pen.px(28.0)).round(),
            right: sheet.whole.right - pen.px(SCALE),
            bottom: (top + step - pen.px(44.0)).round(),
        };
        let heading = cut(pen, name, LABELS, frame.right - frame.left);
        pen.text(&heading, (frame.left, frame.top - pen.px(14.0)), LABELS, pen.style.theme.ink(), Anchor::Left)?;
        map(pen, sheet, &frame, cells, range)?;
    }
    scale(pen, sheet, range)?;
    let left_out = count.saturating_sub(MOST);
    let more = if left_out > 0 { format!("; {left_out} more bases are not shown") } else { String::new() };
    let note =
        format!("framed: the smallest of each base; crossed out: no number (diverged, refused or not made){more}");
    let at = (pen.px(84.0), sheet.whole.bottom - pen.px(12.0));
    pen.text(&note, at, NOTES, pen.style.theme.ink(), Anchor::Left)
}

/// The values of an axis, each once, in order.
fn steps(cells: &[Cell], axis: usize) -> Vec<f64> {
    let mut values: Vec<_> = cells.iter().map(|(at, _)| at[axis]).collect();
    values.sort_by(f64::total_cmp);
    values.dedup();
    values
}

fn share(value: f64, (low, high): (f64, f64)) -> f64 {
    if high > low { (value - low) / (high - low) } else { 0.0 }
}

fn map<S: Surface>(
    pen: &mut Pen<'_, S>,
    sheet: &Sheet<'_>,
    frame: &Frame,
    cells: &[Cell],
    range: (f64, f64),
) -> Result<(), DrawError> {
    let (xs, ys) = (steps(cells, 0), steps(cells, 1));
    if xs.is_empty() {
        return say(pen, frame, "no run has been made yet");
    }
    let ink = pen.style.theme.ink();
    // On whole layout pixels, or neighbours would have seams.
    let grain = pen.px(1.0).max(1.0);
    let edge =
        |from: f64, to: f64, n: usize, of: usize| ((from + (to - from) * n as f64 / of as f64) / grain).round() * grain;
    let place = |(at, _): &Cell| {
        let column = xs.partition_point(|x| *x < at[0]);
        let row = ys.partition_point(|y| *y < at[1]);
        Frame {
            left: edge(frame.left, frame.right, column, xs.len()),
            right: edge(frame.left, frame.right, column + 1, xs.len()),
            top: edge(frame.bottom, frame.top, row + 1, ys.len()),
            bottom: edge(frame.bottom, frame.top, row, ys.len()),
        }
    };
    let best = extent(cells.iter().filter_map(|(_, value)| *value)).map(|(least, _)| least);
    for cell in cells {
        let area = place(cell);
        match cell.1 {
            Some(value) => {
                let share = share(value, range);
                pen.fill(area, shade(share))?;
                let text = short(value);
                let room = area.right - area.left > pen.text_width(&text, TICKS) + pen.px(4.0);
                if room && area.bottom - area.top > pen.px(1.3 * TICKS) {
                    let color = if is_dark(share) { (255, 255, 255) } else { (32, 36, 42) };
                    let middle = f64::midpoint(area.top, area.bottom) - pen.px(0.5 * TICKS);
                    pen.text(&text, (f64::midpoint(area.left, area.right), middle), TICKS, color, Anchor::Top)?;
                }
            }
            None => cross(pen, &area)?,
        }
    }
    for cell in cells.iter().filter(|(_, value)| value.is_some() && *value == best) {
        outline(pen, &place(cell))?;
    }
    let names = names::fields(sheet.experiment);
    let name = |n: usize| names.get(n).map_or("", String::as_str);
    let every = |count: usize, length: f64, each: f64| (count as f64 * pen.px(each) / length).ceil().max(1.0) as usize;
    let (across, up) =
        (every(xs.len(), frame.right - frame.left, 56.0), every(ys.len(), frame.bottom - frame.top, 15.0));
    for (n, x) in xs.iter().enumerate().step_by(across) {
        let at =
            f64::midpoint(edge(frame.left, frame.right, n, xs.len()), edge(frame.left, frame.right, n + 1, xs.len()));
        pen.text(&short(*x), (at, frame.bottom + pen.px(4.0)), TICKS, ink, Anchor::Top)?;
    }
    for (n, y) in ys.iter().enumerate().step_by(up) {
        let at =
            f64::midpoint(edge(frame.bottom, frame.top, n, ys.len()), edge(frame.bottom, frame.top, n + 1, ys.len()));
        pen.text(&short(*y), (frame.left - pen.px(5.0), at), TICKS, ink, Anchor::Right)?;
    }
    let middle = f64::midpoint(frame.left, frame.right);
    pen.text(name(0), (middle, frame.bottom + pen.px(20.0)), LABELS, ink, Anchor::Top)?;
    let middle = f64::midpoint(frame.top, frame.bottom);
    pen.text(name(1), (frame.left - pen.px(68.0), middle), LABELS, ink, Anchor::TurnedTop)
}

fn cross<S: Surface>(pen: &mut Pen<'_, S>, area: &Frame) -> Result<(), DrawError> {
    let theme = pen.style.theme;
    pen.fill(*area, theme.grid())?;
    let line = Line { color: theme.limit(), dash: Dash(None), width: 1.0 };
    pen.curve(&Path::straight((area.left, area.top), (area.right, area.bottom)), line)?;
    pen.curve(&Path::straight((area.left, area.bottom), (area.right, area.top)), line)
}

/// A frame that shows on any shade: white within dark.
fn outline<S: Surface>(pen: &mut Pen<'_, S>, area: &Frame) -> Result<(), DrawError> {
    for (inset, width, color) in [(1.5, 3.0, (32, 36, 42)), (3.5, 1.5, (255, 255, 255))] {
        let inset = pen.px(inset);
        let (left, top, right, bottom) = (area.left + inset, area.top + inset, area.right - inset, area.bottom - inset);
        let line = Line { color, dash: Dash(None), width };
        for (from, to) in [
            ((left, top), (right, top)),
            ((right, top), (right, bottom)),
            ((right, bottom), (left, bottom)),
            ((left, bottom), (left, top)),
        ] {
            pen.curve(&Path::straight(from, to), line)?;
        }
    }
    Ok(())
}

/// What the colours stand for.
fn scale<S: Surface>(pen: &mut Pen<'_, S>, sheet: &Sheet<'_>, range: (f64, f64)) -> Result<(), DrawError> {
    const BARS: usize = 64;
    let ink = pen.style.theme.ink();
    let left = sheet.whole.right - pen.px(SCALE - 36.0);
    let (top, bottom) = (pen.px(28.0), pen.px(f64::from(MAP) - 44.0));
    let at = |share: f64| (bottom + (top - bottom) * share).round();
    for n in 0..BARS {
        let shares = [n as f64 / BARS as f64, (n + 1) as f64 / BARS as f64];
        // Each lies over the end of the one below.
        let bottom = (at(shares[0]) + pen.px(1.0)).min(bottom);
        let bar = Frame { left, right: left + pen.px(14.0), top: at(shares[1]), bottom };
        pen.fill(bar, shade(f64::midpoint(shares[0], shares[1])))?;
    }
    for share in [0.0, 0.25, 0.5, 0.75, 1.0] {
        let value = range.0 + share * (range.1 - range.0);
        pen.text(&short(value), (left + pen.px(18.0), at(share)), TICKS, ink, Anchor::Left)?;
    }
    let label = names::metric(sheet.metric);
    pen.text(&label, (left - pen.px(22.0), f64::midpoint(top, bottom)), LABELS, ink, Anchor::TurnedTop)
}
