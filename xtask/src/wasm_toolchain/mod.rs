//! A compiler that can build for the browser, on machines that differ in what they have.
//!
//! In order: the standard library for wasm32 is installed; rustup installs it; Debian's own Rust builds it from source;
//! else an error that says what to install. The first way that works is taken, and the choice needs no configuration.

mod debian_rust;

use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

use anyhow::{Result, bail};

use crate::workspace::Workspace;
use crate::{debian, tools};
use debian_rust::DebianRust;

const TARGET: &str = "wasm32-unknown-unknown";

/// Two numbers per instruction (docs/decisions/0010-simd128.md). Takes the place of all flags from elsewhere: those chosen
/// for this host's processor do not compile for the browser.
const RUSTFLAGS: &str = "-Ctarget-feature=+simd128";

/// The component is some 25 MB; a network that drops packets instead of refusing would hold us here for ever.
const RUSTUP_LIMIT: Duration = Duration::from_mins(3);

/// A way to compile for wasm32 that is ready to use.
pub(crate) enum WasmToolchain {
    /// The cargo that runs us has the standard library.
    Installed,
    /// Debian's cargo, which compiles the standard library too.
    Debian(DebianRust),
}

impl WasmToolchain {
    /// `cargo build` for the browser, ready for package and profile arguments, and the folder that receives profiles.
    pub(crate) fn build(&self, workspace: &Workspace) -> (Command, PathBuf) {
        match self {
            Self::Installed => {
                let mut command = workspace.cargo();
                command.env("CARGO_ENCODED_RUSTFLAGS", RUSTFLAGS).args(["build", "--locked", "--target", TARGET]);
                (command, workspace.target.join(TARGET))
            }
            Self::Debian(rust) => (rust.build(workspace), debian_rust::target(workspace).join(TARGET)),
        }
    }
}

/// Finds a way to compile for wasm32, installing what it needs.
pub(crate) fn ensure(workspace: &Workspace) -> Result<WasmToolchain> {
    match env::var("ADAPTARM_WASM_TOOLCHAIN").as_deref() {
        Err(_) | Ok("" | "auto") => first_that_works(workspace),
        Ok("installed") if has_standard_library() => Ok(WasmToolchain::Installed),
        Ok("installed") => bail!("this Rust has no standard library for {TARGET}"),
        Ok("rustup") => install_with_rustup(),
        Ok("debian") => install_with_debian(workspace),
        Ok(other) => bail!("ADAPTARM_WASM_TOOLCHAIN is `{other}`; it may be auto, installed, rustup or debian"),
    }
}

fn first_that_works(workspace: &Workspace) -> Result<WasmToolchain> {
    if has_standard_library() {
        return Ok(WasmToolchain::Installed);
    }
    // Its folder says that Debian's way was needed here before: do not wait for rustup to fail every time.
    if debian_rust::target(workspace).is_dir()
        && let Some(ready) = DebianRust::find(workspace)
    {
        return Ok(WasmToolchain::Debian(ready));
    }
    if tools::find_program("rustup").is_some() {
        match install_with_rustup() {
            Ok(ready) => return Ok(ready),
            Err(error) => {
                eprintln!("rustup could not install it ({error:#}); looking for another way");
            }
        }
    }
    let ready = install_with_debian(workspace)?;
    fs::create_dir_all(debian_rust::target(workspace))?;
    Ok(ready)
}

fn has_standard_library() -> bool {
    sysroot("rustc").is_some_and(|sysroot| {
        let folder = sysroot.join("lib/rustlib").join(TARGET).join("lib");
        let is_std = |path: &Path| {
            path.extension().is_some_and(|extension| extension == "rlib")
                && path.file_stem().is_some_and(|stem| stem.to_string_lossy().starts_with("libstd-"))
        };
        fs::read_dir(folder).is_ok_and(|entries| entries.flatten().any(|entry| is_std(&entry.path())))
    })
}

fn install_with_rustup() -> Result<WasmToolchain> {
    eprintln!("Installing Rust's standard library for {TARGET} with rustup");
    let mut rustup = Command::new("rustup");
    // A refusal is expected on closed networks and needs no stack trace.
    rustup.args(["target", "add", TARGET]).env_remove("RUST_BACKTRACE");
    tools::run_within(&mut rustup, RUSTUP_LIMIT)?;
    // A toolchain from elsewhere can be first on PATH although rustup exists.
    if !has_standard_library() {
        bail!("rustup succeeded, but the `rustc` on PATH still has no standard library for {TARGET}");
    }
    Ok(WasmToolchain::Installed)
}

fn install_with_debian(workspace: &Workspace) -> Result<WasmToolchain> {
    if let Some(ready) = DebianRust::find(workspace) {
        return Ok(WasmToolchain::Debian(ready));
    }
    if !debian::can_install() {
        bail!("{}", advice());
    }
    debian::install(&debian_rust::PACKAGES, "building for the browser")?;
    match DebianRust::find(workspace) {
        Some(ready) => Ok(WasmToolchain::Debian(ready)),
        None => bail!(
            "Debian's Rust is incomplete or older than {}, which this workspace needs; {}",
            workspace.rust_version,
            advice()
        ),
    }
}

fn advice() -> String {
    format!(
        "this Rust cannot compile for the browser. Install the standard library for {TARGET}, one of:\n  \
         rustup target add {TARGET}\n  on Debian, as root: {}\nand run the same command again",
        debian::install_command(&debian_rust::PACKAGES)
    )
}

fn sysroot(rustc: &str) -> Option<PathBuf> {
    let output = Command::new(rustc).args(["--print", "sysroot"]).output().ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    output.status.success().then(|| PathBuf::from(text.trim()))
}
