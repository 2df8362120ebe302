//! Exercises as files: those that come with the program, and a teacher's own in a folder.
//!
//! `read` makes exercises of TOML, `markdown` makes pages of their texts, `lint` says what a teacher should mend, and
//! `calibrate` shows that an exercise is fair. What an exercise is and what a solution is worth is the core's.

mod calibrate;
mod library;
mod lint;
mod markdown;
mod read;
mod table;

pub use calibrate::{Calibration, CriterionSpread, Effort, Scores, calibrate, reports};
pub use library::{Library, LibraryError};
pub use lint::lint;
pub use markdown::{MarkdownError, to_html};
pub use read::{ExerciseError, parse, read};
pub use table::{markdown_table, text_table};
