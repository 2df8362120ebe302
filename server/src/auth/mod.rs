//! Who asks, and what they may do: tokens, their owners and scopes, and how often they may ask.
//!
//! Only rules and values. Where tokens are stored, and which requests need one, is decided elsewhere.

mod owner;
mod rate;
mod scope;
mod token;

pub use owner::{Owner, OwnerError};
pub use rate::{FailureLimiter, Rate, RateLimiter};
pub use scope::{Scope, ScopeError, Scopes};
pub use token::{Denied, Presented, SecretHash, Token, TokenError, TokenId, TokenText};
