//! Debian's own Rust as a compiler for the browser: it has no wasm32 standard library, but the sources to compile one.
//!
//! The sources' dependencies come from the crate registry like any other. Another toolchain's cargo runs us, so its
//! variables are hidden from Debian's; builds go to a folder of their own, because two compilers cannot share one.

use std::env;
use std::path::{Path, PathBuf};
use std::process::Command;

use super::{RUSTFLAGS, TARGET, sysroot};
use crate::tools;
use crate::workspace::Workspace;

/// The Rust that Debian keeps as new as its browsers need, its sources, and a linker of the same LLVM.
pub(super) const PACKAGES: [&str; 4] = ["rustc-web", "cargo-web", "rust-web-src", "lld-22"];

const RUSTC: &str = "/usr/bin/rustc";
const CARGO: &str = "/usr/bin/cargo";

/// Debian's compiler, complete and new enough.
pub(crate) struct DebianRust {
    linker: PathBuf,
}

impl DebianRust {
    /// Debian's compiler if it is here, new enough for the workspace, and has its sources and a linker.
    pub(super) fn find(workspace: &Workspace) -> Option<Self> {
        if !Path::new(RUSTC).is_file() || !Path::new(CARGO).is_file() {
            return None;
        }
        let version = tools::capture(Command::new(RUSTC).arg("-vV")).ok()?;
        let sysroot = sysroot(RUSTC)?;
        let has_sources = sysroot.join("lib/rustlib/src/rust/library/Cargo.lock").is_file();
        if !has_sources || !is_at_least(&version, &workspace.rust_version) {
            return None;
        }
        // A linker of the compiler's own LLVM reads its bitcode; a newer one does too.
        let same_llvm = format!("wasm-ld-{}", field(&version, "LLVM version")?.split('.').next()?);
        let linker = [&same_llvm, "wasm-ld-22"]
            .into_iter()
            .find_map(tools::find_program)
            .or_else(|| rust_lld(&sysroot, &version))?;
        Some(Self { linker })
    }

    /// `cargo build` for the browser with this compiler.
    pub(super) fn build(&self, workspace: &Workspace) -> Command {
        let mut command = Command::new(CARGO);
        for (name, _) in env::vars_os() {
            if misleads_another_toolchain(&name.to_string_lossy()) {
                command.env_remove(name);
            }
        }
        command
            .current_dir(&workspace.root)
            .env("CARGO_TARGET_DIR", target(workspace))
            .env("RUSTC", RUSTC)
            .env("CARGO_ENCODED_RUSTFLAGS", RUSTFLAGS)
            // `-Z` on a release compiler: the one unstable thing we ask for is to compile the standard library.
            .env("RUSTC_BOOTSTRAP", "1")
            .env("CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER", &self.linker)
            .args(["build", "--locked", "-Zbuild-std=std,panic_abort", "--target", TARGET]);
        command
    }
}

/// Where this compiler's builds go.
pub(super) fn target(workspace: &Workspace) -> PathBuf {
    workspace.target.join("wasm-debian")
}

fn rust_lld(sysroot: &Path, version: &str) -> Option<PathBuf> {
    let path = sysroot.join("lib/rustlib").join(field(version, "host")?).join("bin/rust-lld");
    path.is_file().then_some(path)
}

/// The value of `name: value` in what `rustc -vV` prints.
fn field<'a>(version: &'a str, name: &str) -> Option<&'a str> {
    version.lines().find_map(|line| line.strip_prefix(name)?.strip_prefix(": "))
}

/// Whether the compiler that printed `version` is `minimum` or newer; both read as `major.minor`.
fn is_at_least(version: &str, minimum: &str) -> bool {
    let numbers = |text: &str| {
        let mut parts = text.split('.').map(|part| part.parse::<u32>().ok());
        Some((parts.next()??, parts.next()??))
    };
    match (field(version, "release").and_then(numbers), numbers(minimum)) {
        (Some(found), Some(wanted)) => found >= wanted,
        _ => false,
    }
}

/// Whether a variable describes the toolchain or package that runs us and would mislead Debian's.
///
/// `RUSTFLAGS` is among them: flags chosen for this host's processor do not compile for the browser. What says where
/// crates come from, how many jobs to run and how to print stays.
fn misleads_another_toolchain(name: &str) -> bool {
    const KEPT: [&str; 8] = [
        "CARGO_HOME",
        "CARGO_NET_",
        "CARGO_HTTP_",
        "CARGO_REGISTR",
        "CARGO_SOURCE_",
        "CARGO_TERM_",
        "CARGO_BUILD_JOBS",
        "RUST_BACKTRACE",
    ];
    let concerns_rust = name.starts_with("CARGO") || name.starts_with("RUST") || name == "LD_LIBRARY_PATH";
    concerns_rust && !KEPT.iter().any(|kept| name.starts_with(kept))
}

#[cfg(test)]
mod tests {
    use super::*;

    const VERSION: &str = "rustc 1.96.0 (ac68faa20 2026-05-25) (built from a source tarball)\nbinary: rustc\n\
        host: x86_64-unknown-linux-gnu\nrelease: 1.96.0\nLLVM version: 22.1.8\n";

    #[test]
    fn versions_compare_as_numbers() {
        assert!(is_at_least(VERSION, "1.95"));
        assert!(is_at_least(VERSION, "1.96"));
        assert!(!is_at_least(VERSION, "1.100"));
        assert!(!is_at_least("no version", "1.95"));
    }

    #[test]
    fn the_compiler_tells_its_host_and_llvm() {
        assert_eq!(field(VERSION, "host"), Some("x86_64-unknown-linux-gnu"));
        assert_eq!(field(VERSION, "LLVM version"), Some("22.1.8"));
    }

    #[test]
    fn only_what_names_the_other_toolchain_is_hidden_from_debians() {
        for name in ["CARGO", "CARGO_PKG_NAME", "CARGO_TARGET_DIR", "RUSTUP_TOOLCHAIN", "RUSTC_WRAPPER", "RUSTFLAGS"] {
            assert!(misleads_another_toolchain(name), "{name}");
        }
        for name in ["CARGO_HOME", "CARGO_NET_OFFLINE", "CARGO_REGISTRIES_CRATES_IO_PROTOCOL", "PATH", "HOME"] {
            assert!(!misleads_another_toolchain(name), "{name}");
        }
    }
}
