//! What every request and response must keep to: whose requests are answered, and the headers that bind the browser.
//!
//! A server on the loopback address answers only names of this machine: a hostile page can point its own name at
//! 127.0.0.1 (DNS rebinding), but cannot change the `Host` that the browser then sends.

use crate::error::Problem;
use axum::http::{HeaderMap, HeaderName, HeaderValue, Request, StatusCode, header};
use std::net::{IpAddr, SocketAddr};

/// What a page may load and where it may be shown: only itself.
const CONTENT_SECURITY_POLICY: &str = "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; worker-src 'self'; \
     style-src 'self'; img-src 'self' data: blob:; connect-src 'self'; font-src 'self'; manifest-src 'self'; \
     base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// Abilities that no page here needs. A policy of documents: what a page loads keeps to the page's.
const PERMISSIONS_POLICY: &str = "accelerometer=(), autoplay=(), browsing-topics=(), camera=(), display-capture=(), \
     geolocation=(), gyroscope=(), magnetometer=(), microphone=(), midi=(), payment=(), usb=()";

const HEADERS: [(HeaderName, HeaderValue); 4] = [
    (header::CONTENT_SECURITY_POLICY, HeaderValue::from_static(CONTENT_SECURITY_POLICY)),
    (header::X_CONTENT_TYPE_OPTIONS, HeaderValue::from_static("nosniff")),
    (header::REFERRER_POLICY, HeaderValue::from_static("no-referrer")),
    (HeaderName::from_static("cross-origin-resource-policy"), HeaderValue::from_static("same-origin")),
];

/// Adds the headers that every response carries, and those of a page to a page: a first visit makes some hundred requests, each
/// with its headers. Pages that a learning platform shows within its own bring a stricter policy that names the platform; two
/// policies would both count.
pub fn protect(headers: &mut HeaderMap) {
    for (name, value) in HEADERS {
        headers.entry(name).or_insert(value);
    }
    let media_type = headers.get(header::CONTENT_TYPE).and_then(|value| value.to_str().ok()).unwrap_or_default();
    if media_type.starts_with("text/html") {
        headers.insert("permissions-policy", HeaderValue::from_static(PERMISSIONS_POLICY));
    }
}

/// Whose names a server answers to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Hosts {
    /// Names of this machine for itself.
    Loopback,
    /// Any.
    Any,
}

impl Hosts {
    /// The rule for a server listening on `address`.
    pub fn of(address: SocketAddr) -> Self {
        if address.ip().is_loopback() { Self::Loopback } else { Self::Any }
    }

    /// Whether a request may be answered.
    pub fn check<B>(self, request: &Request<B>) -> Result<(), Problem> {
        if self == Self::Any {
            return Ok(());
        }
        let mut names = request.headers().get_all(header::HOST).iter();
        let (host, more) = (names.next().and_then(|name| name.to_str().ok()), names.next());
        // A request line may carry a whole address, which then counts instead of `Host`.
        let host = request.uri().authority().map(axum::http::uri::Authority::as_str).or(host);
        if more.is_none() && host.is_some_and(is_loopback) {
            return Ok(());
        }
        Err(Problem::new(
            StatusCode::MISDIRECTED_REQUEST,
            "/problems/wrong-host",
            "Not a name of this server",
            "this server answers only as localhost, 127.0.0.1 or [::1]; check the address or the Host header",
        ))
    }
}

/// Whether `host`, with or without port, names this machine to itself.
fn is_loopback(host: &str) -> bool {
    let (name, port) = match host.rsplit_once(':') {
        Some((name, port)) if !port.contains(']') => (name, port),
        _ => (host, ""),
    };
    let address = name.strip_prefix('[').and_then(|name| name.strip_suffix(']')).unwrap_or(name);
    port.bytes().all(|byte| byte.is_ascii_digit())
        && (name.eq_ignore_ascii_case("localhost") || address.parse::<IpAddr>().is_ok_and(|ip| ip.is_loopback()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_this_machine_s_own_names_are_loopback() {
        for host in ["localhost", "LOCALHOST:8080", "127.0.0.1", "127.0.0.1:80", "[::1]", "[::1]:8080"] {
            assert!(is_loopback(host), "{host}");
        }
        for host in [
            "",
            ":80",
            "example.org",
            "localhost.example.org",
            "127.0.0.1.nip.io",
            "192.168.0.1",
            "user@localhost",
            "localhost:x",
        ] {
            assert!(!is_loopback(host), "{host}");
        }
    }
}
