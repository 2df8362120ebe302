//! The study's closed loops by others' means (`benches/peers/`), timed side by side with ours: `cargo xtask bench --peers`.
//!
//! Every contestant, ours too, is a process of its own that runs one scheme some times over and prints a [`Measurement`].
//! A contestant whose numbers differ from ours is refused: its time would say nothing.
//!
//! [`Measurement`]: measurement::Measurement

mod check;
mod measurement;
mod own;
mod peers;
mod report;
mod rounds;

use adaptarm_core::scenario::Scheme;
use anyhow::{Context, Result, bail};
use rounds::Pinned;
use std::path::PathBuf;

/// Where peers are compiled to and where the table also goes.
struct Arguments {
    into: PathBuf,
    json: Option<PathBuf>,
}

fn main() -> Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    if let [mode, name, scheme, repetitions, steps_per_ms] = &arguments[..]
        && mode == own::MODE
    {
        return own::print(name, scheme, repetitions, steps_per_ms);
    }
    compare(&read(arguments)?)
}

fn read(arguments: Vec<String>) -> Result<Arguments> {
    let (mut into, mut json) = (None, None);
    let mut arguments = arguments.into_iter();
    while let Some(name) = arguments.next() {
        let value = arguments.next().with_context(|| format!("{name} needs a value"))?;
        match name.as_str() {
            "--into" => into = Some(PathBuf::from(value)),
            "--json" => json = Some(PathBuf::from(value)),
            _ => bail!("{name} is neither --into FOLDER nor --json FILE"),
        }
    }
    Ok(Arguments { into: into.context("--into FOLDER says where to compile the peers to")?, json })
}

fn compare(arguments: &Arguments) -> Result<()> {
    let mut contestants = own::contestants()?;
    contestants.extend(peers::prepare(&arguments.into)?);
    let pinned = Pinned::find();
    let mut results = Vec::new();
    let mut refused = 0;
    for scheme in Scheme::ALL {
        let mut accepted = Vec::new();
        for (index, contestant) in contestants.iter().enumerate() {
            match check::examine(contestant, &pinned, scheme)? {
                Ok(examined) => accepted.push((index, contestant, examined)),
                Err(disagreement) => {
                    println!("refused: {}, {}: {disagreement}", contestant.name, scheme.name());
                    refused += 1;
                }
            }
        }
        results.push(rounds::take_turns(&pinned, scheme, accepted)?);
    }
    report::print(&contestants, &results, &pinned);
    if let Some(path) = &arguments.json {
        let text = serde_json::to_string_pretty(&report::json(&contestants, &results))?;
        std::fs::write(path, text + "\n").with_context(|| format!("cannot write {}", path.display()))?;
    }
    if refused > 0 {
        bail!("{refused} contestants above compute something else than we do");
    }
    Ok(())
}
