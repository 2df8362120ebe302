//! Columns of doubles as Parquet files: as tables to download, and (in `object`) as what the object store keeps.
//!
//! Every column is plain doubles, their bytes split into streams (the high bytes of a smooth signal hardly change) and
//! compressed with Zstandard. No statistics, no indices: whoever reads such a file reads all of it.

mod object;

pub use object::{ObjectError, decode, encode};

use super::table::Table;
use parquet::basic::{Compression, Encoding, Repetition, Type as Physical, ZstdLevel};
use parquet::data_type::DoubleType;
use parquet::errors::{ParquetError, Result};
use parquet::file::metadata::KeyValue;
use parquet::file::properties::{EnabledStatistics, WriterProperties};
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::Type;
use std::io::Write;
use std::sync::Arc;

/// A table as a Parquet file, with the hash of the trajectory from which it was taken.
pub fn from_table(table: &Table, trajectory_hash: &str) -> Result<Vec<u8>> {
    let columns = (0..table.names().len()).map(|column| Ok::<_, ParquetError>(table.column(column).collect()));
    write(Vec::new(), table.names(), columns, &[("adaptarm.trajectory_hash", trajectory_hash)], &[])
}

/// Writes columns of one length as a Parquet file; one of them is held at a time.
pub fn write_columns<E: From<ParquetError>>(
    out: impl Write + Send,
    names: &[String],
    columns: impl Iterator<Item = Result<Vec<f64>, E>>,
    metadata: &[(&str, &str)],
) -> Result<(), E> {
    write(out, names, columns, metadata, &[]).map(drop)
}

/// Writes a file of these columns, all of one length. `lead` stands before the first of them; readers of Parquet skip it.
fn write<W: Write + Send, E: From<ParquetError>>(
    out: W,
    names: &[String],
    columns: impl Iterator<Item = Result<Vec<f64>, E>>,
    metadata: &[(&str, &str)],
    lead: &[u8],
) -> Result<W, E> {
    let metadata = metadata.iter().map(|(key, value)| KeyValue::new((*key).to_owned(), (*value).to_owned())).collect();
    let properties = WriterProperties::builder()
        .set_created_by(concat!("adaptarm ", env!("CARGO_PKG_VERSION")).to_owned())
        .set_key_value_metadata(Some(metadata))
        .set_dictionary_enabled(false)
        .set_encoding(Encoding::BYTE_STREAM_SPLIT)
        .set_compression(Compression::ZSTD(ZstdLevel::try_new(1)?))
        .set_statistics_enabled(EnabledStatistics::None)
        .set_offset_index_disabled(true)
        .build();
    let mut file = SerializedFileWriter::new(out, Arc::new(schema(names)?), Arc::new(properties))?;
    file.write_all(lead).map_err(ParquetError::from)?;
    let mut group = file.next_row_group()?;
    for values in columns {
        // As many columns as the schema has names.
        if let Some(mut column) = group.next_column()? {
            column.typed::<DoubleType>().write_batch(&values?, None, None)?;
            column.close()?;
        }
    }
    group.close()?;
    Ok(file.into_inner()?)
}

fn schema(names: &[String]) -> Result<Type> {
    let column = |name: &String| {
        let column = Type::primitive_type_builder(name, Physical::DOUBLE).with_repetition(Repetition::REQUIRED);
        Ok(Arc::new(column.build()?))
    };
    Type::group_type_builder("samples").with_fields(names.iter().map(column).collect::<Result<_>>()?).build()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::series::table::tests::{recording, same_as_csv};
    use crate::series::{Selection, Table};
    use bytes::Bytes;
    use parquet::file::reader::{FileReader, SerializedFileReader};
    use parquet::record::Field;

    /// Names and columns of a file, read through the library's rows instead of the typed columns that wrote it.
    fn read(bytes: Vec<u8>) -> (Vec<String>, Vec<Vec<f64>>) {
        let file = SerializedFileReader::new(Bytes::from(bytes)).unwrap();
        let schema = file.metadata().file_metadata().schema_descr();
        let names: Vec<_> = schema.columns().iter().map(|column| column.name().to_owned()).collect();
        let mut columns = vec![Vec::new(); names.len()];
        for row in file.get_row_iter(None).unwrap() {
            for (column, (_, field)) in columns.iter_mut().zip(row.unwrap().get_column_iter()) {
                let Field::Double(value) = field else { panic!("not a double: {field}") };
                column.push(*value);
            }
        }
        (names, columns)
    }

    #[test]
    fn reads_back_as_the_numbers_of_the_csv() {
        for (rows, every, columns) in [(0, 1, None), (1, 1, None), (700, 1, None), (700, 13, Some("s_rad_s_3,t_s"))] {
            let selection = Selection::parse(columns, Some(&every.to_string())).unwrap();
            let table = Table::new(recording(rows), &selection).unwrap();
            let (names, columns) = read(from_table(&table, "hash").unwrap());
            same_as_csv(&table, &names, &columns);
        }
    }
}
