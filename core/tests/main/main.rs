//! The core's tests from outside: reference data, the laws of mechanics, resumption, bad documents. One binary.

mod convergence;
mod documents;
mod dual;
mod lanes;
mod laws;
mod reference;
mod replication;
mod resumption;
mod robots;
mod trajectories;
