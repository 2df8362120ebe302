//! The laboratory's outermost layer: command line, HTTP API, and the page. Everything that touches files, clocks, threads
//! or the network is here; everything that computes is in `adaptarm-core`.
//!
//! Tests build the same application in process: [`router::build_app`].

pub mod api;
pub mod assets;
pub mod commands;
pub mod config;
pub mod document;
pub mod error;
pub mod figures;
pub mod guard;
pub mod jobs;
pub mod listener;
pub mod metrics;
pub mod replicate;
pub mod router;
pub mod routes;
pub mod state;
pub mod stdout;
pub mod telemetry;
pub mod webhooks;
