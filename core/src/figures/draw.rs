//! How a figure looks: a legend on top, panels with labelled axes and light grids, one time axis title at the bottom.

use super::decimate::decimate;
use super::panels::{Figure, Panel, PlottedRun};
use super::style::{Dash, Rgb, Style, scheme_style};
use crate::robots::RobotData;
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// The backend failed.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("the figure could not be drawn: {0}")]
pub struct DrawError(String);

impl<E: std::error::Error + Send + Sync> From<DrawingAreaErrorKind<E>> for DrawError {
    fn from(error: DrawingAreaErrorKind<E>) -> Self {
        Self(error.to_string())
    }
}

/// Font of every text; each backend maps it to what it has.
const FONT: &str = "sans-serif";

/// Lengths in layout pixels, scaled to the device.
struct Pen {
    style: Style,
}

impl Pen {
    fn px(&self, layout: f64) -> i32 {
        (layout * self.style.scale).round() as i32
    }

    fn stroke(&self, layout: f64) -> u32 {
        (layout * self.style.scale).round().max(1.0) as u32
    }

    fn text(&self, layout: f64, color: Rgb, pos: Pos) -> TextStyle<'static> {
        (FONT, layout * self.style.scale).into_font().color(&rgb(color)).pos(pos)
    }
}

fn rgb((r, g, b): Rgb) -> RGBColor {
    RGBColor(r, g, b)
}

/// Draws a figure of `runs` on `robot` into the whole area. Runs that do not belong into the figure are left out.
pub fn draw<DB: DrawingBackend>(
    area: &DrawingArea<DB, Shift>,
    figure: Figure,
    robot: &RobotData,
    runs: &[PlottedRun<'_>],
    style: Style,
) -> Result<(), DrawError> {
    let pen = Pen { style };
    area.fill(&rgb(style.theme.background()))?;
    let runs: Vec<_> = runs.iter().copied().filter(|run| figure.shows(run.scheme)).collect();
    let panels = figure.panels(robot);
    let truth = panels.iter().any(|panel| panel.truth.is_some());
    let (legend, body) = area.split_vertically(pen.px(24.0));
    draw_legend(&legend, &runs, truth, &pen)?;
    let columns = figure.columns(f64::from(area.dim_in_pixel().0) / style.scale);
    let rows = panels.len().div_ceil(columns);
    let cells = body.split_evenly((rows, columns));
    let end_s = runs.iter().filter_map(|run| run.recording.times_s().next_back()).fold(0.0, f64::max);
    for (n, (cell, panel)) in cells.iter().zip(&panels).enumerate() {
        let last_row = n + columns >= panels.len();
        draw_panel(cell, panel, &runs, if end_s > 0.0 { end_s } else { 1.0 }, last_row, &pen)?;
    }
    Ok(())
}

fn draw_legend<DB: DrawingBackend>(
    area: &DrawingArea<DB, Shift>,
    runs: &[PlottedRun<'_>],
    truth: bool,
    pen: &Pen,
) -> Result<(), DrawError> {
    let theme = pen.style.theme;
    let text = pen.text(12.0, theme.ink(), Pos::new(HPos::Left, VPos::Center));
    let middle = area.dim_in_pixel().1 as i32 / 2;
    let mut x = pen.px(10.0);
    let mut entries: Vec<_> = runs.iter().map(|run| (run.scheme.name(), scheme_style(run.scheme, theme))).collect();
    if truth {
        entries.push(("true value", (theme.truth(), Dash(Some((1, 2))))));
    }
    for (name, (color, dash)) in entries {
        let line = [(x, middle), (x + pen.px(26.0), middle)];
        draw_line(area, &line.map(|(x, y)| (f64::from(x), f64::from(y))), color, dash, pen)?;
        area.draw(&Text::new(name, (x + pen.px(32.0), middle), text.clone()))?;
        let (width, _) = area.estimate_text_size(name, &text)?;
        x += pen.px(48.0) + width as i32;
    }
    Ok(())
}

/// A polyline in pixels, dashed or solid.
fn draw_line<DB: DrawingBackend>(
    area: &DrawingArea<DB, Shift>,
    points: &[(f64, f64)],
    color: Rgb,
    dash: Dash,
    pen: &Pen,
) -> Result<(), DrawError> {
    let style = rgb(color).stroke_width(pen.stroke(1.4));
    for piece in dash_pieces(points, dash, pen.style.scale) {
        area.draw(&PathElement::new(piece, style))?;
    }
    Ok(())
}

/// Cuts a polyline into its dashes.
fn dash_pieces(points: &[(f64, f64)], dash: Dash, scale: f64) -> Vec<Vec<(i32, i32)>> {
    let round = |(x, y): (f64, f64)| (x.round() as i32, y.round() as i32);
    let Some((on, off)) = dash.0 else {
        return vec![points.iter().copied().map(round).collect()];
    };
    let lengths = [f64::from(on) * scale, f64::from(off) * scale];
    let mut pieces = Vec::new();
    let mut piece: Vec<(i32, i32)> = points.first().copied().map(round).into_iter().collect();
    let (mut phase, mut left) = (0, lengths[0]);
    for pair in points.windows(2) {
        let (mut from, to) = (pair[0], pair[1]);
        loop {
            let (dx, dy) = (to.0 - from.0, to.1 - from.1);
            let distance = (dx * dx + dy * dy).sqrt();
            if distance <= left {
                left -= distance;
                if phase == 0 {
                    piece.push(round(to));
                }
                break;
            }
            from = (from.0 + dx * left / distance, from.1 + dy * left / distance);
            if phase == 0 {
                piece.push(round(from));
                pieces.push(std::mem::take(&mut piece));
            } else {
                piece.push(round(from));
            }
            phase = 1 - phase;
            left = lengths[phase];
        }
    }
    if piece.len() > 1 {
        pieces.push(piece);
    }
    pieces
}

fn draw_panel<DB: DrawingBackend>(
    area: &DrawingArea<DB, Shift>,
    panel: &Panel,
    runs: &[PlottedRun<'_>],
    end_s: f64,
    last_row: bool,
    pen: &Pen,
) -> Result<(), DrawError> {
    let theme = pen.style.theme;
    let values = |run: &PlottedRun<'_>| -> Vec<(f64, f64)> {
        let samples = run.recording.signal(panel.signal, panel.component).map(|x| x * panel.factor);
        run.recording.times_s().zip(samples).collect()
    };
    let curves: Vec<_> = runs.iter().map(|run| (run.scheme, values(run))).collect();
    let range = padded_range(curves.iter().flat_map(|(_, points)| points.iter().map(|p| p.1)).chain(panel.truth));

    let mut chart = ChartBuilder::on(area)
        .margin_right(pen.px(12.0))
        .margin_left(pen.px(4.0))
        .margin_top(pen.px(6.0))
        .set_label_area_size(LabelAreaPosition::Left, pen.px(66.0))
        .set_label_area_size(LabelAreaPosition::Bottom, pen.px(if last_row { 36.0 } else { 20.0 }))
        .build_cartesian_2d(0.0..end_s, range.0..range.1)?;
    let label = pen.text(11.0, theme.ink(), Pos::default());
    let step = tick_step(range.1 - range.0);
    let format_y = |y: &f64| format_tick(*y, step);
    let format_t = |t: &f64| format_tick(*t, tick_step(end_s));
    let mut mesh = chart.configure_mesh();
    mesh.disable_x_mesh()
        .set_all_tick_mark_size(pen.px(4.0))
        .max_light_lines(0)
        .x_labels(7)
        .y_labels(5)
        .bold_line_style(rgb(theme.grid()).stroke_width(pen.stroke(1.0)))
        .axis_style(rgb(theme.ink()).stroke_width(pen.stroke(1.0)))
        .label_style(label.clone())
        .y_label_formatter(&format_y)
        .x_label_formatter(&format_t)
        .y_desc(panel.label.clone())
        .axis_desc_style(pen.text(12.5, theme.ink(), Pos::default()));
    if last_row {
        mesh.x_desc("t [s]");
    }
    mesh.draw()?;

    let plot = chart.plotting_area();
    let (xs, ys) = plot.get_pixel_range();
    let to_pixel = |(t, y): (f64, f64)| {
        let x = f64::from(xs.start) + t / end_s * f64::from(xs.end - xs.start);
        let v = (y - range.0) / (range.1 - range.0);
        (x, f64::from(ys.end) - v * f64::from(ys.end - ys.start))
    };
    // Pixels of the whole drawing, not of this panel.
    let canvas = plot.strip_coord_spec();
    let (left, top) = canvas.get_base_pixel();
    // Two to four points per layout pixel: finer is invisible and makes documents large.
    let columns = (f64::from(xs.end - xs.start) / pen.style.scale).ceil().max(1.0) as usize;
    let local = |point| {
        let (x, y): (f64, f64) = to_pixel(point);
        (x - f64::from(left), y - f64::from(top))
    };
    if let Some(truth) = panel.truth {
        let line = [local((0.0, truth)), local((end_s, truth))];
        draw_line(&canvas, &line, theme.truth(), Dash(Some((1, 2))), pen)?;
    }
    for (scheme, points) in &curves {
        let (color, dash) = scheme_style(*scheme, theme);
        let line: Vec<_> = decimate(points.iter().copied(), (0.0, end_s), columns).into_iter().map(local).collect();
        draw_line(&canvas, &line, color, dash, pen)?;
    }
    Ok(())
}

/// Range of the values with room around them; something sensible for constants and for nothing.
fn padded_range(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), y| (low.min(y), high.max(y)));
    if low > high {
        return (-1.0, 1.0);
    }
    let span = high - low;
    let pad = if span > 0.0 { 0.06 * span } else { low.abs().max(1.0) * 0.1 };
    (low - pad, high + pad)
}

/// Rough distance of ticks on an axis of this length.
fn tick_step(span: f64) -> f64 {
    span / 6.0
}

/// A tick's label with as many decimals as its axis needs; powers of ten for very small spans.
fn format_tick(value: f64, step: f64) -> String {
    let value = if value.abs() < step * 1e-6 { 0.0 } else { value };
    if step > 0.0 && step < 5e-4 {
        return if value == 0.0 { "0".to_owned() } else { format!("{value:.1e}") };
    }
    let decimals = (1.0 - step.log10()).ceil().clamp(0.0, 6.0) as usize;
    let text = format!("{value:.decimals$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_read_well() {
        assert_eq!(format_tick(0.1, 0.05), "0.1");
        assert_eq!(format_tick(-20.0, 10.0), "-20");
        assert_eq!(format_tick(1e-20, 0.05), "0");
        assert_eq!(format_tick(2e-5, 1e-5), "2.0e-5");
    }

    #[test]
    fn dashes_have_their_lengths() {
        let pieces = dash_pieces(&[(0.0, 0.0), (30.0, 0.0)], Dash(Some((8, 4))), 1.0);
        assert_eq!(pieces, [vec![(0, 0), (8, 0)], vec![(12, 0), (20, 0)], vec![(24, 0), (30, 0)]]);
    }

    #[test]
    fn ranges_survive_constants_and_nothing() {
        assert_eq!(padded_range([].into_iter()), (-1.0, 1.0));
        assert_eq!(padded_range([0.0, 0.0].into_iter()), (-0.1, 0.1));
    }
}
