//! Adaptive control of robot arms: a pure, deterministic laboratory.
//!
//! ```text
//! Scenario --simulate--> Recording --metrics--> Report
//! ```
//!
//! A control scheme is three choices: a velocity source ([`velocity`]), a feedback law ([`control`]) and an adaptation
//! law ([`adaptation`]). Start at [`scenario::Scenario`]; the paper's equations live in the files that name them.
//! Nothing here reads files, clocks or the network, and every target computes the same bits.
//!
//! Unoptimised, a run takes 2 to 3 MiB of stack, which is more than Rust gives to a thread that it starts: optimise this crate in development
//! too (`[profile.dev.package.adaptarm-core] opt-level = 3`), or give threads that run it 8 MiB.
#![cfg_attr(test, allow(clippy::disallowed_methods, reason = "the platform's functions are what tests compare with"))]

pub mod adaptation;
pub mod control;
pub mod decomposition;
pub mod diagnostics;
pub mod dynamics;
pub mod effects;
mod eigen;
pub mod exercises;
pub mod experiments;
#[cfg(feature = "figures")]
pub mod figures;
pub mod integrators;
pub mod lanes;
pub mod metrics;
mod packed;
mod random;
pub mod recording;
pub mod regressor;
pub mod robots;
pub mod scalar;
pub mod scenario;
pub mod simulation;
mod spare;
pub mod states;
mod sum;
pub mod trajectories;
mod transcendental;
mod unroll;
pub mod velocity;

/// Version of this crate, as reports carry it.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");
