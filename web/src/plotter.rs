//! Draws the core's figures on the page's canvases. Holds the latest samples of each scheme; needs the main thread.

use crate::failure::Failure;
use adaptarm_core::recording::{Columns, Recording};
use adaptarm_core::robots::ROBOTS;
use adaptarm_core::scenario::Scheme;
use std::collections::BTreeMap;
use wasm_bindgen::prelude::wasm_bindgen;

/// A run that is shown.
#[cfg_attr(not(target_arch = "wasm32"), expect(dead_code, reason = "read only where there is a canvas"))]
struct Shown {
    recording: Recording,
    completed: bool,
    theta_true: Vec<f64>,
}

/// The latest runs and how to draw them.
#[wasm_bindgen]
#[derive(Default)]
pub struct Plotter {
    /// By the scheme's place in [`Scheme::ALL`], which is also the order of drawing.
    runs: BTreeMap<usize, Shown>,
}

#[wasm_bindgen]
impl Plotter {
    /// Without runs.
    #[wasm_bindgen(constructor)]
    pub fn new() -> Self {
        Self::default()
    }

    /// Replaces a scheme's samples by `rows` as `Run.rows` gives them; `completed` is false for a diverged run,
    /// `theta_true` its arm's parameters. Throws on a scheme that does not exist.
    pub fn set_run(
        &mut self,
        scheme: &str,
        rows: Vec<f64>,
        completed: bool,
        theta_true: Vec<f64>,
    ) -> Result<(), wasm_bindgen::JsValue> {
        // The one robot so far.
        let robot = ROBOTS[0];
        let columns = Columns { joints: robot.joint_count(), parameters: robot.parameter_count() };
        let recording = Recording::from_rows(columns, rows)
            .ok_or_else(|| Failure::new("the samples end in the middle of a row".to_owned()))?;
        self.runs.insert(place(scheme)?, Shown { recording, completed, theta_true });
        Ok(())
    }

    /// Forgets a scheme's samples: it is no longer drawn.
    pub fn clear(&mut self, scheme: &str) -> Result<(), wasm_bindgen::JsValue> {
        self.runs.remove(&place(scheme)?);
        Ok(())
    }
}

fn place(scheme: &str) -> Result<usize, Failure> {
    Scheme::ALL
        .iter()
        .position(|candidate| candidate.id() == scheme)
        .ok_or_else(|| Failure::new(format!("{scheme:?} is not a scheme")))
}

#[cfg(target_arch = "wasm32")]
mod drawing {
    use super::{Failure, Plotter, ROBOTS, Scheme, wasm_bindgen};
    use crate::canvas::Canvas;
    use adaptarm_core::figures::{self, Figure, PlottedRun, Style, Theme};
    use plotters::prelude::IntoDrawingArea;
    use wasm_bindgen::JsValue;
    use web_sys::HtmlCanvasElement;

    #[wasm_bindgen]
    impl Plotter {
        /// Draws a figure over the whole canvas, whose size in device pixels is the caller's choice; `schemes` names the
        /// runs to show, `scale` is device pixels per layout pixel. Throws JSON text `{pointer, message}`.
        pub fn draw(
            &self,
            canvas: HtmlCanvasElement,
            figure: &str,
            schemes: Vec<String>,
            dark: bool,
            scale: f64,
        ) -> Result<(), JsValue> {
            let figure = Figure::from_id(figure).ok_or_else(|| Failure::new(format!("{figure:?} is not a figure")))?;
            let backend = Canvas::new(canvas).ok_or_else(|| Failure::new("the canvas cannot be drawn on"))?;
            let shown = self.runs.iter().filter(|(place, _)| schemes.iter().any(|id| id == Scheme::ALL[**place].id()));
            let runs: Vec<_> = shown
                .map(|(place, run)| PlottedRun {
                    scheme: Scheme::ALL[*place],
                    recording: &run.recording,
                    completed: run.completed,
                    theta_true: &run.theta_true,
                })
                .collect();
            let theme = if dark { Theme::Dark } else { Theme::Light };
            figures::draw(&backend.into_drawing_area(), figure, ROBOTS[0], &runs, Style { theme, scale })
                .map_err(|error| Failure::new(error.to_string()).into())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn schemes_are_known_by_their_identifiers() {
        assert_eq!(place("tang_arteaga"), Ok(1));
        assert!(place("pid").unwrap_err().message.contains("pid"));
    }
}
