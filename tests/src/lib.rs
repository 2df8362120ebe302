//! What every end-to-end test needs: the built `adaptarm` binary, and a server of it on a free port.

use anyhow::{Context, Result, bail};
use std::io::{BufRead, BufReader, Read};
use std::path::PathBuf;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

/// Path of the binary under test: `ADAPTARM_BIN`, which `cargo xtask test` sets.
pub fn binary() -> Result<PathBuf> {
    let path = std::env::var_os("ADAPTARM_BIN")
        .map(PathBuf::from)
        .context("ADAPTARM_BIN does not name the adaptarm binary; run the tests with `cargo xtask test`")?;
    if !path.is_file() {
        bail!("ADAPTARM_BIN names {}, which is not a file", path.display());
    }
    Ok(path)
}

/// A running server; it dies with this value.
#[derive(Debug)]
pub struct Server {
    child: Child,
    /// Address, such as `http://127.0.0.1:41234`.
    pub url: String,
    /// Its data folder; removed with this value.
    pub data: tempfile::TempDir,
}

impl Server {
    /// Starts `adaptarm serve` on a free port with a fresh data folder and waits for the line that names its address.
    pub fn start(arguments: &[&str]) -> Result<Self> {
        let data = tempfile::tempdir()?;
        let mut child = Command::new(binary()?)
            .args(["serve", "--bind", "127.0.0.1:0", "--data"])
            .arg(data.path())
            .args(arguments)
            // A line per request would bury what a failing test says.
            .env("RUST_LOG", std::env::var_os("RUST_LOG").unwrap_or_else(|| "warn".into()))
            .stdout(Stdio::piped())
            .spawn()?;
        let mut stdout = BufReader::new(child.stdout.take().context("the server has no standard output")?);
        let mut line = String::new();
        while stdout.read_line(&mut line)? > 0 {
            if let Some(start) = line.find("http://") {
                let url = line[start..].trim().to_owned();
                // Nothing may block the server by not reading what it prints.
                std::thread::spawn(move || stdout.read_to_end(&mut Vec::new()));
                return Ok(Self { child, url, data });
            }
            line.clear();
        }
        bail!("the server ended before it listened: {}", child.wait()?);
    }

    /// Process identifier, for signals.
    pub fn id(&self) -> u32 {
        self.child.id()
    }

    /// How it ended, once it has, which must be within this time.
    pub fn wait(&mut self, within: Duration) -> Result<ExitStatus> {
        let deadline = Instant::now() + within;
        while Instant::now() < deadline {
            if let Some(status) = self.child.try_wait()? {
                return Ok(status);
            }
            std::thread::sleep(Duration::from_millis(10));
        }
        bail!("the server still runs after {within:?}");
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        // It may have ended already, by a test's own doing.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
