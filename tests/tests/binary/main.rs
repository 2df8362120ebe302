//! The binary from outside: command line and HTTP.

mod bad_scenarios;
mod experiment;
mod replicate;
mod run;
mod serve;
