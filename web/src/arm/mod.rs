//! The arm as a picture: where it is at an instant of a run, its solids, a camera, and WebGL2 to draw it with.
//!
//! `motion` reads runs, `body` and `mesh` make the solids, `camera` and `matrix` are the geometry of looking; none of these
//! knows a browser. `gl`, `shaders` and `scene` draw, and `view` is what the page holds. A page without WebGL2 draws lines
//! from `arm_pose` and `arm_paths` instead.

#[cfg(any(target_arch = "wasm32", test))]
mod body;
#[cfg(any(target_arch = "wasm32", test))]
mod camera;
#[cfg(target_arch = "wasm32")]
mod gl;
#[cfg(any(target_arch = "wasm32", test))]
mod matrix;
#[cfg(any(target_arch = "wasm32", test))]
mod mesh;
mod motion;
#[cfg(target_arch = "wasm32")]
mod scene;
#[cfg(target_arch = "wasm32")]
mod shaders;
mod view;

pub use motion::{arm_paths, arm_pose};
