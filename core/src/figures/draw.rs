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

#[cfg(test)]
mod tests {
    use super::super::style::{Style, Theme};
    use super::super::surface::Stroke;
    use super::super::{Path, Texts};
    use super::*;
    use crate::robots::ROBOTS;
    use crate::scenario::{Run, Scenario, Scheme};
    use plotters_backend::{
        BackendColor, BackendCoord, BackendStyle, BackendTextStyle, DrawingBackend, DrawingErrorKind,
    };

    /// Remembers what is drawn on it.
    struct Sheet {
        size: (u32, u32),
        texts: Vec<String>,
        curves: Vec<(Path, Stroke)>,
    }

    type Drawn = Result<(), DrawingErrorKind<std::io::Error>>;

    impl DrawingBackend for Sheet {
        type ErrorType = std::io::Error;
        fn get_size(&self) -> (u32, u32) {
            self.size
        }
        fn ensure_prepared(&mut self) -> Drawn {
            Ok(())
        }
        fn present(&mut self) -> Drawn {
            Ok(())
        }
        fn draw_pixel(&mut self, _: BackendCoord, _: BackendColor) -> Drawn {
            Ok(())
        }
        fn draw_rect<S: BackendStyle>(&mut self, from: BackendCoord, to: BackendCoord, _: &S, _: bool) -> Drawn {
            assert!(from.0 <= to.0 && from.1 <= to.1, "{from:?} {to:?}");
            Ok(())
        }
        fn draw_text<S: BackendTextStyle>(&mut self, text: &str, _: &S, _: BackendCoord) -> Drawn {
            self.texts.push(text.to_owned());
            Ok(())
        }
    }

    impl Surface for Sheet {
        fn draw_curve(&mut self, path: &Path, stroke: Stroke) -> Drawn {
            self.curves.push((path.clone(), stroke));
            Ok(())
        }
    }

    fn run(scheme: Scheme) -> Run {
        let mut document = scheme.paper();
        (document.integration.duration_s, document.recording.samples) = (0.2, 100);
        Scenario::new(document).unwrap().run()
    }

    fn drawn(figure: Figure, size: (u32, u32), runs: &[PlottedRun<'_>], view: &View<'_>) -> (Sheet, Vec<PanelPlace>) {
        let mut sheet = Sheet { size, texts: Vec::new(), curves: Vec::new() };
        let places = draw(&mut sheet, figure, ROBOTS[0], runs, view).unwrap();
        (sheet, places)
    }

    #[test]
    fn places_are_where_the_curves_are() {
        let run = run(Scheme::Proposed);
        let theta = ROBOTS[0].theta();
        let runs = [PlottedRun::new(Scheme::Proposed, &run.recording, true, &theta)];
        for (size, scale) in [((600, 420), 1.0), ((1200, 840), 2.0), ((390, 300), 1.0), ((60, 40), 1.0), ((1, 1), 3.0)]
        {
            for figure in Figure::ALL {
                let view = View { window_s: Some((0.05, 0.15)), ..View::whole(Style { theme: Theme::Dark, scale }) };
                let (sheet, places) = drawn(figure, size, &runs, &view);
                assert!(!places.is_empty());
                for place in &places {
                    assert!(place.left < place.right && place.top < place.bottom && place.y_bottom < place.y_top);
                    if figure != Figure::PhasePlane {
                        assert_eq!((place.x_left, place.x_right), (0.05, 0.15));
                    }
                }
                let within = |(x, y): &(f64, f64)| {
                    let holds = |place: &PanelPlace| {
                        *x >= place.left && *x <= place.right && *y >= place.top && *y <= place.bottom
                    };
                    places.iter().any(holds)
                };
                let is_within = |path: &Path| path.pieces().flatten().all(within);
                // After the legend's samples, all lines are within panels.
                let mut lines = sheet.curves.iter().map(|(path, _)| path).skip_while(|path| !is_within(path));
                assert!(lines.all(is_within), "{figure:?} {size:?}");
            }
        }
    }

    #[test]
    fn a_value_is_drawn_where_the_place_says() {
        let run = run(Scheme::SlotineLi);
        let runs = [PlottedRun::new(Scheme::SlotineLi, &run.recording, true, &[])];
        let view = View::whole(Style { theme: Theme::Light, scale: 1.0 });
        for axis in [AxisKind::Linear, AxisKind::Symlog] {
            let (sheet, places) = drawn(Figure::TrackingErrors, (600, 420), &runs, &View { axis, ..view });
            let place = places[1];
            let threshold = 10.0_f64.powf(place.y_bottom.abs().max(place.y_top.abs()).log10().ceil() - 3.0);
            let map = |y: f64| if axis == AxisKind::Symlog { (y / (2.0 * threshold)).asinh() } else { y };
            let end = run.recording.signal(crate::recording::Signal::Error, 1).next_back().unwrap().to_degrees();
            let share = (map(end) - map(place.y_bottom)) / (map(place.y_top) - map(place.y_bottom));
            let expected = place.bottom + share * (place.top - place.bottom);
            // Legend, then the joints.
            let (x, y) = *sheet.curves[2].0.pieces().last().unwrap().last().unwrap();
            assert!((x - place.right).abs() < 1e-9 && (y - expected).abs() < 1e-9, "{axis:?}: {y} for {expected}");
        }
    }

    #[test]
    fn runs_to_compare_with_are_paler_thinner_and_below() {
        let run = run(Scheme::Proposed);
        let live = PlottedRun::new(Scheme::Proposed, &run.recording, true, &[]);
        let pinned = PlottedRun { faded: true, label: Some("before"), ..live };
        let texts = Texts { time_axis: "tiempo [s]", ..Texts::default() };
        let view = View { texts, ..View::whole(Style { theme: Theme::Light, scale: 2.0 }) };
        let (sheet, _) = drawn(Figure::Torques, (1200, 840), &[live, pinned], &view);
        let widths: Vec<_> = sheet.curves.iter().map(|(_, stroke)| stroke.width).collect();
        assert!(widths[0] > widths[1], "the legend keeps the caller's order");
        assert!(widths[2] < widths[3], "the panel draws the live run last");
        assert!(sheet.texts.iter().any(|text| text == "before") && sheet.texts.iter().any(|text| text == "tiempo [s]"));
        assert!(!sheet.texts.iter().any(|text| text == "effort limit"), "a limit out of range has no legend");
        let (sheet, _) = drawn(Figure::Voltages, (600, 420), &[live], &view);
        assert!(sheet.texts.iter().any(|text| text == "supply limit"));
    }

    #[test]
    fn an_empty_figure_has_its_axes() {
        let view = View::whole(Style { theme: Theme::Light, scale: 1.0 });
        for figure in Figure::ALL {
            let (sheet, places) = drawn(figure, (600, 420), &[], &view);
            assert!(
                !places.is_empty() && sheet.curves.iter().all(|(path, _)| path.pieces().all(|piece| piece.len() < 3))
            );
        }
    }
}
