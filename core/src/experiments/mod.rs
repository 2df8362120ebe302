//! Experiments: questions put to several runs at once.

pub mod replication;
