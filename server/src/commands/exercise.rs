//! `adaptarm exercise`: list, check, calibrate and grade exercises without a server.

use super::Failure;
use super::run::read_input;
use crate::document::parse as parse_json;
use crate::exercises::{
    Calibration, Effort, ExerciseError, Library, calibrate, lint, markdown_table, read, reports, text_table,
};
use crate::stdout::print;
use adaptarm_core::exercises::{Exercise, GradeError, Visibility};
use clap::{Args, Subcommand};
use serde_json::json;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  adaptarm exercise list
  adaptarm exercise check my.toml
  adaptarm exercise calibrate my.toml
  adaptarm exercise grade pendulum-gravity --gains gains.json --seed 7

FILE is a path ending in .toml, or the id of an exercise that comes with the program. docs/exercises.md tells how to write one.

Exit codes:
  0  done; check and calibrate found nothing to mend
  1  something could not be read or written
  2  a file or the arguments are wrong, or there is something to mend")]
pub(super) struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// List the exercises that come with the program.
    List {
        /// As JSON.
        #[arg(long)]
        json: bool,
    },
    /// Read exercises and say what is wrong or missing.
    Check {
        /// Files; all that come with the program if none is given.
        #[arg(value_name = "FILE")]
        files: Vec<PathBuf>,
    },
    /// Show that reference solutions, naive values and random gains get the marks that they deserve.
    Calibrate {
        /// Files; all that come with the program if none is given.
        #[arg(value_name = "FILE")]
        files: Vec<PathBuf>,
        /// Students, each with variants of their own.
        #[arg(long, value_name = "N", default_value_t = 20, value_parser = clap::value_parser!(u64).range(1..=10_000))]
        seeds: u64,
        /// Gains at random.
        #[arg(long, value_name = "N", default_value_t = 40, value_parser = clap::value_parser!(u64).range(0..=100_000))]
        random: u64,
        /// Print JSON.
        #[arg(long, conflicts_with = "markdown")]
        json: bool,
        /// Print the tables of docs/exercises.md.
        #[arg(long)]
        markdown: bool,
    },
    /// Grade gains as the server would, and print everything, also what students may not see.
    Grade {
        /// File or id.
        #[arg(value_name = "FILE")]
        file: PathBuf,
        /// JSON file with a number for each move; - for standard input.
        #[arg(long, value_name = "GAINS.json")]
        gains: PathBuf,
        /// Seed of the variants.
        #[arg(long, value_name = "N")]
        seed: u64,
        /// On the visible variants instead of the hidden ones.
        #[arg(long)]
        visible: bool,
    },
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    match &arguments.command {
        Command::List { json } => list(*json),
        Command::Check { files } => check(files),
        Command::Calibrate { files, seeds, random, json, markdown } => {
            let effort = Effort { seeds: *seeds, random: *random };
            let form = if *json {
                Form::Json
            } else if *markdown {
                Form::Markdown
            } else {
                Form::Text
            };
            calibrate_all(files, effort, form)
        }
        Command::Grade { file, gains, seed, visible } => grade(file, gains, *seed, *visible),
    }
}

fn library() -> Result<Library, Failure> {
    Library::shipped().map_err(Failure::system)
}

/// An exercise by path or by identifier.
fn open(file: &Path) -> Result<Exercise, Failure> {
    let name = file.display().to_string();
    if file.extension().is_none_or(|end| end != "toml") {
        let library = library()?;
        let known = || library.iter().map(|exercise| exercise.document().id.as_str()).collect::<Vec<_>>().join(", ");
        let message = || format!("{name}: no exercise is called so (a file ends in .toml); there are {}", known());
        return library.get(&name).cloned().ok_or_else(|| Failure::input(message()));
    }
    read(file).map_err(|error| match error {
        ExerciseError::File(crate::document::FileError::Unreadable(_)) => Failure::system(format!("{name}: {error}")),
        _ => Failure::input(format!("{name}: {error}")),
    })
}

/// Each with its name as the caller wrote it; all of the program's if none is named.
fn open_all(files: &[PathBuf]) -> Result<Vec<(String, Exercise)>, Failure> {
    if files.is_empty() {
        let library = library()?;
        return Ok(library.iter().map(|exercise| (exercise.document().id.clone(), exercise.clone())).collect());
    }
    files.iter().map(|file| Ok((file.display().to_string(), open(file)?))).collect()
}

fn list(as_json: bool) -> Result<(), Failure> {
    let library = library()?;
    let mut text = String::new();
    if as_json {
        let rows = library.iter().map(|exercise| {
            let document = exercise.document();
            json!({
                "id": document.id, "level": document.level, "minutes": document.minutes, "title": document.title,
                "goal": document.goal, "fingerprint": exercise.fingerprint(),
            })
        });
        text = serde_json::to_string_pretty(&rows.collect::<Vec<_>>()).map_err(Failure::system)? + "\n";
    } else {
        for exercise in library.iter() {
            let document = exercise.document();
            // Writing to a string cannot fail.
            let _ = writeln!(text, "{:<22} {:>4} min  {}", document.id, document.minutes, document.title.en);
        }
    }
    Ok(print(&text)?)
}

fn check(files: &[PathBuf]) -> Result<(), Failure> {
    let (mut text, mut found) = (String::new(), 0);
    for (name, exercise) in open_all(files)? {
        let findings = lint(&exercise);
        let _ = writeln!(text, "{name}: {}", if findings.is_empty() { "nothing to mend" } else { "to mend:" });
        for finding in &findings {
            let _ = writeln!(text, "  {finding}");
        }
        found += findings.len();
    }
    print(&text)?;
    if found == 0 { Ok(()) } else { Err(Failure::input(format!("{found} to mend"))) }
}

/// How a calibration is printed.
#[derive(Clone, Copy)]
enum Form {
    Text,
    Json,
    Markdown,
}

fn calibrate_all(files: &[PathBuf], effort: Effort, form: Form) -> Result<(), Failure> {
    let mut all: Vec<Calibration> = Vec::new();
    for (name, exercise) in open_all(files)? {
        let calibration = calibrate(&exercise, effort).map_err(|error| Failure::input(format!("{name}: {error}")))?;
        if matches!(form, Form::Text) {
            print(&text_table(&calibration))?;
        }
        all.push(calibration);
    }
    match form {
        Form::Text => {}
        Form::Json => print(&(serde_json::to_string_pretty(&all).map_err(Failure::system)? + "\n"))?,
        Form::Markdown => print(&markdown_table(&all))?,
    }
    let unfair = all.iter().filter(|calibration| !calibration.findings.is_empty());
    let names: Vec<_> = unfair.map(|calibration| calibration.exercise.as_str()).collect();
    if names.is_empty() { Ok(()) } else { Err(Failure::input(format!("not fair: {}", names.join(", ")))) }
}

fn grade(file: &Path, gains: &Path, seed: u64, visible: bool) -> Result<(), Failure> {
    let exercise = open(file)?;
    let (name, bytes) = read_input(gains)?;
    let gains = parse_json::<BTreeMap<String, f64>>(&bytes);
    let gains = gains.map_err(|error| Failure::input(format!("{name}: {error}")))?;
    let visibility = if visible { Visibility::Visible } else { Visibility::Hidden };
    let grade = reports(&exercise, &gains, seed, visibility)
        .and_then(|reports| exercise.grade(&gains, seed, visibility, &reports))
        .map_err(|error: GradeError| Failure::input(format!("{name}: {error}")))?;
    Ok(print(&(serde_json::to_string_pretty(&grade).map_err(Failure::system)? + "\n"))?)
}
