//! Timing the study's workload: builds the page and the release server, then runs the benchmark program of `tests/`.
//!
//! What is measured, and how, is that program's business.

use anyhow::Result;

use crate::workspace::{Workspace, build_server};
use crate::{BenchArgs, DistArgs, dist, tools};

pub(crate) fn run(workspace: &Workspace, args: &BenchArgs) -> Result<()> {
    dist::run(workspace, &DistArgs { debug_info: false })?;
    tools::run(&mut build_server(workspace, "release"))?;
    let mut command = workspace.cargo();
    command
        .env("ADAPTARM_BIN", workspace.server_program("release"))
        .args(["run", "--locked", "--release", "--package", "adaptarm-tests", "--bin", "bench_study", "--"])
        .args(&args.bench_args);
    tools::run(&mut command)
}
