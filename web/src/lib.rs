//! The browser facade.
use wasm_bindgen::prelude::*;
/// Stub.
#[wasm_bindgen]
pub fn version() -> String {
    "0".into()
}
