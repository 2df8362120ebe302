//! `adaptarm presets`: the scenarios that have a name.

use super::Failure;
use crate::stdout::print;
use adaptarm_core::scenario::{PRESETS, Preset, Scenario, preset};
use clap::Args;

#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  adaptarm presets
  adaptarm presets --show tang_arteaga > my.json    then edit my.json and: adaptarm run my.json")]
pub(super) struct Arguments {
    /// Print this preset as a scenario document with every default filled in.
    #[arg(long, value_name = "NAME")]
    show: Option<String>,
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    match &arguments.show {
        Some(name) => print(&document(&scenario(name)?)?)?,
        None => print(&list())?,
    }
    Ok(())
}

/// The scenario of a preset.
pub(super) fn scenario(name: &str) -> Result<Scenario, Failure> {
    let preset = preset(name).ok_or_else(|| {
        let names: Vec<_> = PRESETS.iter().map(|preset| preset.id).collect();
        Failure::input(format!("there is no preset {name:?}; there are {}", names.join(", ")))
    })?;
    Scenario::new(preset.document()).map_err(Failure::input)
}

fn document(scenario: &Scenario) -> Result<String, Failure> {
    serde_json::to_string_pretty(scenario.document()).map(|text| text + "\n").map_err(Failure::system)
}

fn list() -> String {
    let width = PRESETS.iter().map(|preset| preset.id.len()).max().unwrap_or(0);
    let line = |preset: &Preset| format!("{:width$}  {}\n", preset.id, preset.description);
    PRESETS.iter().map(line).collect()
}
