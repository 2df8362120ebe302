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
        let whole = Scenario::read(document)?.run().recording.to_csv();
        for (columns, every) in [
            (None, 1),
            (None, 7),
            (Some("t_s,e_deg_1"), 1),
            (Some("theta_hat_18,t_s,s_rad_s_2"), 10),
            (Some("tau_nm_3"), 1_000_000),
        ] {
            let selection = columns.map(|columns| format!("&columns={columns}")).unwrap_or_default();
            let selection = format!("{selection}&every={every}");
            let read =
                compare(&client, &id, n, &selection, folder.path()).with_context(|| format!("{n}{selection}"))?;
            let expected = part(&whole, columns, every)?;
            let table = fs::read_to_string(file(folder.path(), "csv", n, &selection))?;
            ensure!(table == expected, "{n}{selection}: the table is not that part of the core's");
            ensure!(read["rows"] == expected.lines().count() - 1, "{n}{selection}: {read}");
        }
    }
    Ok(())
}

/// These columns of a table, and every so many rows of it; the last one in any case.
fn part(table: &str, columns: Option<&str>, every: usize) -> Result<String> {
    let rows: Vec<Vec<&str>> = table.lines().map(|line| line.split(',').collect()).collect();
    let (names, rows) = rows.split_first().context("an empty table")?;
    let place = |name: &str| names.iter().position(|other| *other == name).with_context(|| format!("no column {name}"));
    let places = columns.map_or_else(
        || Ok((0..names.len()).collect()),
        |columns| columns.split(',').map(place).collect::<Result<Vec<_>>>(),
    )?;
    let kept = rows.iter().enumerate().filter(|(n, _)| n % every == 0 || n + 1 == rows.len()).map(|(_, row)| row);
    let lines = std::iter::once(names)
        .chain(kept)
        .map(|row| places.iter().map(|place| row[*place]).collect::<Vec<_>>().join(","));
    Ok(lines.map(|line| line + "\n").collect())
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
