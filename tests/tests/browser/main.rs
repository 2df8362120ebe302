//! The page in a real Chromium.
fn main() {}
