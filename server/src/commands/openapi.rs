//! `adaptarm openapi`: the description of the HTTP API, for generators of clients.

use super::Failure;
use crate::openapi;
use crate::stdout::print;

pub(super) fn run() -> Result<(), Failure> {
    let text = serde_json::to_string_pretty(openapi::document()).map_err(Failure::system)?;
    Ok(print(&(text + "\n"))?)
}
