//! `adaptarm receipt`: checks a signed receipt and makes its runs again; prints the key that receipts are signed with.

use super::Failure;
use super::options::StorageOptions;
use super::run::read_input;
use crate::document::parse;
use crate::exercises::{ExerciseError, Library, read};
use crate::laboratory::data_folder;
use crate::receipts::{Receipt, ReceiptKey, Reveal, rerun};
use crate::stdout::print;
use adaptarm_core::exercises::Exercise;
use clap::{Args, Subcommand};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  adaptarm receipt verify receipt.json --key 4f1c...          the signature
  adaptarm receipt verify receipt.json --reveal reveal.json   and the runs, once the seed is revealed
  adaptarm receipt key --data /var/lib/adaptarm               what others verify with

Exit codes:
  0  the receipt is good, and its runs came out the same if they were made
  1  something could not be read
  2  the receipt is forged, its runs come out otherwise, or the arguments are wrong")]
pub(super) struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Check a receipt's signature and, with what was revealed after the deadline, make its runs again.
    Verify {
        /// The receipt (JSON), or - for standard input.
        #[arg(value_name = "RECEIPT.json")]
        file: PathBuf,
        /// Public key that must have signed it, in hexadecimal.
        #[arg(long, value_name = "HEX")]
        key: Option<String>,
        /// What was revealed after the deadline (JSON).
        #[arg(long, value_name = "REVEAL.json")]
        reveal: Option<PathBuf>,
        /// The exercise, where it neither comes with the program nor with the reveal (TOML).
        #[arg(long, value_name = "FILE", requires = "reveal")]
        exercise: Option<PathBuf>,
    },
    /// Print the public key of a data folder; makes the key if there is none.
    Key {
        #[command(flatten)]
        storage: StorageOptions,
    },
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    match &arguments.command {
        Command::Verify { file, key, reveal, exercise } => {
            verify(file, key.as_deref(), reveal.as_deref(), exercise.as_deref())
        }
        Command::Key { storage } => {
            let config = storage.load(Vec::new())?.config;
            let key = ReceiptKey::open(&data_folder(&config)).map_err(Failure::system)?;
            Ok(print(&format!("{}\n", key.public()))?)
        }
    }
}

fn verify(file: &Path, key: Option<&str>, reveal: Option<&Path>, exercise: Option<&Path>) -> Result<(), Failure> {
    let (name, bytes) = read_input(file)?;
    let wrong = |error: &dyn std::fmt::Display| Failure::input(format!("{name}: {error}"));
    let receipt = parse::<Receipt>(&bytes).map_err(|error| wrong(&error))?;
    receipt.verify(key).map_err(|error| wrong(&format!("forged: {error}")))?;
    let mut text = describe(&receipt);
    if key.is_none() {
        text.push_str("give --key to know that this key is your teacher's\n");
    }
    if let Some(path) = reveal {
        let (name, bytes) = read_input(path)?;
        let reveal = parse::<Reveal>(&bytes).map_err(|error| Failure::input(format!("{name}: {error}")))?;
        let exercise = self::exercise(&receipt, &reveal, exercise)?;
        let again = rerun(&receipt, &reveal, &exercise).map_err(|error| wrong(&error))?;
        // Writing to a string cannot fail.
        let _ = writeln!(text, "made again: {} trajectories with the same bits, the same points", again.trajectories);
    }
    Ok(print(&text)?)
}

fn describe(receipt: &Receipt) -> String {
    let statement = &receipt.statement;
    let grade = &statement.grade;
    let mut text = format!("good signature by key {}\n", receipt.key);
    let _ = writeln!(text, "exercise {}, fingerprint {}", grade.exercise, grade.fingerprint);
    let _ =
        writeln!(text, "attempt {}, graded {}, core {}", statement.attempt, statement.graded_at, grade.core_version);
    let _ = writeln!(text, "{} of {} points", grade.points, grade.of);
    for criterion in &grade.criteria {
        let _ = writeln!(text, "  {:<16} {} of {}", criterion.id, criterion.points, criterion.of);
    }
    text
}

/// The file's, the reveal's, or the program's own.
fn exercise(receipt: &Receipt, reveal: &Reveal, file: Option<&Path>) -> Result<Exercise, Failure> {
    if let Some(path) = file {
        let name = path.display();
        return read(path).map_err(|error| match error {
            ExerciseError::File(crate::document::FileError::Unreadable(_)) => {
                Failure::system(format!("{name}: {error}"))
            }
            _ => Failure::input(format!("{name}: {error}")),
        });
    }
    if let Some(document) = &reveal.exercise {
        return Exercise::new(document.clone()).map_err(|error| Failure::input(format!("revealed exercise: {error}")));
    }
    let id = &receipt.statement.grade.exercise;
    let library = Library::shipped().map_err(Failure::system)?;
    let message = || format!("no exercise {id:?} comes with the program; give --exercise");
    library.get(id).cloned().ok_or_else(|| Failure::input(message()))
}
