//! Installing Debian packages, when we are root on Debian, and the command to show when we are not.
//!
//! Nothing is installed that is there already, and what will be installed is said first.

use std::fs;
use std::process::Command;
use std::sync::OnceLock;

use anyhow::{Context, Result};

use crate::tools;

/// Whether `apt-get install` can work here: Debian itself, apt present, root.
pub(crate) fn can_install() -> bool {
    is_debian() && tools::find_program("apt-get").is_some() && is_root()
}

/// The install command, for a message to someone who must run it.
pub(crate) fn install_command(packages: &[&str]) -> String {
    format!("apt-get install -y --no-install-recommends {}", packages.join(" "))
}

/// Installs those of `packages` that are missing, after saying which and what for.
pub(crate) fn install(packages: &[&str], purpose: &str) -> Result<()> {
    let missing: Vec<&str> = packages.iter().copied().filter(|package| !is_installed(package)).collect();
    if missing.is_empty() {
        return Ok(());
    }
    eprintln!("Installing Debian packages for {purpose}: {}", missing.join(" "));
    update_lists_once()?;
    tools::run(apt_get().args(["install", "-y", "--no-install-recommends"]).args(&missing))
        .with_context(|| format!("Debian could not install what {purpose} needs"))
}

/// A fresh container has no package lists; a long-lived machine has stale ones.
fn update_lists_once() -> Result<()> {
    static UPDATED: OnceLock<()> = OnceLock::new();
    if UPDATED.get().is_none() {
        tools::run(apt_get().args(["update", "-q"]))?;
        UPDATED.get_or_init(|| ());
    }
    Ok(())
}

fn apt_get() -> Command {
    let mut command = Command::new("apt-get");
    // Another apt-get may be at work (unattended upgrades): wait for it instead of failing.
    command.env("DEBIAN_FRONTEND", "noninteractive").arg("-oDPkg::Lock::Timeout=300");
    command
}

fn is_installed(package: &str) -> bool {
    Command::new("dpkg-query")
        .args(["--show", "--showformat=${db:Status-Status}", package])
        .output()
        .is_ok_and(|output| output.status.success() && output.stdout == b"installed")
}

fn is_debian() -> bool {
    fs::read_to_string("/etc/os-release").is_ok_and(|text| names_debian(&text))
}

/// Only Debian itself: its derivatives name the packages differently or ship the browser as a snap.
fn names_debian(os_release: &str) -> bool {
    os_release.lines().any(|line| line.trim().replace('"', "") == "ID=debian")
}

fn is_root() -> bool {
    Command::new("id").arg("-u").output().is_ok_and(|output| output.stdout.trim_ascii() == b"0")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn debian_is_told_from_its_derivatives() {
        assert!(names_debian("PRETTY_NAME=\"Debian GNU/Linux 12\"\nID=debian\n"));
        assert!(names_debian("ID=\"debian\""));
        assert!(!names_debian("ID=ubuntu\nID_LIKE=debian\n"));
    }

    #[test]
    fn the_shown_command_is_complete() {
        assert_eq!(
            install_command(&["chromium", "chromium-driver"]),
            "apt-get install -y --no-install-recommends chromium chromium-driver"
        );
    }
}
