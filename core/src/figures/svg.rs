//! A figure as an SVG document, sharper than a pixel.
//!
//! Plotters' coordinates are whole pixels; drawing four times as large and letting the view box shrink the picture gives
//! curves a quarter of a pixel.

use super::{DrawError, Figure, PlottedRun, View, draw};
use crate::robots::RobotData;
use plotters::prelude::*;

/// Drawing units per layout pixel.
const UNITS: u32 = 4;

/// A figure as an SVG document of its natural size, whatever the view's scale.
pub fn svg(figure: Figure, robot: &RobotData, runs: &[PlottedRun<'_>], view: &View<'_>) -> Result<String, DrawError> {
    let (width, height) = figure.natural_size();
    let mut view = *view;
    view.style.scale = f64::from(UNITS);
    let mut document = String::new();
    {
        let mut backend = SVGBackend::with_string(&mut document, (width * UNITS, height * UNITS));
        draw(&mut backend, figure, robot, runs, &view)?;
        backend.present()?;
    }
    let drawn = format!("<svg width=\"{}\" height=\"{}\"", width * UNITS, height * UNITS);
    debug_assert!(document.starts_with(&drawn), "the backend writes another header");
    Ok(document.replacen(&drawn, &format!("<svg width=\"{width}\" height=\"{height}\""), 1))
}
