//! The laboratory's outermost layer: command line, HTTP API, and the page. Everything that touches files, clocks, threads
//! or the network is here; everything that computes is in `adaptarm-core`.
//!
//! Tests build the same application in process: [`router::build_app`].

#![allow(clippy::duplicate_mod, reason = "the same statements are compiled once for each database")]

pub mod api;
pub mod assets;
pub mod auth;
pub mod classroom;
pub mod commands;
pub mod compression;
pub mod config;
pub mod document;
pub mod download;
pub mod error;
pub mod events;
pub mod exercises;
pub mod experiment;
pub mod figures;
pub mod guard;
pub mod jobs;
pub mod laboratory;
pub mod listener;
pub mod lti;
pub mod metrics;
pub mod openapi;
mod packed;
pub mod receipts;
pub mod replicate;
pub mod results;
pub mod router;
pub mod routes;
pub mod series;
pub mod state;
pub mod stdout;
pub mod telemetry;
pub mod unread;
pub mod webhooks;
