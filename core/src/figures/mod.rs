//! The study's figures, drawn through any plotters backend: canvas in the browser, SVG and PNG on the server.
//!
//! `panels` decides what a figure shows, `draw` how a panel looks, `style` its colours and sizes. One code for all targets.

mod axes;
mod decimate;
mod draw;
mod legend;
mod panels;
mod pen;
mod style;
mod svg;

pub use draw::draw;
pub use panels::{Figure, PlottedRun};
pub use pen::DrawError;
pub use style::{Dash, Rgb, Style, Theme, scheme_style};
pub use svg::svg;
