//! A virtual environment in `target/python` with the Python packages that tests use, at the versions that
//! `tests/python/requirements.txt` pins.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result};

use crate::requirement::Requirement;
use crate::workspace::Workspace;
use crate::{debian, tools};

pub(crate) const PYTHON: Requirement = Requirement {
    name: "PYTHON",
    purpose: "tests in Python",
    needs: "Python 3.11 or newer as `python3`, with its module venv",
    packages: &["python3", "python3-venv"],
};

const REQUIREMENTS: &str = "tests/python/requirements.txt";
/// What `cargo xtask bench --peers` adds to the same environment.
const PEERS_REQUIREMENTS: &str = "benches/peers/requirements.txt";

/// Exits with success in an interpreter that can make environments and run the pinned packages.
const PROBE: &str = "import ensurepip, sys, venv; sys.exit(sys.version_info < (3, 11))";

/// Makes the environment, or brings it up to date; says what to install where that is impossible.
pub(crate) fn ensure(workspace: &Workspace) -> Result<()> {
    if is_current(workspace)? {
        return Ok(());
    }
    PYTHON.settle(prepare(workspace))
}

/// Makes the environment as for tests, and adds the packages of the peers that the benchmark compares us with.
pub(crate) fn ensure_peers(workspace: &Workspace) -> Result<()> {
    if !is_current(workspace)? {
        prepare(workspace)?;
    }
    // Inside the environment, so that it goes when that is made anew.
    let stamp = folder(workspace).join("requirements-peers.txt");
    let wanted = read(workspace, PEERS_REQUIREMENTS)?;
    if fs::read_to_string(&stamp).ok().as_ref() == Some(&wanted) {
        return Ok(());
    }
    eprintln!("Installing Python packages for peers into {}", folder(workspace).display());
    install(workspace, PEERS_REQUIREMENTS)?;
    fs::write(stamp, wanted).context("cannot note which packages are installed")
}

/// The environment's interpreter.
pub(crate) fn interpreter(workspace: &Workspace) -> PathBuf {
    let inside = if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" };
    folder(workspace).join(inside)
}

/// The script of axe-core, which one of the packages bundles.
pub(crate) fn axe(workspace: &Workspace) -> Option<PathBuf> {
    let versions = fs::read_dir(folder(workspace).join("lib")).into_iter().flatten().flatten();
    let libraries = versions.map(|entry| entry.path()).chain([folder(workspace).join("Lib")]);
    let mut scripts = libraries.map(|library| library.join("site-packages/axe_playwright_python/axe.min.js"));
    scripts.find(|script| script.is_file())
}

fn folder(workspace: &Workspace) -> PathBuf {
    workspace.target.join("python")
}

/// A copy of the requirements that the environment was made from; written last.
fn stamp(workspace: &Workspace) -> PathBuf {
    folder(workspace).join("requirements.txt")
}

fn requirements(workspace: &Workspace) -> Result<String> {
    read(workspace, REQUIREMENTS)
}

fn read(workspace: &Workspace, file: &str) -> Result<String> {
    fs::read_to_string(workspace.root.join(file)).with_context(|| format!("cannot read {file}"))
}

/// Installs exactly what `file` pins.
fn install(workspace: &Workspace, file: &str) -> Result<()> {
    let mut pip = Command::new(interpreter(workspace));
    pip.args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--no-deps", "--requirement"]);
    tools::run(pip.arg(workspace.root.join(file)))
}

/// Whether the environment has what is pinned, and its interpreter has not been removed from under it.
pub(crate) fn is_current(workspace: &Workspace) -> Result<bool> {
    let installed = fs::read_to_string(stamp(workspace)).ok();
    Ok(installed == Some(requirements(workspace)?)
        && tools::succeeds(Command::new(interpreter(workspace)).arg("--version")))
}

fn prepare(workspace: &Workspace) -> Result<()> {
    if find().is_none() {
        PYTHON.install_or_explain(|| debian::install(PYTHON.packages, PYTHON.purpose))?;
    }
    let python = find().with_context(|| format!("{} need {}", PYTHON.purpose, PYTHON.needs))?;
    eprintln!("Installing Python packages for tests into {}", folder(workspace).display());
    tools::run(Command::new(python).args(["-m", "venv", "--clear"]).arg(folder(workspace)))?;
    install(workspace, REQUIREMENTS)?;
    fs::write(stamp(workspace), requirements(workspace)?).context("cannot note which packages are installed")
}

/// An interpreter that can make the environment. The one on PATH may be someone's own, without what Debian's has.
fn find() -> Option<PathBuf> {
    let on_path = tools::find_program("python3");
    on_path
        .into_iter()
        .chain([Path::new("/usr/bin/python3").to_path_buf()])
        .find(|python| tools::succeeds(Command::new(python).args(["-c", PROBE])))
}
