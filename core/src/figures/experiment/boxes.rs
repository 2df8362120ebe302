//! Quantiles of a metric, a box per base and condition: the middle half with the median, whiskers from 5 % to 95 %, the
//! extremes as ticks, the mean as a diamond.

use super::super::path::{Frame, Path};
use super::super::style::{Dash, Line};
use super::super::surface::{Anchor, DrawError, Pen, Surface};
use super::chart::{LABELS, NOTES, across, cut, padded, say};
use super::{Sheet, names};
use crate::experiments::{Experiment, GroupSummary, Statistics, Summary};

/// Most boxes; what is beyond is left out, and said.
const MOST: usize = 40;
/// Height of a row and of what is around all of them, layout pixels.
const ROW: f64 = 28.0;
const AROUND: f64 = 82.0;
/// Room for names, layout pixels.
const NAMES: f64 = 250.0;

/// Height of the figure, layout pixels.
pub(super) fn height(experiment: &Experiment) -> u32 {
    let groups = experiment.base_names().len() * experiment.condition_names().len().max(1);
    (AROUND + ROW * groups.clamp(2, MOST) as f64) as u32
}

pub(super) fn draw<S: Surface>(pen: &mut Pen<'_, S>, sheet: &Sheet<'_>, summary: &Summary) -> Result<(), DrawError> {
    let statistics = |group: &GroupSummary| {
        group.metrics.iter().find(|metric| metric.metric == sheet.metric).map(|metric| metric.statistics.clone())
    };
    let groups: Vec<_> = summary.groups.iter().take(MOST).map(|group| (group, statistics(group))).collect();
    let numbers = groups.iter().filter_map(|(_, it)| it.as_ref()).flat_map(|it| [it.min, it.max]);
    let Some(range) = padded(numbers) else { return say(pen, &sheet.whole, "no run has this metric") };
    let frame = Frame {
        left: pen.px(NAMES),
        top: pen.px(10.0),
        right: sheet.whole.right - pen.px(24.0),
        bottom: sheet.whole.bottom - pen.px(AROUND - 14.0),
    };
    let axis = across(pen, &frame, range, &names::metric(sheet.metric))?;
    let ink = pen.style.theme.ink();
    let row = (frame.bottom - frame.top) / groups.len().max(1) as f64;
    let one = sheet.experiment.condition_names().len() < 2;
    for (n, (group, statistics)) in groups.iter().enumerate() {
        let middle = (frame.top + row * (n as f64 + 0.5)).round();
        let name = if one { group.base.clone() } else { format!("{} · {}", group.condition, group.base) };
        let name = cut(pen, &name, LABELS, pen.px(NAMES - 20.0));
        pen.text(&name, (frame.left - pen.px(10.0), middle), LABELS, ink, Anchor::Right)?;
        match statistics {
            Some(statistics) => draw_box(pen, statistics, middle, &|value| axis.pixel(value))?,
            None => pen.text("no number", (frame.left + pen.px(8.0), middle), NOTES, ink, Anchor::Left)?,
        }
    }
    let left_out = summary.groups.len().saturating_sub(MOST);
    let more = if left_out > 0 { format!("; {left_out} more are not shown") } else { String::new() };
    let note =
        format!("box: middle half; thick line: median; diamond: mean; whiskers: 5 % to 95 %; ticks: extremes{more}");
    pen.text(&note, (frame.left, sheet.whole.bottom - pen.px(14.0)), NOTES, ink, Anchor::Left)
}

fn draw_box<S: Surface>(
    pen: &mut Pen<'_, S>,
    statistics: &Statistics,
    middle: f64,
    x: &dyn Fn(f64) -> f64,
) -> Result<(), DrawError> {
    let theme = pen.style.theme;
    let line = |width: f64| Line { color: theme.ink(), dash: Dash(None), width };
    let half = pen.px(8.0);
    let upright = |at: f64, half: f64| Path::straight((at, middle - half), (at, middle + half));
    let Statistics { min, p05, p25, p50, p75, p95, max, mean, .. } = *statistics;
    pen.curve(&Path::straight((x(p05), middle), (x(p95), middle)), line(1.2))?;
    for (value, height) in [(p05, 0.6), (p95, 0.6), (min, 0.3), (max, 0.3)] {
        pen.curve(&upright(x(value), half * height), line(1.2))?;
    }
    pen.fill(
        Frame {
            left: x(p25).round(),
            top: middle - half,
            right: x(p75).round().max(x(p25).round() + 1.0),
            bottom: middle + half,
        },
        (173, 205, 235),
    )?;
    let (left, right) = (x(p25), x(p75));
    for at in [left, right] {
        pen.curve(&upright(at, half), line(1.2))?;
    }
    for y in [middle - half, middle + half] {
        pen.curve(&Path::straight((left, y), (right, y)), line(1.2))?;
    }
    pen.curve(&upright(x(p50), half), line(2.6))?;
    let (at, size) = (x(mean), pen.px(4.0));
    let corners =
        [(at, middle - size), (at + size, middle), (at, middle + size), (at - size, middle), (at, middle - size)];
    for pair in corners.windows(2) {
        pen.curve(&Path::straight(pair[0], pair[1]), Line { color: theme.limit(), dash: Dash(None), width: 1.6 })?;
    }
    Ok(())
}
