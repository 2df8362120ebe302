//! What the classroom refuses, and in which words. Where a secret was wrong, nothing tells which or how far.

use crate::error::Problem;
use axum::http::StatusCode;
use std::time::Duration;

/// No session, or one that has ended.
pub fn no_session() -> Problem {
    Problem::new(StatusCode::UNAUTHORIZED, "/problems/session", "Sign in first", "there is no session, or it has ended")
}

/// A key, code, invitation, login or password that is not good.
pub fn sign_in() -> Problem {
    let detail = "this does not let anyone in: it is wrong, used up, closed or too old";
    Problem::new(StatusCode::UNAUTHORIZED, "/problems/sign-in", "Not let in", detail)
}

/// For the other role.
pub fn other_role() -> Problem {
    Problem::new(StatusCode::FORBIDDEN, "/problems/role", "Not for you", "this is for another role than yours")
}

/// Without the token that only our own pages know.
pub fn cross_site() -> Problem {
    let detail = "send the header X-CSRF-Token with the session's csrf, which GET /api/v1/classroom/session tells";
    Problem::new(StatusCode::FORBIDDEN, "/problems/csrf", "The request's token is missing or wrong", detail)
}

/// Not there, or not theirs.
pub fn nothing() -> Problem {
    Problem::status(StatusCode::NOT_FOUND, "there is no such thing here, or it is not yours")
}

/// The login is another's.
pub fn taken() -> Problem {
    Problem::new(StatusCode::CONFLICT, "/problems/taken", "The login is taken", "choose another login")
}

/// As many as there may be.
pub fn full(what: &'static str, most: i64) -> Problem {
    let detail = format!("{what}: there may be {most}");
    Problem::new(StatusCode::CONFLICT, "/problems/full", "There is no room for more", detail)
        .with("what", what)
        .with("most", most)
}

/// Too often.
pub fn too_often(wait: Duration) -> Problem {
    let seconds = u32::try_from(wait.as_millis().div_ceil(1000)).unwrap_or(u32::MAX).max(1);
    let detail = format!("too many requests, or too many wrong ones; try again in {seconds} s");
    let problem = Problem::new(StatusCode::TOO_MANY_REQUESTS, "/problems/rate-limit", "Too many requests", detail);
    Problem { retry_after_s: Some(seconds), ..problem }
}
