//! Webhooks: a signed POST to an address of the owner's choice when a job ends.
//!
//! A client names a [`Webhook`], a queue holds a [`Delivery`] per event, and a [`Sender`] makes one attempt at it and says
//! what to do next. Nothing here keeps anything: what is due, and when, is the queue's affair.
//! [`Policy`] keeps the server from being used to reach what only the server can reach.

mod addresses;
mod delivery;
mod guard;
mod retry;
mod signature;
mod target;
mod tls;
pub mod worker;

#[cfg(test)]
mod tests;

pub use delivery::{Delivery, Outcome, Sender, Timing, causes, guarded_client};
pub use guard::{Policy, PolicyError, Refused};
pub use retry::pause_after;
pub use signature::{SignatureError, sign, verify};
pub use target::{Secret, Webhook};
pub use tls::install_crypto_provider;
