//! The core's tests from outside: reference data, the laws of mechanics, resumption, bad documents. One binary.
#![allow(clippy::disallowed_methods, reason = "the platform's functions are what tests compare with")]

mod beyond;
mod convergence;
mod diagnostics;
mod documents;
mod dual;
mod elasticity;
mod exercises;
mod experiments;
mod imperfections;
mod integral_and_signs;
mod lanes;
mod laws;
mod learning;
mod reference;
mod replication;
mod resumption;
mod robots;
mod trajectories;
mod yardsticks_on_robots;
