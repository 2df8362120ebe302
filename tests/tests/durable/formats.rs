//! A result's samples as NumPy and PyArrow read them: the same columns and bits as the CSV, whole or in part.

use adaptarm_core::scenario::Scenario;
use adaptarm_tests::client::Client;
use adaptarm_tests::workload::{scenario, study};
use adaptarm_tests::{Launch, machine};
use anyhow::{Context, Result, ensure};
use serde_json::{Value, json};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

pub fn series() -> Result<()> {
    let server = Launch::new().serve()?;
    let client = Client::new(&server.url);
    // The last one diverges: its recording ends early.
    let scenarios = [
        scenario("proposed", &json!({})),
        scenario("tang_arteaga", &json!({"duration_s": 1})),
        scenario("slotine_li", &json!({"step_s": 0.1})),
    ];
    let id = client.submit(&study(&scenarios))?;
    let ended = client.wait(&id, Duration::from_mins(1))?;
    ensure!(ended["state"] == "succeeded", "{ended}");
    let folder = tempfile::tempdir()?;
    for (n, document) in scenarios.iter().enumerate() {
        let recording = Scenario::read(document)?.run().recording;
        let rows = recording.len();
        let all = 1 + 6 * 3 + 18;
        for (selection, columns, rows) in [
            ("", all, rows),
            ("&every=7", all, rows.div_ceil(7)),
            ("&columns=t_s,e_deg_1", 2, rows),
            ("&columns=theta_hat_18,t_s,s_rad_s_2&every=10", 3, rows.div_ceil(10)),
        ] {
            let read =
                compare(&client, &id, n, selection, folder.path()).with_context(|| format!("{n} {selection}"))?;
            let read_columns = read["columns"].as_array().map_or(0, Vec::len);
            ensure!((read_columns, read["rows"].as_u64()) == (columns, Some(rows as u64)), "{n}{selection}: {read}");
        }
        let table = fs::read_to_string(file(folder.path(), "csv", n, ""))?;
        ensure!(table == recording.to_csv(), "the table of scenario {n} is not the core's");
    }
    Ok(())
}

fn file(folder: &Path, format: &str, scenario: usize, selection: &str) -> PathBuf {
    folder.join(format!("{scenario}{selection}.{format}"))
}

/// Downloads one table in every format and has Python compare them.
fn compare(client: &Client, id: &str, scenario: usize, selection: &str, folder: &Path) -> Result<Value> {
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/python/read_series.py");
    let mut command = Command::new(machine::python().context("ADAPTARM_PYTHON names no interpreter")?);
    command.arg(script);
    for format in ["csv", "npz", "parquet"] {
        let path = format!("/api/v1/jobs/{id}/result/series?scenario={scenario}&format={format}{selection}");
        let answer = client.get(&path)?;
        answer.expect_status(200)?;
        let file = file(folder, format, scenario, selection);
        fs::write(&file, &answer.body)?;
        command.arg(file);
    }
    let output = command.output()?;
    ensure!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    Ok(serde_json::from_slice(&output.stdout)?)
}
