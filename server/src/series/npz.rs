//! A table as NPZ: one array of doubles per column, under the column's name, as numpy.load gives it back.
//!
//! The arrays are stored as they are: doubles hardly shrink under the compression that NumPy knows, and its own default
//! leaves it away as well.

use super::table::Table;
use npyz::WriterBuilder;
use npyz::npz::NpzWriter;
use npyz::zip::CompressionMethod;
use npyz::zip::write::FileOptions;
use std::io::{Cursor, Result};

/// The whole archive. The same table gives the same bytes at any time.
pub(super) fn from_table(table: &Table) -> Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let mut archive = NpzWriter::new(Cursor::new(&mut bytes));
    for (n, name) in table.names().iter().enumerate() {
        let options = FileOptions::default()
            .compression_method(CompressionMethod::Stored)
            // Not the time of day, with which no two downloads would be the same.
            .last_modified_time(npyz::zip::DateTime::default());
        let rows = table.row_count() as u64;
        let mut array = archive.array(name, options)?.default_dtype().shape(&[rows]).begin_nd()?;
        array.extend(table.column(n))?;
        array.finish()?;
    }
    archive.zip_writer().finish()?;
    drop(archive);
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::super::table::tests::{recording, same_as_csv};
    use super::*;
    use crate::series::Selection;
    use npyz::npz::NpzArchive;

    #[test]
    fn reads_back_as_the_numbers_of_the_csv() {
        for (rows, every, columns) in
            [(0, "1", None), (1, "1", None), (700, "1", None), (700, "13", Some("s_rad_s_3,t_s"))]
        {
            let selection = Selection::parse(columns, Some(every)).unwrap();
            let table = Table::new(recording(rows), &selection).unwrap();
            let mut archive = NpzArchive::new(Cursor::new(from_table(&table).unwrap())).unwrap();
            let mut in_archive: Vec<_> = archive.array_names().map(str::to_owned).collect();
            let arrays = table.names().iter().map(|name| {
                let array = archive.by_name(name).unwrap().unwrap();
                assert_eq!(array.shape(), [table.row_count() as u64]);
                assert_eq!(array.dtype().descr(), "'<f8'");
                array.into_vec().unwrap()
            });
            same_as_csv(&table, table.names(), &arrays.collect::<Vec<_>>());
            let mut names = table.names().to_vec();
            in_archive.sort();
            names.sort();
            assert_eq!(in_archive, names);
        }
    }

    #[test]
    fn does_not_depend_on_when_it_was_made() {
        let table = Table::new(recording(3), &Selection::default()).unwrap();
        let bytes = from_table(&table).unwrap();
        // Local file header: time and date of 1980-01-01 00:00, the first that ZIP can say.
        assert_eq!(bytes[10..14], [0, 0, 0x21, 0]);
    }
}
