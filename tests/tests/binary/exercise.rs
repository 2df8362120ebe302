//! `adaptarm exercise` and `receipt`: shipped exercises are fair, mistakes are named, grades are the core's.

use crate::run::refusal;
use adaptarm_core::exercises::Exercise;
use adaptarm_tests::binary;
use adaptarm_tests::machine::soak;
use anyhow::{Context, Result, ensure};
use serde_json::{Value, json};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

fn adaptarm(arguments: &[&str], folder: &Path) -> Result<Output> {
    Ok(Command::new(binary()?).args(arguments).current_dir(folder).stdin(Stdio::null()).output()?)
}

fn stdout(output: &Output) -> Result<String> {
    ensure!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    Ok(String::from_utf8(output.stdout.clone())?)
}

fn shipped(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../static/exercises").join(name)
}

#[test]
fn there_are_ten_exercises_and_nothing_to_mend_in_them() -> Result<()> {
    let folder = tempfile::tempdir()?;
    let list: Value = serde_json::from_str(&stdout(&adaptarm(&["exercise", "list", "--json"], folder.path())?)?)?;
    let list = list.as_array().context("no list")?;
    ensure!(list.len() >= 10, "{}", list.len());
    for level in ["first", "intermediate", "advanced", "research"] {
        ensure!(list.iter().any(|exercise| exercise["level"] == level), "none for {level}");
    }
    let checked = stdout(&adaptarm(&["exercise", "check"], folder.path())?)?;
    ensure!(checked.lines().count() == list.len() && checked.lines().all(|line| line.ends_with(": nothing to mend")));
    Ok(())
}

/// Reference solutions have full marks on every seed, naive values under half, no bound lies within the spread of good solutions.
#[test]
fn every_shipped_exercise_is_fair() -> Result<()> {
    let folder = tempfile::tempdir()?;
    if soak() {
        let table = stdout(&adaptarm(&["exercise", "calibrate", "--markdown"], folder.path())?)?;
        let docs = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/exercises.md"))?;
        ensure!(docs.contains(table.trim()), "docs/exercises.md has other tables than this:\n{table}");
        return Ok(());
    }
    let few = ["exercise", "calibrate", "--seeds", "2", "--random", "4", "--json"];
    let all: Value = serde_json::from_str(&stdout(&adaptarm(&few, folder.path())?)?)?;
    for calibration in all.as_array().context("no list")? {
        let name = &calibration["exercise"];
        for solution in calibration["solutions"].as_array().context("no list")? {
            ensure!(solution["min"] == 1.0, "{name}: {solution}");
        }
        ensure!(calibration["naive"]["max"].as_f64().is_some_and(|score| score < 0.5), "{name}");
    }
    Ok(())
}

#[test]
fn an_unfair_exercise_is_called_so() -> Result<()> {
    let folder = tempfile::tempdir()?;
    let text = fs::read_to_string(shipped("pendulum-gravity.toml"))?;
    let few = |name: &str| adaptarm(&["exercise", "calibrate", name, "--seeds", "2", "--random", "2"], folder.path());
    for (name, from, to, told) in [
        ("strict.toml", "full = 1.2\nzero = 5.0", "full = 0.01\nzero = 5.0", "not full marks"),
        (
            "lax.toml",
            "full = 1.2\nzero = 5.0\nweight = 5.0",
            "full = 80.0\nzero = 90.0\nweight = 50.0",
            "not under half",
        ),
    ] {
        ensure!(text.contains(from));
        fs::write(folder.path().join(name), text.replace(from, to))?;
        let output = few(name)?;
        let said = String::from_utf8(output.stdout.clone())?;
        ensure!(output.status.code() == Some(2) && said.contains(told), "{said}");
        ensure!(String::from_utf8(output.stderr)?.contains("not fair: pendulum-gravity"));
    }
    Ok(())
}

#[test]
fn mistakes_are_told_with_file_and_place() -> Result<()> {
    let folder = tempfile::tempdir()?;
    let text = fs::read_to_string(shipped("pendulum-gravity.toml"))?;
    let path = folder.path().join("my.toml");
    for (content, told) in [
        ("format = ".to_owned(), "my.toml: not TOML: "),
        (
            text.replace("start = 0.5", "start = 50.0"),
            "my.toml: moves[2].start: 50 is outside the allowed range 0 to 15",
        ),
        (text.replace("minutes = 20", "minutes = \"long\""), "my.toml: minutes: invalid type: string"),
        (text.replace("\"pendulum\"", "\"toaster\""), "my.toml: scenario.robot: \"toaster\" is not known"),
        (format!("{text}\n[extra]\n"), "my.toml: "),
    ] {
        fs::write(&path, content)?;
        let line = refusal(&adaptarm(&["exercise", "check", "my.toml"], folder.path())?, 2)?;
        ensure!(line.contains(told), "{line}");
    }
    let missing = refusal(&adaptarm(&["exercise", "check", "none.toml"], folder.path())?, 1)?;
    ensure!(missing.contains("none.toml: cannot read it"), "{missing}");
    let unknown = refusal(&adaptarm(&["exercise", "check", "none"], folder.path())?, 2)?;
    ensure!(unknown.contains("no exercise is called so") && unknown.contains("pendulum-gravity"), "{unknown}");
    fs::write(&path, text.replace("See why PD", "<b>See</b> why PD"))?;
    let output = adaptarm(&["exercise", "check", "my.toml"], folder.path())?;
    ensure!(output.status.code() == Some(2) && String::from_utf8(output.stdout)?.contains("goal.en: holds HTML"));
    Ok(())
}

#[test]
fn a_grade_is_the_cores() -> Result<()> {
    use adaptarm_core::exercises::Visibility::{Hidden, Visible};
    let folder = tempfile::tempdir()?;
    let submitted = json!({ "gravity": 0.9, "k_p": 30.0, "k_d": 3.0 });
    fs::write(folder.path().join("g.json"), submitted.to_string())?;
    let grade = |more: &[&str]| -> Result<Value> {
        let arguments = [&["exercise", "grade", "pendulum-gravity", "--gains", "g.json", "--seed", "7"], more].concat();
        Ok(serde_json::from_str(&stdout(&adaptarm(&arguments, folder.path())?)?)?)
    };
    let gains = serde_json::from_value(submitted)?;
    let text = fs::read_to_string(shipped("pendulum-gravity.toml"))?;
    let exercise = Exercise::read(toml::Deserializer::parse(&text)?)?;
    for (more, visibility) in [(&[][..], Hidden), (&["--visible"][..], Visible)] {
        let runs = exercise.runs(&gains, 7, visibility)?;
        let reports: Vec<_> = runs.iter().map(|run| run.run().report).collect();
        assert_eq!(grade(more)?, serde_json::to_value(exercise.grade(&gains, 7, visibility, &reports)?)?);
    }
    fs::write(folder.path().join("g.json"), "{\"gravity\": 9}")?;
    let arguments = ["exercise", "grade", "pendulum-gravity", "--gains", "g.json", "--seed", "7"];
    let line = refusal(&adaptarm(&arguments, folder.path())?, 2)?;
    ensure!(line.contains("gains.gravity: 9 is outside the allowed range 0 to 2"), "{line}");
    Ok(())
}

#[test]
fn a_receipt_that_is_none_is_refused() -> Result<()> {
    let folder = tempfile::tempdir()?;
    fs::write(folder.path().join("r.json"), "{}")?;
    let line = refusal(&adaptarm(&["receipt", "verify", "r.json"], folder.path())?, 2)?;
    ensure!(line.contains("r.json: ") && line.contains("missing field `statement`"), "{line}");
    let key = stdout(&adaptarm(&["receipt", "key", "--data", "data"], folder.path())?)?;
    ensure!(key.trim().len() == 64, "{key}");
    assert_eq!(stdout(&adaptarm(&["receipt", "key", "--data", "data"], folder.path())?)?, key);
    Ok(())
}
