//! The peers of `benches/peers/`: finds what they need, compiles them, and gives those that can run here.
//!
//! What is missing is said in one line each and skipped. Installing is the business of `cargo xtask bench --peers`.

use crate::measurement::{Contestant, Steps};
use adaptarm_tests::machine;
use anyhow::{Context, Result, bail};
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Where Debian puts Eigen; elsewhere `CPATH` may name it.
const EIGEN: &str = "/usr/include/eigen3";

/// The same source for the machine at hand and for any of its architecture.
const BUILDS: [(&str, &[&str]); 2] = [("-O3 -march=native", &["-O3", "-march=native"]), ("-O3", &["-O3"])];

const EIGEN_PROBE: &str = "#include <Eigen/Dense>\n#include <boost/numeric/odeint/stepper/runge_kutta4.hpp>\n";

/// Every peer that this machine can run, compiled into the folder.
pub fn prepare(into: &Path) -> Result<Vec<Contestant>> {
    fs::create_dir_all(into).with_context(|| format!("cannot make {}", into.display()))?;
    let sources = Path::new(env!("CARGO_MANIFEST_DIR")).join("../benches/peers");
    let python = machine::python();
    let has = |module: &str| python.as_ref().filter(|python| runs(Command::new(python).args(["-c", module])));
    let mut contestants = Vec::new();

    if runs_with_input(compiler("CXX", "g++").args(["-std=c++17", "-fsyntax-only", "-isystem", EIGEN, "-xc++", "-"])) {
        for (name, flags) in BUILDS {
            contestants.push(eigen(&sources.join("cpp"), into, name, flags)?);
        }
    } else {
        println!("skipped: C++ with Eigen needs g++ (or CXX), libeigen3-dev and libboost-dev");
    }

    match has("import casadi") {
        Some(python) if runs(compiler("CC", "gcc").arg("--version")) => {
            contestants.extend(casadi(&sources.join("casadi"), into, python)?);
        }
        _ => println!("skipped: CasADi needs gcc (or CC), and the packages of benches/peers/requirements.txt"),
    }

    match has("import scipy.integrate") {
        Some(python) => contestants.push(Contestant {
            name: "SciPy DOP853".to_owned(),
            program: python.clone(),
            arguments: vec![sources.join("scipy/peer.py").display().to_string()],
            steps: Steps::Adaptive,
        }),
        None => println!("skipped: SciPy needs the packages of benches/peers/requirements.txt"),
    }
    Ok(contestants)
}

fn eigen(sources: &Path, into: &Path, name: &str, flags: &[&str]) -> Result<Contestant> {
    let program = into.join(file_name("eigen", flags));
    let mut command = compiler("CXX", "g++");
    command.args(["-std=c++17", "-DNDEBUG", "-isystem", EIGEN]).args(flags);
    succeed(command.arg(sources.join("main.cpp")).arg("-o").arg(&program))?;
    Ok(fixed_steps(format!("C++ Eigen, odeint, {name}"), program))
}

fn casadi(sources: &Path, into: &Path, python: &Path) -> Result<Vec<Contestant>> {
    let folder = into.join("casadi");
    fs::create_dir_all(&folder)?;
    succeed(Command::new(python).arg(sources.join("generate.py")).arg(&folder))?;
    let build = |(name, flags): (&str, &[&str])| {
        let (object, program) =
            (folder.join(file_name("generated", flags) + ".o"), into.join(file_name("casadi", flags)));
        let mut command = compiler("CC", "gcc");
        // By a standard before C99, CasADi's fmin and fmax are comparisons instead of calls, and faster.
        command.args(flags).args(["-std=gnu89", "-c"]);
        succeed(command.arg(folder.join("generated.c")).arg("-o").arg(&object))?;
        let mut command = compiler("CC", "gcc");
        command.args(flags).arg("-std=gnu17").arg("-I").arg(&folder).arg(sources.join("main.c")).arg(&object);
        succeed(command.arg("-o").arg(&program).arg("-lm"))?;
        Ok(fixed_steps(format!("CasADi, C, {name}"), program))
    };
    BUILDS.into_iter().map(build).collect()
}

fn fixed_steps(name: String, program: PathBuf) -> Contestant {
    Contestant { name, program, arguments: Vec::new(), steps: Steps::Fixed }
}

fn file_name(stem: &str, flags: &[&str]) -> String {
    format!("{stem}{}", flags.concat().replace('=', "-"))
}

fn compiler(variable: &str, usual: &str) -> Command {
    Command::new(std::env::var_os(variable).unwrap_or_else(|| OsString::from(usual)))
}

fn succeed(command: &mut Command) -> Result<()> {
    let status = command.status().with_context(|| format!("{} cannot be started", command.get_program().display()))?;
    if !status.success() {
        bail!("{command:?} ended with {status}");
    }
    Ok(())
}

/// Whether it starts and succeeds, with nothing shown.
fn runs(command: &mut Command) -> bool {
    command
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status()
        .is_ok_and(|status| status.success())
}

/// Whether a compiler accepts [`EIGEN_PROBE`] on its standard input.
fn runs_with_input(command: &mut Command) -> bool {
    let spawned = command.stdin(Stdio::piped()).stdout(Stdio::null()).stderr(Stdio::null()).spawn();
    let Ok(mut compiler) = spawned else { return false };
    let written = compiler
        .stdin
        .take()
        .is_some_and(|mut input| std::io::Write::write_all(&mut input, EIGEN_PROBE.as_bytes()).is_ok());
    compiler.wait().is_ok_and(|status| status.success()) && written
}
