//! Canceling what runs: the job says so at once, and its computation is gone within a second.

use adaptarm_tests::client::{Client, surely};
use adaptarm_tests::workload::{scenario, study};
use adaptarm_tests::{Launch, Server, machine};
use anyhow::{Result, ensure};
use serde_json::json;
use std::thread::sleep;
use std::time::Duration;

pub fn running() -> Result<()> {
    let server = Launch::new().arguments(["--threads", "1"]).serve()?;
    let client = Client::new(&server.url);
    // Some minutes, if it were let run.
    let long = scenario("proposed", &json!({"duration_s": 3000, "step_s": 5e-5}));
    let id = client.submit(&study(&[long]))?;
    surely(Duration::from_secs(20), || {
        let job = client.job(&id)?;
        Ok((job["state"] == "running" && job["progress"].as_f64() > Some(0.0)).then_some(()))
    })?;
    // Computing is polite: what else runs on the machine comes first.
    surely(Duration::from_mins(1), || Ok((computing(&server)? > 0.2).then_some(())))?;

    let canceled = client.cancel(&id)?.expect(200)?;
    ensure!(canceled["state"] == "canceled", "{canceled}");
    sleep(machine::promised(Duration::from_secs(1)));
    let busy = computing(&server)?;
    ensure!(busy < 0.2, "still computing after its time: {busy} of a second");

    let job = client.job(&id)?;
    ensure!(job["state"] == "canceled" && job["finished_at"].is_string(), "{job}");
    let result = client.result(&id)?;
    ensure!(result["complete"] == false && result["reports"] == json!([null]), "{result}");
    Ok(())
}

/// Processor time that a server takes within a second, s.
fn computing(server: &Server) -> Result<f64> {
    let before = server.processor_time()?;
    sleep(Duration::from_secs(1));
    Ok(server.processor_time()?.as_secs_f64() - before.as_secs_f64())
}
