//! `cargo xtask`: the repository's commands, from a bare machine to a running laboratory.
//!
//! This crate only spawns tools and checks text. Nothing depends on it, and it knows no physics.

mod bench;
mod browser;
mod debian;
mod dist;
mod peers;
mod postgres;
mod python;
mod requirement;
mod serve;
mod steps;
mod test;
mod tidy;
mod tools;
mod valgrind;
mod wasm_toolchain;
mod workspace;

use std::ffi::OsString;
use std::process::ExitCode;

use anyhow::Result;
use clap::{Args, Parser, Subcommand, ValueEnum};

use workspace::Workspace;

/// Prepare, build, serve and test adaptarm.
///
/// New here? `cargo xtask serve` builds everything and opens the laboratory on 127.0.0.1:8080;
/// `cargo xtask test` runs every check that CI runs. Both first install what is missing, and say so.
#[derive(Parser)]
#[command(name = "cargo xtask", bin_name = "cargo xtask", version)]
struct Cli {
    #[command(subcommand)]
    command: Task,
}

#[derive(Subcommand)]
enum Task {
    Setup(SetupArgs),
    Dist(DistArgs),
    Serve(ServeArgs),
    Test(TestArgs),
    /// Check the rules of the house: crate arrows, determinism, file sizes, paths named in ARCHITECTURE.md.
    ///
    /// Prints one line per violation, `path:line: message`. Takes a second; needs git.
    Tidy,
    Bench(BenchArgs),
}

/// Install what the other commands need (they call this themselves).
///
/// Always: Rust's standard library for WebAssembly. For tests also: a browser, its driver and a font; PostgreSQL's
/// programs; Python packages in target/python.
/// Uses rustup where it can, else Debian's packages when run as root, else explains what to install.
#[derive(Args)]
struct SetupArgs {
    /// What to prepare for.
    #[arg(long = "for", value_enum, default_value_t = Purpose::Test)]
    purpose: Purpose,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Purpose {
    /// Building and serving: the WebAssembly toolchain.
    Serve,
    /// The same, and the browser, PostgreSQL and Python packages that end-to-end tests use.
    Test,
}

/// Compile the browser's module and its JavaScript bindings into static/generated.
///
/// Files there change only when their content does, so a server built from them is not rebuilt for nothing.
/// `ADAPTARM_WASM_TOOLCHAIN=installed|rustup|debian` forces one way to get WebAssembly instead of trying each.
#[derive(Args)]
pub(crate) struct DistArgs {
    /// Keep function names and line tables, for the browser's profiler and stack traces (a larger file).
    #[arg(long)]
    debug_info: bool,
}

/// Build everything and run the server, by default on 127.0.0.1:8080.
///
/// Arguments after `--` go to `adaptarm serve`, for example
/// `cargo xtask serve -- --bind 127.0.0.1:9000 --data runs`. Ctrl-C drains the server and stops it.
#[derive(Args)]
pub(crate) struct ServeArgs {
    /// Cargo profile of the server; `dev` builds faster and answers slower.
    #[arg(long, default_value = "release")]
    profile: String,
    /// Arguments for `adaptarm serve`.
    #[arg(last = true)]
    server_args: Vec<OsString>,
}

/// Run every check: house rules, formatting, lints, unit tests, real server, real browser, optimised and not.
///
/// Stops at the first failing step and prints the command that repeats it. Without a browser, PostgreSQL, Python or
/// valgrind their tests show as ignored; `REQUIRE_BROWSER=1`, `REQUIRE_POSTGRES=1`, `REQUIRE_PYTHON=1`, `REQUIRE_VALGRIND=1`
/// (implied by `CI=true`) make that a failure.
#[derive(Args)]
pub(crate) struct TestArgs {
    /// The long forms: 20 000 random cases per property instead of 256, and an hour of crashes, load and fuzzing.
    #[arg(long)]
    soak: bool,
    /// Neither install nor use a browser.
    #[arg(long)]
    no_browser: bool,
    /// Run only tests whose name contains this, on fresh builds, without the other checks.
    filter: Option<String>,
}

/// Time the study natively, then the page in a browser against the release server.
///
/// Prints tables with limits beside them. Arguments after `--` go to the native program, `bench_study` in tests/, or with
/// `--peers` to `bench_peers`, for example `cargo xtask bench --peers -- --json peers.json`.
#[derive(Args)]
pub(crate) struct BenchArgs {
    /// Instead: the same closed loops in C++ with Eigen, in C by CasADi and in SciPy (benches/peers), checked against ours and
    /// timed beside it.
    #[arg(long)]
    peers: bool,
    /// Arguments for the benchmark program.
    #[arg(last = true)]
    bench_args: Vec<OsString>,
}

fn main() -> ExitCode {
    // Not `fn main() -> Result`: with RUST_BACKTRACE set that would bury the one line that explains the failure.
    match run(Cli::parse().command) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::FAILURE
        }
    }
}

fn run(task: Task) -> Result<()> {
    let workspace = Workspace::locate()?;
    match task {
        Task::Setup(args) => {
            setup(&workspace, args.purpose)?;
            println!("setup: done");
            Ok(())
        }
        Task::Dist(args) => dist::run(&workspace, &args),
        Task::Serve(args) => serve::run(&workspace, args),
        Task::Test(args) => test::run(&workspace, &args),
        Task::Tidy => tidy::run(&workspace),
        Task::Bench(args) => bench::run(&workspace, &args),
    }
}

pub(crate) fn setup(workspace: &Workspace, purpose: Purpose) -> Result<()> {
    wasm_toolchain::ensure(workspace)?;
    if purpose == Purpose::Test {
        browser::ensure()?;
        setup_services(workspace)?;
    }
    Ok(())
}

/// What end-to-end tests use beside a browser.
pub(crate) fn setup_services(workspace: &Workspace) -> Result<()> {
    postgres::ensure()?;
    valgrind::ensure()?;
    python::ensure(workspace)
}
