//! What an experiment leaves in its folder: the experiment with everything filled in, `summary.json`, a row per run as CSV and
//! Parquet; of a tuning, the best scenario and its generations.

use super::checkpoint::replace;
use crate::series::parquet;
use adaptarm_core::experiments::{Experiment, Results, Row, RowOutcome, Tuning, TuningSummary};
use anyhow::Result;
use serde::Serialize;
use std::fmt::Write as _;
use std::path::Path;

/// Of all kinds but a tuning.
pub(super) fn write(experiment: &Experiment, results: &Results, summary: &impl Serialize, folder: &Path) -> Result<()> {
    save_json(&folder.join("experiment.json"), experiment.document())?;
    save_json(&folder.join("summary.json"), summary)?;
    replace(&folder.join("runs.csv"), csv(experiment, results).as_bytes())?;
    replace(&folder.join("runs.parquet"), &table(experiment, results)?)
}

/// Of a tuning.
pub(super) fn write_tuning(
    experiment: &Experiment,
    tuning: &Tuning,
    summary: &TuningSummary,
    folder: &Path,
) -> Result<()> {
    save_json(&folder.join("experiment.json"), experiment.document())?;
    save_json(&folder.join("summary.json"), summary)?;
    if let Some(best) = tuning.best_scenario(experiment) {
        save_json(&folder.join("best.json"), best.document())?;
    }
    let mut text = "generation,restart,population,best,sigma\n".to_owned();
    for (n, generation) in summary.history.iter().enumerate() {
        let (restart, population) = (generation.restart, generation.population);
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{},{restart},{population},{:?},{:?}", n + 1, generation.best, generation.sigma);
    }
    replace(&folder.join("generations.csv"), text.as_bytes())
}

/// Writes a text file.
pub(super) fn save_text(path: &Path, text: &str) -> Result<()> {
    replace(path, text.as_bytes())
}

fn save_json(path: &Path, document: &impl Serialize) -> Result<()> {
    replace(path, (serde_json::to_string_pretty(document)? + "\n").as_bytes())
}

/// A row per run; an empty cell where there is no number.
fn csv(experiment: &Experiment, results: &Results) -> String {
    let (conditions, bases) = (experiment.condition_names(), experiment.base_names().collect::<Vec<_>>());
    let names = ["run", "point", "condition", "base", "outcome", "at_s"].into_iter().chain(experiment.fields());
    let names = names.chain(experiment.columns().names().iter().map(String::as_str));
    let mut text = names.map(cell).collect::<Vec<_>>().join(",");
    text.push('\n');
    for row in results.rows() {
        let Some(place) = experiment.place(row.index) else { continue };
        let (condition, base) = (cell(conditions[place.condition]), cell(bases[place.base]));
        let _ = write!(text, "{},{},{condition},{base},{}", row.index, place.point, outcome(row));
        let values = experiment.values(place.point).into_iter().map(Some);
        for number in [row.at_s].into_iter().chain(values).chain(row.metrics.iter().copied()) {
            text.push(',');
            if let Some(number) = number {
                let _ = write!(text, "{number:?}");
            }
        }
        text.push('\n');
    }
    text
}

fn outcome(row: &Row) -> &'static str {
    match row.outcome {
        RowOutcome::Completed => "completed",
        RowOutcome::Diverged => "diverged",
        RowOutcome::Refused => "refused",
    }
}

/// A name as a cell. Source: RFC 4180.
fn cell(name: &str) -> String {
    if name.contains([',', '"']) { format!("\"{}\"", name.replace('"', "\"\"")) } else { name.to_owned() }
}

/// The same as Parquet, all doubles: conditions and bases by number from 0, outcomes 0 completed, 1 diverged, 2 refused, and
/// NaN where there is no number.
fn table(experiment: &Experiment, results: &Results) -> Result<Vec<u8>> {
    let names = ["run", "point", "condition", "base", "outcome", "at_s"].into_iter().chain(experiment.fields());
    let names: Vec<_> = names.map(str::to_owned).chain(experiment.columns().names().iter().cloned()).collect();
    let mut columns = vec![Vec::with_capacity(results.len()); names.len()];
    for row in results.rows() {
        let Some(place) = experiment.place(row.index) else { continue };
        let outcome = row.outcome as u8;
        let lead =
            [row.index as f64, place.point as f64, place.condition as f64, place.base as f64, f64::from(outcome)];
        let rest = [row.at_s].into_iter().chain(experiment.values(place.point).into_iter().map(Some));
        let rest = rest.chain(row.metrics.iter().copied()).map(|number| number.unwrap_or(f64::NAN));
        for (column, number) in columns.iter_mut().zip(lead.into_iter().chain(rest)) {
            column.push(number);
        }
    }
    let metadata = [("adaptarm.experiment_hash", experiment.hash())];
    Ok(parquet::from_columns(
        &names,
        columns.into_iter(),
        &metadata.each_ref().map(|(key, value)| (*key, value.as_str())),
    )?)
}
