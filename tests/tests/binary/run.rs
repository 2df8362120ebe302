//! `adaptarm run` and `presets`: what they print, and how they refuse what they cannot run.

use crate::bad_scenarios::{BAD, Bad, MINIMAL};
use adaptarm_core::scenario::{PRESETS, Scenario};
use adaptarm_tests::binary;
use anyhow::{Context, Result, ensure};
use serde_json::Value;
use std::fs::{self, File};
use std::io::Write;
use std::path::Path;
use std::process::{Command, Output, Stdio};

fn adaptarm(arguments: &[&str], folder: &Path) -> Result<Output> {
    Ok(Command::new(binary()?).args(arguments).current_dir(folder).stdin(Stdio::null()).output()?)
}

/// The one line that a refused command prints, after checking that it is one and that nothing else was printed.
pub(crate) fn refusal(output: &Output, code: i32) -> Result<String> {
    let line = String::from_utf8(output.stderr.clone())?;
    ensure!(output.status.code() == Some(code), "{:?} instead of {code}: {line}", output.status.code());
    ensure!(output.stdout.is_empty(), "printed {} bytes", output.stdout.len());
    ensure!(line.ends_with('\n') && line.lines().count() == 1, "not one line: {line:?}");
    ensure!(line.starts_with("adaptarm: ") && line.chars().count() < 1200, "{line}");
    Ok(line)
}

#[test]
fn every_preset_gives_the_report_that_the_core_gives() -> Result<()> {
    let folder = tempfile::tempdir()?;
    for preset in PRESETS {
        let output = adaptarm(&["run", "--preset", preset.id], folder.path())?;
        ensure!(output.status.success() && output.stderr.is_empty(), "{output:?}");
        let report: Value = serde_json::from_slice(&output.stdout)?;
        assert_eq!(report, serde_json::to_value(Scenario::new(preset.document())?.run().report)?);
    }
    Ok(())
}

#[test]
fn a_report_has_the_fields_that_the_design_promises() -> Result<()> {
    let folder = tempfile::tempdir()?;
    let output = adaptarm(&["run", "--preset", "proposed", "--compact"], folder.path())?;
    assert_eq!(std::str::from_utf8(&output.stdout)?.lines().count(), 1);
    let report: Value = serde_json::from_slice(&output.stdout)?;
    for (name, count) in
        [("index_e_deg", 3), ("index_de_deg_s", 3), ("z_peak_deg", 3), ("tau_peak_nm", 3), ("theta_hat_end", 18)]
    {
        let numbers = report[name].as_array().with_context(|| format!("no list {name}"))?;
        ensure!(numbers.len() == count && numbers.iter().all(Value::is_f64), "{name}: {numbers:?}");
    }
    assert_eq!(report["outcome"], "completed");
    for name in ["trajectory_hash", "scenario_hash"] {
        assert_eq!(report[name].as_str().map(str::len), Some(64), "{name}");
    }
    let output = adaptarm(&["run", "--preset", "slotine_li"], folder.path())?;
    let measured: Value = serde_json::from_slice(&output.stdout)?;
    assert!(measured.get("z_peak_deg").is_none(), "nothing observes in this scheme");
    Ok(())
}

#[test]
fn a_diverging_run_is_an_outcome_and_no_failure() -> Result<()> {
    let folder = tempfile::tempdir()?;
    let scenario = MINIMAL.replace("proposed\"}", "slotine_li\"},\"integration\":{\"step_s\":0.1}");
    fs::write(folder.path().join("coarse.json"), scenario)?;
    let output = adaptarm(&["run", "coarse.json"], folder.path())?;
    ensure!(output.status.success(), "{output:?}");
    let report: Value = serde_json::from_slice(&output.stdout)?;
    assert_eq!(report["outcome"], "diverged");
    assert!(report["at_s"].as_f64().is_some_and(|at| at > 0.0) && report["reason"].is_string(), "{report}");
    Ok(())
}

#[test]
fn the_table_holds_every_sample_to_the_bit() -> Result<()> {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("out.csv");
    fs::write(&path, "x".repeat(10_000_000))?;
    let output = adaptarm(&["run", "--preset", "tang_arteaga", "--csv", "out.csv"], folder.path())?;
    ensure!(output.status.success(), "{output:?}");
    let table = fs::read_to_string(&path)?;
    let preset = adaptarm_core::scenario::preset("tang_arteaga").context("no such preset")?;
    assert!(table == Scenario::new(preset.document())?.run().recording.to_csv(), "the table is not the core's");
    let mut lines = table.lines();
    let header: Vec<_> = lines.next().context("no header")?.split(',').collect();
    assert_eq!(header[..2], ["t_s", "e_deg_1"]);
    let mut times = Vec::new();
    for line in lines {
        let numbers = line.split(',').map(str::parse).collect::<Result<Vec<f64>, _>>()?;
        assert_eq!(numbers.len(), header.len());
        times.push(numbers[0]);
    }
    assert_eq!((times.len(), times[0], times[3000]), (3001, 0.0, 12.0));
    Ok(())
}

#[test]
fn a_preset_printed_and_read_again_is_the_same_scenario() -> Result<()> {
    let folder = tempfile::tempdir()?;
    for preset in PRESETS {
        let document = adaptarm(&["presets", "--show", preset.id], folder.path())?.stdout;
        assert_eq!(Scenario::read(&serde_json::from_slice::<Value>(&document)?)?, Scenario::new(preset.document())?);
    }
    let document = adaptarm(&["presets", "--show", "slotine_li"], folder.path())?.stdout;
    let mut child = Command::new(binary()?).args(["run", "-"]).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn()?;
    child.stdin.take().context("no standard input")?.write_all(&document)?;
    let piped = child.wait_with_output()?.stdout;
    assert_eq!(piped, adaptarm(&["run", "--preset", "slotine_li"], folder.path())?.stdout);
    let list = String::from_utf8(adaptarm(&["presets"], folder.path())?.stdout)?;
    assert!(PRESETS.iter().all(|preset| list.contains(preset.id)) && list.lines().count() == PRESETS.len());
    Ok(())
}

#[test]
fn bad_scenarios_are_refused_in_one_line_that_names_the_place() -> Result<()> {
    let folder = tempfile::tempdir()?;
    for Bad { name, document, names, .. } in BAD {
        fs::write(folder.path().join("bad.json"), document())?;
        let line = refusal(&adaptarm(&["run", "bad.json"], folder.path())?, 2).with_context(|| *name)?;
        assert!(line.starts_with("adaptarm: bad.json: ") && line.contains(names), "{name}: {line}");
    }
    Ok(())
}

#[test]
fn files_that_are_no_documents_are_refused() -> Result<()> {
    let folder = tempfile::tempdir()?;
    let run = |file: &str| adaptarm(&["run", file], folder.path());
    // Sparse: nothing reads its hundred megabytes, and if something did, it would show in time and memory.
    File::create(folder.path().join("huge.json"))?.set_len(100_000_000)?;
    let line = refusal(&run("huge.json")?, 2)?;
    assert!(line.starts_with("adaptarm: huge.json: is 100000000 bytes long") && line.contains("1048576"), "{line}");
    fs::create_dir(folder.path().join("folder.json"))?;
    assert!(refusal(&run("folder.json")?, 2)?.contains("folder.json: is a folder"));
    assert!(refusal(&run("missing.json")?, 1)?.contains("missing.json: cannot read it: No such file"));
    assert!(refusal(&adaptarm(&["run"], folder.path())?, 2)?.contains("--preset"));
    assert!(refusal(&adaptarm(&["run", "--preset", "puma"], folder.path())?, 2)?.contains("tang_arteaga"));
    let huge =
        Command::new(binary()?).args(["run", "-"]).stdin(File::open(folder.path().join("huge.json"))?).output()?;
    assert!(refusal(&huge, 2)?.contains("standard input: is longer than the 1048576 bytes"));
    Ok(())
}

#[test]
fn a_table_that_cannot_be_written_is_told_before_the_simulation() -> Result<()> {
    let folder = tempfile::tempdir()?;
    // Hours, if it were run.
    let long = MINIMAL.replace("\"proposed\"}", "\"proposed\"},\"integration\":{\"duration_s\":100000}");
    fs::write(folder.path().join("long.json"), &long)?;
    let line = refusal(&adaptarm(&["run", "long.json", "--csv", "nowhere/out.csv"], folder.path())?, 1)?;
    assert!(line.contains("nowhere/out.csv: cannot write it"), "{line}");
    let line = refusal(&adaptarm(&["run", "long.json", "--csv", "./long.json"], folder.path())?, 2)?;
    assert!(line.contains("would replace the scenario"), "{line}");
    let line = refusal(&adaptarm(&["run", "long.json", "--csv", "-"], folder.path())?, 2)?;
    assert!(line.contains("--csv -: standard output carries the report"), "{line}");
    assert_eq!(fs::read_dir(folder.path())?.count(), 1);
    assert_eq!(fs::read_to_string(folder.path().join("long.json"))?, long);
    Ok(())
}

#[test]
fn a_reader_that_goes_away_is_no_failure() -> Result<()> {
    let mut child = Command::new(binary()?)
        .args(["run", "--preset", "proposed"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()?;
    drop(child.stdout.take());
    let output = child.wait_with_output()?;
    ensure!(output.status.success() && output.stderr.is_empty(), "{output:?}");
    Ok(())
}

#[test]
fn help_teaches_exit_codes_and_examples() -> Result<()> {
    for command in ["run", "serve", "presets"] {
        let help = String::from_utf8(adaptarm(&[command, "--help"], Path::new("."))?.stdout)?;
        assert!(help.contains("Examples:\n  adaptarm "), "{help}");
    }
    let help = String::from_utf8(adaptarm(&["run", "--help"], Path::new("."))?.stdout)?;
    assert!(help.contains("Exit codes:\n  0  "), "{help}");
    Ok(())
}
