//! Timing the study's workload: builds the page and the release server, then runs the benchmark program of `tests/`, and
//! after it the page in a browser where there is one; or, instead, the comparison with other programs.
//!
//! What is measured, and how, is their business.

use anyhow::Result;

use crate::workspace::{Workspace, build_server};
use crate::{BenchArgs, DistArgs, browser, dist, peers, tools};

pub(crate) fn run(workspace: &Workspace, args: &BenchArgs) -> Result<()> {
    if args.peers {
        return peers::run(workspace, args);
    }
    dist::run(workspace, &DistArgs { debug_info: false })?;
    tools::run(&mut build_server(workspace, "release"))?;
    let mut command = workspace.cargo();
    command
        .env("ADAPTARM_BIN", workspace.server_program("release"))
        .args(["run", "--locked", "--release", "--package", "adaptarm-tests", "--bin", "bench_study", "--"])
        .args(&args.bench_args);
    tools::run(&mut command)?;
    if !browser::is_present() {
        eprintln!("the page is not measured: {} need {}", browser::BROWSER.purpose, browser::BROWSER.needs);
        return Ok(());
    }
    let mut command = workspace.cargo();
    command.env("ADAPTARM_BIN", workspace.server_program("release")).env("ADAPTARM_BENCH", "1").args([
        "test",
        "--quiet",
        "--release",
        "--locked",
        "--package",
        "adaptarm-tests",
        "--test",
        "browser",
    ]);
    tools::run(&mut command)
}
