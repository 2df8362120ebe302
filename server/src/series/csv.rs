//! A table as CSV, written down piece by piece as the client takes it.
//!
//! A long recording makes 150 MB of text, which nobody may hold for as long as a slow client likes.

use super::table::Table;
use axum::body::{Body, Bytes};
use futures_util::{StreamExt, stream};
use std::fmt::Write;
use std::ops::Range;
use std::sync::Arc;
use tokio::task::spawn_blocking;

/// Rows written down at a time: some milliseconds, some hundred kilobytes.
const ROWS: usize = 512;

/// Number of pieces. A table without rows still has a header.
pub(super) fn piece_count(table: &Table) -> usize {
    table.row_count().div_ceil(ROWS).max(1)
}

/// A piece's lines, and before the first ones the header. Every number reads back exactly.
pub(super) fn piece(table: &Table, piece: usize) -> String {
    let mut text = String::new();
    if piece == 0 {
        text = table.names().join(",");
        text.push('\n');
    }
    for row in piece * ROWS..table.row_count().min((piece + 1) * ROWS) {
        for (column, number) in table.row(row).enumerate() {
            let separator = if column == 0 { "" } else { "," };
            // Writing to a string cannot fail.
            let _ = write!(text, "{separator}{number:?}");
        }
        text.push('\n');
    }
    text
}

/// Where each piece ends in the text: takes as long as writing the text, but keeps nothing of it.
pub(super) fn ends(table: &Table) -> Vec<u64> {
    let lengths = (0..piece_count(table)).map(|n| piece(table, n).len() as u64);
    lengths
        .scan(0, |end, length| {
            *end += length;
            Some(*end)
        })
        .collect()
}

/// The whole text.
pub(super) fn body(table: Arc<Table>) -> Body {
    pieces(table, 0, 0, u64::MAX)
}

/// These bytes of the text; `ends` are its own.
pub(super) fn part(table: Arc<Table>, ends: &[u64], range: Range<u64>) -> Body {
    let first = ends.partition_point(|end| *end <= range.start);
    let start = first.checked_sub(1).map_or(0, |before| ends[before]);
    pieces(table, first, range.start - start, range.end - range.start)
}

/// Bytes of the text from piece `first` on: `skip` of them are left out, then `left` of them are sent.
fn pieces(table: Arc<Table>, first: usize, skip: u64, left: u64) -> Body {
    let count = piece_count(&table);
    let pieces = stream::unfold((first, skip, left), move |(number, skip, left)| {
        let table = table.clone();
        async move {
            if number >= count || left == 0 {
                return None;
            }
            let text = match spawn_blocking(move || Bytes::from(piece(&table, number))).await {
                Ok(text) => text,
                Err(error) => return Some((Err(error), (count, 0, 0))),
            };
            let start = (skip as usize).min(text.len());
            let text = text.slice(start..);
            let sent = text.slice(..text.len().min(usize::try_from(left).unwrap_or(usize::MAX)));
            let left = left - sent.len() as u64;
            Some((Ok(sent), (number + 1, 0, left)))
        }
    });
    // Compression asks once more after the end.
    Body::from_stream(pieces.fuse())
}

#[cfg(test)]
mod tests {
    use super::super::table::tests::recording;
    use super::*;
    use crate::series::Selection;
    use http_body_util::BodyExt;

    async fn text(body: Body) -> Bytes {
        body.collect().await.unwrap().to_bytes()
    }

    #[tokio::test]
    async fn the_pieces_are_the_core_s_table() {
        for count in [0, 1, ROWS - 1, ROWS, ROWS + 1, 3 * ROWS] {
            let recording = recording(count);
            let table = Arc::new(Table::new(recording.clone(), &Selection::default()).unwrap());
            assert!(text(body(table)).await == recording.to_csv(), "{count} rows");
        }
    }

    #[tokio::test]
    async fn a_selection_has_the_cells_of_the_whole() {
        let recording = recording(1000);
        let selection = Selection::parse(Some("e_deg_2,t_s"), Some("7")).unwrap();
        let table = Arc::new(Table::new(recording.clone(), &selection).unwrap());
        let whole = recording.to_csv();
        let cells: Vec<Vec<_>> = whole.lines().map(|line| line.split(',').collect()).collect();
        let kept = (0..1000).step_by(7).chain([999]).map(|row| row + 1);
        let expected: Vec<_> =
            [0].into_iter().chain(kept).map(|n| format!("{},{}\n", cells[n][2], cells[n][0])).collect();
        assert!(text(body(table)).await == expected.concat());
    }

    #[tokio::test]
    async fn parts_are_cut_from_the_whole() {
        let recording = recording(2 * ROWS + 10);
        let selection = Selection::parse(Some("t_s,e_deg_1"), None).unwrap();
        let table = Arc::new(Table::new(recording, &selection).unwrap());
        let (whole, ends) = (text(body(table.clone())).await, ends(&table));
        let length = whole.len() as u64;
        assert_eq!((ends.len(), *ends.last().unwrap()), (3, length));
        for (start, end) in [
            (0, 1),
            (0, length),
            (5, 9),
            (ends[0] - 1, ends[0] + 1),
            (ends[0], ends[1]),
            (ends[0] + 3, ends[2] - 1),
            (length - 1, length),
        ] {
            let part = text(part(table.clone(), &ends, start..end)).await;
            assert!(part == whole.slice(start as usize..end as usize), "{start} to {end}");
        }
    }
}
