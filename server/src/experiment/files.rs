//! What an experiment leaves, on disk or over HTTP: the experiment with everything filled in, `summary.json`, a row per run as
//! CSV and Parquet; of a tuning, the best scenario, its generations and its Pareto front; of a replication, its report.

use super::checkpoint::{replace, replace_by};
use super::search_report;
use super::{Picture, Refused};
use crate::document::parse;
use crate::figures::PictureFormat;
use crate::series::parquet;
use adaptarm_core::experiments::replication::ReplicationSummary;
use adaptarm_core::experiments::{
    Experiment, ExperimentKind, Front, Place, Results, Row, RowOutcome, RowStoreError, Summary, Tuning, TuningSummary,
};
use anyhow::{Context, Result};
use serde::Serialize;
use std::fmt::Write as _;
use std::io::{ErrorKind, Write};
use std::path::Path;

/// What is known of an experiment, at its end or on the way there.
#[derive(Debug)]
pub enum Found {
    /// Of a sweep, a Monte Carlo study or a comparison: the rows and what they say.
    Rows(Results, Box<Summary>),
    /// Of a replication: the rows and what they say.
    Readings(Results, Box<ReplicationSummary>),
    /// Of a tuning: its search.
    Search(Box<Tuning>),
}

impl Found {
    /// What the rows of an experiment that is no tuning say.
    pub fn of(experiment: &Experiment, results: Results) -> Result<Self, RowStoreError> {
        Ok(if let Some(summary) = ReplicationSummary::of(experiment, &results)? {
            Self::Readings(results, Box::new(summary))
        } else {
            let summary = Box::new(Summary::of(experiment, &results)?);
            Self::Rows(results, summary)
        })
    }

    /// The same, from a stored summary if it is of as many rows.
    pub fn with(experiment: &Experiment, results: Results, stored: Option<&str>) -> Result<Self, RowStoreError> {
        let (stored, done) = (stored.unwrap_or_default(), results.len() as u64);
        if experiment.kind() == ExperimentKind::Replication {
            match serde_json::from_str::<ReplicationSummary>(stored) {
                Ok(summary) if summary.done == done => Ok(Self::Readings(results, Box::new(summary))),
                _ => Self::of(experiment, results),
            }
        } else {
            match serde_json::from_str::<Summary>(stored) {
                Ok(summary) if summary.done == done => Ok(Self::Rows(results, Box::new(summary))),
                _ => Self::of(experiment, results),
            }
        }
    }
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
    /// What a replication found, for people.
    Report,
}

impl File {
    /// Those that an experiment has.
    pub fn of(experiment: &Experiment) -> &'static [Self] {
        match &experiment.document().tuning {
            None if experiment.kind() == ExperimentKind::Replication => {
                &[Self::Experiment, Self::Summary, Self::Report, Self::RunsCsv, Self::RunsParquet]
            }
            None => &[Self::Experiment, Self::Summary, Self::RunsCsv, Self::RunsParquet],
            Some(tuning) if tuning.objectives.is_empty() => {
                &[Self::Experiment, Self::Summary, Self::Best, Self::Generations]
            }
            Some(_) => &[Self::Experiment, Self::Summary, Self::Best, Self::Generations, Self::Front],
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
            Self::Report => "report.md",
        }
    }

    /// Its media type.
    pub const fn media_type(self) -> &'static str {
        match self {
            Self::Experiment | Self::Summary | Self::Best => "application/json",
            Self::RunsCsv | Self::Generations | Self::Front => "text/csv; charset=utf-8; header=present",
            Self::Report => "text/markdown; charset=utf-8",
            Self::RunsParquet => "application/vnd.apache.parquet",
        }
    }

    /// Writes it; says whether there is anything to write. Takes up to a second where there are very many rows, of which a
    /// column is held at a time.
    pub fn write(self, experiment: &Experiment, found: &Found, out: &mut (dyn Write + Send)) -> Result<bool> {
        let bytes = match (self, found) {
            (Self::RunsCsv, Found::Rows(results, _) | Found::Readings(results, _)) => {
                csv(experiment, results, out)?;
                return Ok(true);
            }
            (Self::RunsParquet, Found::Rows(results, _) | Found::Readings(results, _)) => {
                table(experiment, results, out)?;
                return Ok(true);
            }
            (Self::Experiment, _) => json(experiment.document())?,
            (Self::Summary, Found::Rows(_, summary)) => json(summary)?,
            (Self::Summary, Found::Readings(_, summary)) => json(summary)?,
            (Self::Summary, Found::Search(tuning)) => json(&tuning.summary(experiment))?,
            (Self::Best, Found::Search(tuning)) => match tuning.best_scenario(experiment) {
                Some(best) => json(best.document())?,
                None => return Ok(false),
            },
            (Self::Generations, Found::Search(tuning)) => generations(&tuning.summary(experiment)).into_bytes(),
            (Self::Front, Found::Search(tuning)) => match &tuning.summary(experiment).front {
                Some(front) => front_table(front, &tuning.summary(experiment).variables).into_bytes(),
                None => return Ok(false),
            },
            (Self::Report, Found::Readings(_, summary)) => search_report::report(experiment, summary)?.into_bytes(),
            (Self::Report, _)
            | (Self::RunsCsv | Self::RunsParquet, Found::Search(_))
            | (Self::Best | Self::Generations | Self::Front, Found::Rows(..) | Found::Readings(..)) => {
                return Ok(false);
            }
        };
        out.write_all(&bytes)?;
        Ok(true)
    }
}

/// Says in a folder which experiment it is for; refuses one that is for another.
pub(super) fn take(experiment: &Experiment, folder: &Path) -> Result<()> {
    let path = folder.join(File::Experiment.name());
    match std::fs::read(&path) {
        Ok(earlier) => {
            let earlier = parse(&earlier).ok().and_then(|document| Experiment::new(document).ok());
            if earlier.is_some_and(|earlier| earlier.hash() == experiment.hash()) {
                return Ok(());
            }
            Err(Refused::Occupied(folder.to_owned()).into())
        }
        Err(error) if error.kind() == ErrorKind::NotFound => replace(&path, &json(experiment.document())?),
        Err(error) => Err(error).with_context(|| format!("cannot read {}", path.display())),
    }
}

/// Writes all files of an experiment into a folder, and its figures as SVG.
pub(super) fn write(experiment: &Experiment, found: &Found, folder: &Path) -> Result<()> {
    for file in File::of(experiment) {
        replace_by(&folder.join(file.name()), |out| file.write(experiment, found, out))?;
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
fn csv(experiment: &Experiment, results: &Results, text: &mut dyn Write) -> Result<()> {
    let (conditions, bases) = (experiment.condition_names(), experiment.base_names().collect::<Vec<_>>());
    let names = ["run", "point", "condition", "base", "outcome", "at_s"].into_iter().chain(experiment.fields());
    let names = names.chain(experiment.columns().names().iter().map(String::as_str));
    writeln!(text, "{}", names.map(cell).collect::<Vec<_>>().join(","))?;
    for row in results.rows() {
        let row = row?;
        let Some(place) = experiment.place(row.index) else { continue };
        let (condition, base) = (cell(conditions[place.condition]), cell(bases[place.base]));
        write!(text, "{},{},{condition},{base},{}", row.index, place.point, outcome(&row))?;
        let values = experiment.values(place.point).into_iter().map(Some);
        for number in [row.at_s].into_iter().chain(values).chain(row.metrics.iter().copied()) {
            match number {
                Some(number) => write!(text, ",{number:?}")?,
                None => write!(text, ",")?,
            }
        }
        writeln!(text)?;
    }
    Ok(())
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
fn table(experiment: &Experiment, results: &Results, out: &mut (dyn Write + Send)) -> Result<()> {
    let lead = ["run", "point", "condition", "base", "outcome", "at_s"];
    let fields = experiment.fields();
    let names = lead.into_iter().chain(experiment.fields()).map(str::to_owned);
    let names: Vec<_> = names.chain(experiment.columns().names().iter().cloned()).collect();
    let placed = |number: &dyn Fn(Place) -> f64| {
        let number = |index| experiment.place(index).map_or(f64::NAN, number);
        results.outcomes().map(|(index, _)| number(index)).collect()
    };
    let column = |column: usize| -> Result<Vec<f64>> {
        Ok(match column {
            0 => results.outcomes().map(|(index, _)| index as f64).collect(),
            1 => placed(&|place| place.point as f64),
            2 => placed(&|place| place.condition as f64),
            3 => placed(&|place| place.base as f64),
            4 => results.outcomes().map(|(_, outcome)| f64::from(outcome as u8)).collect(),
            5 => results.rows().map(|row| Ok(row?.at_s.unwrap_or(f64::NAN))).collect::<Result<_>>()?,
            _ if column < lead.len() + fields.len() => {
                placed(&|place| experiment.values(place.point)[column - lead.len()])
            }
            _ => {
                let numbers = results.numbers(column - lead.len() - fields.len())?;
                numbers.into_iter().map(|number| number.unwrap_or(f64::NAN)).collect()
            }
        })
    };
    let metadata = [("adaptarm.experiment_hash", experiment.hash())];
    let metadata = metadata.each_ref().map(|(key, value)| (*key, value.as_str()));
    parquet::write_columns(out, &names, (0..names.len()).map(column), &metadata)
}
