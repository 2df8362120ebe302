//! ARCHITECTURE.md names files and folders in backticks: each must exist, or the map no longer shows the land.
//!
//! A path may be given from the root or by its end, as in `robots/a465.rs`. Addresses of the HTTP API (a leading slash),
//! media types, format tags such as `name/1`, and anything with spaces or brackets are not paths.

use std::fs;

use anyhow::{Context, Result};

use super::Violation;
use crate::workspace::Workspace;

const MAP: &str = "ARCHITECTURE.md";

/// Folders that exist only after a build.
const BUILT: [&str; 2] = ["target", "static/generated"];

pub(super) fn check(workspace: &Workspace, files: &[String]) -> Result<Vec<Violation>> {
    let path = workspace.root.join(MAP);
    if !path.is_file() {
        return Ok(vec![Violation::new(MAP, 1, "missing: newcomers start there")]);
    }
    let text = fs::read_to_string(&path).with_context(|| format!("cannot read {MAP}"))?;
    Ok(missing_paths(&text, files))
}

fn missing_paths(text: &str, files: &[String]) -> Vec<Violation> {
    let mut violations = Vec::new();
    for (index, line) in text.lines().enumerate() {
        for path in line.split('`').skip(1).step_by(2).filter(|word| is_path(word)) {
            if !exists(path, files) {
                violations.push(Violation::new(MAP, index + 1, format!("`{path}` does not exist")));
            }
        }
    }
    violations
}

fn is_path(word: &str) -> bool {
    let is_file_name = [".rs", ".md", ".toml"].iter().any(|ending| word.len() > ending.len() && word.ends_with(ending));
    let is_plain = word.chars().all(|c| c.is_ascii_alphanumeric() || "-_./".contains(c));
    let is_media_type = ["application/", "text/", "image/"].iter().any(|kind| word.starts_with(kind));
    let last = word.rsplit('/').next().unwrap_or_default();
    let is_format_tag = !last.is_empty() && last.chars().all(|c| c.is_ascii_digit());
    (is_file_name || word.contains('/'))
        && is_plain
        && !word.starts_with('/')
        && !word.contains("//")
        && !is_media_type
        && !is_format_tag
}

/// Whether `path` is a file or a folder of the repository, from the root or as the end of a longer path.
fn exists(path: &str, files: &[String]) -> bool {
    let path = path.trim_start_matches("./").trim_end_matches('/');
    let inner = format!("/{path}/");
    BUILT.iter().any(|built| path == *built || path.starts_with(&format!("{built}/")))
        || files.iter().any(|file| format!("/{file}/").contains(&inner))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_that_is_gone_is_named_with_its_line() {
        let files = ["core/src/robots/a465.rs", "README.md", "docs/decisions/0001-bits.md"].map(str::to_owned);
        let text = "`core/src/robots/` and `robots/a465.rs`, `a465.rs`\n`README.md`, `docs/decisions`\n\
            `core/src/gone.rs` and `GONE.md`\n";
        let found = missing_paths(text, &files);
        assert_eq!(found.iter().map(|violation| violation.line).collect::<Vec<_>>(), [3, 3]);
        assert!(found[0].message.contains("core/src/gone.rs"));
    }

    #[test]
    fn a_part_of_a_name_is_not_a_path() {
        let files = ["core/src/robots.rs".to_owned()];
        assert!(!exists("obots.rs", &files));
        assert!(!exists("src/rob", &files));
        assert!(exists("src/robots.rs", &files));
    }

    #[test]
    fn what_only_looks_like_a_path_is_left_alone() {
        for word in [
            "/api/v1",
            "application/problem+json",
            "text/csv",
            "adaptarm.scenario/1",
            "a / b",
            "core/{a,b}",
            "Y θ",
            ".rs",
        ] {
            assert!(!is_path(word), "{word}");
        }
        for word in ["core/", "web/src/lib.rs", "Cargo.toml", ".cargo/config.toml", "static/generated"] {
            assert!(is_path(word), "{word}");
        }
        assert!(exists("static/generated/adaptarm_web.js", &[]));
    }
}
