//! Where a client wants to be called, and the secret with which it recognises the call.

use super::guard::Policy;
use adaptarm_core::scenario::{Problem, ScenarioError};
use serde::{Deserialize, Serialize};
use std::fmt;
use url::Url;
use utoipa::ToSchema;

/// Longest address, characters.
const LONGEST_URL_CHARS: usize = 2000;

/// Allowed lengths of a secret, characters.
const SECRET_CHARS: std::ops::RangeInclusive<usize> = 16..=200;

/// A webhook as a client asks for it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct Webhook {
    /// Absolute `http` or `https` address to send to.
    #[schema(format = "uri", max_length = 2000, example = "https://example.org/hooks/adaptarm")]
    pub url: String,
    /// Key of the signature; only the two ends should know it.
    #[schema(value_type = String, min_length = 16, max_length = 200, write_only)]
    pub secret: Secret,
}

/// A shared secret; it never shows in logs.
#[derive(Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Secret(String);

impl Secret {
    /// A secret of this text.
    pub fn new(text: impl Into<String>) -> Self {
        Self(text.into())
    }

    /// The key of signatures.
    pub(super) fn bytes(&self) -> &[u8] {
        self.0.as_bytes()
    }
}

impl fmt::Debug for Secret {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Secret(hidden)")
    }
}

impl Webhook {
    /// Checks both fields; `pointer` is the webhook's place in the document. What a name leads to is checked when sending.
    pub fn check(&self, pointer: &str, policy: &Policy) -> Result<(), ScenarioError> {
        check_url(&self.url, policy).map_err(|problem| ScenarioError::new(format!("{pointer}/url"), problem))?;
        let chars = self.secret.0.chars().count();
        if SECRET_CHARS.contains(&chars) {
            return Ok(());
        }
        let (min, max) = (*SECRET_CHARS.start() as f64, *SECRET_CHARS.end() as f64);
        let problem = Problem::OutOfRange { value: chars as f64, min, max, unit: "characters" };
        Err(ScenarioError::new(format!("{pointer}/secret"), problem))
    }
}

fn check_url(text: &str, policy: &Policy) -> Result<(), Problem> {
    let chars = text.chars().count();
    if chars > LONGEST_URL_CHARS {
        return Err(Problem::TooMany { found: chars, most: LONGEST_URL_CHARS, what: "characters" });
    }
    let malformed = |message: String| Problem::Malformed { message };
    // The parser below would drop these without a word.
    if text.contains(|c: char| c.is_whitespace() || c.is_control()) {
        return Err(malformed("has spaces or control characters; write them percent-encoded".to_owned()));
    }
    let url = Url::parse(text).map_err(|error| malformed(format!("is not an absolute address: {error}")))?;
    if !matches!(url.scheme(), "http" | "https") {
        return Err(Problem::Unknown { value: url.scheme().to_owned(), allowed: "http, https".to_owned() });
    }
    // The parser also takes `https:example.org` and `https:\\example.org`.
    if !text[url.scheme().len()..].starts_with("://") {
        return Err(malformed(format!("is not an absolute address: it must begin with {}://", url.scheme())));
    }
    if !url.username().is_empty() || url.password().is_some() {
        return Err(malformed("holds a user name or password; a receiver knows us by the signature".to_owned()));
    }
    if url.fragment().is_some() {
        return Err(malformed("has a fragment (#...), which is never sent".to_owned()));
    }
    if url.port() == Some(0) {
        return Err(Problem::OutOfRange { value: 0.0, min: 1.0, max: 65535.0, unit: "as its port" });
    }
    policy.check_literal(&url).map_err(|refused| malformed(refused.to_string()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refusal(url: &str) -> String {
        let webhook = Webhook { url: url.to_owned(), secret: Secret::new("0123456789abcdef") };
        webhook.check("/webhook", &Policy::public()).unwrap_err().to_string()
    }

    #[test]
    fn takes_ordinary_addresses() {
        for url in [
            "https://example.org",
            "http://example.org:8080/hook?key=1",
            "HTTPS://Example.org/",
            "https://bücher.example/é",
            "http://1.1.1.1/",
            "https://[2606:4700::1111]/",
        ] {
            let webhook = Webhook { url: url.to_owned(), secret: Secret::new("x".repeat(200)) };
            assert_eq!(webhook.check("/webhook", &Policy::public()), Ok(()), "{url}");
        }
    }

    #[test]
    fn says_what_is_wrong_with_an_address() {
        for (url, words) in [
            ("", "webhook.url: is not an absolute address"),
            ("/hook", "is not an absolute address"),
            ("example.org/hook", "is not an absolute address"),
            ("https:example.org", "must begin with https://"),
            (r"https:\\example.org", "must begin with https://"),
            ("https://", "is not an absolute address"),
            ("ftp://example.org/", "\"ftp\" is not known; allowed: http, https"),
            ("file:///etc/passwd", "\"file\" is not known"),
            ("https://me@example.org/", "user name or password"),
            ("https://:pw@example.org/", "user name or password"),
            ("https://example.org/#top", "fragment"),
            ("https://example.org:0/", "0 is outside the allowed range 1 to 65535 as its port"),
            ("https://example.org:99999/", "is not an absolute address"),
            (" https://example.org/", "spaces or control characters"),
            ("https://example.org/a\nb", "spaces or control characters"),
            ("http://127.0.0.1/", "loopback"),
            ("http://0x7f.1/", "loopback"),
            ("http://2130706433/", "loopback"),
            ("http://[::ffff:169.254.169.254]/", "link-local"),
        ] {
            let said = refusal(url);
            assert!(said.contains(words), "{url:?}: {said}");
        }
        let said = refusal(&format!("https://example.org/{}", "a".repeat(2000)));
        assert!(said.contains("has 2020 where at most 2000 are allowed, characters"), "{said}");
    }

    #[test]
    fn secrets_have_a_length_and_stay_hidden() {
        for (chars, fine) in [(15, false), (16, true), (200, true), (201, false)] {
            let secret = "é".repeat(chars);
            let webhook = Webhook { url: "https://example.org".to_owned(), secret: Secret::new(&secret) };
            let checked = webhook.check("/webhook", &Policy::public());
            assert_eq!(checked.is_ok(), fine, "{chars}");
            if let Err(error) = checked {
                assert_eq!(
                    error.to_string(),
                    format!("webhook.secret: {chars} is outside the allowed range 16 to 200 characters")
                );
            }
            assert!(!format!("{webhook:?}").contains(&secret));
        }
    }

    #[test]
    fn unknown_fields_are_refused() {
        let text = r#"{"url": "https://example.org", "secret": "0123456789abcdef", "method": "PUT"}"#;
        assert!(serde_json::from_str::<Webhook>(text).unwrap_err().to_string().contains("method"));
    }
}
