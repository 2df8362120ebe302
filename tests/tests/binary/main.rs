//! The binary from outside: command line and HTTP.
