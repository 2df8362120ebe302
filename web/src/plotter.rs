//! The core's figures for the page: on its canvases, as documents to keep, and in numbers.

use crate::failure::Failure;
use crate::runs::Runs;
use crate::view::{Scene, ViewDocument, figure};
use adaptarm_core::decomposition::TorquePart;
use adaptarm_core::figures::{self, Key, PanelReading, Value};
use serde_json::json;
use wasm_bindgen::JsValue;
use wasm_bindgen::prelude::wasm_bindgen;

/// What a figure shows at the recorded sample nearest to `time_s`, as JSON text:
///
/// `{"time_s", "panels": [{"label", "x_label", "reference", "values": [{"id", "value", "x"}]}]}`. Values are in the label's
/// unit; `id` is the run's, or in a figure of one run's parts the part's or `total`. `value` is null where a run had ended by
/// then, `x_label` and `x` where the panel is drawn over time, `reference` (true parameter, desired angle) where there is
/// none. Throws JSON text `{pointer, message}`.
#[wasm_bindgen]
pub fn read_figure(runs: &Runs, figure_id: &str, view_json: &str, time_s: f64) -> Result<String, JsValue> {
    Ok(read(runs, figure_id, view_json, time_s)?)
}

/// A figure as an SVG document of its natural size. Throws JSON text `{pointer, message}`.
#[wasm_bindgen]
pub fn export_svg(runs: &Runs, figure_id: &str, view_json: &str) -> Result<String, JsValue> {
    Ok(svg(runs, figure_id, view_json)?)
}

/// Height in layout pixels that suits a figure of this width. Throws JSON text `{pointer, message}`.
#[wasm_bindgen]
pub fn figure_height(figure_id: &str, width: f64) -> Result<f64, JsValue> {
    Ok(figure(figure_id)?.height_at(width))
}

/// How large each part of a run's torques is, as JSON text `{"parts": ["inertia", ...], "rms_nm": [[...] per joint]}`: root
/// mean squares over the samples, N·m. Throws JSON text `{pointer, message}` if there is no such run.
#[wasm_bindgen]
pub fn torque_summary(runs: &Runs, id: &str) -> Result<String, JsValue> {
    Ok(summary(runs, id)?)
}

fn read(runs: &Runs, figure_id: &str, view_json: &str, time_s: f64) -> Result<String, Failure> {
    let (figure, document) = (figure(figure_id)?, ViewDocument::read(view_json)?);
    let scene = Scene::new(runs, figure, &document);
    let reading = figures::read(figure, scene.robot, &scene.runs, &scene.view, time_s);
    let id = |key| match key {
        Key::Run(run) => scene.ids[run],
        Key::Part(part) => TorquePart::ALL[part].id(),
        Key::Total => "total",
    };
    let value = |value: &Value| json!({ "id": id(value.key), "value": value.value, "x": value.x });
    let panel = |panel: &PanelReading| {
        json!({
            "label": panel.label,
            "x_label": panel.x_label,
            "reference": panel.reference,
            "values": panel.values.iter().map(value).collect::<Vec<_>>(),
        })
    };
    let panels: Vec<_> = reading.panels.iter().map(panel).collect();
    Ok(json!({ "time_s": reading.time_s, "panels": panels }).to_string())
}

fn svg(runs: &Runs, figure_id: &str, view_json: &str) -> Result<String, Failure> {
    let (figure, document) = (figure(figure_id)?, ViewDocument::read(view_json)?);
    let scene = Scene::new(runs, figure, &document);
    figures::svg(figure, scene.robot, &scene.runs, &scene.view).map_err(|error| Failure::new(error.to_string()))
}

fn summary(runs: &Runs, id: &str) -> Result<String, Failure> {
    let run = runs.get(id).ok_or_else(|| Failure::new(format!("there is no run {id:?}")))?;
    let rms = run.torque_parts().rms_nm(run.scenario.settings().samples);
    Ok(json!({ "parts": TorquePart::ALL.map(TorquePart::id), "rms_nm": rms }).to_string())
}

#[cfg(target_arch = "wasm32")]
mod drawing {
    use super::{Failure, Runs, Scene, ViewDocument, figure, figures};
    use crate::canvas::Canvas;
    use wasm_bindgen::JsValue;
    use wasm_bindgen::prelude::wasm_bindgen;
    use web_sys::HtmlCanvasElement;

    /// Draws a figure over the whole canvas, whose size in device pixels is the caller's choice; needs the main thread.
    ///
    /// Returns eight numbers per panel: left, top, right and bottom of its plotting area in device pixels of the canvas, what
    /// its left and right edge stand for (time in s; in the phase plane the panel's unit), and the values at its bottom and
    /// top. The horizontal axis is linear. So is the vertical one unless the view asks for `symlog` of a figure that has it:
    /// then it is linear in `asinh(y / 2c)`, where c is `10^(k − 3)` and `10^k` the power of ten at or above the larger of
    /// |bottom| and |top|. Throws JSON text `{pointer, message}`.
    #[wasm_bindgen]
    pub fn draw_figure(
        runs: &Runs,
        canvas: HtmlCanvasElement,
        figure_id: &str,
        view_json: &str,
    ) -> Result<js_sys::Float64Array, JsValue> {
        let (figure, document) = (figure(figure_id)?, ViewDocument::read(view_json)?);
        let scene = Scene::new(runs, figure, &document);
        let mut surface = Canvas::new(canvas).ok_or_else(|| Failure::new("the canvas cannot be drawn on"))?;
        let places = figures::draw(&mut surface, figure, scene.robot, &scene.runs, &scene.view)
            .map_err(|error| Failure::new(error.to_string()))?;
        let numbers: Vec<f64> = places.iter().flat_map(figures::PanelPlace::numbers).collect();
        Ok(js_sys::Float64Array::from(numbers.as_slice()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::failure;
    use serde_json::Value as Json;

    /// A run of the proposed scheme, short.
    fn runs() -> Runs {
        let json = r#"{"format":"adaptarm.scenario/1","scheme":{"kind":"proposed"},
            "integration":{"duration_s":0.1},"recording":{"samples":50}}"#;
        let run = failure::read(json).unwrap().run();
        let mut runs = Runs::new();
        runs.insert("pin-1", json, run.recording.rows().to_vec(), true).unwrap();
        runs
    }

    const VIEW: &str = r#"{"shown":[{"id":"gone"},{"id":"pin-1","label":"mine","faded":true}],"dark":true,"scale":2}"#;

    #[test]
    fn a_reading_names_runs_as_the_page_does() {
        let read =
            |figure, time_s| -> Json { serde_json::from_str(&read(&runs(), figure, VIEW, time_s).unwrap()).unwrap() };
        let errors = read("tracking_errors", 0.0512);
        assert_eq!(errors["panels"][2]["label"], "e3 [°]");
        assert_eq!(errors["panels"][2]["values"][0]["id"], "pin-1");
        assert!(errors["panels"][2]["values"][0]["value"].is_f64() && errors["panels"][0]["x_label"].is_null());
        assert_eq!(errors["panels"][0]["values"].as_array().unwrap().len(), 1, "a run that is gone is left out");
        let parts = read("torque_parts", 0.05);
        assert_eq!(parts["panels"][1]["values"][2]["id"], "gravity");
        assert_eq!(parts["panels"][1]["values"][5]["id"], "total");
    }

    #[test]
    fn a_summary_has_a_row_per_joint() {
        let summary: Json = serde_json::from_str(&summary(&runs(), "pin-1").unwrap()).unwrap();
        assert_eq!(summary["parts"].as_array().unwrap().len(), 5);
        assert_eq!(summary["rms_nm"].as_array().unwrap().len(), 3);
        assert!(summary["rms_nm"][1][2].as_f64().unwrap() > 1.0, "gravity pulls at the shoulder");
        assert!(super::summary(&runs(), "gone").is_err());
    }

    #[test]
    fn documents_have_the_legend_of_the_view() {
        let svg = svg(&runs(), "velocity_errors", VIEW).unwrap();
        assert!(svg.starts_with("<svg width=\"900\"") && svg.contains("mine"));
        assert!(super::svg(&runs(), "nonsense", VIEW).unwrap_err().message.contains("nonsense"));
    }
}
