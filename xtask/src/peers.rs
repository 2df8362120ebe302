//! The comparison with other programs (`benches/peers/`): installs what these need where it can, and runs the comparison.
//!
//! Nothing else needs any of it, so what cannot be installed is no error: the benchmark says whom it skips and what they need.

use anyhow::Result;

use crate::workspace::Workspace;
use crate::{BenchArgs, debian, python, tools};

const PACKAGES: [&str; 5] = ["g++", "gcc", "libc6-dev", "libeigen3-dev", "libboost-dev"];

pub(crate) fn run(workspace: &Workspace, args: &BenchArgs) -> Result<()> {
    let libraries = if debian::can_install() { debian::install(&PACKAGES, "the peers in C++ and C") } else { Ok(()) };
    for result in [libraries, python::ensure_peers(workspace)] {
        if let Err(error) = result {
            eprintln!("warning: {error:#}");
        }
    }
    let mut command = workspace.cargo();
    command
        .env("ADAPTARM_PYTHON", python::interpreter(workspace))
        .args(["run", "--locked", "--release", "--package", "adaptarm-tests", "--bin", "bench_peers", "--", "--into"])
        .arg(workspace.target.join("peers"))
        .args(&args.bench_args);
    tools::run(&mut command)
}
