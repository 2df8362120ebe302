//! The rules of the house, checked by reading: which crate may know which, determinism, sizes, headers, named paths.
//!
//! Each violation is one line, `path:line: message`. What the files are comes from git, so ignored folders are not read;
//! files not yet added are, because a rule is best broken before the commit.

mod arrows;
mod paths;
mod text;

use std::fmt;
use std::fs;
use std::process::Command;

use anyhow::{Context, Result, bail};

use crate::tools;
use crate::workspace::Workspace;

/// Larger files make every clone pay for ever; data of that size belongs in a generator.
const LARGEST_FILE_BYTES: u64 = 512 * 1024;

/// A broken rule and where.
#[derive(Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Violation {
    path: String,
    line: usize,
    message: String,
}

impl Violation {
    fn new(path: &str, line: usize, message: impl Into<String>) -> Self {
        Self { path: path.to_owned(), line, message: message.into() }
    }
}

impl fmt::Display for Violation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}: {}", self.path, self.line, self.message)
    }
}

pub(crate) fn run(workspace: &Workspace) -> Result<()> {
    let files = repository_files(workspace)?;
    let mut violations = arrows::check(workspace)?;
    violations.extend(paths::check(workspace, &files)?);
    for path in &files {
        violations.extend(check_file(workspace, path)?);
    }
    violations.sort();
    for violation in &violations {
        println!("{violation}");
    }
    if !violations.is_empty() {
        bail!("{} of the house's rules broken above", violations.len());
    }
    println!("tidy: {} files in order", files.len());
    Ok(())
}

fn check_file(workspace: &Workspace, path: &str) -> Result<Vec<Violation>> {
    let full = workspace.root.join(path);
    let size = fs::metadata(&full).with_context(|| format!("cannot read {path}"))?.len();
    if size > LARGEST_FILE_BYTES {
        let message = format!("{size} bytes; the largest file may have {LARGEST_FILE_BYTES}");
        return Ok(vec![Violation::new(path, 1, message)]);
    }
    if !text::is_checked(path) {
        return Ok(Vec::new());
    }
    let content = fs::read_to_string(&full).with_context(|| format!("{path} is not UTF-8 text"))?;
    Ok(text::check(path, &content))
}

/// Files that are committed or would be, by their paths from the root, sorted.
fn repository_files(workspace: &Workspace) -> Result<Vec<String>> {
    let mut git = Command::new("git");
    // A build machine often checks out as another user; we only read names.
    git.arg("-c").arg(format!("safe.directory={}", workspace.root.display()));
    git.current_dir(&workspace.root);
    git.args(["ls-files", "-z", "--cached", "--others", "--exclude-standard", "--deduplicate"]);
    let listing = tools::capture(&mut git).context("tidy reads the list of files from git")?;
    let mut files: Vec<String> = listing
        .split_terminator('\0')
        .filter(|path| {
            let path = workspace.root.join(path);
            // Not what is deleted but not yet committed, nor builds in a folder that git does not know to ignore.
            path.is_file() && !path.starts_with(&workspace.target)
        })
        .map(str::to_owned)
        .collect();
    files.sort();
    Ok(files)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_violation_reads_as_editors_expect() {
        let violation = Violation::new("core/src/lib.rs", 7, "no");
        assert_eq!(violation.to_string(), "core/src/lib.rs:7: no");
    }
}
