//! What is done of an experiment, on disk: written beside the old file and then put in its place, so that a kill at any moment
//! leaves one or the other.

use adaptarm_core::VERSION;
use adaptarm_core::experiments::{Experiment, Results, Row, Tuning};
use anyhow::{Context, Result};
use serde::{Deserialize, Serialize, Serializer};
use std::fs::File;
use std::io::{BufWriter, ErrorKind, Seek, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};
use thiserror::Error;

const FORMAT: &str = "adaptarm.experiment_checkpoint/1";
/// Name of the file in the folder of the results.
const NAME: &str = "checkpoint.bin";
/// At least this long between two writings, and so many times as long as one takes.
const INTERVAL: Duration = Duration::from_secs(2);
const SHARE: u32 = 20;

/// What is done.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub(super) enum State {
    Rows(Vec<Row>),
    Tuning(Box<Tuning>),
}

/// The same where it is, to be written without a copy.
#[derive(Debug, Clone, Copy, Serialize)]
#[serde(rename = "State")]
pub(super) enum Current<'a> {
    Rows(#[serde(serialize_with = "rows")] &'a Results),
    Tuning(&'a Tuning),
}

fn rows<S: Serializer>(results: &Results, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(results.rows())
}

#[derive(Debug, Serialize, Deserialize)]
struct Stored<S> {
    format: String,
    core_version: String,
    experiment_hash: String,
    state: S,
}

/// A checkpoint from which this experiment cannot go on.
#[derive(Debug, Error)]
pub enum CheckpointError {
    /// Of other work.
    #[error("{} is of another experiment or another version of this program: drop --resume to begin anew", .0.display())]
    Other(PathBuf),
    /// Not what was written.
    #[error("{} is damaged: drop --resume to begin anew", .0.display())]
    Damaged(PathBuf),
}

/// Where an experiment's progress is kept, if anywhere.
pub(super) struct Checkpoint {
    path: Option<PathBuf>,
    experiment_hash: String,
    written: Instant,
    took: Duration,
}

impl Checkpoint {
    pub fn new(experiment: &Experiment, folder: Option<&Path>) -> Self {
        let path = folder.map(|folder| folder.join(NAME));
        Self { path, experiment_hash: experiment.hash(), written: Instant::now(), took: Duration::ZERO }
    }

    /// What was done; nothing if nothing was kept.
    pub fn load(&self, experiment: &Experiment) -> Result<Option<State>> {
        let Some(path) = &self.path else { return Ok(None) };
        let bytes = match std::fs::read(path) {
            Ok(bytes) => bytes,
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
            Err(error) => return Err(error).with_context(|| format!("cannot read {}", path.display())),
        };
        let damaged = || super::Refused::from(CheckpointError::Damaged(path.clone()));
        let sealed = bytes.split_at_checked(blake3::OUT_LEN).ok_or_else(damaged)?;
        if blake3::hash(sealed.1).as_bytes() != sealed.0 {
            return Err(damaged().into());
        }
        let other = || super::Refused::from(CheckpointError::Other(path.clone()));
        // Another version may have stored something else, hence cannot be told from damage by its shape.
        let stored: Stored<State> = rmp_serde::from_slice(sealed.1).map_err(|_| other())?;
        let belongs = match &stored.state {
            State::Rows(_) => experiment.runs().is_some(),
            State::Tuning(tuning) => tuning.belongs_to(experiment),
        };
        let same =
            stored.format == FORMAT && stored.core_version == VERSION && stored.experiment_hash == self.experiment_hash;
        if same && belongs { Ok(Some(stored.state)) } else { Err(other().into()) }
    }

    /// Writes what is done if it is time to.
    pub fn save_if_due(&mut self, state: Current<'_>) -> Result<()> {
        if self.path.is_none() || self.written.elapsed() < INTERVAL.max(self.took * SHARE) {
            return Ok(());
        }
        self.save(state)
    }

    /// Writes what is done.
    pub fn save(&mut self, state: Current<'_>) -> Result<()> {
        let Some(path) = &self.path else { return Ok(()) };
        let began = Instant::now();
        let stored = Stored {
            format: FORMAT.to_owned(),
            core_version: VERSION.to_owned(),
            experiment_hash: self.experiment_hash.clone(),
            state,
        };
        replace_by(path, |file| {
            // The seal stands first and is known last.
            file.write_all(&[0; blake3::OUT_LEN])?;
            let mut sealing = Sealing { file, hasher: blake3::Hasher::new() };
            rmp_serde::encode::write(&mut sealing, &stored)?;
            let seal = sealing.hasher.finalize();
            file.rewind()?;
            Ok(file.write_all(seal.as_bytes())?)
        })?;
        self.written = Instant::now();
        self.took = began.elapsed();
        Ok(())
    }
}

/// Passes bytes on to a file and remembers their hash.
struct Sealing<'a> {
    file: &'a mut BufWriter<File>,
    hasher: blake3::Hasher,
}

impl Write for Sealing<'_> {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        let count = self.file.write(bytes)?;
        self.hasher.update(&bytes[..count]);
        Ok(count)
    }

    fn flush(&mut self) -> std::io::Result<()> {
        self.file.flush()
    }
}

/// Puts bytes in the place of a file, whole or not at all.
pub(super) fn replace(path: &Path, bytes: &[u8]) -> Result<()> {
    replace_by(path, |file| Ok(file.write_all(bytes)?))
}

/// The same with what writes them, so that not all are held at once.
pub(super) fn replace_by(path: &Path, write: impl FnOnce(&mut BufWriter<File>) -> Result<()>) -> Result<()> {
    let context = || format!("cannot write {}", path.display());
    let mut beside = path.as_os_str().to_owned();
    beside.push(".new");
    let mut file = BufWriter::new(File::create(&beside).with_context(context)?);
    write(&mut file).with_context(context)?;
    file.flush().and_then(|()| file.get_ref().sync_all()).with_context(context)?;
    std::fs::rename(&beside, path).with_context(context)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::parse;

    fn experiment(seed: u64) -> Experiment {
        let document = format!(
            r#"{{"format": "adaptarm.experiment/1", "kind": "monte_carlo", "seed": {seed}, "monte_carlo": {{"draws": 3}},
            "bases": [{{"name": "a", "scenario": {{"format": "adaptarm.scenario/1", "scheme": {{"kind": "proposed"}}}}}}]}}"#
        );
        Experiment::new(parse(document.as_bytes()).unwrap()).unwrap()
    }

    #[test]
    fn what_was_kept_comes_back_and_nothing_else_does() {
        let folder = tempfile::tempdir().unwrap();
        let mine = experiment(1);
        let mut checkpoint = Checkpoint::new(&mine, Some(folder.path()));
        assert_eq!(checkpoint.load(&mine).unwrap(), None);
        let row = Row {
            index: 2,
            outcome: adaptarm_core::experiments::RowOutcome::Completed,
            at_s: None,
            refusal: None,
            metrics: (0..mine.columns().names().len()).map(|n| (n % 3 > 0).then_some(0.1 + 0.2 * n as f64)).collect(),
        };
        let mut results = Results::new();
        results.insert(&mine, row.clone()).unwrap();
        checkpoint.save(Current::Rows(&results)).unwrap();
        assert_eq!(checkpoint.load(&mine).unwrap(), Some(State::Rows(vec![row])));
        let other = experiment(2);
        let said = Checkpoint::new(&other, Some(folder.path())).load(&other).unwrap_err().to_string();
        assert!(said.contains("another experiment"), "{said}");
        let path = folder.path().join(NAME);
        let mut bytes = std::fs::read(&path).unwrap();
        for bytes in [&bytes[..10].to_vec(), {
            *bytes.last_mut().unwrap() ^= 1;
            &bytes
        }] {
            std::fs::write(&path, bytes).unwrap();
            let said = checkpoint.load(&mine).unwrap_err().to_string();
            assert!(said.contains("is damaged"), "{said}");
        }
    }
}
