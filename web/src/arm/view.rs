//! What the page holds: an arm view on a canvas, drawn as the page says.

#[cfg(any(target_arch = "wasm32", test))]
use super::camera::Camera;
#[cfg(any(target_arch = "wasm32", test))]
use serde::Deserialize;

/// What to draw and how.
#[cfg(any(target_arch = "wasm32", test))]
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct View {
    /// Names of runs, one arm each, from left to right.
    pub arms: Vec<String>,
    /// The instant, s.
    pub time_s: f64,
    pub camera: Camera,
    /// On a dark page.
    pub dark: bool,
    /// Size of the canvas, device pixels.
    pub width: u32,
    pub height: u32,
    /// Device pixels per layout pixel: lines get wider with it.
    pub scale: f32,
    /// How many times as large as they are errors are drawn.
    pub exaggeration: f64,
}

#[cfg(target_arch = "wasm32")]
mod drawing {
    use super::super::scene::Scene;
    use super::View;
    use crate::failure::Failure;
    use crate::runs::Runs;
    use wasm_bindgen::JsValue;
    use wasm_bindgen::prelude::wasm_bindgen;
    use web_sys::HtmlCanvasElement;

    /// A canvas with arms.
    #[wasm_bindgen]
    pub struct ArmView {
        scene: Scene,
    }

    #[wasm_bindgen]
    impl ArmView {
        /// Takes a canvas, with multisampling if it is to be `smooth`. Throws JSON text `{pointer, message}` where there is no
        /// WebGL2 and where it fails. After a lost context another view is made on the same canvas, which stays as it was.
        #[wasm_bindgen(constructor)]
        pub fn new(canvas: &HtmlCanvasElement, smooth: bool) -> Result<Self, JsValue> {
            Ok(Self { scene: Scene::new(canvas, smooth).map_err(Failure::new)? })
        }

        /// Whether a processor does the graphics card's work, so that drawings should be few and small.
        #[wasm_bindgen(getter)]
        pub fn is_slow(&self) -> bool {
            self.scene.is_slow
        }

        /// Whether edges are smoothed without drawing more finely.
        #[wasm_bindgen(getter)]
        pub fn is_smooth(&self) -> bool {
            self.scene.is_smooth
        }

        /// Whether the latest drawing is still being made: another one would only wait behind it.
        #[wasm_bindgen(getter)]
        pub fn is_busy(&self) -> bool {
            self.scene.is_busy()
        }

        /// Draws; `view_json` is a [`View`]. Throws JSON text `{pointer, message}`.
        pub fn draw(&mut self, runs: &Runs, view_json: &str) -> Result<(), JsValue> {
            let view: View = serde_json::from_str(view_json).map_err(|error| Failure::new(error.to_string()))?;
            Ok(self.scene.draw(runs, &view).map_err(Failure::new)?)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_view_names_what_it_does_not_know() {
        let camera = r#""camera":{"yaw_rad":0,"pitch_rad":0.3,"zoom":1}"#;
        let rest = r#""arms":["a"],"time_s":1,"dark":true,"width":9,"height":9,"scale":2,"exaggeration":1"#;
        assert!(serde_json::from_str::<View>(&format!("{{{camera},{rest}}}")).is_ok());
        let error = serde_json::from_str::<View>(&format!("{{{camera},{rest},\"mood\":1}}")).unwrap_err();
        assert!(error.to_string().contains("mood"), "{error}");
    }
}
