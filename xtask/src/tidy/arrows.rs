//! Which crate may know which: `server` and `web` know `core`, `core` knows no outside world, nothing knows `xtask`.
//!
//! Also that nalgebra stays without its `std` feature, which brings matrixmultiply: its products have other bits in WASM.

use std::fs;

use anyhow::{Context, Result};

use super::Violation;
use crate::tools;
use crate::workspace::{Package, Workspace};

const CORE: &str = "adaptarm-core";

/// What the workspace's packages may know of each other. Who is not named here may know all but xtask.
const MAY_KNOW: [(&str, &[&str]); 4] = [(CORE, &[]), ("adaptarm-web", &[CORE]), ("adaptarm", &[CORE]), ("xtask", &[])];

/// Input and output, clocks, threads and JSON text: the core computes, others do these. Its tests may.
const NOT_IN_CORE: [&str; 10] =
    ["tokio", "axum", "hyper", "reqwest", "sqlx", "rayon", "web-sys", "js-sys", "wasm-bindgen", "serde_json"];

pub(super) fn check(workspace: &Workspace) -> Result<Vec<Violation>> {
    let mut violations = Vec::new();
    let names: Vec<&str> = workspace.packages.iter().map(|package| package.name.as_str()).collect();
    for package in &workspace.packages {
        let manifest = fs::read_to_string(&package.manifest)
            .with_context(|| format!("cannot read {}", package.manifest.display()))?;
        let path = workspace.relative(&package.manifest);
        for (dependency, message) in forbidden(package, &names) {
            violations.push(Violation::new(&path, line_of(&manifest, &dependency), message));
        }
    }
    let tree = |scope: &[&str]| {
        let mut command = workspace.cargo();
        command.args(["tree", "--locked", "--all-features", "--prefix", "none", "--format", "{p}|{f}"]).args(scope);
        tools::capture(&mut command)
    };
    // Resolved together, because one package's wish for a feature is granted to all that are built with it.
    violations.extend(nalgebra_with_std(&tree(&["--workspace", "--edges", "normal,build,dev"])?));
    violations.extend(matrixmultiply(&tree(&["--package", CORE, "--edges", "normal"])?));
    Ok(violations)
}

/// The dependencies that `package` must not have, each with the reason.
fn forbidden(package: &Package, workspace: &[&str]) -> Vec<(String, String)> {
    let may_know = MAY_KNOW.iter().find(|(name, _)| *name == package.name).map(|(_, known)| *known);
    let mut found = Vec::new();
    for dependency in &package.dependencies {
        let name = dependency.name.as_str();
        let arrow_is_wrong =
            workspace.contains(&name) && (name == "xtask" || may_know.is_some_and(|known| !known.contains(&name)));
        if arrow_is_wrong {
            found.push((name.to_owned(), format!("{} must not depend on {name}", package.name)));
        } else if package.name == CORE && !dependency.dev && NOT_IN_CORE.contains(&name) {
            found.push((name.to_owned(), format!("the core is pure: {name} belongs to server or web")));
        }
    }
    found
}

/// Where a manifest declares a dependency, for the message; the first line if it is declared in an unusual way.
fn line_of(manifest: &str, dependency: &str) -> usize {
    let declares = |line: &str| {
        line.strip_prefix(dependency).is_some_and(|rest| rest.starts_with(['.', ' ', '=']))
            || line.starts_with('[') && line.trim_end().ends_with(&format!("dependencies.{dependency}]"))
    };
    manifest.lines().position(declares).map_or(1, |index| index + 1)
}

fn nalgebra_with_std(tree: &str) -> Option<Violation> {
    let features = tree.lines().filter(|line| line.starts_with("nalgebra v")).filter_map(|line| line.split('|').nth(1));
    let unwanted = features.flat_map(|list| list.split(',')).find(|&name| name == "std" || name == "matrixmultiply")?;
    Some(Violation::new(
        "Cargo.toml",
        1,
        format!(
            "something turns on nalgebra's `{unwanted}`; find it with: cargo tree --workspace -e features -i nalgebra"
        ),
    ))
}

fn matrixmultiply(tree: &str) -> Option<Violation> {
    tree.lines().any(|line| line.starts_with("matrixmultiply ")).then(|| {
        Violation::new(
            "core/Cargo.toml",
            1,
            "matrixmultiply is in the core's tree: its bits differ between native and WASM",
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::workspace::Dependency;

    fn forbidden_of(name: &str, dependencies: &[(&str, bool)]) -> Vec<String> {
        let dependencies = dependencies.iter().map(|&(name, dev)| Dependency { name: name.to_owned(), dev }).collect();
        let package = Package { name: name.to_owned(), manifest: "Cargo.toml".into(), dependencies };
        let workspace = [CORE, "adaptarm", "adaptarm-web", "adaptarm-tests", "xtask"];
        forbidden(&package, &workspace).into_iter().map(|(dependency, _)| dependency).collect()
    }

    #[test]
    fn the_core_is_pure_and_its_tests_may_read_json() {
        assert_eq!(forbidden_of(CORE, &[("nalgebra", false), ("serde_json", true)]), [""; 0]);
        assert_eq!(forbidden_of(CORE, &[("serde_json", false), ("tokio", false)]), ["serde_json", "tokio"]);
        assert_eq!(forbidden_of(CORE, &[("adaptarm", true)]), ["adaptarm"]);
    }

    #[test]
    fn server_and_page_know_only_the_core_and_nothing_knows_xtask() {
        assert_eq!(forbidden_of("adaptarm", &[(CORE, false), ("adaptarm-web", false)]), ["adaptarm-web"]);
        assert_eq!(forbidden_of("adaptarm-web", &[(CORE, false), ("adaptarm", false)]), ["adaptarm"]);
        assert_eq!(forbidden_of("adaptarm-tests", &[(CORE, false), ("adaptarm", false), ("xtask", false)]), ["xtask"]);
    }

    #[test]
    fn the_message_points_at_the_declaration() {
        let manifest = "[dependencies]\ntokio-util = \"1\"\ntokio.workspace = true\n[dev-dependencies.axum]\n";
        assert_eq!(line_of(manifest, "tokio"), 3);
        assert_eq!(line_of(manifest, "axum"), 4);
        assert_eq!(line_of(manifest, "absent"), 1);
    }

    #[test]
    fn nalgebras_std_is_found_and_other_crates_std_is_not() {
        assert_eq!(nalgebra_with_std("nalgebra v0.35.0|alloc,libm-force\nserde v1.0.0|std\n"), None);
        let violation = nalgebra_with_std("nalgebra v0.35.0|alloc,std (*)\nnalgebra v0.35.0|alloc,std\n").unwrap();
        assert!(violation.message.contains("`std`"), "{violation}");
        assert!(matrixmultiply("nalgebra v0.35.0|std\nmatrixmultiply v0.3.0|std\n").is_some());
    }
}
