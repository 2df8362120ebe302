//! The binary from outside: command line and HTTP.

mod bad_scenarios;
mod exercise;
mod experiment;
mod replicate;
mod run;
mod serve;
