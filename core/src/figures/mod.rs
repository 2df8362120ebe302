//! The study's figures, drawn through any plotters backend: canvas in the browser, SVG and PNG on the server.
//!
//! `figure` says which there are, `panels` what each shows, `draw` and `panel` how that looks, `readout` what it says in
//! numbers; `experiment` draws what experiments show. One code for all targets.

mod axes;
mod decimate;
mod draw;
mod experiment;
mod figure;
mod legend;
mod panel;
mod panels;
mod path;
mod readout;
mod run;
mod style;
mod surface;
mod svg;
mod ticks;
mod view;

pub use draw::draw;
pub use experiment::{ExperimentFigure, Shown, draw_experiment, experiment_metrics, experiment_svg};
pub use figure::Figure;
pub use panel::PanelPlace;
pub use panels::Key;
pub use path::Path;
pub use readout::{PanelReading, Reading, Value, read};
pub use run::PlottedRun;
pub use style::{Dash, Rgb, Style, Theme, scheme_style, torque_style};
pub use surface::{DrawError, Stroke, Surface};
pub use svg::svg;
pub use view::{AxisKind, Texts, View};
