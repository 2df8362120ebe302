//! What a server is started with, and the limits it keeps. Only values; the command line fills them in.

use std::net::SocketAddr;
use std::path::PathBuf;
use std::time::Duration;

/// Settings of one server.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Config {
    /// Address to listen on; port 0 means any free port.
    pub bind: SocketAddr,
    /// Folder reserved for results; nothing is stored in it yet.
    pub data: Option<PathBuf>,
    /// How many studies may wait or run, and how many finished ones are kept.
    pub capacity: Capacity,
}

/// Bounds on what is held in memory.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Capacity {
    /// Jobs waiting or running; one more is refused.
    pub unfinished: usize,
    /// Finished jobs that can still be read; the oldest makes room.
    pub finished: usize,
    /// Recordings of finished jobs that can still be read, bytes; the oldest make room.
    pub recording_bytes: usize,
}

impl Default for Capacity {
    fn default() -> Self {
        Self { unfinished: 64, finished: 256, recording_bytes: 256 << 20 }
    }
}

/// Largest document read from a file, standard input or a request body, bytes.
pub const DOCUMENT_BYTES: usize = 1 << 20;

/// Longest time for a request's headers to arrive.
pub const HEADER_TIMEOUT: Duration = Duration::from_secs(10);

/// Longest time to read a request's body and answer it.
pub const REQUEST_TIMEOUT: Duration = Duration::from_secs(30);

/// Longest time that a shutdown waits for answers under way.
pub const DRAIN_TIMEOUT: Duration = Duration::from_secs(10);

/// Connections served at a time; more wait to be accepted.
pub const CONNECTIONS: usize = 512;
