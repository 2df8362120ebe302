//! A dot plot on a logarithmic axis: a row per thing with the span of its values, a value that stands out and the best one.
//!
//! For tables of experiments, which have no time axis. Values that are not positive have no place on it and are left out.

use super::axes::{decade_above, decade_below, power_of_ten};
use super::path::{Frame, Path};
use super::style::{Dash, Line, Rgb, Theme, scheme_style};
use super::surface::{Anchor, DrawError, Pen, Surface};
use super::ticks::Tick;
use crate::scalar::decimal_logarithm;
use crate::scenario::Scheme;

/// A row.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct DotRow {
    /// What it is about.
    pub label: String,
    /// Least and greatest value.
    pub span: Option<[f64; 2]>,
    /// Drawn as a filled square.
    pub filled: Option<f64>,
    /// Drawn as an open square.
    pub open: Option<f64>,
}

/// The picture.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct DotPlot<'a> {
    /// Title of the value axis.
    pub axis: &'a str,
    /// What span, filled and open squares are; what is empty does not show in the legend.
    pub legend: [&'a str; 3],
    /// Rows in groups with their titles.
    pub groups: Vec<(String, Vec<DotRow>)>,
    /// A value to compare with.
    pub reference: f64,
}

/// Layout pixels.
const ROW: f64 = 18.0;
const LEFT: f64 = 300.0;
const RIGHT: f64 = 24.0;
const TOP: f64 = 34.0;
const BOTTOM: f64 = 44.0;
const HALF_SQUARE: f64 = 4.0;
const LETTERS: f64 = 12.0;

/// Logarithmic axis across the picture.
struct Scale {
    low: f64,
    high: f64,
    left: f64,
    right: f64,
}

impl Scale {
    fn new(plot: &DotPlot<'_>, left: f64, right: f64) -> Self {
        let rows = plot.groups.iter().flat_map(|(_, rows)| rows);
        let values = rows.flat_map(|row| row.span.into_iter().flatten().chain(row.filled).chain(row.open));
        let positive = values.chain([plot.reference]).filter(|value| *value > 0.0 && value.is_finite());
        let (low, high) = positive.fold((f64::INFINITY, 0.0_f64), |(low, high), x| (low.min(x), high.max(x)));
        Self { low: low / 1.15, high: high * 1.15, left, right }
    }

    fn x(&self, value: f64) -> f64 {
        let share = decimal_logarithm(value / self.low) / decimal_logarithm(self.high / self.low);
        self.left + share * (self.right - self.left)
    }

    /// Powers of ten; with few of them also 2 and 5 times, with hardly one every whole multiple.
    fn ticks(&self) -> Vec<Tick> {
        let steps: &[f64] = match decimal_logarithm(self.high / self.low) {
            decades if decades < 0.7 => &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0],
            decades if decades < 2.5 => &[1.0, 2.0, 5.0],
            _ => &[1.0],
        };
        let (first, last) = (decade_below(self.low), decade_above(self.high));
        let tick = |k: i32, step: f64| {
            let (value, decimals) = (step * power_of_ten(k), (-k).max(0) as usize);
            (value, format!("{value:.decimals$}"))
        };
        let all = (first..=last).flat_map(|k| steps.iter().map(move |step| tick(k, *step)));
        all.filter(|(value, _)| (self.low..=self.high).contains(value)).collect()
    }
}

/// Height of the picture, layout pixels.
pub(super) fn height(plot: &DotPlot<'_>) -> u32 {
    let lines: usize = plot.groups.iter().map(|(_, rows)| rows.len() + 1).sum();
    (TOP + BOTTOM + ROW * lines as f64).ceil() as u32
}

/// Draws it from the left and upper edges to those of a frame.
pub(super) fn draw<S: Surface>(pen: &mut Pen<'_, S>, plot: &DotPlot<'_>, whole: &Frame) -> Result<(), DrawError> {
    let theme = pen.style.theme;
    let scale = Scale::new(plot, pen.px(LEFT), whole.right - pen.px(RIGHT));
    let (top, floor) = (pen.px(TOP), whole.bottom - pen.px(BOTTOM));
    for (value, label) in scale.ticks() {
        let x = scale.x(value);
        pen.hairline((x, top), (x, floor), theme.grid())?;
        pen.text(&label, (x, floor + pen.px(4.0)), LETTERS, theme.ink(), Anchor::Top)?;
    }
    let middle = f64::midpoint(scale.left, scale.right);
    pen.text(plot.axis, (middle, floor + pen.px(22.0)), LETTERS + 0.5, theme.ink(), Anchor::Top)?;
    let reference = scale.x(plot.reference);
    pen.curve(&Path::straight((reference, top), (reference, floor)), Line::of_limit(theme))?;
    draw_legend(pen, plot)?;
    let mut y = top + pen.px(ROW / 2.0);
    for (title, rows) in &plot.groups {
        pen.text(title, (pen.px(8.0), y), LETTERS, theme.ink(), Anchor::Left)?;
        y += pen.px(ROW);
        for row in rows {
            pen.text(&row.label, (pen.px(24.0), y), LETTERS, theme.ink(), Anchor::Left)?;
            draw_row(pen, row, &scale, y)?;
            y += pen.px(ROW);
        }
    }
    Ok(())
}

fn draw_row<S: Surface>(pen: &mut Pen<'_, S>, row: &DotRow, scale: &Scale, y: f64) -> Result<(), DrawError> {
    let theme = pen.style.theme;
    if let Some([low, high]) = row.span.filter(|[low, _]| *low > 0.0) {
        let line = Line { color: theme.truth(), dash: Dash(None), width: 3.0 };
        pen.curve(&Path::straight((scale.x(low), y), (scale.x(high), y)), line)?;
    }
    for (value, is_open) in [(row.open, true), (row.filled, false)] {
        if let Some(value) = value.filter(|value| *value > 0.0) {
            square(pen, (scale.x(value), y), is_open, theme)?;
        }
    }
    Ok(())
}

fn mark_color(theme: Theme) -> Rgb {
    scheme_style(Scheme::Proposed, theme).0
}

fn square<S: Surface>(pen: &mut Pen<'_, S>, (x, y): (f64, f64), is_open: bool, theme: Theme) -> Result<(), DrawError> {
    let around = |half: f64| Frame { left: x - half, top: y - half, right: x + half, bottom: y + half };
    pen.fill(around(pen.px(HALF_SQUARE)), mark_color(theme))?;
    if is_open { pen.fill(around(pen.px(HALF_SQUARE - 1.5)), theme.background()) } else { Ok(()) }
}

fn draw_legend<S: Surface>(pen: &mut Pen<'_, S>, plot: &DotPlot<'_>) -> Result<(), DrawError> {
    let theme = pen.style.theme;
    let (mut x, y) = (pen.px(12.0), pen.px(14.0));
    for (n, name) in plot.legend.iter().enumerate().filter(|(_, name)| !name.is_empty()) {
        if n == 0 {
            let line = Line { color: theme.truth(), dash: Dash(None), width: 3.0 };
            pen.curve(&Path::straight((x - pen.px(6.0), y), (x + pen.px(6.0), y)), line)?;
        } else {
            square(pen, (x, y), n == 2, theme)?;
        }
        pen.text(name, (x + pen.px(12.0), y), LETTERS, theme.ink(), Anchor::Left)?;
        x += pen.px(36.0) + pen.text_width(name, LETTERS);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::style::Style;
    use super::*;
    use plotters::prelude::*;

    #[test]
    fn what_has_no_place_on_the_axis_is_left_out() {
        let row = |filled| DotRow { label: "a".to_owned(), filled: Some(filled), ..DotRow::default() };
        let groups = vec![("group".to_owned(), vec![row(0.1), row(10.0), row(0.0), row(-1.0)])];
        let plot = DotPlot { axis: "x", legend: ["", "point", ""], groups, reference: 1.0 };
        let scale = Scale::new(&plot, 0.0, 100.0);
        assert!((scale.x(1.0) - 50.0).abs() < 1e-9);
        let labels: Vec<_> = scale.ticks().into_iter().map(|(_, label)| label).collect();
        assert_eq!(labels, ["0.1", "0.2", "0.5", "1", "2", "5", "10"]);
        let mut svg = String::new();
        {
            let mut backend = SVGBackend::with_string(&mut svg, (900, height(&plot)));
            let mut pen = Pen { surface: &mut backend, style: Style { theme: Theme::Light, scale: 1.0 } };
            draw(&mut pen, &plot, &Frame { left: 0.0, top: 0.0, right: 900.0, bottom: 200.0 }).unwrap();
            backend.present().unwrap();
        }
        let color = svg.matches("fill=\"#0054A6\"").count();
        assert_eq!(color, 3, "one in the legend, two in rows");
    }
}
