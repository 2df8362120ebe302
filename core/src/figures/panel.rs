//! How one panel looks: grid, labelled axes, limits, references and curves.

use super::axes::{Axis, x_range};
use super::decimate::{Columns, Point, Thinner};
use super::panels::{Panel, Reference};
use super::path::{Frame, Path};
use super::run::{PlottedRun, Quantity};
use super::style::Line;
use super::surface::{Anchor, DrawError, Pen, Surface};
use super::ticks::{Tick, ticks};
use super::view::AxisKind;

/// Where a panel ended up: its plotting area in device pixels and what its edges stand for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PanelPlace {
    /// Left edge, device pixels.
    pub left: f64,
    /// Top edge.
    pub top: f64,
    /// Right edge.
    pub right: f64,
    /// Bottom edge.
    pub bottom: f64,
    /// At the left edge: time in s, or what the panel is drawn over. Linear towards the right.
    pub x_left: f64,
    /// At the right edge.
    pub x_right: f64,
    /// Value at the bottom, in the panel's unit.
    pub y_bottom: f64,
    /// Value at the top. On a linear axis values in between are linear. A symmetric-logarithmic axis is linear in
    /// `asinh(y / 2c)`, where c is `10^(k − 3)` and `10^k` the power of ten at or above the larger of `|y_bottom|` and
    /// `|y_top|`: within ±c it is nearly linear, beyond it counts decades.
    pub y_top: f64,
}

impl PanelPlace {
    /// As plain numbers, in the order of the fields.
    pub fn numbers(&self) -> [f64; 8] {
        [self.left, self.top, self.right, self.bottom, self.x_left, self.x_right, self.y_bottom, self.y_top]
    }
}

/// What all panels of a figure share.
pub(super) struct Shared<'a> {
    pub runs: &'a [PlottedRun<'a>],
    /// What is shown, s.
    pub window: (f64, f64),
    pub kind: AxisKind,
}

/// Where the panel is in its figure.
pub(super) struct Cell {
    pub frame: Frame,
}

/// Lists that are filled anew for every curve and keep their memory.
#[derive(Default)]
pub(super) struct Scratch {
    points: Vec<Point>,
    /// Pixels of what a curve is drawn over, if not over time.
    across: Vec<f64>,
    path: Path,
}

/// A panel narrower than this, in layout pixels, has its label above it.
const NARROW: f64 = 300.0;
/// Size of ticks' letters and of labels', layout pixels.
const TICKS: f64 = 11.0;
const LABELS: f64 = 12.5;
/// What a straight line may leave out, layout pixels: nobody sees it.
const TOLERANCE: f64 = 0.1;

/// Draws a panel that shows a range of values into its cell.
pub(super) fn draw_panel<S: Surface>(
    pen: &mut Pen<'_, S>,
    cell: &Cell,
    panel: &Panel,
    y_values: (f64, f64),
    shared: &Shared<'_>,
    scratch: &mut Scratch,
) -> Result<PanelPlace, DrawError> {
    let frame = plotting_area(pen, cell, panel);
    let over_time = panel.x_label.is_none();
    let x_values = if over_time { shared.window } else { x_range(panel, shared.runs, shared.window) };
    let x = Axis::new(AxisKind::Linear, x_values, frame.left, frame.right);
    let y = Axis::new(shared.kind, y_values, frame.bottom, frame.top);
    draw_axes(pen, cell, panel, &frame, &x, &y)?;
    draw_lines_across(pen, panel, &frame, &y)?;

    let plot = Plot { frame, x, y, window: shared.window };
    for curve in &panel.curves {
        trace(pen, &plot, &shared.runs[curve.run], curve.x, curve.y, scratch);
        pen.curve(&scratch.path, curve.line)?;
    }
    // On top: a good run would hide it.
    if let Some(Reference::Curve { run, quantity }) = panel.reference {
        trace(pen, &plot, &shared.runs[run], None, quantity, scratch);
        pen.curve(&scratch.path, Line::of_reference(pen.style.theme))?;
    }
    Ok(PanelPlace {
        left: frame.left,
        top: frame.top,
        right: frame.right,
        bottom: frame.bottom,
        x_left: x.low,
        x_right: x.high,
        y_bottom: y.low,
        y_top: y.high,
    })
}

fn is_narrow<S: Surface>(pen: &Pen<'_, S>, cell: &Cell) -> bool {
    cell.frame.right - cell.frame.left < NARROW * pen.style.scale
}

/// What labels leave of a cell; at least a pixel.
fn plotting_area<S: Surface>(pen: &Pen<'_, S>, cell: &Cell, panel: &Panel) -> Frame {
    let narrow = is_narrow(pen, cell);
    let Frame { left, top, right, bottom } = cell.frame;
    let left = (left + pen.px(if narrow { 46.0 } else { 70.0 })).round();
    let top = (top + pen.px(if narrow { 20.0 } else { 6.0 })).round();
    let below = if panel.x_label.is_some() { 36.0 } else { 20.0 };
    Frame {
        left,
        top,
        right: (right - pen.px(12.0)).round().max(left + 1.0),
        bottom: (bottom - pen.px(below)).round().max(top + 1.0),
    }
}

fn draw_axes<S: Surface>(
    pen: &mut Pen<'_, S>,
    cell: &Cell,
    panel: &Panel,
    frame: &Frame,
    x: &Axis,
    y: &Axis,
) -> Result<(), DrawError> {
    let (ink, grid) = (pen.style.theme.ink(), pen.style.theme.grid());
    let room = |length: f64, each: f64, most: usize| ((length / pen.style.scale / each) as usize).clamp(2, most);
    let each = if is_narrow(pen, cell) { 36.0 } else { 64.0 };
    let x_ticks = ticks(x, room(frame.right - frame.left, each, 8), pen.style.scale);
    let y_ticks = ticks(y, room(frame.bottom - frame.top, 17.0, 6), pen.style.scale);
    let tick = pen.px(4.0);
    for (value, text) in &y_ticks {
        let at = y.pixel(*value);
        pen.hairline((frame.left, at), (frame.right, at), grid)?;
        pen.hairline((frame.left - tick, at), (frame.left, at), ink)?;
        pen.text(text, (frame.left - tick - pen.px(3.0), at), TICKS, ink, Anchor::Right)?;
    }
    for (value, text) in fitting(pen, x_ticks, x, cell.frame.right) {
        let at = x.pixel(value);
        pen.hairline((at, frame.bottom), (at, frame.bottom + tick), ink)?;
        pen.text(&text, (at, frame.bottom + tick + pen.px(2.0)), TICKS, ink, Anchor::Top)?;
    }
    pen.hairline((frame.left, frame.top), (frame.left, frame.bottom), ink)?;
    pen.hairline((frame.left, frame.bottom), (frame.right, frame.bottom), ink)?;
    if is_narrow(pen, cell) {
        let at = (cell.frame.left + pen.px(8.0), cell.frame.top + pen.px(10.0));
        pen.text(&panel.label, at, LABELS, ink, Anchor::Left)?;
    } else {
        let at = (cell.frame.left + pen.px(4.0), f64::midpoint(frame.top, frame.bottom));
        pen.text(&panel.label, at, LABELS, ink, Anchor::TurnedTop)?;
    }
    if let Some(label) = &panel.x_label {
        let at = (f64::midpoint(frame.left, frame.right), frame.bottom + pen.px(20.0));
        pen.text(label, at, LABELS, ink, Anchor::Top)?;
    }
    Ok(())
}

/// Ticks without those whose text would leave the picture on the right.
fn fitting<S: Surface>(pen: &Pen<'_, S>, ticks: Vec<Tick>, x: &Axis, right: f64) -> Vec<Tick> {
    let reach = |text: &str| 0.25 * TICKS * pen.style.scale * text.chars().count() as f64;
    ticks.into_iter().filter(|(value, text)| x.pixel(*value) + reach(text) <= right).collect()
}

/// Limits where they are in range, and a true value that does not change.
fn draw_lines_across<S: Surface>(
    pen: &mut Pen<'_, S>,
    panel: &Panel,
    frame: &Frame,
    y: &Axis,
) -> Result<(), DrawError> {
    let theme = pen.style.theme;
    let mut lines = Vec::new();
    if let Some(limit) = panel.limit {
        lines.extend([limit.value, -limit.value].map(|value| (value, Line::of_limit(theme))));
    }
    if let Some(Reference::Constant(value)) = panel.reference {
        lines.push((value, Line::of_reference(theme)));
    }
    for (value, line) in lines.into_iter().filter(|(value, _)| (y.low..=y.high).contains(value)) {
        let at = y.pixel(value);
        pen.curve(&Path::straight((frame.left, at), (frame.right, at)), line)?;
    }
    Ok(())
}

/// Where curves go.
struct Plot {
    frame: Frame,
    x: Axis,
    y: Axis,
    window: (f64, f64),
}

/// Leaves a curve in `scratch.path`: decimated, in pixels, clipped to the panel.
fn trace<S: Surface>(
    pen: &Pen<'_, S>,
    plot: &Plot,
    run: &PlottedRun<'_>,
    x: Option<Quantity>,
    y: Quantity,
    scratch: &mut Scratch,
) {
    /// Farther out is as good as anywhere.
    const FAR: f64 = 1e6;
    let tolerance = TOLERANCE * pen.style.scale;
    let pixel = |(t, value): Point| (plot.x.pixel(t), plot.y.pixel(value).clamp(-FAR, FAR));
    scratch.points.clear();
    scratch.path.clear();
    if let Some(x) = x {
        let rows = run.rows_within(plot.window);
        scratch.across.clear();
        run.visit(x, rows.clone(), |_, value| scratch.across.push(plot.x.pixel(value).clamp(-FAR, FAR)));
        let mut across = scratch.across.iter();
        let mut thinner = Thinner::turning(&mut scratch.points, tolerance);
        run.visit(y, rows, |_, value| {
            let point = (across.next().copied().unwrap_or(f64::NAN), plot.y.pixel(value).clamp(-FAR, FAR));
            if point.0.is_finite() && point.1.is_finite() {
                thinner.push(point);
            }
        });
        thinner.finish();
    } else {
        let (from_s, to_s) = plot.window;
        // On paper, where pixels are small, two columns per layout pixel will do.
        let width = plot.frame.right - plot.frame.left;
        let columns = width * (pen.style.scale.min(2.0) / pen.style.scale);
        let mut thinner = Thinner::rising(&mut scratch.points, tolerance);
        let mut keep = |point| thinner.push(pixel(point));
        let mut columns = Columns::new(from_s, to_s - from_s, columns.max(1.0));
        run.visit(y, run.rows_about(plot.window), |t, value| {
            if value.is_finite() {
                columns.push(t, value, &mut keep);
            }
        });
        columns.finish(&mut keep);
        thinner.finish();
    }
    scratch.path.add_clipped(&scratch.points, &plot.frame);
}
