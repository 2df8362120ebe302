//! Results and checkpoints in a bucket instead of a folder: the same bits, also of a simulation that went on elsewhere.

use adaptarm_core::scenario::Scenario;
use adaptarm_tests::client::{Client, surely};
use adaptarm_tests::s3::S3;
use adaptarm_tests::workload::{Work, Workload};
use adaptarm_tests::{Launch, Server};
use anyhow::{Context, Result, ensure};
use serde_json::Value;
use std::time::Duration;

const PREFIX: &str = "results/here";

const PATIENCE: Duration = Duration::from_mins(2);

pub fn results() -> Result<()> {
    let store = S3::start()?;
    let launch = Launch::new().arguments(["--threads", "1"]).variable("ADAPTARM_QUEUE_SLICE_S", "0.5");
    let mut server = store.launch(launch, PREFIX).serve()?;
    let client = Client::new(&server.url);
    let mut workload = Workload::new(6, 1500.0)?;
    let short = workload.study(8);
    let (undisturbed, disturbed) = (workload.even(1), workload.even(1));

    let (short_id, _) = finish(&client, &server, &short)?;
    let (undisturbed_id, whole_s) = finish(&client, &server, &undisturbed)?;

    let disturbed_id = client.submit(&disturbed.body)?;
    surely(PATIENCE, || {
        let job = client.job(&disturbed_id)?;
        Ok((job["progress"].as_f64() > Some(0.6) && !checkpoints(&store)?.is_empty()).then_some(()))
    })
    .context("a checkpoint in the bucket")?;
    server.restart()?;
    let job = client.wait(&disturbed_id, PATIENCE)?;
    disturbed.check(&client, &job)?;
    let rest_s = server.processor_time()?.as_secs_f64();
    println!("a simulation of {whole_s:.1} s of computing, killed after 60 %: {rest_s:.1} s for the rest");
    ensure!(rest_s < 0.8 * whole_s, "it began anew instead of going on: {rest_s} s after {whole_s} s");

    for (id, work) in [(&short_id, &short), (&undisturbed_id, &undisturbed), (&disturbed_id, &disturbed)] {
        for n in 0..work.hashes.len() {
            let path = format!("/api/v1/jobs/{id}/result/series?scenario={n}&format=csv");
            let series = client.get(&path)?;
            series.expect_status(200)?;
            let expected = Scenario::read(scenario(work, n))?.run().recording.to_csv();
            ensure!(series.body == expected.as_bytes(), "scenario {n} of {}: other samples", work.label);
        }
    }
    let recordings = store.objects(&format!("{PREFIX}/recordings"))?.len();
    ensure!(recordings == 10, "{recordings} recordings in the bucket, 10 scenarios");
    ensure!(checkpoints(&store)?.is_empty(), "checkpoints of jobs that have ended: {:?}", checkpoints(&store)?);
    ensure!(!server.data.path().join("results").exists(), "there is a folder of results as well");
    client.get("/readyz")?.expect_status(200)
}

/// Runs a job; its identifier, and the processor time that the server took over it, s.
fn finish(client: &Client, server: &Server, work: &Work) -> Result<(String, f64)> {
    let before = server.processor_time()?;
    let id = client.submit(&work.body)?;
    work.check(client, &client.wait(&id, PATIENCE)?)?;
    Ok((id, server.processor_time()?.as_secs_f64() - before.as_secs_f64()))
}

fn checkpoints(store: &S3) -> Result<Vec<std::path::PathBuf>> {
    store.objects(&format!("{PREFIX}/checkpoints"))
}

fn scenario(work: &Work, n: usize) -> &Value {
    &work.body["spec"]["scenarios"][n]
}
