//! The core in the browser: a thin facade that turns JSON text and typed arrays into the core's types and back.
//!
//! `describe` says what exists, `check` validates, `Run` advances a simulation in a worker, `Plotter` draws on the main
//! thread. No physics and no page here: the page's behaviour is in `static/js`.

#[cfg(target_arch = "wasm32")]
mod canvas;
mod describe;
mod failure;
mod plotter;
mod run;

pub use describe::describe;
pub use plotter::Plotter;
pub use run::{Run, check};
