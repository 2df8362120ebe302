//! The chromedriver process: found, started on a free port, stopped with its value.

use anyhow::{Context, Result};
use std::io::{BufRead, BufReader, Read};
use std::process::{Child, Command, Stdio};

const BROWSER: &str = "chromium";
const DRIVER: &str = "chromedriver";

/// The first of the two programs that is not on PATH.
pub fn missing() -> Option<&'static str> {
    let path = std::env::var_os("PATH").unwrap_or_default();
    let present = |program: &str| std::env::split_paths(&path).any(|folder| folder.join(program).is_file());
    [BROWSER, DRIVER].into_iter().find(|program| !present(program))
}

/// A running chromedriver.
#[derive(Debug)]
pub struct Driver {
    process: Child,
    /// Address, such as `http://127.0.0.1:41234`.
    pub url: String,
}

impl Driver {
    /// Starts a driver and waits until it says on which port.
    pub fn start() -> Result<Self> {
        let mut process = Command::new(DRIVER)
            .arg("--port=0")
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .with_context(|| format!("cannot start {DRIVER}"))?;
        let mut output = BufReader::new(process.stdout.take().context("the driver has no standard output")?);
        let mut line = String::new();
        while output.read_line(&mut line)? > 0 {
            if let Some((_, port)) = line.trim().trim_end_matches('.').rsplit_once("started successfully on port ") {
                let url = format!("http://127.0.0.1:{port}");
                // Nothing may block the driver by not reading what it prints.
                std::thread::spawn(move || output.read_to_end(&mut Vec::new()));
                return Ok(Self { process, url });
            }
            line.clear();
        }
        anyhow::bail!("the driver ended before it listened: {}", process.wait()?);
    }
}

impl Drop for Driver {
    fn drop(&mut self) {
        // It may have ended already; either way it is gone.
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}
