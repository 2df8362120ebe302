//! One experiment, one result: by command line or by HTTP, on one thread or two, in lanes or run by run, undisturbed or killed
//! again and again. Compared to the byte, in all files.

use adaptarm_core::experiments::{Experiment, Results, Row, Summary};
use adaptarm_tests::client::{Client, surely};
use adaptarm_tests::postgres::Cluster;
use adaptarm_tests::{Launch, binary, machine};
use anyhow::{Context, Result, ensure};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::ffi::OsString;
use std::fs;
use std::path::Path;
use std::process::Command;
use std::thread::sleep;
use std::time::Duration;

const PATIENCE: Duration = Duration::from_mins(10);

/// Short, so that the death of a worker shows within the test.
const LEASE_S: &str = "2";

/// Files of an experiment by name.
type Files = BTreeMap<String, Vec<u8>>;

fn base(scheme: &str, duration_s: f64) -> Value {
    let scenario = json!({ "format": "adaptarm.scenario/1", "scheme": { "kind": scheme },
        "integration": { "duration_s": duration_s }, "recording": { "samples": 200 } });
    json!({ "name": scheme, "scenario": scenario })
}

fn arms() -> Value {
    let distribution = json!({ "kind": "lognormal", "median": 1, "log_sd": 0.1 });
    json!({ "field": "/plant/theta_scale/*", "distribution": distribution })
}

/// One of each kind. The comparison's runs are long enough to be interrupted themselves.
fn documents(size: u32) -> [Value; 4] {
    let document = |kind: &str, bases: Value, section: Value| {
        let mut document = json!({ "format": "adaptarm.experiment/1", "kind": kind, "seed": 7, "bases": bases });
        document[kind] = section;
        document
    };
    let set = json!([{ "field": "/plant/friction/width_rad_s", "value": 2, "relative": true }]);
    let conditions = json!([{ "name": "as it is" }, { "name": "softer friction", "set": set }]);
    let axes = json!([
        { "field": "/scheme/gains/k_v/0", "min": 10, "max": 160, "points": 4 + size, "log": true },
        { "field": "/scheme/gains/beta", "min": 2, "max": 20, "points": 5 },
    ]);
    let variable = json!({ "field": "/scheme/gains/k_v/*", "min": 0.25, "max": 4, "log": true, "relative": true });
    let tuning = json!({
        "variables": [variable], "objective": [{ "metric": "index_e_deg", "weight": 1 }],
        "plants": { "count": 4, "fields": [arms()], "validation": 8 }, "evaluations": 20 * size, "restarts": 2,
    });
    [
        document(
            "monte_carlo",
            json!([base("proposed", 2.0), base("slotine_li", 2.0)]),
            json!({ "draws": 60 * size, "fields": [arms()] }),
        ),
        document(
            "compare",
            json!([base("proposed", 300.0), base("slotine_li", 300.0)]),
            json!({ "conditions": conditions, "draws": 2 * size, "fields": [arms()] }),
        ),
        document("sweep", json!([base("proposed", 2.0)]), json!({ "design": "grid", "axes": axes })),
        document("tuning", json!([base("proposed", 2.0)]), tuning),
    ]
}

/// Files that the command line writes.
fn by_command(document: &Value, threads: &str) -> Result<Files> {
    let folder = tempfile::tempdir()?;
    let (file, out) = (folder.path().join("experiment.json"), folder.path().join("out"));
    fs::write(&file, document.to_string())?;
    let mut command = Command::new(binary()?);
    let output = command.arg("experiment").arg(&file).args(["--threads", threads]).arg("--out").arg(&out).output()?;
    ensure!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let read = |entry: std::io::Result<fs::DirEntry>| {
        let entry = entry?;
        Ok((entry.file_name().to_string_lossy().into_owned(), fs::read(entry.path())?))
    };
    fs::read_dir(&out)?.map(read).collect()
}

/// Files that a server gives.
fn by_http(client: &Client, id: &str) -> Result<Files> {
    let result = client.result(id)?;
    ensure!(result["complete"] == true, "{result}");
    let names = |list: &str| {
        result[list].as_array().into_iter().flatten().filter_map(Value::as_str).map(str::to_owned).collect::<Vec<_>>()
    };
    let read = |path: String, name: String| {
        let answer = client.get(&format!("/api/v1/jobs/{id}/result/{path}/{name}"))?;
        answer.expect_status(200)?;
        Ok((name, answer.body))
    };
    let files = names("files").into_iter().map(|name| read("files".to_owned(), name));
    files.chain(names("figures").into_iter().map(|name| read("figures".to_owned(), format!("{name}.svg")))).collect()
}

/// The summary when every run is made alone, without lanes.
fn run_by_run(document: &Value) -> Result<Option<String>> {
    let experiment = Experiment::read(document)?;
    let Some(runs) = experiment.runs() else { return Ok(None) };
    let mut results = Results::new();
    for run in experiment.plan(0..runs) {
        let row: Row = match run.scenario {
            Ok(scenario) => experiment.row(run.index, &scenario.run().report),
            Err(why) => experiment.refused(run.index, &why),
        };
        results.insert(&experiment, row)?;
    }
    Ok(Some(serde_json::to_string_pretty(&Summary::of(&experiment, &results))? + "\n"))
}

/// Whether a server's files are those of the command line, all but the checkpoint.
fn compare(kind: &Value, expected: &Files, found: &Files) -> Result<()> {
    let names = |files: &Files| files.keys().filter(|name| *name != "checkpoint.bin").cloned().collect::<Vec<_>>();
    ensure!(names(expected) == names(found), "{kind}: {:?} by command, {:?} by HTTP", names(expected), names(found));
    for (name, content) in found {
        ensure!(content == &expected[name], "{kind}: {name} differs");
    }
    Ok(())
}

fn submit(client: &Client, document: &Value) -> Result<String> {
    client.submit(&json!({ "kind": document["kind"], "spec": document }))
}

pub fn killed() -> Result<()> {
    let (size, kills) = if machine::soak() { (10, 12) } else { (1, 2) };
    let mut server = Launch::new().arguments(["--threads", "2"]).variable("ADAPTARM_QUEUE_SLICE_S", "0.2").serve()?;
    let client = Client::new(&server.url);
    let mut random = StdRng::seed_from_u64(11);
    for document in documents(size) {
        let expected = by_command(&document, "1")?;
        ensure!(expected["summary.json"] == by_command(&document, "2")?["summary.json"], "threads make a difference");
        if let Some(summary) = run_by_run(&document)? {
            ensure!(expected["summary.json"] == summary.as_bytes(), "{}: lanes make a difference", document["kind"]);
        }
        let id = submit(&client, &document)?;
        let mut at_work = 0;
        for kill in 0..kills {
            let goal = (f64::from(kill) + random.random_range(0.1..0.7)) / f64::from(kills);
            surely(PATIENCE, || {
                let job = client.job(&id)?;
                Ok((job["progress"].as_f64() >= Some(goal) || job["state"] == "succeeded").then_some(()))
            })
            .context("progress")?;
            at_work += u32::from(client.job(&id)?["state"] == "running");
            server.restart()?;
        }
        let job = client.wait(&id, PATIENCE)?;
        ensure!(job["state"] == "succeeded", "{job}");
        println!("{}: killed {at_work} times at work, {} attempts", document["kind"], job["attempts"]);
        compare(&document["kind"], &expected, &by_http(&client, &id)?)?;
    }
    Ok(())
}

pub fn workers() -> Result<()> {
    let size = if machine::soak() { 10 } else { 1 };
    let cluster = Cluster::start()?;
    let results = tempfile::tempdir()?;
    let arguments = arguments(&cluster.database("adaptarm")?, results.path());
    let server = Launch::new().arguments(&arguments).arguments(["--threads", "0"]).serve()?;
    let work = || {
        let launch = Launch::new().arguments(&arguments).arguments(["--threads", "1"]);
        launch.variable("ADAPTARM_QUEUE_LEASE_S", LEASE_S).variable("ADAPTARM_QUEUE_SLICE_S", "0.2").work()
    };
    let client = Client::new(&server.url);
    let mut first = work()?;
    let mut ids = Vec::new();
    for document in documents(size) {
        // One worker alone, which gets company while it works; then it is killed.
        let id = submit(&client, &document)?;
        let progressed =
            |goal: f64| surely(PATIENCE, || Ok((client.job(&id)?["progress"].as_f64() >= Some(goal)).then_some(())));
        progressed(0.1)?;
        let second = work()?;
        progressed(0.3)?;
        first.restart()?;
        let job = client.wait(&id, PATIENCE)?;
        ensure!(job["state"] == "succeeded", "{job}");
        drop(second);
        ids.push((document, id));
        sleep(Duration::from_millis(100));
    }
    for (document, id) in ids {
        compare(&document["kind"], &by_command(&document, "2")?, &by_http(&client, &id)?)?;
    }
    Ok(())
}

fn arguments(database: &str, results: &Path) -> Vec<OsString> {
    vec!["--database".into(), database.into(), "--results".into(), results.into()]
}
