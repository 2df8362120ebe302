//! Owners as handlers receive them: whoever has one has passed the gate, with the scope that its type names.

use super::gate::{Refusal, seconds};
use super::{Denied, Owner, Scope};
use crate::error::Problem;
use crate::listener::Peer;
use crate::routes::problems::database;
use crate::state::AppState;
use axum::extract::FromRequestParts;
use axum::http::StatusCode;
use axum::http::request::Parts;
use std::net::{IpAddr, Ipv4Addr};

/// May read jobs.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Reader(pub Owner);

/// May start, stop and delete jobs.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Writer(pub Owner);

/// May read metrics.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Observer;

async fn admit(parts: &Parts, state: &AppState, scope: Scope) -> Result<Owner, Problem> {
    // Who comes without a connection is called in process, and all such callers are one.
    let peer = parts.extensions.get::<Peer>().map_or(IpAddr::V4(Ipv4Addr::UNSPECIFIED), |peer| peer.0.ip());
    state.gate.admit(&parts.headers, peer, scope).await.map_err(Problem::from)
}

impl FromRequestParts<AppState> for Reader {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, state: &AppState) -> Result<Self, Problem> {
        admit(parts, state, Scope::JobsRead).await.map(Self)
    }
}

impl FromRequestParts<AppState> for Writer {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, state: &AppState) -> Result<Self, Problem> {
        admit(parts, state, Scope::JobsWrite).await.map(Self)
    }
}

impl FromRequestParts<AppState> for Observer {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, state: &AppState) -> Result<Self, Problem> {
        admit(parts, state, Scope::MetricsRead).await.map(|_| Self)
    }
}

impl From<Refusal> for Problem {
    fn from(refusal: Refusal) -> Self {
        let detail = refusal.to_string();
        let unauthorized = |challenge: &str| {
            Self::new(StatusCode::UNAUTHORIZED, "/problems/token", "A token is needed", detail.clone())
                .challenging(challenge)
        };
        let later = |wait, kind, title| {
            let problem = Self::new(StatusCode::TOO_MANY_REQUESTS, kind, title, detail.clone());
            Self { retry_after_s: Some(seconds(wait)), ..problem }
        };
        match refusal {
            Refusal::NoToken => unauthorized(r#"Bearer realm="adaptarm""#),
            Refusal::Malformed(_)
            | Refusal::Denied(Denied::Unknown | Denied::Revoked | Denied::Expired(_) | Denied::Scope(_)) => {
                unauthorized(r#"Bearer realm="adaptarm", error="invalid_token""#)
            }
            Refusal::Scope(scope) => {
                let challenge =
                    format!(r#"Bearer realm="adaptarm", error="insufficient_scope", scope="{}""#, scope.name());
                Self::new(StatusCode::FORBIDDEN, "/problems/scope", "The token does not allow this", detail)
                    .challenging(&challenge)
                    .with("scope", scope.name())
            }
            Refusal::TooOften { per_minute, wait } => {
                later(wait, "/problems/rate-limit", "Too many requests").with("per_minute", per_minute)
            }
            Refusal::TooManyFailures(wait) => later(wait, "/problems/rate-limit", "Too many wrong tokens"),
            Refusal::Store(error) => database(error),
        }
    }
}
