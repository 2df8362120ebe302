//! The core in the browser: a thin facade that turns JSON text and typed arrays into the core's types and back.
//!
//! `describe` says what exists, `check` and `resolve` validate, `Run` advances a simulation in a worker; `Runs` holds what is
//! shown, `draw_figure` draws it on the main thread, `read_figure` gives it in numbers, `export_svg` to keep. No physics and
//! no page here: the page's behaviour is in `static/js`.

mod arm;
#[cfg(target_arch = "wasm32")]
mod canvas;
mod claims;
mod describe;
mod failure;
mod feedback;
mod plotter;
mod run;
mod runs;
mod view;

pub use arm::{arm_paths, arm_pose};
pub use claims::claims;
pub use describe::describe;
pub use feedback::sliding_rms;
pub use plotter::{export_svg, figure_height, read_figure, torque_summary};
pub use run::{Run, check, resolve};
pub use runs::Runs;
