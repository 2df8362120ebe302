//! What end-to-end tests need: the built `adaptarm` binary, servers and workers of it that can be killed and come back,
//! clusters of PostgreSQL, a store that speaks S3, a client, and work whose results are known.

pub mod classroom;
pub mod client;
pub mod events;
pub mod machine;
pub mod platform;
pub mod postgres;
pub mod process;
pub mod s3;
mod server;
pub mod timing;
pub mod workload;

pub use machine::binary;
pub use server::{Launch, Server, Worker};
