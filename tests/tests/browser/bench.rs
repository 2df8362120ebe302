//! What all trials share: one server, one driver, one runtime for the driver's client.

use crate::driver::Driver;
use adaptarm_tests::Server;
use anyhow::Result;
use std::path::PathBuf;

/// Server, driver and runtime; all end with this value.
#[derive(Debug)]
pub struct Bench {
    pub server: Server,
    pub driver: Driver,
    pub runtime: tokio::runtime::Runtime,
}

impl Bench {
    pub fn start() -> Result<Self> {
        Ok(Self {
            server: Server::start(&[])?,
            driver: Driver::start()?,
            runtime: tokio::runtime::Builder::new_current_thread().enable_all().build()?,
        })
    }
}

/// The repository's root.
pub fn repository() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Where screenshots go.
pub fn screenshots() -> Result<PathBuf> {
    let target = || std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| repository().join("target"), PathBuf::from);
    let folder = std::env::var_os("ADAPTARM_SCREENSHOTS").map_or_else(|| target().join("screenshots"), PathBuf::from);
    std::fs::create_dir_all(&folder)?;
    Ok(folder)
}
