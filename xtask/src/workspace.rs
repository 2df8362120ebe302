//! Where things are: the workspace's root, its target folder and its packages, as cargo itself reports them.
//!
//! Asking cargo respects `CARGO_TARGET_DIR` and configuration files, and works from any subfolder.

use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result};
use serde_json::Value;

use crate::tools;

/// One package's name, manifest and declared dependencies.
pub(crate) struct Package {
    pub(crate) name: String,
    pub(crate) manifest: PathBuf,
    pub(crate) dependencies: Vec<Dependency>,
}

/// A dependency as declared in a manifest.
pub(crate) struct Dependency {
    pub(crate) name: String,
    /// Used by tests only.
    pub(crate) dev: bool,
}

/// The checked-out repository.
pub(crate) struct Workspace {
    pub(crate) root: PathBuf,
    pub(crate) target: PathBuf,
    pub(crate) packages: Vec<Package>,
    /// The lowest compiler that the packages accept, for example `1.95`.
    pub(crate) rust_version: String,
}

impl Workspace {
    /// Asks `cargo metadata` about the workspace around the current folder.
    pub(crate) fn locate() -> Result<Self> {
        let mut command = tools::cargo();
        command.args(["metadata", "--no-deps", "--format-version=1"]);
        let metadata: Value = serde_json::from_str(&tools::capture(&mut command)?)
            .context("cargo metadata printed something other than JSON")?;
        let packages = metadata["packages"].as_array().context("cargo metadata lists no packages")?;
        Ok(Self {
            root: path_field(&metadata, "workspace_root")?,
            target: path_field(&metadata, "target_directory")?,
            packages: packages.iter().map(package).collect::<Result<_>>()?,
            rust_version: packages
                .iter()
                .find_map(|package| package["rust_version"].as_str())
                .context("no package states a rust-version")?
                .to_owned(),
        })
    }

    /// Cargo at the root, with the target folder that this process was given.
    pub(crate) fn cargo(&self) -> Command {
        let mut command = tools::cargo();
        command.current_dir(&self.root);
        // Relative, it would mean another folder there than it did to the cargo that started us.
        if std::env::var_os("CARGO_TARGET_DIR").is_some_and(|target| Path::new(&target).is_relative()) {
            command.env("CARGO_TARGET_DIR", &self.target);
        }
        command
    }

    /// The server's program as built under `profile`.
    pub(crate) fn server_program(&self, profile: &str) -> PathBuf {
        // Cargo's one irregular folder name.
        let folder = if profile == "dev" { "debug" } else { profile };
        self.target.join(folder).join(format!("adaptarm{}", std::env::consts::EXE_SUFFIX))
    }

    /// `path` as the repository names it, with forward slashes.
    pub(crate) fn relative(&self, path: &Path) -> String {
        path.strip_prefix(&self.root).unwrap_or(path).to_string_lossy().replace('\\', "/")
    }
}

/// The command that builds the server with cargo profile `profile`.
pub(crate) fn build_server(workspace: &Workspace, profile: &str) -> Command {
    let mut command = workspace.cargo();
    command.args(["build", "--locked", "--package", "adaptarm", "--profile", profile]);
    command
}

fn package(value: &Value) -> Result<Package> {
    let dependencies = value["dependencies"].as_array().map_or(&[][..], Vec::as_slice);
    Ok(Package {
        name: string_field(value, "name")?,
        manifest: path_field(value, "manifest_path")?,
        dependencies: dependencies.iter().map(dependency).collect::<Result<_>>()?,
    })
}

fn dependency(value: &Value) -> Result<Dependency> {
    Ok(Dependency { name: string_field(value, "name")?, dev: value["kind"].as_str() == Some("dev") })
}

fn path_field(value: &Value, field: &str) -> Result<PathBuf> {
    string_field(value, field).map(PathBuf::from)
}

fn string_field(value: &Value, field: &str) -> Result<String> {
    value[field].as_str().map(str::to_owned).with_context(|| format!("cargo metadata has no text `{field}`"))
}
