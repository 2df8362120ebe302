//! Receipts for grades: what was graded, by what and with which result, signed so that nobody can change a word.
//!
//! `receipt` is the signed document and `reveal` what is published after the deadline; `key` keeps the signing key; `verify` checks
//! a receipt and makes its runs again. `docs/decisions/0017-receipts.md` tells why the seed is committed to and not shown.

mod key;
mod receipt;
mod reveal;
#[cfg(test)]
mod tests;
mod verify;

pub use key::{KeyError, ReceiptKey};
pub use receipt::{Forgery, RECEIPT_FORMAT, Receipt, Statement};
pub use reveal::{Nonce, REVEAL_FORMAT, Reveal};
pub use verify::{Rerun, RerunError, rerun};
