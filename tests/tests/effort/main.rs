//! What a step costs, in instructions: held against a snapshot, so that no change makes the core slower unseen.
//!
//! The release binary runs under valgrind twice per scheme, once for twice as long; the difference is what the steps cost,
//! whatever starting and reporting take. Instructions do not depend on how busy the machine is. A rise by more than 5 % fails;
//! a fall by as much asks for a new snapshot: `ADAPTARM_BLESS=1 cargo xtask test effort`.

use adaptarm_core::scenario::Scheme;
use adaptarm_tests::machine;
use anyhow::{Context, Result, bail, ensure};
use libtest_mimic::{Arguments, Failed, Trial};
use serde_json::{Map, Value, json};
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

/// Instructions per step, by scheme.
const SNAPSHOT: &str = "tests/effort/instructions_per_step.json";
const TOLERANCE: f64 = 0.05;
/// Steps of the shorter run; the longer one takes twice as many.
const STEPS: u64 = 1000;

fn main() -> ExitCode {
    let is_here = Command::new("valgrind").arg("--version").output().is_ok_and(|output| output.status.success());
    let ignored = !is_here && !machine::switched_on("REQUIRE_VALGRIND");
    let trials = Scheme::ALL.map(|scheme| {
        let trial = move || examine(scheme).map_err(|error| Failed::from(format!("{error:#}")));
        Trial::test(format!("effort::{}", scheme.id()), trial).with_ignored_flag(ignored)
    });
    let mut arguments = Arguments::from_args();
    // They share the snapshot where it is written anew.
    arguments.test_threads = Some(1);
    libtest_mimic::run(&arguments, trials.into()).exit_code()
}

fn examine(scheme: Scheme) -> Result<()> {
    let folder = tempfile::tempdir()?;
    let short = instructions(folder.path(), scheme, STEPS)?;
    let long = instructions(folder.path(), scheme, 2 * STEPS)?;
    let per_step = (long - short) / STEPS as f64;
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(SNAPSHOT);
    let text = std::fs::read_to_string(&path).unwrap_or_else(|_| "{}".to_owned());
    let mut snapshot: Map<String, Value> = serde_json::from_str(&text).context("the snapshot is no object")?;
    if machine::switched_on("ADAPTARM_BLESS") {
        snapshot.insert(scheme.id().to_owned(), json!(per_step.round()));
        return Ok(std::fs::write(&path, serde_json::to_string_pretty(&snapshot)? + "\n")?);
    }
    let expected = snapshot.get(scheme.id()).and_then(Value::as_f64).context("the snapshot lacks this scheme")?;
    let change = per_step / expected - 1.0;
    println!("{}: {per_step:.0} instructions per step, {:+.1} % of the snapshot", scheme.id(), 100.0 * change);
    let bless = "if it is meant to be so: ADAPTARM_BLESS=1 cargo xtask test effort";
    ensure!(change <= TOLERANCE, "{per_step:.0} instructions per step instead of {expected:.0}; {bless}");
    ensure!(
        change >= -TOLERANCE,
        "only {per_step:.0} instructions per step instead of {expected:.0}: well done; {bless}"
    );
    Ok(())
}

/// Instructions that `adaptarm run` takes for so many steps of a millisecond.
fn instructions(folder: &Path, scheme: Scheme, steps: u64) -> Result<f64> {
    let scenario = json!({
        "format": "adaptarm.scenario/1",
        "scheme": {"kind": scheme.id()},
        "integration": {"duration_s": steps as f64 * 1e-3},
        "recording": {"samples": 50},
    });
    let file = folder.join("scenario.json");
    std::fs::write(&file, scenario.to_string())?;
    let output = Command::new("valgrind")
        .args(["--tool=cachegrind", "--cache-sim=no", "--branch-sim=no", "--cachegrind-out-file=/dev/null"])
        .arg(machine::binary()?)
        .arg("run")
        .arg(&file)
        .output()
        .context("valgrind")?;
    let words = String::from_utf8_lossy(&output.stderr);
    if !output.status.success() {
        bail!("valgrind: {}: {words}", output.status);
    }
    let line = words.lines().find(|line| line.contains("refs:")).with_context(|| format!("no count in: {words}"))?;
    let digits: String = line.rsplit(':').next().unwrap_or_default().chars().filter(char::is_ascii_digit).collect();
    digits.parse().with_context(|| format!("no number in: {line}"))
}
