//! Samples over the wire: a recording as CSV, written down piece by piece as the client takes it.
//!
//! A long recording makes 150 MB of text, which nobody may hold for as long as a slow client likes.

use crate::jobs::StudyResult;
use adaptarm_core::recording::Recording;
use axum::body::{Body, Bytes};
use futures_util::{StreamExt, stream};
use std::sync::Arc;
use tokio::task::spawn_blocking;

/// Rows written down at a time: some milliseconds, some hundred kilobytes.
const ROWS: usize = 512;

/// The samples of one scenario, which the result must have, in the very bytes of [`Recording::to_csv`].
pub fn csv(result: Arc<StudyResult>, scenario: usize) -> Body {
    let pieces = stream::unfold(0, move |start| {
        let result = result.clone();
        async move {
            // A recording without rows still has a header.
            if start > 0 && start >= result.recordings[scenario].len() {
                return None;
            }
            let piece = spawn_blocking(move || piece(&result.recordings[scenario], start)).await;
            Some((piece, start + ROWS))
        }
    });
    // Compression asks once more after the end.
    Body::from_stream(pieces.fuse())
}

/// The lines of some rows from `start` on, and before the first row the header.
fn piece(recording: &Recording, start: usize) -> Bytes {
    let (columns, end) = (recording.columns(), recording.len().min(start + ROWS));
    let rows = recording.rows()[start * columns.width()..end * columns.width()].to_vec();
    // Cut between two rows, above.
    let text = Bytes::from(Recording::from_rows(columns, rows).expect("whole rows").to_csv());
    let header = text.iter().position(|byte| *byte == b'\n').map_or(0, |end| end + 1);
    if start == 0 { text } else { text.slice(header..) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use adaptarm_core::recording::Columns;
    use http_body_util::BodyExt;

    #[tokio::test]
    async fn the_pieces_are_the_table() {
        let columns = Columns { joints: 3, parameters: 18 };
        for count in [0, 1, ROWS - 1, ROWS, ROWS + 1, 3 * ROWS] {
            let rows = (0..count * columns.width()).map(|n| (n as f64).sin()).collect();
            let recording = Recording::from_rows(columns, rows).unwrap();
            let expected = recording.to_csv();
            let result = StudyResult { reports: Vec::new(), recordings: vec![recording] };
            let body = csv(Arc::new(result), 0).collect().await.unwrap().to_bytes();
            assert!(body == expected, "{count} rows");
        }
    }
}
