//! Why a platform's message is refused. The reason is stable, for tests and for whoever set the platform up; what is said
//! about it shows no secret, for a message that is refused was not necessarily the platform's.

use crate::error::Problem;
use crate::jobs::StoreError;
use axum::http::StatusCode;
use jsonwebtoken::errors::ErrorKind;

/// A refused message.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Refusal {
    /// In a word.
    pub reason: &'static str,
    /// In a sentence.
    pub detail: String,
}

impl Refusal {
    /// For this reason.
    pub fn new(reason: &'static str, detail: impl Into<String>) -> Self {
        Self { reason, detail: detail.into() }
    }
}

impl From<jsonwebtoken::errors::Error> for Refusal {
    fn from(error: jsonwebtoken::errors::Error) -> Self {
        match error.kind() {
            ErrorKind::ExpiredSignature | ErrorKind::ImmatureSignature => {
                Self::new("time", "the launch is too old or too new; do the clocks agree?")
            }
            ErrorKind::InvalidIssuer => Self::new("issuer", "the launch is another platform's"),
            ErrorKind::InvalidAudience => Self::new("audience", "the launch is meant for another tool"),
            ErrorKind::InvalidAlgorithm | ErrorKind::UnsupportedAlgorithm | ErrorKind::InvalidAlgorithmName => {
                Self::new("algorithm", "a launch is signed with RS256")
            }
            ErrorKind::InvalidSignature => Self::new("signature", "the launch's signature is not the platform's"),
            ErrorKind::MissingRequiredClaim(name) => Self::new("claim", format!("the launch says no {name:?}")),
            _ => Self::new("token", "the launch cannot be read"),
        }
    }
}

impl From<Refusal> for Problem {
    fn from(Refusal { reason, detail }: Refusal) -> Self {
        Problem::new(StatusCode::FORBIDDEN, "/problems/lti", "The learning platform's message is refused", detail)
            .with("reason", reason)
    }
}

/// What can go wrong between a platform and us.
#[derive(Debug)]
pub enum LtiError {
    /// The message is not good.
    Refused(Refusal),
    /// The platform does not answer as it should.
    Platform(String),
    /// The tables failed.
    Store(StoreError),
    /// We failed.
    Ours(anyhow::Error),
}

impl From<Refusal> for LtiError {
    fn from(refusal: Refusal) -> Self {
        Self::Refused(refusal)
    }
}

impl From<jsonwebtoken::errors::Error> for LtiError {
    fn from(error: jsonwebtoken::errors::Error) -> Self {
        Self::Refused(error.into())
    }
}

impl From<StoreError> for LtiError {
    fn from(error: StoreError) -> Self {
        Self::Store(error)
    }
}

impl From<anyhow::Error> for LtiError {
    fn from(error: anyhow::Error) -> Self {
        Self::Ours(error)
    }
}

impl From<LtiError> for Problem {
    fn from(error: LtiError) -> Self {
        match error {
            LtiError::Refused(refusal) => refusal.into(),
            LtiError::Platform(why) => {
                let title = "The learning platform does not answer as it should";
                Problem::new(StatusCode::BAD_GATEWAY, "/problems/lti-platform", title, why)
            }
            LtiError::Store(error) => crate::routes::problems::database(error),
            LtiError::Ours(error) => crate::routes::internal(format!("{error:#}")),
        }
    }
}
