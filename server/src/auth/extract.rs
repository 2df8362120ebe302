//! Owners as handlers receive them: whoever has one has passed the gate, with the scope that its type names.

use super::gate::{Refusal, seconds};
use super::{Challenge, Owner, Scope};
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

/// The address that a request comes from. Who comes without a connection is called in process, and all such callers are one.
pub fn peer(parts: &Parts) -> IpAddr {
    parts.extensions.get::<Peer>().map_or(IpAddr::V4(Ipv4Addr::UNSPECIFIED), |peer| peer.0.ip())
}

async fn admit(parts: &Parts, state: &AppState, scope: Scope) -> Result<Owner, Problem> {
    state.gate.admit(&parts.headers, peer(parts), scope).await.map_err(Problem::from)
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
        let new = |status, kind, title| Self::new(status, kind, title, detail);
        match refusal {
            Refusal::NoToken | Refusal::Malformed(_) | Refusal::Denied(_) => {
                let none = matches!(refusal, Refusal::NoToken);
                let challenge = Some(if none { Challenge::Token } else { Challenge::OtherToken });
                Self { challenge, ..new(StatusCode::UNAUTHORIZED, "/problems/token", "A token is needed") }
            }
            Refusal::Scope(scope) => {
                let problem = new(StatusCode::FORBIDDEN, "/problems/scope", "The token does not allow this");
                let problem = problem.with("scope", scope.name());
                Self { challenge: Some(Challenge::Scope(scope)), ..problem }
            }
            Refusal::TooOften { per_minute, wait } => {
                let problem = new(StatusCode::TOO_MANY_REQUESTS, "/problems/rate-limit", "Too many requests");
                Self { retry_after_s: Some(seconds(wait)), ..problem.with("per_minute", per_minute) }
            }
            Refusal::TooManyFailures(wait) => {
                let problem = new(StatusCode::TOO_MANY_REQUESTS, "/problems/rate-limit", "Too many wrong tokens");
                Self { retry_after_s: Some(seconds(wait)), ..problem }
            }
            Refusal::Store(error) => database(error),
        }
    }
}
