//! The examples of docs/api.md, run as they stand but for the server's address: a manual whose examples fail is worse than none.

use adaptarm_tests::{Launch, machine};
use anyhow::{Context, Result, ensure};
use std::fs;
use std::path::Path;
use std::process::Command;

const MANUAL: &str = include_str!("../../../docs/api.md");

const RUST: &str = include_str!("../../src/bin/api_example.rs");

/// Address of the server in the examples.
const ADDRESS: &str = "http://127.0.0.1:8080";

/// The fenced blocks of a language.
fn blocks(language: &str) -> Vec<&'static str> {
    let parts = MANUAL.split("\n```").skip(1).step_by(2);
    parts.filter_map(|part| part.strip_prefix(language)?.strip_prefix('\n')).collect()
}

/// Runs a program in a folder; what it printed.
fn run(command: &mut Command, folder: &Path) -> Result<String> {
    let output = command.current_dir(folder).output()?;
    let printed = String::from_utf8_lossy(&output.stdout).into_owned();
    ensure!(output.status.success(), "{printed}{}", String::from_utf8_lossy(&output.stderr));
    Ok(printed)
}

pub fn manual() -> Result<()> {
    let server = Launch::new().serve()?;
    let folder = tempfile::tempdir()?;
    let here = |text: &str| text.replace(ADDRESS, &server.url);

    let [study, experiment] = blocks("sh")[..] else { anyhow::bail!("two blocks for the shell are expected") };
    let shell = |block: &str| run(Command::new("bash").args(["-euo", "pipefail", "-c", &here(block)]), folder.path());
    let told = shell(study)?;
    ensure!(told.contains("event: summary") && told.contains("\"state\":\"succeeded\""), "{told}");
    let read = |name: &str| fs::read(folder.path().join(name)).context(name.to_owned());
    ensure!(read("errors.csv")?.starts_with(b"t_s,e_deg_1\n0.0,"), "the samples");
    ensure!(read("torques.png")?.starts_with(b"\x89PNG"), "the picture");
    ensure!(read("result.json")?.starts_with(b"{\"format\":\"adaptarm.study/1\",\"complete\":true"), "the result");

    shell(experiment)?;
    ensure!(
        read("experiment-result.json")?.starts_with(b"{\"format\":\"adaptarm.experiment_result/1\",\"complete\":true"),
        "the experiment"
    );
    ensure!(read("runs.csv")?.split(|byte| *byte == b'\n').count() == 22, "a header, twenty runs, the end");
    ensure!(read("boxes.png")?.starts_with(b"\x89PNG"), "the picture of an experiment");

    let python = machine::python().context("ADAPTARM_PYTHON names no interpreter")?;
    let [client, receiver] = blocks("python")[..] else { anyhow::bail!("two blocks of Python are expected") };
    let told = run(Command::new(&python).args(["-c", &here(client)]), folder.path())?;
    ensure!(told.matches("completed: root mean square").count() == 3, "{told}");
    run(Command::new(&python).args(["-c", receiver]), folder.path())?;

    let [program] = blocks("rust")[..] else { anyhow::bail!("one block of Rust is expected") };
    let compiled = RUST.split_once("\n\n").context("a program without a first line")?.1;
    ensure!(program.trim() == compiled.trim(), "docs/api.md and api_example.rs differ");
    let told = run(Command::new(env!("CARGO_BIN_EXE_api_example")).arg(&server.url), folder.path())?;
    ensure!(told.contains("\"slotine_li\": tracking error [") && told.contains("302 lines of samples"), "{told}");
    Ok(())
}
