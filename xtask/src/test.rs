//! Every check, in the order that finds mistakes soonest: rules and formatting, lints, then builds and tests.
//!
//! The page's module comes before anything that compiles the server, which embeds it.

use std::process::Command;

use anyhow::{Result, bail};

use crate::browser::BROWSER;
use crate::postgres::{self, POSTGRES};
use crate::python::{self, PYTHON};
use crate::requirement::Requirement;
use crate::steps::{Outcome, Steps};
use crate::valgrind::VALGRIND;
use crate::workspace::{Workspace, build_server};
use crate::{DistArgs, Purpose, TestArgs, dist, setup, setup_services, tidy, tools};

/// Random cases per property in a soak; proptest's own default is 256.
const SOAK_CASES: &str = "20000";

pub(crate) fn run(workspace: &Workspace, args: &TestArgs) -> Result<()> {
    let mut steps = Steps::new();
    let every_check = args.filter.is_none();

    if every_check {
        steps.run("setup", "cargo xtask setup", || done(prepare(workspace, args)))?;
        steps.run("tidy", "cargo xtask tidy", || done(tidy::run(workspace)))?;
        component(&mut steps, "formatting", "fmt", "rustfmt", &mut formatting(workspace))?;
    }
    // Kept when filtering: the tests drive these builds, and a stale server would pass or fail for yesterday's reasons.
    steps.run("page", "cargo xtask dist", || done(dist::run(workspace, &DistArgs { debug_info: false })))?;
    if every_check {
        component(&mut steps, "lints", "clippy", "clippy", &mut lints(workspace))?;
    }
    if args.soak {
        tool(&mut steps, "release", &mut build_server(workspace, "release"))?;
    }
    tool(&mut steps, "tests", &mut tests(workspace, args)?)?;
    if every_check {
        tool(&mut steps, "unoptimised bits", &mut core_tests(workspace, "unoptimized", &["trajectory_hashes"]))?;
        let mut release = core_tests(workspace, "release", &["trajectory_hashes", "effort"]);
        tool(&mut steps, "release bits", &mut release)?;
    }
    steps.print_table();
    Ok(())
}

fn prepare(workspace: &Workspace, args: &TestArgs) -> Result<()> {
    if args.no_browser {
        setup(workspace, Purpose::Serve)?;
        setup_services(workspace)
    } else {
        setup(workspace, Purpose::Test)
    }
}

fn formatting(workspace: &Workspace) -> Command {
    let mut command = workspace.cargo();
    command.args(["fmt", "--all", "--check"]);
    command
}

fn lints(workspace: &Workspace) -> Command {
    let mut command = workspace.cargo();
    command
        .args(["clippy", "--workspace", "--all-targets", "--all-features", "--locked"])
        .args(["--", "-D", "warnings"]);
    command
}

/// The workspace's tests, told where the server's program is and what they may use.
///
/// That program is the one that they build themselves, with the page inside: its core is optimised like a release's. A release
/// takes a quarter of an hour to compile, so it is what a soak drives.
fn tests(workspace: &Workspace, args: &TestArgs) -> Result<Command> {
    let mut command = workspace.cargo();
    command.env("ADAPTARM_BIN", workspace.server_program(if args.soak { "release" } else { "dev" }));
    if args.soak {
        command.env("PROPTEST_CASES", SOAK_CASES).env("ADAPTARM_SOAK", "1");
    }
    for requirement in [BROWSER, POSTGRES, PYTHON, VALGRIND].into_iter().filter(Requirement::is_required) {
        command.env(requirement.variable(), "1");
    }
    if args.no_browser {
        command.env("ADAPTARM_NO_BROWSER", "1").env_remove(BROWSER.variable());
    }
    if let Some(folder) = postgres::programs() {
        command.env("ADAPTARM_POSTGRES", folder);
    }
    if python::is_current(workspace)? {
        command.env("ADAPTARM_PYTHON", python::interpreter(workspace));
        if let Some(axe) = python::axe(workspace) {
            command.env("ADAPTARM_AXE", axe);
        }
    }
    command.args(["test", "--workspace", "--all-features", "--locked"]);
    if let Some(filter) = &args.filter {
        command.args(["--", filter]);
    }
    Ok(command)
}

/// The core's tests whose answer depends on how it is compiled: the bits must not, and the effort counts in a release only.
fn core_tests(workspace: &Workspace, profile: &str, names: &[&str]) -> Command {
    let mut command = workspace.cargo();
    command.args(["test", "--locked", "--package", "adaptarm-core", "--profile", profile]);
    for name in names {
        command.args(["--test", name]);
    }
    if VALGRIND.is_required() {
        command.env(VALGRIND.variable(), "1");
    }
    command
}

fn tool(steps: &mut Steps, name: &'static str, command: &mut Command) -> Result<()> {
    steps.run(name, &tools::describe(command), || done(tools::run_unnamed(command)))
}

/// A step that needs a part of the toolchain which minimal installations leave out: required on CI, else skipped.
fn component(
    steps: &mut Steps,
    name: &'static str,
    subcommand: &str,
    component: &str,
    command: &mut Command,
) -> Result<()> {
    steps.run(name, &tools::describe(command), || {
        if tools::succeeds(tools::cargo().args([subcommand, "--version"])) {
            return done(tools::run_unnamed(command));
        }
        let missing = format!("`cargo {subcommand}` is not installed; with rustup: rustup component add {component}");
        if tools::switched_on("CI") {
            bail!("{missing}");
        }
        Ok(Outcome::Skipped(missing))
    })
}

fn done(result: Result<()>) -> Result<Outcome> {
    result.map(|()| Outcome::Done)
}
