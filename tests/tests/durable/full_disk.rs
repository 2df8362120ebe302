//! No space left where results are stored: the job says so and fails, the server lives, and goes on once there is space.

use adaptarm_tests::Launch;
use adaptarm_tests::client::Client;
use adaptarm_tests::workload::{scenario, study};
use anyhow::{Context, Result, ensure};
use serde_json::{Value, json};
use std::fs::{self, File};
use std::io::Write;
use std::time::Duration;

/// Far more samples than the file system holds, as incompressible as they come.
fn large(seed: u64) -> Value {
    let mut scenario = scenario("proposed", &json!({"duration_s": 30}));
    scenario["recording"] = json!({"samples": 30_000});
    scenario["seed"] = json!(seed);
    study(&[scenario])
}

fn small(seed: u64) -> Value {
    let mut scenario = scenario("slotine_li", &json!({"duration_s": 0.1}));
    scenario["recording"] = json!({"samples": 10});
    scenario["seed"] = json!(seed);
    study(&[scenario])
}

pub fn results() -> Result<()> {
    let disk = tempfile::tempdir()?;
    let folder = disk.path().to_str().context("a temporary folder whose name is not Unicode")?;
    let mount = r#"mount -t tmpfs -o size=1m tmpfs "$0" && exec "$@""#;
    let server = Launch::new()
        .through(["unshare", "--mount", "--propagation", "private", "sh", "-c", mount, folder])
        .arguments(["--results", folder])
        .serve()?;
    let client = Client::new(&server.url);
    let wait = |id: &str| client.wait(id, Duration::from_mins(2));
    // As the process sees it: outside, nothing is mounted there.
    let inside = format!("/proc/{}/root{folder}", server.id());
    let ended = wait(&client.submit(&small(1))?)?;
    ensure!(ended["state"] == "succeeded", "{ended}");

    let id = client.submit(&large(2))?;
    let ended = wait(&id)?;
    let reason = ended["reason"].as_str().unwrap_or_default().to_lowercase();
    ensure!(ended["state"] == "failed" && reason.contains("no space"), "{ended}");
    let result = client.result(&id)?;
    ensure!(result["complete"] == false && result["reports"][0].is_null(), "{result}");

    // Full to the last byte: nothing at all can be stored.
    let filler = format!("{inside}/filler");
    let mut file = File::create(&filler).context("the process's file system")?;
    while file.write_all(&[0; 1024]).is_ok() {}
    drop(file);
    let ended = wait(&client.submit(&small(3))?)?;
    let reason = ended["reason"].as_str().unwrap_or_default().to_lowercase();
    ensure!(ended["state"] == "failed" && reason.contains("no space"), "{ended}");
    for path in ["/healthz", "/readyz", "/api/v1/presets", "/api/v1/jobs"] {
        client.get(path)?.expect_status(200)?;
    }

    fs::remove_file(&filler)?;
    let ended = wait(&client.submit(&small(4))?)?;
    ensure!(ended["state"] == "succeeded", "{ended}");
    Ok(())
}
