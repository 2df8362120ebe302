//! The browser that end-to-end tests drive: Debian's Chromium, its driver, and a font to draw text with.

use anyhow::Result;

use crate::requirement::Requirement;
use crate::{debian, tools};

pub(crate) const BROWSER: Requirement = Requirement {
    name: "BROWSER",
    purpose: "browser tests",
    needs: "`chromium` and `chromedriver` on PATH",
    // Without any font Chromium lays out text at zero width, and layout tests fail for no visible reason.
    packages: &["chromium", "chromium-driver", "fonts-dejavu-core"],
};

/// Installs the browser where that is possible; says how where it is not.
pub(crate) fn ensure() -> Result<()> {
    if !debian::can_install() && is_present() {
        return Ok(());
    }
    BROWSER.settle(BROWSER.install_or_explain(|| debian::install(BROWSER.packages, BROWSER.purpose)))
}

/// Whether browser and driver are on PATH.
pub(crate) fn is_present() -> bool {
    ["chromium", "chromedriver"].iter().all(|program| tools::find_program(program).is_some())
}
