//! PostgreSQL's server programs, with which tests run clusters of their own. No cluster of the system is made or used.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};

use crate::requirement::Requirement;
use crate::{debian, tools};

/// Debian's package holds the extension `hstore` too, which other systems package apart.
pub(crate) const POSTGRES: Requirement = Requirement {
    name: "POSTGRES",
    purpose: "PostgreSQL tests",
    needs: "PostgreSQL's `initdb`, `postgres` and `psql` on PATH, with its extension hstore",
    packages: &["postgresql"],
};

const PROGRAMS: [&str; 3] = ["initdb", "postgres", "psql"];

/// Where Debian puts the programs of each version; not on PATH.
const DEBIAN_FOLDER: &str = "/usr/lib/postgresql";

/// What Debian's package reads to decide whether it makes a cluster and starts it.
const CLUSTER_SETTINGS: &str = "/etc/postgresql-common/createcluster.conf";

/// Installs the programs where that is possible; says how where it is not.
pub(crate) fn ensure() -> Result<()> {
    if programs().is_some() {
        return Ok(());
    }
    POSTGRES.settle(POSTGRES.install_or_explain(install))
}

/// The folder of the newest version's programs.
pub(crate) fn programs() -> Option<PathBuf> {
    let versions = fs::read_dir(DEBIAN_FOLDER).into_iter().flatten().flatten();
    let mut folders: Vec<(u32, PathBuf)> = versions
        .filter_map(|version| Some((version.file_name().to_str()?.parse().ok()?, version.path().join("bin"))))
        .filter(|(_, folder)| is_complete(folder))
        .collect();
    folders.sort();
    let newest = folders.pop().map(|(_, folder)| folder);
    newest.or_else(|| {
        let folder = tools::find_program("initdb")?.parent()?.to_path_buf();
        is_complete(&folder).then_some(folder)
    })
}

fn is_complete(folder: &Path) -> bool {
    PROGRAMS.iter().all(|program| folder.join(format!("{program}{}", std::env::consts::EXE_SUFFIX)).is_file())
}

/// Installs Debian's package without the cluster that it would make and start for the system.
fn install() -> Result<()> {
    // The settings come with this package, and count when the next one is installed.
    debian::install(&["postgresql-common"], POSTGRES.purpose)?;
    let settings = fs::read_to_string(CLUSTER_SETTINGS).with_context(|| format!("cannot read {CLUSTER_SETTINGS}"))?;
    let write =
        |text: &str| fs::write(CLUSTER_SETTINGS, text).with_context(|| format!("cannot write {CLUSTER_SETTINGS}"));
    write(&format!("{settings}\ncreate_main_cluster = false\n"))?;
    let installed = debian::install(POSTGRES.packages, POSTGRES.purpose);
    // Whoever installs another version later decides for themselves.
    write(&settings)?;
    installed
}
