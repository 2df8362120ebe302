//! The gate: whose request this is, and whether it may pass.
//!
//! On a loopback address only this machine can come, so no token is needed there; one that is shown counts all the same.

use super::{Denied, FailureLimiter, Owner, Presented, Rate, RateLimiter, Scope, Token, TokenId};
use crate::config::Auth;
use crate::jobs::{JobStore, StoreError};
use axum::http::{HeaderMap, header};
use jiff::{SignedDuration, Timestamp};
use std::net::IpAddr;
use std::num::NonZeroU32;
use std::sync::Arc;
use std::time::Duration;
use thiserror::Error;

/// Failed attempts that one address has per minute.
const FAILURES_PER_MINUTE: NonZeroU32 = NonZeroU32::new(30).unwrap();

/// How exactly a token's last use is known.
const USE_NOTED_EVERY: SignedDuration = SignedDuration::from_mins(1);

/// Why a request does not pass.
#[derive(Debug, Error)]
pub enum Refusal {
    /// Nothing says whose it is.
    #[error("this address of the server needs a token: send the header `Authorization: Bearer adaptarm_...`")]
    NoToken,
    /// What should say it cannot be read.
    #[error("the header Authorization is not `Bearer adaptarm_...`: {0}")]
    Malformed(String),
    /// The token is not good.
    #[error("{0}")]
    Denied(Denied),
    /// The token is good, but not for this.
    #[error("the token lacks the scope {}, which this request needs", .0.name())]
    Scope(Scope),
    /// The token asked too often.
    #[error("more than {per_minute} requests per minute with this token; try again in {} s", seconds(*.wait))]
    TooOften {
        /// How often it may.
        per_minute: u32,
        /// When it may again.
        wait: Duration,
    },
    /// The address failed too often.
    #[error("too many wrong tokens came from your address; try again in {} s", seconds(*.0))]
    TooManyFailures(Duration),
    /// It cannot be known.
    #[error(transparent)]
    Store(#[from] StoreError),
}

/// A wait in whole seconds, never too short.
pub(super) fn seconds(wait: Duration) -> u32 {
    u32::try_from(wait.as_millis().div_ceil(1000)).unwrap_or(u32::MAX).max(1)
}

/// Decides about requests.
pub struct Gate {
    open: bool,
    store: Arc<dyn JobStore>,
    per_minute: NonZeroU32,
    requests: RateLimiter<TokenId>,
    failures: FailureLimiter,
}

impl Gate {
    /// A gate that lets requests without a token pass if it is `open`.
    pub fn new(store: Arc<dyn JobStore>, settings: &Auth, open: bool) -> Self {
        let per_minute = NonZeroU32::new(settings.requests_per_minute).unwrap_or(NonZeroU32::MIN);
        let failures = Rate { per_minute: FAILURES_PER_MINUTE, burst: FAILURES_PER_MINUTE };
        Self {
            open,
            store,
            per_minute,
            requests: RateLimiter::new(Rate { per_minute, burst: per_minute }),
            failures: FailureLimiter::new(failures),
        }
    }

    /// Whose request this is, if it may do what needs this scope.
    pub async fn admit(&self, headers: &HeaderMap, peer: IpAddr, scope: Scope) -> Result<Owner, Refusal> {
        let Some(text) = self.bearer(headers)? else {
            return if self.open { Ok(Owner::local()) } else { Err(Refusal::NoToken) };
        };
        let token = match self.find(text).await {
            Err(refusal @ (Refusal::Malformed(_) | Refusal::Denied(_))) => {
                // Behind a proxy all have one address: who shows a good token must not suffer from others' bad ones, and
                // nobody guesses 256 bits, however often.
                self.failures.check(peer).map_err(Refusal::TooManyFailures)?;
                self.failures.record(peer);
                return Err(refusal);
            }
            found => found?,
        };
        let per_minute = self.per_minute.get();
        self.requests.check(&token.id).map_err(|wait| Refusal::TooOften { per_minute, wait })?;
        token.allow(scope).map_err(|_| Refusal::Scope(scope))?;
        Ok(token.owner)
    }

    /// The token that a request shows. An open gate takes no interest in other ways of logging in: a proxy may have asked.
    fn bearer<'a>(&self, headers: &'a HeaderMap) -> Result<Option<&'a str>, Refusal> {
        let malformed = |why: &str| Refusal::Malformed(why.to_owned());
        let mut values = headers.get_all(header::AUTHORIZATION).iter();
        let Some(value) = values.next() else { return Ok(None) };
        if values.next().is_some() {
            return Err(malformed("it is there twice"));
        }
        let value = value.to_str().map_err(|_| malformed("it is not plain text"))?;
        match value.split_once(' ') {
            Some((scheme, text)) if scheme.eq_ignore_ascii_case("bearer") => Ok(Some(text.trim_matches(' '))),
            _ if self.open => Ok(None),
            _ => Err(malformed("it does not begin with Bearer and a space")),
        }
    }

    /// The token of this text, if it is good.
    async fn find(&self, text: &str) -> Result<Token, Refusal> {
        let presented = Presented::parse(text).map_err(|error| Refusal::Malformed(error.to_string()))?;
        let stored = self.store.token(&presented.id().to_string()).await?;
        let stored = stored.ok_or(Refusal::Denied(Denied::Unknown))?;
        let (used, now) = (stored.last_used_at, Timestamp::now());
        let token = Token::try_from(stored)?;
        token.check(&presented, now).map_err(Refusal::Denied)?;
        if used.is_none_or(|used| now.duration_since(used) >= USE_NOTED_EVERY) {
            self.note_use(token.id);
        }
        Ok(token)
    }

    /// The answer need not wait for this.
    fn note_use(&self, id: TokenId) {
        let store = self.store.clone();
        tokio::spawn(async move {
            if let Err(error) = store.touch_token(&id.to_string()).await {
                tracing::warn!("cannot note that the token {id} was used: {error}");
            }
        });
    }
}
