//! The core in the browser: a thin facade that turns JSON text and typed arrays into the core's types and back.
//!
//! `describe` says what exists, `check` and `resolve` validate, `Run` advances a simulation in a worker; `Runs` holds what is
//! shown, `draw_figure` draws it on the main thread, `read_figure` gives it in numbers, `export_svg` to keep. `Exercise` makes
//! runs of gains and a grade of reports, in a module of its own that the playground does not load. No physics and no page
//! here: the page's behaviour is in `static/js`.

#[cfg(feature = "playground")]
mod arm;
#[cfg(all(target_arch = "wasm32", feature = "playground"))]
mod canvas;
#[cfg(feature = "playground")]
mod claims;
#[cfg(feature = "playground")]
mod describe;
#[cfg(feature = "exercise")]
mod exercise;
mod failure;
#[cfg(feature = "playground")]
mod feedback;
#[cfg(feature = "playground")]
mod plotter;
#[cfg(feature = "playground")]
mod run;
#[cfg(feature = "playground")]
mod runs;
#[cfg(feature = "playground")]
mod view;

#[cfg(feature = "playground")]
pub use arm::{arm_paths, arm_pose};
#[cfg(feature = "playground")]
pub use claims::claims;
#[cfg(feature = "playground")]
pub use describe::describe;
#[cfg(feature = "exercise")]
pub use exercise::Exercise;
#[cfg(feature = "playground")]
pub use feedback::sliding_rms;
#[cfg(feature = "playground")]
pub use plotter::{export_svg, figure_height, read_figure, torque_summary};
#[cfg(feature = "playground")]
pub use run::{Run, check, resolve};
#[cfg(feature = "playground")]
pub use runs::Runs;
