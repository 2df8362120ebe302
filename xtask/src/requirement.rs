//! What tests need beside Rust: whether lacking it is a message on a contributor's machine or a failure.
//!
//! `REQUIRE_<NAME>` decides where it is set; else it is a failure on CI (`CI=true`). Elsewhere its tests show as ignored.

use anyhow::{Result, bail};

use crate::{debian, tools};

/// Something that some tests cannot run without.
pub(crate) struct Requirement {
    /// Ends the names of its variables, such as `BROWSER` in `REQUIRE_BROWSER`.
    pub(crate) name: &'static str,
    /// For people, such as "browser tests".
    pub(crate) purpose: &'static str,
    /// What must be there when Debian's packages are not an option.
    pub(crate) needs: &'static str,
    /// Debian's packages that provide it.
    pub(crate) packages: &'static [&'static str],
}

impl Requirement {
    /// Name of the variable that demands it.
    pub(crate) fn variable(&self) -> String {
        format!("REQUIRE_{}", self.name)
    }

    /// Whether tests must fail without it.
    pub(crate) fn is_required(&self) -> bool {
        let variable = self.variable();
        if std::env::var_os(&variable).is_some() { tools::switched_on(&variable) } else { tools::switched_on("CI") }
    }

    /// Passes a success on; turns a failure into a warning where this is not required.
    pub(crate) fn settle(&self, result: Result<()>) -> Result<()> {
        match result {
            Err(error) if !self.is_required() => {
                eprintln!("warning: {error:#}. Until then {} show as ignored.", self.purpose);
                Ok(())
            }
            result => result,
        }
    }

    /// Installs it by `install` where Debian's packages can be installed; else says what to install.
    pub(crate) fn install_or_explain(&self, install: impl FnOnce() -> Result<()>) -> Result<()> {
        if debian::can_install() {
            return install();
        }
        let command = debian::install_command(self.packages);
        bail!("{} need {}; on Debian, as root: {command}", self.purpose, self.needs)
    }
}
