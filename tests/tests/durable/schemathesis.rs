//! The API against its own description: schemathesis reads `openapi.json` and tries to catch the server contradicting it.

use adaptarm_tests::{Launch, machine};
use anyhow::{Context, Result, ensure};
use serde_json::Value;
use std::fs;
use std::process::Command;

const CONFIG: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/python/schemathesis.toml");

pub fn conformance() -> Result<()> {
    let server = Launch::new().serve()?;
    let python = machine::python().context("ADAPTARM_PYTHON names no interpreter")?;
    let folder = tempfile::tempdir()?;
    let report = folder.path().join("report.json");
    let examples = if machine::soak() { "400" } else { "8" };
    let mut command = Command::new(python);
    command
        .args(["-m", "schemathesis.cli", "--config-file", CONFIG, "run"])
        .arg(format!("{}/api/v1/openapi.json", server.url))
        .args(["--seed", "1", "--max-examples", examples, "--no-color", "--report", "json", "--report-json-path"])
        .arg(&report)
        .current_dir(folder.path());
    let output = command.output()?;
    let text = String::from_utf8_lossy(&output.stdout);
    ensure!(output.status.success(), "{text}{}", String::from_utf8_lossy(&output.stderr));
    let report: Value = serde_json::from_slice(&fs::read(&report)?)?;
    println!("schemathesis: {} over {}", report["test_cases"], report["operations"]);
    let cases = report["test_cases"]["generated"].as_u64().context("a report without cases")?;
    let enough = if machine::soak() { 5000 } else { 100 };
    ensure!(cases >= enough, "{cases} cases, {enough} at least are wanted");
    ensure!(report["operations"]["tested"] == report["operations"]["total"], "{}", report["operations"]);
    Ok(())
}
