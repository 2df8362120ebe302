//! The application in process: every class of error, the catalogue, the life of a job, what guards all of it.

mod auth;
mod catalog;
mod description;
mod errors;
mod events;
mod experiments;
mod files;
mod guard;
mod jobs;
mod page;
mod requests;
mod support;
mod webhooks;
