//! Draws the core's figures on the page's canvases; needs the main thread.

use serde::Deserialize;

/// How the page wants a figure drawn.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
#[cfg_attr(not(target_arch = "wasm32"), expect(dead_code, reason = "read only where there is a canvas"))]
struct View {
    /// Names of the runs to show, in the order of drawing; those that do not exist are left out.
    shown: Vec<String>,
    /// On a dark page.
    dark: bool,
    /// Device pixels per layout pixel.
    scale: f64,
}

#[cfg(target_arch = "wasm32")]
mod drawing {
    use super::View;
    use crate::canvas::Canvas;
    use crate::failure::Failure;
    use crate::runs::Runs;
    use adaptarm_core::figures::{self, Figure, PlottedRun, Style, Theme};
    use adaptarm_core::robots::ROBOTS;
    use plotters::prelude::IntoDrawingArea;
    use wasm_bindgen::JsValue;
    use wasm_bindgen::prelude::wasm_bindgen;
    use web_sys::HtmlCanvasElement;

    /// Draws a figure over the whole canvas, whose size in device pixels is the caller's choice. `view_json` is a [`View`].
    /// Throws JSON text `{pointer, message}`.
    #[wasm_bindgen]
    pub fn draw_figure(runs: &Runs, canvas: HtmlCanvasElement, figure: &str, view_json: &str) -> Result<(), JsValue> {
        let figure = Figure::from_id(figure).ok_or_else(|| Failure::new(format!("{figure:?} is not a figure")))?;
        let view: View = serde_json::from_str(view_json).map_err(|error| Failure::new(error.to_string()))?;
        let backend = Canvas::new(canvas).ok_or_else(|| Failure::new("the canvas cannot be drawn on"))?;
        let shown: Vec<_> = view.shown.iter().filter_map(|id| runs.get(id)).collect();
        let thetas: Vec<_> = shown.iter().map(|run| run.scenario.theta()).collect();
        let plotted: Vec<_> = shown
            .iter()
            .zip(&thetas)
            .map(|(run, theta)| PlottedRun {
                scheme: run.scenario.scheme(),
                recording: &run.recording,
                completed: run.completed,
                theta_true: theta,
            })
            .collect();
        let robot = shown.first().map_or(ROBOTS[0], |run| run.scenario.robot());
        let theme = if view.dark { Theme::Dark } else { Theme::Light };
        figures::draw(&backend.into_drawing_area(), figure, robot, &plotted, Style { theme, scale: view.scale })
            .map_err(|error| Failure::new(error.to_string()).into())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_view_names_what_it_does_not_know() {
        let error = serde_json::from_str::<View>(r#"{"shown":[],"dark":false,"scale":1,"zoom":2}"#).unwrap_err();
        assert!(error.to_string().contains("zoom"), "{error}");
    }
}
