//! Printing to standard output, where whoever reads may leave at any time.

use std::io::{self, Write};
use thiserror::Error;

/// Standard output cannot take what was printed.
#[derive(Debug, Error)]
#[error("cannot write to standard output: {0}")]
pub struct PrintError(io::Error);

/// Prints; nobody reading it any more is no failure.
pub fn print(text: &str) -> Result<(), PrintError> {
    let mut out = io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(PrintError(error)),
        _ => Ok(()),
    }
}
