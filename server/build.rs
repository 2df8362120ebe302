//! Embeds the page, `static/`, with the generated WebAssembly module if it has been built.
//!
//! A release, and any build with the feature `embed`, holds every file brotli-compressed; another build reads them from disk
//! at each request, so that editing a script needs no rebuild. Cargo looks into the whole folder for changes: a new file is
//! a change too.

use std::path::Path;
use std::{env, fs, io};

fn main() -> io::Result<()> {
    let variable = |name| env::var(name).map_err(io::Error::other);
    let folder = Path::new(&variable("CARGO_MANIFEST_DIR")?).join("../static");
    println!("cargo::rerun-if-changed={}", folder.display());
    let embed = variable("PROFILE")? == "release" || env::var_os("CARGO_FEATURE_EMBED").is_some();
    println!("cargo::rustc-check-cfg=cfg(embedded)");
    if embed {
        println!("cargo::rustc-cfg=embedded");
    }
    // Not `load_directory`: it prints every file as a warning.
    let assets = match folder.canonicalize() {
        Ok(folder) => {
            let out = variable("OUT_DIR")?;
            memory_serve::assets_to_code("page", &folder, Path::new(&out), embed, |_| {})
        }
        Err(error) if error.kind() == io::ErrorKind::NotFound => "&[]".to_owned(),
        Err(error) => return Err(error),
    };
    fs::write(Path::new(&variable("OUT_DIR")?).join("memory_serve_assets.rs"), format!("&[(\"default\", {assets})]"))
}
