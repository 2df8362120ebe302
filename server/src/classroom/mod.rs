//! Classes: a teacher gives exercises out, students hand gains in, the engine computes their hidden variants, and marks follow.
//!
//! `docs/classroom.md` is the contract over HTTP. [`ClassroomStore`] is the seam to the tables; [`Desk`] is what requests share;
//! the grader turns what jobs computed into grades, each exactly once. What is graded, and how, is the core's.

mod board;
mod desk;
mod export;
mod gradebook;
mod grader;
pub(crate) mod marks;
pub(crate) mod model;
mod passwords;
pub(crate) mod problems;
mod reading;
mod routes;
pub(crate) mod rows;
pub(crate) mod secrets;
pub(crate) mod session;
pub(crate) mod store;
pub(crate) mod texts;
pub(crate) mod views;
pub(crate) mod work;

pub use desk::{Desk, invite};
pub use grader::{forget_sessions, grade};
pub use routes::routes;
pub(crate) use routes::{STUDENTS, give_out, new_person, own_assignment, own_class};
pub use store::ClassroomStore;
