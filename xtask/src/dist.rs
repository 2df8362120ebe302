//! The browser's modules: compile `web/` for wasm32, generate their JavaScript bindings, put all into `static/generated`.
//!
//! Two of one crate: the playground's, and what exercises need beside it, which would be a fifth more for every visitor.
//! Cargo decides what is up to date. Files are rewritten only when their content changes, because the server embeds that
//! folder and would be rebuilt by a newer date alone.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use wasm_bindgen_cli_support::Bindgen;

use crate::workspace::Workspace;
use crate::{DistArgs, tools, wasm_toolchain};

/// Paths below a folder, and what the files hold.
type Contents = BTreeMap<PathBuf, Vec<u8>>;

/// Each module's name and the crate's feature that it is made of.
const MODULES: [(&str, &str); 2] = [("adaptarm_exercise", "exercise"), ("adaptarm_web", "playground")];

pub(crate) fn run(workspace: &Workspace, args: &DistArgs) -> Result<()> {
    let mut generated = Contents::new();
    for (name, feature) in MODULES {
        let module = compile(workspace, feature, args)?;
        generated.append(&mut bindings(workspace, &module, name, args)?);
    }
    let folder = workspace.root.join("static/generated");
    let changed = synchronise(&generated, &folder)?;
    for (path, content) in &generated {
        let path = workspace.relative(&folder.join(path));
        println!("{:>8.1} kB  {path}", content.len() as f64 / 1000.0);
    }
    println!("{changed} of {} files changed", generated.len());
    Ok(())
}

/// Compiles the browser's crate with one of its features and returns the module's path, which is the same for each.
fn compile(workspace: &Workspace, feature: &str, args: &DistArgs) -> Result<PathBuf> {
    let (mut command, profiles) = wasm_toolchain::ensure(workspace)?.build(workspace);
    command.args(["--package", "adaptarm-web", "--lib", "--profile", "web", "--no-default-features"]);
    command.args(["--features", feature]);
    if args.debug_info {
        command.env("CARGO_PROFILE_WEB_DEBUG", "line-tables-only").env("CARGO_PROFILE_WEB_STRIP", "none");
    }
    tools::run(&mut command)?;
    Ok(profiles.join("web/adaptarm_web.wasm"))
}

/// Runs the generator in a folder of its own and returns what it wrote.
fn bindings(workspace: &Workspace, module: &Path, name: &str, args: &DistArgs) -> Result<Contents> {
    // One folder per process: two commands at a time must not read each other's half-written files.
    let staging = workspace.target.join(format!("bindings-{}", std::process::id()));
    let mut bindgen = Bindgen::new();
    bindgen
        .input_path(module)
        .out_name(name)
        .web(true)?
        .omit_default_module_path(false)
        .typescript(false)
        .keep_debug(args.debug_info)
        .remove_name_section(!args.debug_info)
        .remove_producers_section(!args.debug_info);
    let written = bindgen
        .generate(&staging)
        .with_context(|| format!("cannot generate bindings for {}", module.display()))
        .and_then(|()| read_folder(&staging));
    if staging.exists() {
        fs::remove_dir_all(&staging)?;
    }
    written
}

/// Makes `folder` hold exactly `wanted`, touching only files that differ; returns how many did.
fn synchronise(wanted: &Contents, folder: &Path) -> Result<usize> {
    fs::create_dir_all(folder)?;
    let present = read_folder(folder)?;
    let mut changed = 0;
    for (path, content) in wanted.iter().filter(|(path, content)| present.get(*path) != Some(content)) {
        let path = folder.join(path);
        if let Some(parent) = path.parent() {
            fs::create_dir_all(parent)?;
        }
        fs::write(&path, content).with_context(|| format!("cannot write {}", path.display()))?;
        changed += 1;
    }
    for path in present.keys().filter(|path| !wanted.contains_key(*path)) {
        fs::remove_file(folder.join(path))?;
        changed += 1;
    }
    Ok(changed)
}

/// All files below `folder`, by their path from it.
fn read_folder(folder: &Path) -> Result<Contents> {
    let mut contents = Contents::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(current) = folders.pop() {
        for entry in fs::read_dir(&current).with_context(|| format!("cannot read {}", current.display()))? {
            let path = entry?.path();
            if path.is_dir() {
                folders.push(path);
            } else {
                let content = fs::read(&path).with_context(|| format!("cannot read {}", path.display()))?;
                contents.insert(path.strip_prefix(folder)?.to_owned(), content);
            }
        }
    }
    Ok(contents)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_files_that_differ_are_touched_and_stale_ones_go() -> Result<()> {
        let folder = std::env::temp_dir().join(format!("adaptarm-dist-{}", std::process::id()));
        let content = |pairs: &[(&str, &str)]| -> Contents {
            pairs.iter().map(|(path, text)| (PathBuf::from(path), text.as_bytes().to_vec())).collect()
        };
        let first = content(&[("module.js", "1"), ("snippets/inline.js", "2")]);
        assert_eq!(synchronise(&first, &folder)?, 2);
        let written = fs::metadata(folder.join("module.js"))?.modified()?;
        assert_eq!(synchronise(&first, &folder)?, 0);
        let second = content(&[("module.js", "1"), ("other.js", "3")]);
        assert_eq!(synchronise(&second, &folder)?, 2);
        assert_eq!(read_folder(&folder)?, second);
        assert_eq!(fs::metadata(folder.join("module.js"))?.modified()?, written);
        fs::remove_dir_all(&folder)?;
        Ok(())
    }
}
