//! Valgrind, which counts the instructions of a step for the guard against slow-downs.

use anyhow::Result;

use crate::requirement::Requirement;
use crate::{debian, tools};

pub(crate) const VALGRIND: Requirement =
    Requirement { name: "VALGRIND", purpose: "tests of effort", needs: "`valgrind` on PATH", packages: &["valgrind"] };

/// Installs it where that is possible; says how where it is not.
pub(crate) fn ensure() -> Result<()> {
    if tools::find_program("valgrind").is_some() {
        return Ok(());
    }
    VALGRIND.settle(VALGRIND.install_or_explain(|| debian::install(VALGRIND.packages, VALGRIND.purpose)))
}
