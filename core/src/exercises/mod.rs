//! Exercises: what a student may move, on which variants of a scenario it is tried, and what the runs are worth.
//!
//! `document` is what people write, `resolve` checks it into an [`Exercise`]; it plans runs from gains and a seed, and makes a
//! [`Grade`] of their reports. The same bits in the browser, which knows the visible variants only, and on the server. Nothing
//! here knows files, accounts or deadlines.

mod document;
mod exercise;
mod grade;
mod limits;
mod measures;
mod resolve;

pub use document::{
    CriterionDocument, EXERCISE_FORMAT, ExerciseDocument, HintDocument, Level, MoveDocument, ShareAggregate,
    SolutionDocument, Text, VariantsDocument,
};
pub use exercise::{Exercise, Released, Visibility};
pub use grade::{CriterionGrade, Grade, GradeError, PublicCriterion, PublicGrade, VariantCriterion, VariantGrade};
pub use limits::{EXERCISE_LIMITS, ExerciseLimits};
pub use measures::metric_names;
