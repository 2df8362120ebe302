//! `adaptarm experiment`: the same files with any number of threads, killed or not; what it says of wrong ones.

use crate::run::refusal;
use adaptarm_tests::binary;
use anyhow::{Context, Result, ensure};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

fn command(file: &Path, arguments: &[&str], out: &Path) -> Result<Command> {
    let mut command = Command::new(binary()?);
    command.arg("experiment").arg(file).args(arguments).arg("--out").arg(out).stdin(Stdio::null());
    Ok(command)
}

/// Content of every file in a folder, by name.
fn files(folder: &Path) -> Result<BTreeMap<PathBuf, Vec<u8>>> {
    fs::read_dir(folder)?
        .map(|entry| {
            Ok((entry.as_ref().map(|entry| entry.file_name().into()).unwrap_or_default(), fs::read(entry?.path())?))
        })
        .collect()
}

fn summary(output: &Output) -> Result<Value> {
    ensure!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    Ok(serde_json::from_slice(&output.stdout)?)
}

fn write(folder: &Path, document: &Value) -> Result<PathBuf> {
    let path = folder.join("experiment.json");
    fs::write(&path, document.to_string())?;
    Ok(path)
}

fn scenario(scheme: &str, duration_s: f64) -> Value {
    let integration = json!({ "duration_s": duration_s });
    json!({ "format": "adaptarm.scenario/1", "scheme": { "kind": scheme }, "integration": integration,
            "recording": { "samples": 100 } })
}

fn monte_carlo(draws: u32, duration_s: f64) -> Value {
    let distribution = json!({ "kind": "normal", "mean": 1, "sd": 0.1, "min": 0.5 });
    let bases = json!([
        { "name": "a, with a comma", "scenario": scenario("proposed", duration_s) },
        { "name": "b", "scenario": scenario("slotine_li", duration_s) },
    ]);
    json!({ "format": "adaptarm.experiment/1", "kind": "monte_carlo", "seed": 3, "bases": bases,
            "monte_carlo": { "draws": draws, "fields": [{ "field": "/plant/theta_scale/*", "distribution": distribution }] } })
}

/// Starts an experiment, kills it as soon as it has kept something, and says whether it was killed at work.
fn kill(file: &Path, out: &Path) -> Result<bool> {
    let mut child = command(file, &["--threads", "1"], out)?.stdout(Stdio::null()).spawn()?;
    let started = Instant::now();
    while !out.join("checkpoint.bin").exists() {
        ensure!(started.elapsed() < Duration::from_mins(2), "nothing was kept");
        std::thread::sleep(Duration::from_millis(20));
    }
    // It is there before the first rows are.
    std::thread::sleep(Duration::from_secs(1));
    child.kill()?;
    child.wait()?;
    Ok(!out.join("summary.json").exists())
}

#[test]
fn killed_and_resumed_with_other_threads_the_files_are_the_same() -> Result<()> {
    let folder = tempfile::tempdir()?;
    // Several seconds of one core, so that the kill comes in the middle.
    let file = write(folder.path(), &monte_carlo(400, 12.0))?;
    let [whole, broken] = ["whole", "broken"].map(|name| folder.path().join(name));
    ensure!(kill(&file, &broken)?, "it was done before it could be killed");
    let resumed = summary(&command(&file, &["--threads", "2", "--resume"], &broken)?.output()?)?;
    let straight = summary(&command(&file, &["--threads", "2"], &whole)?.output()?)?;
    assert_eq!(resumed, straight);
    assert_eq!((straight["runs"].as_u64(), straight["done"].as_u64()), (Some(800), Some(800)));
    let (resumed, straight) = (files(&broken)?, files(&whole)?);
    assert_eq!(resumed.keys().collect::<Vec<_>>(), straight.keys().collect::<Vec<_>>());
    for (name, content) in &straight {
        assert!(resumed[name] == *content, "{} differs", name.display());
    }
    // Resuming what is done changes nothing.
    summary(&command(&file, &["--resume"], &broken)?.output()?)?;
    assert!(files(&broken)? == straight);
    Ok(())
}

#[test]
fn a_folder_of_another_experiment_is_left_alone() -> Result<()> {
    let folder = tempfile::tempdir()?;
    let out = folder.path().join("out");
    let file = write(folder.path(), &monte_carlo(2, 0.1))?;
    summary(&command(&file, &[], &out)?.output()?)?;
    let earlier = files(&out)?;
    let other = write(folder.path(), &monte_carlo(3, 0.1))?;
    let said = refusal(&command(&other, &[], &out)?.output()?, 2)?;
    assert!(said.contains("--out") && said.contains("another experiment's results"), "{said}");
    assert!(files(&out)? == earlier);
    let same = write(folder.path(), &monte_carlo(2, 0.1))?;
    summary(&command(&same, &[], &out)?.output()?)?;
    assert!(files(&out)? == earlier);
    Ok(())
}

#[test]
fn one_thread_and_two_write_the_same_table() -> Result<()> {
    let folder = tempfile::tempdir()?;
    let file = write(folder.path(), &monte_carlo(20, 0.2))?;
    let outs = ["1", "2"].map(|threads| (threads, folder.path().join(threads)));
    for (threads, out) in &outs {
        summary(&command(&file, &["--threads", threads], out)?.output()?)?;
    }
    let [one, two] = outs.map(|(_, out)| files(&out));
    let (one, two) = (one?, two?);
    assert!(one == two);
    let names: Vec<_> = one.keys().filter_map(|name| name.to_str()).collect();
    assert_eq!(
        names,
        ["boxes.svg", "checkpoint.bin", "experiment.json", "ranking.svg", "runs.csv", "runs.parquet", "summary.json"]
    );
    let csv = String::from_utf8(one[Path::new("runs.csv")].clone())?;
    let lines: Vec<_> = csv.lines().collect();
    assert_eq!(lines.len(), 41);
    assert!(lines[0].starts_with("run,point,condition,base,outcome,at_s,/plant/theta_scale/0,"), "{}", lines[0]);
    assert!(lines[1].starts_with("0,0,nominal,\"a, with a comma\",completed,,"), "{}", lines[1]);
    // What is planned there is what `run` runs.
    let experiment: Value = serde_json::from_slice(&one[Path::new("experiment.json")])?;
    let mut first = experiment["bases"][1]["scenario"].clone();
    let cells: Vec<_> = lines[2].split(',').collect();
    for n in 0..18 {
        first["plant"]["theta_scale"][n] = json!(cells[6 + n].parse::<f64>()?);
    }
    let path = folder.path().join("first.json");
    fs::write(&path, first.to_string())?;
    let run = Command::new(binary()?).arg("run").arg(&path).output()?;
    let run: Value = serde_json::from_slice(&run.stdout)?;
    let column = lines[0].split(',').position(|name| name == "index_e_deg_1").context("no such column")?;
    assert_eq!(json!(cells[column].parse::<f64>()?), run["index_e_deg"][0]);
    Ok(())
}

#[test]
fn a_tuning_leaves_a_scenario_that_runs() -> Result<()> {
    let folder = tempfile::tempdir()?;
    let tuning = json!({
        "variables": [{ "field": "/scheme/gains/k_v/*", "min": 0.1, "max": 10, "log": true, "relative": true }],
        "objective": [{ "metric": "index_e_deg", "weight": 1 }],
        "evaluations": 21,
    });
    let bases = json!([{ "name": "a", "scenario": scenario("proposed", 0.2) }]);
    let document = json!({ "format": "adaptarm.experiment/1", "kind": "tuning", "bases": bases, "tuning": tuning });
    let file = write(folder.path(), &document)?;
    let [one, two] = ["1", "2"].map(|threads| (threads, folder.path().join(threads)));
    for (threads, out) in [&one, &two] {
        let found = summary(&command(&file, &["--threads", threads], out)?.output()?)?;
        assert!(found["best"]["objective"].as_f64() < Some(1.0), "{found}");
    }
    assert!(files(&one.1)? == files(&two.1)?);
    let run = Command::new(binary()?).arg("run").arg(one.1.join("best.json")).output()?;
    ensure!(run.status.success(), "{run:?}");
    assert_eq!(fs::read_to_string(one.1.join("generations.csv"))?.lines().count(), 1 + 3);
    Ok(())
}

#[test]
fn what_is_wrong_is_said_on_one_line() -> Result<()> {
    let folder = tempfile::tempdir()?;
    let out = folder.path().join("out");
    let refused = |document: &Value, arguments: &[&str], code: i32| -> Result<String> {
        refusal(&command(&write(folder.path(), document)?, arguments, &out)?.output()?, code)
    };
    let mut wrong = monte_carlo(0, 0.1);
    assert!(refused(&wrong, &[], 2)?.contains("monte_carlo.draws: 0 is outside the allowed range 1 to 200000"));
    wrong["monte_carlo"]["draws"] = json!("many");
    assert!(refused(&wrong, &[], 2)?.contains("monte_carlo.draws: invalid type: string \"many\""));
    wrong["bases"][1]["scenario"]["scheme"]["kind"] = json!("magic");
    assert!(refused(&wrong, &[], 2)?.contains("bases[1].scenario.scheme.kind"));
    assert!(!out.exists(), "a wrong experiment leaves nothing");

    summary(&command(&write(folder.path(), &monte_carlo(2, 0.1))?, &[], &out)?.output()?)?;
    assert!(refused(&monte_carlo(3, 0.1), &["--resume"], 2)?.contains("another experiment's results"));
    fs::write(out.join("checkpoint.bin"), "nonsense")?;
    assert!(refused(&monte_carlo(2, 0.1), &["--resume"], 1)?.contains("is damaged"));
    let missing = command(&folder.path().join("nowhere.json"), &[], &out)?.output()?;
    assert!(refusal(&missing, 1)?.contains("cannot read it"));
    Ok(())
}

/// The examples of the manual are right, whatever they would take to run.
#[test]
fn the_examples_of_the_manual_are_experiments() -> Result<()> {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs");
    let mut count = 0;
    for folder in ["experiments", "experiments/sensorless", "replication"].map(|name| docs.join(name)) {
        for entry in fs::read_dir(folder)? {
            let path = entry?.path();
            if path.extension().is_none_or(|extension| extension != "json") {
                continue;
            }
            let text = fs::read_to_string(&path)?;
            let read = adaptarm_core::experiments::Experiment::read(&mut serde_json::Deserializer::from_str(&text));
            ensure!(read.is_ok(), "{}: {:?}", path.display(), read.err().map(|error| error.to_string()));
            count += 1;
        }
    }
    assert!(count >= 18, "{count}");
    Ok(())
}

/// The search says the same with any number of threads, and its report stands beside its rows.
#[test]
fn a_replication_search_reports_what_it_found() -> Result<()> {
    let folder = tempfile::tempdir()?;
    let bases: Vec<_> = ["proposed", "tang_arteaga", "slotine_li"]
        .map(|scheme| json!({ "name": scheme, "scenario": scenario(scheme, 1.0) }))
        .into();
    let options = json!([{ "name": "moving" }, { "name": "at rest", "change": { "initial": { "velocity": "rest" } } }]);
    let section = json!({ "unknowns": [{ "name": "start", "options": options }], "horizons_s": [1, 0.8],
        "windows": [{ "name": "whole" }], "units": ["labelled", "radians"] });
    let document =
        json!({ "format": "adaptarm.experiment/1", "kind": "replication", "bases": bases, "replication": section });
    let file = write(folder.path(), &document)?;
    let [one, two] = ["1", "2"].map(|threads| (threads, folder.path().join(threads)));
    let mut found = Vec::new();
    for (threads, out) in [&one, &two] {
        found.push((summary(&command(&file, &["--threads", threads], out)?.output()?)?, files(out)?));
    }
    assert_eq!(found[0].0, found[1].0);
    for (name, bytes) in &found[0].1 {
        assert!(name.ends_with("checkpoint.bin") || bytes == &found[1].1[name], "{}", name.display());
    }
    assert_eq!((found[0].0["runs"].as_u64(), found[0].0["complete"].as_u64()), (Some(6), Some(8)));
    let report = fs::read_to_string(one.1.join("report.md"))?;
    let place = |text: &str| report.find(text).with_context(|| format!("no {text:?} in the report"));
    ensure!(place("**Distance**")? < place("## The nearest readings")?, "results stand before what distance means");
    ensure!(place("| start | moving; at rest | all schemes |")? < place("## The paper's claims")?);
    for figure in ["entries.svg", "unknowns.svg"] {
        ensure!(report.contains(figure) && fs::read_to_string(one.1.join(figure))?.starts_with("<svg"), "{figure}");
    }
    Ok(())
}
