//! Who asks, and what they may do: tokens, their owners and scopes, and how often they may ask.
//!
//! Most of it is rules and values. [`Gate`] applies them to requests, and a handler that takes a [`Reader`], [`Writer`] or
//! [`Observer`] is reached only by requests that passed.

mod extract;
mod gate;
mod owner;
mod rate;
mod scope;
mod stored;
mod token;

pub use extract::{Observer, Reader, Writer, peer};
pub use gate::{Gate, Refusal};
pub use owner::{Owner, OwnerError};
pub use rate::{FailureLimiter, Rate, RateLimiter};
pub use scope::{Challenge, Scope, ScopeError, Scopes};
pub use token::{Denied, Presented, SecretHash, Token, TokenError, TokenId, TokenText};
