//! The core in the browser: a thin facade that turns JSON text and typed arrays into the core's types and back.
//!
//! `describe` says what exists, `check` validates, `Run` advances a simulation in a worker; `Runs` holds what is shown and
//! `draw_figure` draws it, on the main thread. No physics and no page here: the page's behaviour is in `static/js`.

mod arm;
#[cfg(target_arch = "wasm32")]
mod canvas;
mod describe;
mod failure;
mod plotter;
mod run;
mod runs;

pub use arm::{arm_paths, arm_pose};
pub use describe::describe;
pub use run::{Run, check};
pub use runs::Runs;
