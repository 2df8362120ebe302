//! Where a tuning stands, on disk: written beside the old file and then put in its place, so that a kill at any moment leaves
//! one or the other. The rows of other experiments are their own checkpoint (`row_file`).

use adaptarm_core::VERSION;
use adaptarm_core::experiments::{Experiment, Tuning};
use anyhow::{Context, Result};
use serde::{Deserialize, Serialize};
use std::fs::File;
use std::io::{BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};
use thiserror::Error;

const FORMAT: &str = "adaptarm.experiment_checkpoint/2";
/// Name of the file in the folder of the results.
pub(super) const NAME: &str = "checkpoint.bin";
/// At least this long between two writings, and so many times as long as one takes.
const INTERVAL: Duration = Duration::from_secs(2);
const SHARE: u32 = 20;

#[derive(Debug, Serialize, Deserialize)]
struct Stored<T> {
    format: String,
    core_version: String,
    experiment_hash: String,
    tuning: T,
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

/// Where a search's progress is kept, if anywhere.
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
    pub fn load(&self, experiment: &Experiment) -> Result<Option<Tuning>> {
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
        let stored: Stored<Tuning> = rmp_serde::from_slice(sealed.1).map_err(|_| other())?;
        let same =
            stored.format == FORMAT && stored.core_version == VERSION && stored.experiment_hash == self.experiment_hash;
        if same && stored.tuning.belongs_to(experiment) { Ok(Some(stored.tuning)) } else { Err(other().into()) }
    }

    /// Writes what is done if it is time to.
    pub fn save_if_due(&mut self, tuning: &Tuning) -> Result<()> {
        if self.path.is_none() || self.written.elapsed() < INTERVAL.max(self.took * SHARE) {
            return Ok(());
        }
        self.save(tuning)
    }

    /// Writes what is done.
    pub fn save(&mut self, tuning: &Tuning) -> Result<()> {
        let Some(path) = &self.path else { return Ok(()) };
        let began = Instant::now();
        let stored = Stored {
            format: FORMAT.to_owned(),
            core_version: VERSION.to_owned(),
            experiment_hash: self.experiment_hash.clone(),
            tuning,
        };
        let bytes = rmp_serde::to_vec(&stored).context("cannot encode the search")?;
        replace(path, &[blake3::hash(&bytes).as_bytes(), bytes.as_slice()].concat())?;
        self.written = Instant::now();
        self.took = began.elapsed();
        Ok(())
    }
}

/// Puts bytes in the place of a file, whole or not at all.
pub(super) fn replace(path: &Path, bytes: &[u8]) -> Result<()> {
    replace_by(path, |file| {
        file.write_all(bytes)?;
        Ok(true)
    })
}

/// The same with what writes them, so that not all are held at once; it says whether there is anything to put there.
pub(super) fn replace_by(path: &Path, write: impl FnOnce(&mut BufWriter<File>) -> Result<bool>) -> Result<()> {
    let context = || format!("cannot write {}", path.display());
    let beside = beside(path);
    let mut file = BufWriter::new(File::create(&beside).with_context(context)?);
    if !write(&mut file).with_context(context)? {
        return std::fs::remove_file(&beside).with_context(context);
    }
    file.flush().and_then(|()| file.get_ref().sync_all()).with_context(context)?;
    std::fs::rename(&beside, path).with_context(context)
}

/// Where a file is written before it takes another's place.
pub(super) fn beside(path: &Path) -> PathBuf {
    let mut beside = path.as_os_str().to_owned();
    beside.push(".new");
    beside.into()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::parse;

    fn experiment(seed: u64) -> Experiment {
        let document = format!(
            r#"{{"format": "adaptarm.experiment/1", "kind": "tuning", "seed": {seed}, "tuning": {{"evaluations": 10,
            "variables": [{{"field": "/scheme/gains/beta", "min": 1, "max": 20}}],
            "objective": [{{"metric": "index_e_deg", "weight": 1}}]}},
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
        let tuning = mine.tuning().unwrap();
        checkpoint.save(&tuning).unwrap();
        assert_eq!(checkpoint.load(&mine).unwrap(), Some(tuning));
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
