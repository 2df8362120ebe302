//! What a step costs, in instructions: held against a snapshot, so that no change makes the core slower unseen.
//!
//! This program runs itself under valgrind twice per scheme, once for twice as long; the difference is what the steps cost,
//! whatever starting takes. Instructions do not depend on how busy the machine is. Only an optimised build without debug
//! assertions is what people get, so only there it counts. A rise by more than 5 % fails; a fall by as much asks for a new
//! snapshot: see `BLESS`.

use adaptarm_core::scenario::{Scenario, Scheme};
use libtest_mimic::{Arguments, Failed, Trial};
use serde_json::{Map, Value, json};
use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

/// Instructions per step, by scheme.
const SNAPSHOT: &str = "tests/effort/instructions_per_step.json";
const TOLERANCE: f64 = 0.05;
/// Steps of the shorter run; the longer one takes twice as many.
const STEPS: u64 = 1000;
/// Tells this program to run the scenario in this file, and nothing else.
const SCENARIO: &str = "ADAPTARM_EFFORT_SCENARIO";
const BLESS: &str = "ADAPTARM_BLESS=1 cargo test --release --package adaptarm-core --test effort";

type Result<T> = std::result::Result<T, Box<dyn Error>>;

fn main() -> ExitCode {
    if let Some(file) = std::env::var_os(SCENARIO) {
        return match simulate(Path::new(&file)) {
            Ok(()) => ExitCode::SUCCESS,
            Err(error) => {
                eprintln!("{error}");
                ExitCode::FAILURE
            }
        };
    }
    let is_here = Command::new("valgrind").arg("--version").output().is_ok_and(|output| output.status.success());
    let is_required = is_set("REQUIRE_VALGRIND");
    let ignored = cfg!(debug_assertions) || !(is_here || is_required) || !is_counted_here();
    let trials = Scheme::ALL.map(|scheme| {
        let trial = move || examine(scheme).map_err(|error| Failed::from(error.to_string()));
        Trial::test(format!("effort::{}", scheme.id()), trial).with_ignored_flag(ignored)
    });
    let mut arguments = Arguments::from_args();
    // They share the snapshot where it is written anew.
    arguments.test_threads = Some(1);
    libtest_mimic::run(&arguments, trials.into()).exit_code()
}

/// The snapshot is of a machine that has the vector instructions which one run uses; another takes more of smaller ones.
fn is_counted_here() -> bool {
    #[cfg(target_arch = "x86_64")]
    return std::is_x86_feature_detected!("avx2");
    #[cfg(not(target_arch = "x86_64"))]
    false
}

fn is_set(variable: &str) -> bool {
    std::env::var_os(variable).is_some_and(|value| value == "1")
}

/// What is counted.
fn simulate(file: &Path) -> Result<()> {
    let document = serde_json::from_str(&std::fs::read_to_string(file)?)?;
    std::hint::black_box(Scenario::new(document)?.run());
    Ok(())
}

fn examine(scheme: Scheme) -> Result<()> {
    let short = instructions(scheme, STEPS)?;
    let long = instructions(scheme, 2 * STEPS)?;
    let per_step = (long - short) / STEPS as f64;
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(SNAPSHOT);
    let text = std::fs::read_to_string(&path).unwrap_or_else(|_| "{}".to_owned());
    let mut snapshot: Map<String, Value> = serde_json::from_str(&text)?;
    if is_set("ADAPTARM_BLESS") {
        snapshot.insert(scheme.id().to_owned(), json!(per_step.round()));
        return Ok(std::fs::write(&path, serde_json::to_string_pretty(&snapshot)? + "\n")?);
    }
    let expected = snapshot.get(scheme.id()).and_then(Value::as_f64).ok_or("the snapshot lacks this scheme")?;
    let change = per_step / expected - 1.0;
    println!("{}: {per_step:.0} instructions per step, {:+.1} % of the snapshot", scheme.id(), 100.0 * change);
    if change.abs() <= TOLERANCE {
        return Ok(());
    }
    let better = if change < 0.0 { "well done" } else { "too many" };
    Err(format!("{per_step:.0} instructions per step instead of {expected:.0}: {better}; if it is meant: {BLESS}")
        .into())
}

/// Instructions that this program takes for so many steps of a millisecond.
fn instructions(scheme: Scheme, steps: u64) -> Result<f64> {
    let scenario = json!({
        "format": "adaptarm.scenario/1",
        "scheme": {"kind": scheme.id()},
        "integration": {"duration_s": steps as f64 * 1e-3},
        "recording": {"samples": 50},
    });
    let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("effort-{}-{steps}.json", scheme.id()));
    std::fs::write(&file, scenario.to_string())?;
    let output = Command::new("valgrind")
        .args(["--tool=cachegrind", "--cache-sim=no", "--branch-sim=no", "--cachegrind-out-file=/dev/null"])
        .arg(std::env::current_exe()?)
        .env(SCENARIO, &file)
        .output()?;
    let words = String::from_utf8_lossy(&output.stderr);
    if !output.status.success() {
        return Err(format!("valgrind: {}: {words}", output.status).into());
    }
    let line = words.lines().find(|line| line.contains("refs:")).ok_or_else(|| format!("no count in: {words}"))?;
    let digits: String = line.rsplit(':').next().unwrap_or_default().chars().filter(char::is_ascii_digit).collect();
    Ok(digits.parse()?)
}
