//! The browser that end-to-end tests drive: Debian's Chromium, its driver, and a font to draw text with.
//!
//! A missing browser is a message on a contributor's machine and an error where `REQUIRE_BROWSER=1`.

use anyhow::{Result, bail};

use crate::{debian, tools};

/// Without any font Chromium lays out text at zero width, and layout tests fail for no visible reason.
const PACKAGES: [&str; 3] = ["chromium", "chromium-driver", "fonts-dejavu-core"];

/// Installs the browser where that is possible; says how where it is not.
pub(crate) fn ensure() -> Result<()> {
    if debian::can_install() {
        let installed = debian::install(&PACKAGES, "browser tests");
        return match installed {
            Err(error) if !is_required() => {
                eprintln!("warning: {error:#}. Without a browser its tests show as ignored.");
                Ok(())
            }
            result => result,
        };
    }
    if is_present() {
        return Ok(());
    }
    let advice = format!(
        "browser tests need `chromium` and `chromedriver` on PATH; on Debian, as root: {}",
        debian::install_command(&PACKAGES)
    );
    if is_required() {
        bail!("{advice}");
    }
    eprintln!("warning: {advice}. Until then they show as ignored.");
    Ok(())
}

/// Whether a missing browser is a failure: `REQUIRE_BROWSER=1`, or on CI unless `REQUIRE_BROWSER` says otherwise.
pub(crate) fn is_required() -> bool {
    if std::env::var_os("REQUIRE_BROWSER").is_some() {
        tools::switched_on("REQUIRE_BROWSER")
    } else {
        tools::switched_on("CI")
    }
}

fn is_present() -> bool {
    ["chromium", "chromedriver"].iter().all(|program| tools::find_program(program).is_some())
}
