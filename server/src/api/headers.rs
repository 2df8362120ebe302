//! Headers of a request for a job: its name among its owner's requests, and how long its answer may take.

use crate::document::brief;
use crate::error::Problem;
use axum::http::{HeaderMap, HeaderName, StatusCode};
use std::time::Duration;

/// Names a request, so that sending it twice makes one job (draft-ietf-httpapi-idempotency-key-header).
pub const IDEMPOTENCY_KEY: HeaderName = HeaderName::from_static("idempotency-key");

/// Tells that the answer is about a job that an earlier request made.
pub const IDEMPOTENCY_REPLAYED: HeaderName = HeaderName::from_static("idempotency-replayed");

/// What a client would like (RFC 7240).
const PREFER: HeaderName = HeaderName::from_static("prefer");

/// Which of it was done.
pub const PREFERENCE_APPLIED: HeaderName = HeaderName::from_static("preference-applied");

/// Longest key, characters.
pub const KEY_CHARS: usize = 200;

/// The request's key, if it has one.
pub fn idempotency_key(headers: &HeaderMap) -> Result<Option<String>, Problem> {
    let mut values = headers.get_all(IDEMPOTENCY_KEY).iter();
    let Some(value) = values.next() else { return Ok(None) };
    let shown = || brief(&String::from_utf8_lossy(value.as_bytes()));
    let wrong = |message: String| {
        let detail = format!("Idempotency-Key: {message}");
        Problem::new(StatusCode::BAD_REQUEST, "/problems/malformed-header", "A header is wrong", detail)
            .with("header", "Idempotency-Key")
            .with("value", shown())
            .with("message", message)
    };
    if values.next().is_some() {
        return Err(wrong("it is there twice; one request has one key".to_owned()));
    }
    let length = value.len();
    if !(1..=KEY_CHARS).contains(&length) {
        return Err(wrong(format!("a key has 1 to {KEY_CHARS} characters; this one has {length}")));
    }
    match value.to_str() {
        Ok(key) if key.bytes().all(|byte| byte.is_ascii_graphic()) => Ok(Some(key.to_owned())),
        _ => Err(wrong("a key is made of visible ASCII characters, without spaces".to_owned())),
    }
}

/// How long the client would like to wait for the end of its job: `Prefer: wait=N`, in seconds. What cannot be understood
/// is no preference, as RFC 7240 wants it; of several the first counts.
pub fn preferred_wait(headers: &HeaderMap) -> Option<Duration> {
    let values = headers.get_all(PREFER).into_iter().filter_map(|value| value.to_str().ok());
    let mut preferences = values.flat_map(|value| split(value, ',')).filter_map(|preference| {
        // What follows a semicolon are parameters, of which `wait` has none.
        let preference = split(preference, ';').next()?;
        let (name, value) = preference.split_once('=').unwrap_or((preference, ""));
        name.trim().eq_ignore_ascii_case("wait").then(|| value.trim().trim_matches('"'))
    });
    let seconds = preferences.next()?;
    let digits = !seconds.is_empty() && seconds.bytes().all(|byte| byte.is_ascii_digit());
    // More than can be counted is more than is allowed.
    digits.then(|| Duration::from_secs(seconds.parse().unwrap_or(u64::MAX)))
}

/// Parts of a header's value, cut at a character that is not within quotes.
fn split(value: &str, at: char) -> impl Iterator<Item = &str> {
    let (mut quoted, mut escaped) = (false, false);
    value.split(move |c| {
        let within = quoted;
        match c {
            _ if escaped => escaped = false,
            '\\' if quoted => escaped = true,
            '"' => quoted = !quoted,
            _ => {}
        }
        c == at && !within
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use axum::http::HeaderValue;

    fn headers(name: &HeaderName, values: &[&str]) -> HeaderMap {
        values.iter().map(|value| (name.clone(), HeaderValue::from_bytes(value.as_bytes()).unwrap())).collect()
    }

    #[test]
    fn keys_are_short_and_visible() {
        let key = |values: &[&str]| idempotency_key(&headers(&IDEMPOTENCY_KEY, values));
        assert_eq!(key(&[]), Ok(None));
        for good in ["a", "\"8e03978e-40d5-43dd-bc93-6894a57f9324\"", &"~".repeat(200)] {
            assert_eq!(key(&[good]), Ok(Some(good.to_owned())));
        }
        for (values, words) in [
            (&[""][..], "this one has 0"),
            (&[&"x".repeat(201)], "this one has 201"),
            (&["a b"], "visible ASCII"),
            (&["é"], "visible ASCII"),
            (&["a\tb"], "visible ASCII"),
            (&["a", "a"], "twice"),
        ] {
            let problem = key(values).unwrap_err();
            assert_eq!((problem.status, problem.kind), (400, "/problems/malformed-header"));
            assert!(problem.detail.contains(words), "{problem:?}");
        }
    }

    #[test]
    fn a_wait_is_found_among_other_preferences() {
        let wait = |values: &[&str]| preferred_wait(&headers(&PREFER, values)).map(|wait| wait.as_secs());
        for (values, seconds) in [
            (&["wait=5"][..], Some(5)),
            (&["respond-async, WAIT = 10"], Some(10)),
            (&["return=minimal", "wait=\"7\"; x=1"], Some(7)),
            (&["wait=3, wait=4"], Some(3)),
            (&["wait=99999999999999999999999"], Some(u64::MAX)),
            (&["foo=\"a, wait=4\""], None),
            (&["foo=\"a\\\", wait=4\", wait=6"], Some(6)),
            (&["wait"], None),
            (&["wait=-1"], None),
            (&["wait=1.5"], None),
            (&["waiting=1"], None),
            (&[], None),
        ] {
            assert_eq!(wait(values), seconds, "{values:?}");
        }
    }
}
