//! The object in which the store keeps a scenario's samples: a Parquet file with the very doubles of the recording, in SI
//! units, one column per entry of a row.
//!
//! Any reader of Parquet opens it. Behind the first four bytes, where those readers see nothing, it carries a seal: the hash
//! of everything after it. Damage is found there, before the library reads anything: on some damaged files it panics.

use super::write;
use adaptarm_core::recording::{Columns, Recording, Signal};
use adaptarm_core::robots::ROBOTS;
use adaptarm_core::scenario::{LIMITS, Report};
use bytes::Bytes;
use parquet::column::reader::ColumnReader;
use parquet::errors::ParquetError;
use parquet::file::metadata::FileMetaData;
use parquet::file::reader::{FileReader, SerializedFileReader};
use thiserror::Error;

/// Identifier of the format.
const FORMAT: &str = "adaptarm.samples/1";
/// What a Parquet file starts with.
const MAGIC: &[u8] = b"PAR1";
/// Bytes of the seal.
const SEAL: usize = blake3::OUT_LEN;
/// First byte behind the seal.
const CONTENT: usize = MAGIC.len() + SEAL;

const KEY_FORMAT: &str = "adaptarm.format";
const KEY_VERSION: &str = "adaptarm.core_version";
const KEY_SCENARIO: &str = "adaptarm.scenario_hash";
const KEY_TRAJECTORY: &str = "adaptarm.trajectory_hash";
const KEY_JOINTS: &str = "adaptarm.joints";
const KEY_PARAMETERS: &str = "adaptarm.parameters";

/// Why bytes are not the samples that somebody stored.
#[derive(Debug, Error)]
pub enum ObjectError {
    /// Too short, or not the kind of file.
    #[error("the stored samples are {0} bytes that are not an {FORMAT} file")]
    NotSamples(usize),
    /// Some bytes are not those that were written.
    #[error("the stored samples are damaged: their {0} bytes do not match their seal")]
    Damaged(usize),
    /// Whole, but written by something else.
    #[error("the stored samples say {key} {found:?}, where {expected} is needed")]
    Unexpected {
        /// What is not as it should be.
        key: &'static str,
        /// What it says.
        found: String,
        /// What it should say.
        expected: String,
    },
    /// The file could not be written or read.
    #[error("the stored samples cannot be encoded or decoded: {0}")]
    Parquet(#[from] ParquetError),
}

/// The object that keeps a run's samples. Takes some milliseconds of a processor.
pub fn encode(report: &Report, recording: &Recording) -> Result<Bytes, ObjectError> {
    let shape = recording.columns();
    let (joints, parameters) = (shape.joints.to_string(), shape.parameters.to_string());
    let metadata = [
        (KEY_FORMAT, FORMAT),
        (KEY_VERSION, report.core_version.as_str()),
        (KEY_SCENARIO, report.scenario_hash.as_str()),
        (KEY_TRAJECTORY, report.trajectory_hash.as_str()),
        (KEY_JOINTS, joints.as_str()),
        (KEY_PARAMETERS, parameters.as_str()),
    ];
    let column =
        |n: usize| Ok::<_, ParquetError>(recording.rows().iter().skip(n).step_by(shape.width()).copied().collect());
    let mut bytes = write(Vec::new(), &names(shape), (0..shape.width()).map(column), &metadata, &[0; SEAL])?;
    let seal = blake3::hash(&bytes[CONTENT..]);
    bytes[MAGIC.len()..CONTENT].copy_from_slice(seal.as_bytes());
    Ok(bytes.into())
}

/// The recording in an object, to the bit; an error for anything that [`encode`] did not write. Takes some milliseconds.
pub fn decode(bytes: Bytes) -> Result<Recording, ObjectError> {
    let length = bytes.len();
    if length < CONTENT || !bytes.starts_with(MAGIC) {
        return Err(ObjectError::NotSamples(length));
    }
    if blake3::hash(&bytes[CONTENT..]).as_bytes() != &bytes[MAGIC.len()..CONTENT] {
        return Err(ObjectError::Damaged(length));
    }
    let file = SerializedFileReader::new(bytes)?;
    let about = file.metadata().file_metadata();
    expect("format", value(about, KEY_FORMAT), FORMAT)?;
    let shape = shape(about)?;
    let (count, width) = (row_count(about)?, shape.width());
    let mut rows = vec![0.0; count * width];
    let mut values = Vec::with_capacity(count);
    for group in 0..file.num_row_groups() {
        // One group is written; whatever another says would overwrite the first, and the hash below notices.
        let group = file.get_row_group(group)?;
        for column in 0..width {
            values.clear();
            if let ColumnReader::DoubleColumnReader(mut reader) = group.get_column_reader(column)? {
                reader.read_records(count, None, None, &mut values)?;
            }
            rows.iter_mut().skip(column).step_by(width).zip(&values).for_each(|(entry, value)| *entry = *value);
        }
    }
    let recording = Recording::from_rows(shape, rows).ok_or(ObjectError::NotSamples(length))?;
    expect("trajectory hash", value(about, KEY_TRAJECTORY), &recording.hash())?;
    Ok(recording)
}

/// Names of the columns: those of exported tables, with the SI unit where the exported one is another.
fn names(shape: Columns) -> Vec<String> {
    let mut names = vec!["t_s".to_owned()];
    for signal in Signal::ALL {
        let (name, scale) = signal.exported();
        let name = if scale == 1.0 { name.to_owned() } else { name.replacen("_deg", "_rad", 1) };
        names.extend((1..=shape.count(signal)).map(|n| format!("{name}_{n}")));
    }
    names
}

/// Shape of the rows, which must be that of a robot there is, with the columns that belong to it.
fn shape(about: &FileMetaData) -> Result<Columns, ObjectError> {
    let number = |key| value(about, key).parse().unwrap_or(0);
    let shape = Columns { joints: number(KEY_JOINTS), parameters: number(KEY_PARAMETERS) };
    let of_a_robot = ROBOTS.iter().any(|robot| {
        let known = Columns { joints: robot.joint_count(), parameters: robot.parameter_count() };
        known == shape
    });
    if !of_a_robot {
        let found = format!("{} joints, {} parameters", shape.joints, shape.parameters);
        return Err(unexpected("shape", &found, "the shape of a known robot"));
    }
    let columns = about.schema_descr().columns();
    let found: Vec<_> = columns.iter().map(|column| format!("{} {}", column.name(), column.physical_type())).collect();
    let expected: Vec<_> = names(shape).into_iter().map(|name| format!("{name} DOUBLE")).collect();
    expect("columns", &found.join(", "), &expected.join(", "))?;
    Ok(shape)
}

/// Number of rows: at most the samples of a scenario and its end.
fn row_count(about: &FileMetaData) -> Result<usize, ObjectError> {
    let (count, most) = (about.num_rows(), LIMITS.samples[1] + 1);
    let allowed = usize::try_from(count).ok().filter(|count| *count <= most);
    allowed.ok_or_else(|| unexpected("number of rows", &count.to_string(), &format!("0 to {most}")))
}

/// What the file says about itself under a key; nothing if it does not.
fn value<'a>(about: &'a FileMetaData, key: &str) -> &'a str {
    let pairs = about.key_value_metadata().map_or(&[][..], Vec::as_slice);
    pairs.iter().find(|pair| pair.key == key).and_then(|pair| pair.value.as_deref()).unwrap_or_default()
}

fn expect(key: &'static str, found: &str, expected: &str) -> Result<(), ObjectError> {
    if found == expected { Ok(()) } else { Err(unexpected(key, found, expected)) }
}

fn unexpected(key: &'static str, found: &str, expected: &str) -> ObjectError {
    ObjectError::Unexpected { key, found: crate::document::brief(found), expected: expected.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use adaptarm_core::scenario::{Run, Scenario, Scheme};
    use proptest::prelude::*;
    use std::sync::LazyLock;

    static RUN: LazyLock<Run> = LazyLock::new(|| {
        let mut document = Scheme::Proposed.paper();
        (document.integration.duration_s, document.recording.samples) = (0.2, 100);
        Scenario::new(document).unwrap().run()
    });
    static OBJECT: LazyLock<Bytes> = LazyLock::new(|| encode(&RUN.report, &RUN.recording).unwrap());

    /// The same bytes with a seal that fits them.
    fn seal(mut bytes: Vec<u8>) -> Bytes {
        let seal = blake3::hash(&bytes[CONTENT..]);
        bytes[MAGIC.len()..CONTENT].copy_from_slice(seal.as_bytes());
        bytes.into()
    }

    #[test]
    fn gives_back_the_same_bits() {
        let back = decode(OBJECT.clone()).unwrap();
        assert_eq!(back.columns(), RUN.recording.columns());
        assert!(back.rows().iter().zip(RUN.recording.rows()).all(|(a, b)| a.to_bits() == b.to_bits()));
        assert_eq!(back.hash(), RUN.report.trajectory_hash);
        assert!(OBJECT.len() < size_of_val(RUN.recording.rows()), "{} bytes", OBJECT.len());
    }

    #[test]
    fn a_run_without_samples_is_kept_too() {
        let recording = Recording::with_capacity(RUN.recording.columns(), 0);
        let report = Report { trajectory_hash: recording.hash(), ..RUN.report.clone() };
        assert_eq!(decode(encode(&report, &recording).unwrap()).unwrap(), recording);
    }

    #[test]
    fn says_whose_samples_these_are_in_units_of_their_own() {
        let file = SerializedFileReader::new(OBJECT.clone()).unwrap();
        let about = file.metadata().file_metadata();
        assert_eq!(value(about, KEY_SCENARIO), RUN.report.scenario_hash);
        assert_eq!(value(about, KEY_VERSION), adaptarm_core::VERSION);
        let names: Vec<_> = about.schema_descr().columns().iter().map(|column| column.name().to_owned()).collect();
        assert_eq!(names[..5], ["t_s", "e_rad_1", "e_rad_2", "e_rad_3", "de_rad_s_1"]);
    }

    #[test]
    fn refuses_samples_that_belong_to_another_run() {
        let report = Report { trajectory_hash: "0".repeat(64), ..RUN.report.clone() };
        let error = decode(encode(&report, &RUN.recording).unwrap()).unwrap_err().to_string();
        assert!(error.starts_with("the stored samples say trajectory hash \"0000"), "{error}");
    }

    #[test]
    fn refuses_shapes_that_no_robot_has() {
        let columns = Columns { joints: 2, parameters: 5 };
        let recording = Recording::from_rows(columns, vec![0.5; columns.width()]).unwrap();
        let error = decode(encode(&RUN.report, &recording).unwrap()).unwrap_err().to_string();
        assert!(error.contains("shape \"2 joints, 5 parameters\""), "{error}");
    }

    #[test]
    fn refuses_what_is_no_object_at_all() {
        for bytes in [&b""[..], b"PAR1", &[0; 100]] {
            assert!(matches!(decode(Bytes::from_static(b"").slice(..0)), Err(ObjectError::NotSamples(0))));
            assert!(matches!(decode(Bytes::copy_from_slice(bytes)), Err(ObjectError::NotSamples(_))));
        }
        let column = std::iter::once(Ok::<_, ParquetError>(vec![1.0]));
        let plain = write(Vec::new(), &["x".to_owned()], column, &[], &[0; SEAL]).unwrap();
        assert!(matches!(decode(plain.clone().into()), Err(ObjectError::Damaged(_))));
        assert!(matches!(decode(seal(plain)), Err(ObjectError::Unexpected { key: "format", .. })));
    }

    proptest! {
        #[test]
        fn notices_every_cut(length in 0..OBJECT.len()) {
            decode(OBJECT.slice(..length)).unwrap_err();
        }

        #[test]
        fn notices_every_flipped_bit(place in 0..OBJECT.len(), bit in 0..8_u8) {
            let mut bytes = OBJECT.to_vec();
            bytes[place] ^= 1_u8 << bit;
            decode(bytes.into()).unwrap_err();
        }
    }
}
