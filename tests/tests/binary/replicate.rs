//! `adaptarm replicate`: what it prints, what it leaves in its folder, and how it refuses.

use adaptarm_tests::binary;
use anyhow::{Result, ensure};
use serde_json::Value;
use std::path::Path;
use std::process::{Command, Output};

fn replicate(arguments: &[&str], folder: &Path) -> Result<Output> {
    Ok(Command::new(binary()?).arg("replicate").args(arguments).arg("--out").arg(folder).output()?)
}

#[test]
fn the_study_is_regenerated() -> Result<()> {
    let folder = tempfile::tempdir()?;
    let output = replicate(&[], &folder.path().join("deep/er"))?;
    let folder = folder.path().join("deep/er");
    let said = String::from_utf8(output.stdout)?;
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    for expected in ["Table 1.", "Table 2.", "ratio", "HOLDS", "DOES NOT HOLD", "criterion:", "Assumptions", "K_d"] {
        assert!(said.contains(expected), "{expected} is missing in:\n{said}");
    }

    let report: Value = serde_json::from_str(&std::fs::read_to_string(folder.join("report.json"))?)?;
    assert_eq!(report["format"], "adaptarm.replication/1");
    assert_eq!(report["tables"][0]["rows"].as_array().map(Vec::len), Some(3));
    assert_eq!(report["claims"].as_array().map(Vec::len), Some(12));
    assert_eq!(report["assumptions"].as_array().map(Vec::len), Some(18));

    // Self-contained: nothing is fetched from anywhere.
    let html = std::fs::read_to_string(folder.join("report.html"))?;
    assert_eq!(html.matches("<svg").count(), 7);
    let namespaces = html.matches("http://www.w3.org/").count();
    assert_eq!(html.matches("http").count(), namespaces);
    assert!(!html.contains("<script") && !html.contains("src=") && !html.contains("<link"));

    for scheme in ["proposed", "tang_arteaga", "slotine_li"] {
        let csv = std::fs::read_to_string(folder.join(format!("series/{scheme}.csv")))?;
        assert_eq!(csv.lines().count(), 3002);
        // The scenario in the folder gives the very run in the report.
        let run = Command::new(binary()?).arg("run").arg(folder.join(format!("scenarios/{scheme}.json"))).output()?;
        let run: Value = serde_json::from_slice(&run.stdout)?;
        let reports = report["reports"].as_array().map_or(&[][..], Vec::as_slice);
        assert!(reports.contains(&run), "{scheme}: another report");
    }
    for figure in [
        "tracking_errors",
        "velocity_errors",
        "observer_errors",
        "estimates_1",
        "estimates_2",
        "estimates_3",
        "torques",
    ] {
        let png = std::fs::read(folder.join(format!("figures/{figure}.png")))?;
        assert!(png.starts_with(b"\x89PNG") && png.len() > 10_000, "{figure}");
        assert!(std::fs::read_to_string(folder.join(format!("figures/{figure}.svg")))?.starts_with("<svg"));
    }
    Ok(())
}

#[test]
fn diverged_runs_are_named_and_not_counted() -> Result<()> {
    let folder = tempfile::tempdir()?;
    let output = replicate(&["--step", "0.05", "--duration", "1"], folder.path())?;
    ensure!(output.status.success(), "{output:?}");
    let said = String::from_utf8(output.stdout)?;
    assert!(said.contains("proposed DIVERGED at"), "{said}");
    // In both tables, three joints of two schemes, and the observer's three peaks.
    assert_eq!(said.matches(" diverged ").count(), 2 * 3 * 2 + 3, "{said}");
    assert_eq!(said.matches("NOT TESTED ").count(), 12, "{said}");
    let html = std::fs::read_to_string(folder.path().join("report.html"))?;
    assert_eq!(html.matches("<td>diverged</td>").count(), 2 * 3 * 2 + 3);
    assert_eq!(html.matches("– not tested").count(), 12);
    Ok(())
}

#[test]
fn other_settings_are_said_and_wrong_ones_refused() -> Result<()> {
    let folder = tempfile::tempdir()?;
    let output = replicate(&["--duration", "1", "--samples", "500", "--from-rest"], folder.path())?;
    assert!(output.status.success());
    assert!(String::from_utf8(output.stdout)?.contains("1 s, step 0.001 s, 500 samples, from rest"));

    let output = replicate(&["--step", "7"], folder.path())?;
    assert_eq!(output.status.code(), Some(2));
    let said = String::from_utf8(output.stderr)?;
    assert_eq!(said.lines().count(), 1, "{said}");
    assert!(said.contains("integration.step_s: 7 is outside the allowed range"), "{said}");

    let occupied = folder.path().join("file");
    std::fs::write(&occupied, "")?;
    let output = replicate(&[], &occupied)?;
    assert_eq!(output.status.code(), Some(1));
    assert!(String::from_utf8(output.stderr)?.contains("cannot make the folder"));
    Ok(())
}
