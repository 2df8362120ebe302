//! How a figure is laid out: a legend on top, panels side by side and below each other, one time axis title at the bottom.

use super::axes::value_range;
use super::figure::Figure;
use super::legend::draw_legend;
use super::panel::{Cell, PanelPlace, Scratch, Shared, draw_panel};
use super::panels::{Key, Panel, panels};
use super::path::Frame;
use super::run::PlottedRun;
use super::style::Line;
use super::surface::{Anchor, DrawError, Pen, Surface};
use super::view::{AxisKind, View};
use crate::robots::RobotData;

/// Draws a figure of `runs` on `robot` over the whole surface; says where its panels are.
///
/// Runs that do not belong into the figure are left out.
pub fn draw<S: Surface>(
    surface: &mut S,
    figure: Figure,
    robot: &RobotData,
    runs: &[PlottedRun<'_>],
    view: &View<'_>,
) -> Result<Vec<PanelPlace>, DrawError> {
    let (width, height) = surface.get_size();
    let whole = Frame { left: 0.0, top: 0.0, right: f64::from(width), bottom: f64::from(height) };
    let mut pen = Pen { surface, style: view.style };
    pen.fill(whole, view.style.theme.background())?;
    let panels = panels(figure, robot, runs, view);
    let shared = Shared {
        runs,
        window: window(figure, runs, view),
        kind: if figure.has_symlog() { view.axis } else { AxisKind::Linear },
    };
    let ranges: Vec<_> = panels.iter().map(|panel| value_range(panel, runs, shared.window, shared.kind)).collect();
    let top = draw_legend(&mut pen, whole.right, &entries(figure, &panels, &ranges, runs, view))?;

    let over_time = panels.iter().all(|panel| panel.x_label.is_none());
    let bottom = if over_time { whole.bottom - pen.px(16.0) } else { whole.bottom };
    let columns = figure.columns(whole.right / view.style.scale);
    let rows = panels.len().div_ceil(columns);
    let mut scratch = Scratch::default();
    let mut places = Vec::with_capacity(panels.len());
    for (n, panel) in panels.iter().enumerate() {
        let (row, column) = (n / columns, n % columns);
        let share = |from: f64, to: f64, index: usize, count: usize| from + (to - from) * index as f64 / count as f64;
        let frame = Frame {
            left: share(0.0, whole.right, column, columns).round(),
            right: share(0.0, whole.right, column + 1, columns).round(),
            top: share(top, bottom, row, rows).round(),
            bottom: share(top, bottom, row + 1, rows).round(),
        };
        let place = draw_panel(&mut pen, &Cell { frame }, panel, ranges[n], &shared, &mut scratch)?;
        if over_time && n + columns >= panels.len() {
            let at = (f64::midpoint(place.left, place.right), frame.bottom - pen.px(2.0));
            pen.text(view.texts.time_axis, at, 12.5, view.style.theme.ink(), Anchor::Top)?;
        }
        places.push(place);
    }
    Ok(places)
}

/// What is shown, s: what the view asks for, or all there is.
fn window(figure: Figure, runs: &[PlottedRun<'_>], view: &View<'_>) -> (f64, f64) {
    view.window_s.unwrap_or_else(|| {
        let shown = runs.iter().filter(|run| figure.shows(run.scheme));
        let end_s = shown.filter_map(PlottedRun::end_s).fold(0.0, f64::max);
        (0.0, if end_s > 0.0 { end_s } else { 1.0 })
    })
}

/// Names of the lines: of runs in the caller's order, of parts in the equation's, of what they are compared with.
fn entries<'a>(
    figure: Figure,
    panels: &[Panel],
    ranges: &[(f64, f64)],
    runs: &[PlottedRun<'a>],
    view: &View<'a>,
) -> Vec<(&'a str, Line)> {
    let theme = view.style.theme;
    let mut curves: Vec<_> =
        panels.first().map_or(&[][..], |panel| &panel.curves).iter().map(|curve| (curve.key, curve.line)).collect();
    curves.sort_by_key(|(key, _)| match key {
        Key::Run(n) | Key::Part(n) => *n,
        Key::Total => usize::MAX,
    });
    let name = |key| match key {
        Key::Run(run) => runs[run].name(),
        Key::Part(part) => view.texts.parts[part],
        Key::Total => view.texts.total,
    };
    let mut entries: Vec<_> = curves.into_iter().map(|(key, line)| (name(key), line)).collect();
    if panels.iter().any(|panel| panel.reference.is_some()) {
        let name = if figure == Figure::Positions { "desired" } else { "true value" };
        entries.push((view.texts.reference.unwrap_or(name), Line::of_reference(theme)));
    }
    let in_range = |panel: &Panel, (low, high): (f64, f64)| {
        panel.limit.is_some_and(|limit| limit.value <= high || -limit.value >= low)
    };
    if panels.iter().zip(ranges).any(|(panel, range)| in_range(panel, *range)) {
        let name = if figure == Figure::Voltages { "supply limit" } else { "effort limit" };
        entries.push((view.texts.limit.unwrap_or(name), Line::of_limit(theme)));
    }
    entries
}
