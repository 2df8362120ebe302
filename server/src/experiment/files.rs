//! What an experiment leaves, on disk or over HTTP: the experiment with everything filled in, `summary.json`, a row per run as
//! CSV and Parquet; of a tuning, the best scenario, its generations and its Pareto front.

use super::Picture;
use super::checkpoint::replace;
use crate::figures::PictureFormat;
use crate::series::parquet;
use adaptarm_core::experiments::{Experiment, Front, Results, Row, RowOutcome, Summary, Tuning, TuningSummary};
use anyhow::Result;
use serde::Serialize;
use std::fmt::Write as _;
use std::path::Path;

/// What is known of an experiment, at its end or on the way there.
#[derive(Debug)]
pub enum Found {
    /// Of a sweep, a Monte Carlo study or a comparison: the rows and what they say.
    Rows(Results, Box<Summary>),
    /// Of a tuning: its search.
    Search(Box<Tuning>),
}

/// A file of an experiment.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum File {
    /// The experiment with everything filled in.
    Experiment,
    /// What its rows say.
    Summary,
    /// A row per run, as text.
    RunsCsv,
    /// A row per run, as Parquet.
    RunsParquet,
    /// The best scenario of a tuning.
    Best,
    /// A tuning's generations, as text.
    Generations,
    /// A tuning's Pareto front, as text.
    Front,
}

impl File {
    /// Those that an experiment has.
    pub fn of(experiment: &Experiment) -> &'static [Self] {
        if experiment.runs().is_some() {
            &[Self::Experiment, Self::Summary, Self::RunsCsv, Self::RunsParquet]
        } else {
            &[Self::Experiment, Self::Summary, Self::Best, Self::Generations, Self::Front]
        }
    }

    /// Its name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Experiment => "experiment.json",
            Self::Summary => "summary.json",
            Self::RunsCsv => "runs.csv",
            Self::RunsParquet => "runs.parquet",
            Self::Best => "best.json",
            Self::Generations => "generations.csv",
            Self::Front => "front.csv",
        }
    }

    /// Its media type.
    pub const fn media_type(self) -> &'static str {
        match self {
            Self::Experiment | Self::Summary | Self::Best => "application/json",
            Self::RunsCsv | Self::Generations | Self::Front => "text/csv; charset=utf-8; header=present",
            Self::RunsParquet => "application/vnd.apache.parquet",
        }
    }

    /// Its bytes; nothing where there is nothing to write. Takes up to a second where there are very many rows.
    pub fn bytes(self, experiment: &Experiment, found: &Found) -> Result<Option<Vec<u8>>> {
        Ok(Some(match (self, found) {
            (Self::Experiment, _) => json(experiment.document())?,
            (Self::Summary, Found::Rows(_, summary)) => json(summary)?,
            (Self::Summary, Found::Search(tuning)) => json(&tuning.summary(experiment))?,
            (Self::RunsCsv, Found::Rows(results, _)) => csv(experiment, results).into_bytes(),
            (Self::RunsParquet, Found::Rows(results, _)) => table(experiment, results)?,
            (Self::Best, Found::Search(tuning)) => match tuning.best_scenario(experiment) {
                Some(best) => json(best.document())?,
                None => return Ok(None),
            },
            (Self::Generations, Found::Search(tuning)) => generations(&tuning.summary(experiment)).into_bytes(),
            (Self::Front, Found::Search(tuning)) => match &tuning.summary(experiment).front {
                Some(front) => front_table(front, &tuning.summary(experiment).variables).into_bytes(),
                None => return Ok(None),
            },
            (Self::RunsCsv | Self::RunsParquet, Found::Search(_))
            | (Self::Best | Self::Generations | Self::Front, Found::Rows(..)) => {
                return Ok(None);
            }
        }))
    }
}

/// Writes all files of an experiment into a folder, and its figures as SVG.
pub(super) fn write(experiment: &Experiment, found: &Found, folder: &Path) -> Result<()> {
    for file in File::of(experiment) {
        if let Some(bytes) = file.bytes(experiment, found)? {
            replace(&folder.join(file.name()), &bytes)?;
        }
    }
    for picture in Picture::of(experiment).filter(|picture| picture.format == PictureFormat::Svg) {
        replace(&folder.join(picture.name()), &picture.bytes(experiment, found, None)?)?;
    }
    Ok(())
}

fn json(document: &impl Serialize) -> Result<Vec<u8>> {
    Ok((serde_json::to_string_pretty(document)? + "\n").into_bytes())
}

fn generations(summary: &TuningSummary) -> String {
    let mut text = "generation,restart,population,best,sigma\n".to_owned();
    for (n, generation) in summary.history.iter().enumerate() {
        let (restart, population) = (generation.restart, generation.population);
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{},{restart},{population},{:?},{:?}", n + 1, generation.best, generation.sigma);
    }
    text
}

/// A row per candidate that no other beats in every objective.
fn front_table(front: &Front, variables: &[String]) -> String {
    let names = front.objectives.iter().chain(variables).map(|name| cell(name));
    let mut text = names.collect::<Vec<_>>().join(",") + "\n";
    for candidate in &front.candidates {
        let numbers = candidate.objectives.iter().chain(&candidate.values).map(|number| format!("{number:?}"));
        text += &(numbers.collect::<Vec<_>>().join(",") + "\n");
    }
    text
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
