//! How a figure looks: a legend on top, panels with labelled axes and light grids, one time axis title at the bottom.

use super::axes::{format_tick, tick_step, value_range};
use super::decimate::decimate;
use super::legend::draw_legend;
use super::panels::{Figure, Panel, PlottedRun};
use super::pen::{DrawError, Pen, draw_line, rgb};
use super::style::{Dash, Style, scheme_style};
use crate::robots::RobotData;
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::Pos;

/// Line of a parameter's true value.
const TRUTH_DASH: Dash = Dash(Some((1, 2)));

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
    // Runs side by side are runs of one arm.
    let panels = figure.panels(robot, runs.first().map_or(&[], |run| run.theta_true));
    let mut entries: Vec<_> =
        runs.iter().map(|run| (run.scheme.name(), scheme_style(run.scheme, style.theme))).collect();
    if panels.iter().any(|panel| panel.truth.is_some()) {
        entries.push(("true value", (style.theme.truth(), TRUTH_DASH)));
    }
    let body = draw_legend(area, &entries, &pen)?;
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
    let curves: Vec<_> = runs.iter().map(|run| (run, values(run))).collect();
    let range = {
        let curves: Vec<_> = curves.iter().map(|(run, points)| (points.as_slice(), run.completed)).collect();
        value_range(&curves, panel.truth)
    };

    let mut chart = ChartBuilder::on(area)
        .margin_right(pen.px(12.0))
        .margin_left(pen.px(4.0))
        .margin_top(pen.px(6.0))
        .set_label_area_size(LabelAreaPosition::Left, pen.px(66.0))
        .set_label_area_size(LabelAreaPosition::Bottom, pen.px(if last_row { 36.0 } else { 20.0 }))
        .build_cartesian_2d(0.0..end_s, range.0..range.1)?;
    let label = pen.text(11.0, theme.ink(), Pos::default());
    let step = tick_step(range.1 - range.0);
    // As many as the panel has room for.
    let y_labels = ((f64::from(area.dim_in_pixel().1) / pen.style.scale / 28.0) as usize).clamp(2, 5);
    let format_y = |y: &f64| format_tick(*y, step);
    let format_t = |t: &f64| format_tick(*t, tick_step(end_s));
    let mut mesh = chart.configure_mesh();
    mesh.disable_x_mesh()
        .set_all_tick_mark_size(pen.px(4.0))
        .max_light_lines(0)
        .x_labels(7)
        .y_labels(y_labels)
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
        // What leaves the range runs along its edge.
        let v = (y.clamp(range.0, range.1) - range.0) / (range.1 - range.0);
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
        draw_line(&canvas, &line, theme.truth(), TRUTH_DASH, pen)?;
    }
    for (run, points) in &curves {
        let (color, dash) = scheme_style(run.scheme, theme);
        let line: Vec<_> = decimate(points.iter().copied(), (0.0, end_s), columns).into_iter().map(local).collect();
        draw_line(&canvas, &line, color, dash, pen)?;
    }
    Ok(())
}
