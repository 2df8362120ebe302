//! The rows of an experiment in a file of records of one length, the record of run `n` in place `n`: memory need not hold
//! them, and what a kill leaves is a checkpoint.
//!
//! Each record carries a seal. One that is damaged or torn counts as a run that has not been made.

use super::Refused;
use super::checkpoint::{CheckpointError, beside};
use adaptarm_core::VERSION;
use adaptarm_core::experiments::{Experiment, Row, RowOutcome, RowStore, RowStoreError};
use anyhow::{Context, Result};
use std::fs::File;
use std::io::{self, ErrorKind, Read};
use std::os::unix::fs::FileExt;
use std::path::Path;
use std::time::{Duration, Instant};

const MAGIC: &[u8; 16] = b"adaptarm.rows/1\n";
/// Magic, and the hash of what the rows belong to.
const HEAD: usize = MAGIC.len() + blake3::OUT_LEN;
/// Bytes of a record's seal: against accidents, not against people.
const SEAL: usize = 8;
/// Seal, outcome, and where the words of a refusal are.
const FIXED: usize = SEAL + 1 + 8 + 4;
/// Bytes read at a time, or one record.
const AT_ONCE: usize = 1 << 18;
/// What the machine's own death may cost; the process's costs nothing.
const SYNC: Duration = Duration::from_secs(2);

/// Rows on disk. Only one process writes the file.
#[derive(Debug)]
pub struct RowFile {
    file: File,
    /// Numbers in a record: when a run was given up, and one per column.
    numbers: usize,
    runs: u64,
    /// Where the next words of a refusal go: behind all records.
    end: u64,
    /// When the file was last known to be on the disk; never for a file without a name.
    synced: Option<Instant>,
}

impl RowFile {
    /// In a file that nobody else sees, and that is gone when it is dropped.
    pub fn unnamed(experiment: &Experiment) -> Result<Self> {
        let file = tempfile::tempfile().context("cannot make a temporary file")?;
        Self::begin(experiment, file).context("cannot write a temporary file")
    }

    /// In a new file, which takes the place of an older one.
    pub fn create(experiment: &Experiment, path: &Path) -> Result<Self> {
        let context = || format!("cannot write {}", path.display());
        let beside = beside(path);
        let file = File::options().read(true).write(true).create(true).truncate(true).open(&beside);
        let mut rows = file.and_then(|file| Self::begin(experiment, file)).with_context(context)?;
        rows.file.sync_all().with_context(context)?;
        std::fs::rename(&beside, path).with_context(context)?;
        rows.synced = Some(Instant::now());
        Ok(rows)
    }

    /// In a file that an earlier process left, if there is one.
    pub fn open(experiment: &Experiment, path: &Path) -> Result<Option<Self>> {
        let mut file = match File::options().read(true).write(true).open(path) {
            Ok(file) => file,
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
            Err(error) => return Err(error).with_context(|| format!("cannot open {}", path.display())),
        };
        let mut head = [0; HEAD];
        let read = file.read_exact(&mut head);
        let refuse = |error: CheckpointError| anyhow::Error::from(Refused::from(error));
        read.map_err(|_| refuse(CheckpointError::Damaged(path.to_owned())))?;
        if head != self::head(experiment) {
            return Err(refuse(CheckpointError::Other(path.to_owned())));
        }
        let mut rows = Self::of(experiment, file);
        let length = rows.file.metadata().with_context(|| format!("cannot read {}", path.display()))?.len();
        if length < rows.end {
            rows.file.set_len(rows.end).with_context(|| format!("cannot write {}", path.display()))?;
        }
        rows.end = rows.end.max(length);
        rows.synced = Some(Instant::now());
        Ok(Some(rows))
    }

    fn begin(experiment: &Experiment, file: File) -> io::Result<Self> {
        let rows = Self::of(experiment, file);
        // Zeros, which take no room on the disk until they are written over, are records of no run.
        rows.file.set_len(rows.end)?;
        rows.file.write_all_at(&head(experiment), 0)?;
        Ok(rows)
    }

    fn of(experiment: &Experiment, file: File) -> Self {
        let (numbers, runs) = (1 + experiment.columns().names().len(), experiment.runs().unwrap_or(0));
        let mut rows = Self { file, numbers, runs, end: 0, synced: None };
        rows.end = rows.place(runs);
        rows
    }

    /// Bytes of a record.
    fn width(&self) -> usize {
        FIXED + self.numbers.div_ceil(8) + 8 * self.numbers
    }

    fn place(&self, index: u64) -> u64 {
        HEAD as u64 + index * self.width() as u64
    }

    /// Visits every record.
    fn each(&self, mut visit: impl FnMut(&[u8]) -> io::Result<()>) -> Result<(), RowStoreError> {
        let (width, mut bytes) = (self.width(), Vec::new());
        let at_once = (AT_ONCE / width).max(1);
        for first in (0..self.runs).step_by(at_once) {
            bytes.resize((self.runs - first).min(at_once as u64) as usize * width, 0);
            self.file.read_exact_at(&mut bytes, self.place(first)).map_err(failed)?;
            bytes.chunks_exact(width).try_for_each(&mut visit).map_err(failed)?;
        }
        Ok(())
    }

    /// The words of a refusal, if the record has any.
    fn refusal(&self, record: &[u8]) -> io::Result<Option<Vec<u8>>> {
        let at = u64::from_le_bytes(array(&record[SEAL + 1..]));
        let length = u32::from_le_bytes(array(&record[SEAL + 9..])) as usize;
        // A record that is torn may say anything.
        if at == 0 || at.saturating_add(length as u64) > self.end {
            return Ok(None);
        }
        let mut words = vec![0; length];
        self.file.read_exact_at(&mut words, at)?;
        Ok(Some(words))
    }

    fn number(&self, record: &[u8], n: usize) -> Option<f64> {
        let known = record[FIXED + n / 8] >> (n % 8) & 1 == 1;
        let at = FIXED + self.numbers.div_ceil(8) + 8 * n;
        known.then(|| f64::from_le_bytes(array(&record[at..])))
    }

    fn encode(&mut self, row: &Row) -> io::Result<Vec<u8>> {
        let mut record = vec![0; self.width()];
        record[SEAL] = 1 + row.outcome as u8;
        let words = row.refusal.as_deref().map(str::as_bytes);
        if let Some(words) = words {
            self.file.write_all_at(words, self.end)?;
            record[SEAL + 1..][..8].copy_from_slice(&self.end.to_le_bytes());
            record[SEAL + 9..][..4].copy_from_slice(&(words.len() as u32).to_le_bytes());
            self.end += words.len() as u64;
        }
        for (n, number) in std::iter::once(&row.at_s).chain(&row.metrics).enumerate() {
            if let Some(number) = number {
                record[FIXED + n / 8] |= 1 << (n % 8);
                let at = FIXED + self.numbers.div_ceil(8) + 8 * n;
                record[at..at + 8].copy_from_slice(&number.to_le_bytes());
            }
        }
        let seal = seal(&record, words);
        record[..SEAL].copy_from_slice(&seal);
        Ok(record)
    }

    fn decode(&self, index: u64, record: &[u8]) -> io::Result<Option<Row>> {
        let Some(outcome) = outcome(record) else { return Ok(None) };
        let refusal = self.refusal(record)?.map(|words| String::from_utf8_lossy(&words).into_owned());
        let metrics = (1..self.numbers).map(|n| self.number(record, n)).collect();
        Ok(Some(Row { index, outcome, at_s: self.number(record, 0), refusal, metrics }))
    }
}

impl RowStore for RowFile {
    fn outcomes(&self) -> Result<Vec<Option<RowOutcome>>, RowStoreError> {
        let mut outcomes = Vec::with_capacity(self.runs as usize);
        self.each(|record| {
            let words = self.refusal(record)?;
            let whole = record[..SEAL] == seal(record, words.as_deref());
            outcomes.push(outcome(record).filter(|_| whole));
            Ok(())
        })?;
        Ok(outcomes)
    }

    fn put(&mut self, row: Row) -> Result<(), RowStoreError> {
        let record = self.encode(&row).map_err(failed)?;
        self.file.write_all_at(&record, self.place(row.index)).map_err(failed)?;
        if self.synced.is_some_and(|synced| synced.elapsed() > SYNC) {
            self.file.sync_data().map_err(failed)?;
            self.synced = Some(Instant::now());
        }
        Ok(())
    }

    fn row(&self, index: u64) -> Result<Option<Row>, RowStoreError> {
        let mut record = vec![0; self.width()];
        self.file.read_exact_at(&mut record, self.place(index)).map_err(failed)?;
        self.decode(index, &record).map_err(failed)
    }

    fn column(&self, column: usize) -> Result<Vec<Option<f64>>, RowStoreError> {
        let mut numbers = Vec::with_capacity(self.runs as usize);
        self.each(|record| {
            numbers.push(self.number(record, 1 + column));
            Ok(())
        })?;
        Ok(numbers)
    }
}

/// What the rows belong to.
fn head(experiment: &Experiment) -> [u8; HEAD] {
    let mut head = [0; HEAD];
    let hash = blake3::hash(format!("{VERSION}\n{}", experiment.hash()).as_bytes());
    head[..MAGIC.len()].copy_from_slice(MAGIC);
    head[MAGIC.len()..].copy_from_slice(hash.as_bytes());
    head
}

fn outcome(record: &[u8]) -> Option<RowOutcome> {
    use RowOutcome::{Completed, Diverged, Refused};
    [Completed, Diverged, Refused].into_iter().find(|outcome| record[SEAL] == 1 + *outcome as u8)
}

/// Of everything behind it, and of the words of a refusal.
fn seal(record: &[u8], words: Option<&[u8]>) -> [u8; SEAL] {
    let mut hasher = blake3::Hasher::new();
    hasher.update(&record[SEAL..]).update(words.unwrap_or_default());
    array(hasher.finalize().as_bytes())
}

/// The first bytes of some, zeros behind the last.
fn array<const N: usize>(bytes: &[u8]) -> [u8; N] {
    std::array::from_fn(|n| bytes.get(n).copied().unwrap_or(0))
}

fn failed(error: impl std::fmt::Display) -> RowStoreError {
    RowStoreError(error.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;
    use adaptarm_core::experiments::Results;
    use serde_json::json;

    fn experiment(seed: u64) -> Experiment {
        let scenario = json!({ "format": "adaptarm.scenario/1", "scheme": { "kind": "proposed" } });
        let document = json!({
            "format": "adaptarm.experiment/1", "kind": "monte_carlo", "seed": seed, "monte_carlo": { "draws": 2000 },
            "bases": [{ "name": "a", "scenario": scenario }],
        });
        Experiment::read(&document).unwrap()
    }

    /// All kinds of rows: numbers of any bits, none, words.
    fn row(experiment: &Experiment, index: u64) -> Row {
        let width = experiment.columns().names().len() as u64;
        let number = |n: u64| match (index + n) % 5 {
            0 => None,
            1 => Some(-0.0),
            2 => Some(5e-324),
            _ => Some((index as f64 + 0.1) / (n as f64 + 0.3)),
        };
        match index % 3 {
            0 => Row {
                index,
                outcome: RowOutcome::Completed,
                at_s: None,
                refusal: None,
                metrics: (0..width).map(number).collect(),
            },
            1 => Row {
                index,
                outcome: RowOutcome::Diverged,
                at_s: Some(0.1 * index as f64),
                refusal: None,
                metrics: vec![None; width as usize],
            },
            _ => Row {
                index,
                outcome: RowOutcome::Refused,
                at_s: None,
                refusal: Some(format!("/plant: too heavy by {index} · ½")),
                metrics: vec![None; width as usize],
            },
        }
    }

    fn same(experiment: &Experiment, kept: &Results, indices: impl Iterator<Item = u64>) {
        let mut memory = Results::new();
        indices.for_each(|index| memory.insert(experiment, row(experiment, index)).unwrap());
        assert_eq!(kept.len(), memory.len());
        assert!(kept.rows().eq(memory.rows()));
        for column in 0..experiment.columns().names().len() {
            let bits = |results: &Results| -> Vec<_> {
                results.numbers(column).unwrap().into_iter().map(|number| number.map(f64::to_bits)).collect()
            };
            assert_eq!(bits(kept), bits(&memory));
        }
    }

    #[test]
    fn rows_come_back_to_the_bit_in_any_order_and_from_another_process() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("rows");
        let mine = experiment(1);
        assert!(RowFile::open(&mine, &path).unwrap().is_none());
        let mut kept = Results::kept_in(RowFile::create(&mine, &path).unwrap()).unwrap();
        assert!(kept.is_empty());
        for index in (0..2000).rev().filter(|index| index % 7 > 0) {
            kept.insert(&mine, row(&mine, index)).unwrap();
            kept.insert(&mine, row(&mine, index)).unwrap();
        }
        same(&mine, &kept, (0..2000).filter(|index| index % 7 > 0));
        drop(kept);
        let mut kept = Results::kept_in(RowFile::open(&mine, &path).unwrap().unwrap()).unwrap();
        same(&mine, &kept, (0..2000).filter(|index| index % 7 > 0));
        (0..2000).for_each(|index| kept.insert(&mine, row(&mine, index)).unwrap());
        same(&mine, &kept, 0..2000);
    }

    #[test]
    fn what_is_damaged_has_not_been_made() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("rows");
        let mine = experiment(1);
        let mut kept = Results::kept_in(RowFile::create(&mine, &path).unwrap()).unwrap();
        (0..9).for_each(|index| kept.insert(&mine, row(&mine, index)).unwrap());
        let whole = std::fs::read(&path).unwrap();
        let rows = RowFile::open(&mine, &path).unwrap().unwrap();
        let (width, words) = (rows.width() as u64, rows.place(rows.runs));
        // A byte of the seal, the outcome, the numbers; and one of the words of run 2.
        for (at, lost) in [(0, 0), (SEAL as u64 + width, 1), (4 * width - 1, 3)].map(|(at, n)| (HEAD as u64 + at, n)) {
            let mut bytes = whole.clone();
            bytes[at as usize] ^= 64;
            std::fs::write(&path, bytes).unwrap();
            let mut kept = Results::kept_in(RowFile::open(&mine, &path).unwrap().unwrap()).unwrap();
            same(&mine, &kept, (0..9).filter(|index| *index != lost));
            kept.insert(&mine, row(&mine, lost)).unwrap();
            same(&mine, &kept, 0..9);
        }
        let mut bytes = whole.clone();
        bytes[words as usize] ^= 1;
        std::fs::write(&path, &bytes).unwrap();
        let kept = Results::kept_in(RowFile::open(&mine, &path).unwrap().unwrap()).unwrap();
        same(&mine, &kept, (0..9).filter(|index| *index != 2));
        // Torn off behind the fifth row, in the middle of the sixth.
        std::fs::write(&path, &whole[..HEAD + 5 * width as usize + 17]).unwrap();
        let kept = Results::kept_in(RowFile::open(&mine, &path).unwrap().unwrap()).unwrap();
        same(&mine, &kept, [0, 1, 3, 4].into_iter());
    }

    #[test]
    fn another_experiment_does_not_take_it() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("rows");
        RowFile::create(&experiment(1), &path).unwrap();
        let said = RowFile::open(&experiment(2), &path).unwrap_err().to_string();
        assert!(said.contains("another experiment"), "{said}");
        std::fs::write(&path, "short").unwrap();
        let said = RowFile::open(&experiment(1), &path).unwrap_err().to_string();
        assert!(said.contains("is damaged"), "{said}");
    }
}
