//! What `cargo xtask test` says about this machine and this run, through variables of the environment.

use anyhow::{Context, Result, bail};
use std::path::PathBuf;
use std::process::Command;
use std::time::Duration;

/// Path of the binary under test: `ADAPTARM_BIN`.
pub fn binary() -> Result<PathBuf> {
    let path = std::env::var_os("ADAPTARM_BIN")
        .map(PathBuf::from)
        .context("ADAPTARM_BIN does not name the adaptarm binary; run the tests with `cargo xtask test`")?;
    if !path.is_file() {
        bail!("ADAPTARM_BIN names {}, which is not a file", path.display());
    }
    Ok(path)
}

/// Folder of PostgreSQL's programs: `ADAPTARM_POSTGRES`.
pub fn postgres_programs() -> Option<PathBuf> {
    std::env::var_os("ADAPTARM_POSTGRES").map(PathBuf::from).filter(|folder| folder.join("initdb").is_file())
}

/// Interpreter with the packages of `tests/python/requirements.txt`: `ADAPTARM_PYTHON`.
pub fn python() -> Option<PathBuf> {
    std::env::var_os("ADAPTARM_PYTHON").map(PathBuf::from).filter(|program| program.is_file())
}

/// Whether the long forms of tests are asked for: `ADAPTARM_SOAK`.
pub fn soak() -> bool {
    switched_on("ADAPTARM_SOAK")
}

/// How long to wait for what is promised within a time: that time in the long forms; in the short ones, beside which other
/// tests run, and on who knows what machine, four times as long.
pub fn promised(time: Duration) -> Duration {
    if soak() { time } else { 4 * time }
}

/// Whether we may do what root may.
pub fn is_root() -> bool {
    Command::new("id").arg("-u").output().is_ok_and(|output| output.stdout.trim_ascii() == b"0")
}

/// Whether a process of ours can have a file system of its own.
pub fn can_mount() -> bool {
    let mount = "mount -t tmpfs -o size=64k tmpfs /mnt";
    is_root()
        && Command::new("unshare")
            .args(["--mount", "sh", "-c", mount])
            .output()
            .is_ok_and(|output| output.status.success())
}

/// Whether a variable is set to anything but nothing, `0` or `false`.
pub fn switched_on(variable: &str) -> bool {
    std::env::var(variable).is_ok_and(|value| !matches!(value.as_str(), "" | "0" | "false"))
}
