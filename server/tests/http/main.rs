//! The application in process: every class of error, the catalogue, the life of a job, what guards all of it.

mod catalog;
mod errors;
mod guard;
mod jobs;
mod support;
