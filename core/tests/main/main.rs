//! The core's tests from outside: reference data, the laws of mechanics, resumption, bad documents. One binary.

mod beyond;
mod convergence;
mod documents;
mod dual;
mod exercises;
mod experiments;
mod imperfections;
mod integral_and_signs;
mod lanes;
mod laws;
mod reference;
mod replication;
mod resumption;
mod robots;
mod trajectories;
mod yardsticks_on_robots;
