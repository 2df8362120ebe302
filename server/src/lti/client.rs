//! Asking platforms: over https, at public addresses or those that the settings allow, JSON of a bounded size, no redirects.

use super::refusal::LtiError;
use crate::webhooks::{Policy, Timing, causes, guarded_client};
use adaptarm_core::scenario::Problem;
use reqwest::header::{ACCEPT, AUTHORIZATION, CONTENT_TYPE, HeaderMap, HeaderName};
use reqwest::{Client, Method, RequestBuilder, Response, StatusCode};
use serde_json::Value;
use std::sync::{Arc, OnceLock};
use url::{Host, Url};

/// Largest answer that is read, bytes: a page of a list of members.
const ANSWER_BYTES: usize = 4 << 20;

/// Longest address, characters.
const URL_CHARS: usize = 2000;

/// Asks platforms. Cheap to clone.
#[derive(Debug, Clone)]
pub struct Caller {
    policy: Arc<Policy>,
    // Built when first needed: it reads the system's certificates, which a server without platforms need not have.
    client: Arc<OnceLock<Client>>,
}

/// An answer.
#[derive(Debug)]
pub struct Answer {
    /// Its status.
    pub status: StatusCode,
    /// Its headers.
    pub headers: HeaderMap,
    /// Its body; null if it is no JSON.
    pub body: Value,
}

impl Answer {
    /// The body of a success.
    pub fn success(self, what: &str) -> Result<Value, LtiError> {
        if self.status.is_success() { Ok(self.body) } else { Err(self.failure(what)) }
    }

    /// Words for an answer that is none.
    pub fn failure(&self, what: &str) -> LtiError {
        LtiError::Platform(format!("{what}: the platform answered {}", self.status))
    }
}

impl Caller {
    /// Within this policy.
    pub fn new(policy: Policy) -> Self {
        Self { policy: Arc::new(policy), client: Arc::default() }
    }

    /// Whether a platform's address may be called, as far as it shows: https, or http on this machine itself.
    pub fn check(&self, text: &str) -> Result<Url, Problem> {
        let malformed = |message: String| Problem::Malformed { message };
        if text.chars().count() > URL_CHARS {
            return Err(Problem::TooMany { found: text.chars().count(), most: URL_CHARS, what: "characters" });
        }
        let url = Url::parse(text).map_err(|error| malformed(format!("is not an absolute address: {error}")))?;
        let here = match url.host() {
            Some(Host::Ipv4(address)) => address.is_loopback(),
            Some(Host::Ipv6(address)) => address.is_loopback(),
            _ => false,
        };
        if url.scheme() != "https" && !(here && url.scheme() == "http") {
            return Err(malformed("must begin with https://; platforms are not called in the clear".to_owned()));
        }
        if !url.username().is_empty() || url.password().is_some() || url.fragment().is_some() {
            return Err(malformed("holds a user name, a password or a fragment".to_owned()));
        }
        self.policy.check_literal(&url).map_err(|refused| malformed(refused.to_string()))?;
        Ok(url)
    }

    /// GET of JSON of this media type, with this access token.
    pub async fn get(&self, url: &str, accept: &str, token: Option<&str>) -> Result<Answer, LtiError> {
        self.send(self.request(Method::GET, url, token)?.header(ACCEPT, accept)).await
    }

    /// POST of JSON of this media type.
    pub async fn post(&self, url: &str, media_type: &str, token: &str, body: &Value) -> Result<Answer, LtiError> {
        let request = self.request(Method::POST, url, Some(token))?.header(ACCEPT, media_type);
        self.send(request.header(CONTENT_TYPE, media_type).body(body.to_string())).await
    }

    /// POST of a form.
    pub async fn post_form(&self, url: &str, fields: &[(&str, &str)]) -> Result<Answer, LtiError> {
        let body = url::form_urlencoded::Serializer::new(String::new()).extend_pairs(fields).finish();
        let request = self.request(Method::POST, url, None)?.header(ACCEPT, "application/json");
        self.send(request.header(CONTENT_TYPE, "application/x-www-form-urlencoded").body(body)).await
    }

    fn request(&self, method: Method, url: &str, token: Option<&str>) -> Result<RequestBuilder, LtiError> {
        let url =
            self.check(url).map_err(|problem| LtiError::Platform(format!("an address of the platform {problem}")))?;
        let client = if let Some(client) = self.client.get() {
            client
        } else {
            let made = guarded_client(&self.policy, Timing::default()).map_err(|error| failed(&error))?;
            self.client.get_or_init(|| made)
        };
        let request = client.request(method, url);
        Ok(match token {
            Some(token) => request.header(AUTHORIZATION, format!("Bearer {token}")),
            None => request,
        })
    }

    async fn send(&self, request: RequestBuilder) -> Result<Answer, LtiError> {
        let response = request.send().await.map_err(|error| failed(&error))?;
        let (status, headers) = (response.status(), response.headers().clone());
        let body = serde_json::from_slice(&read(response).await?).unwrap_or_default();
        Ok(Answer { status, headers, body })
    }
}

async fn read(mut response: Response) -> Result<Vec<u8>, LtiError> {
    let mut body = Vec::new();
    while let Some(chunk) = response.chunk().await.map_err(|error| failed(&error))? {
        if body.len() + chunk.len() > ANSWER_BYTES {
            return Err(LtiError::Platform(format!("the platform's answer is longer than {ANSWER_BYTES} bytes")));
        }
        body.extend_from_slice(&chunk);
    }
    Ok(body)
}

fn failed(error: &reqwest::Error) -> LtiError {
    LtiError::Platform(if error.is_timeout() { "the platform took too long".to_owned() } else { causes(error) })
}

/// The address of the next page that an answer names (RFC 8288).
pub fn next_page(headers: &HeaderMap) -> Option<String> {
    const LINK: HeaderName = HeaderName::from_static("link");
    let links = headers.get_all(LINK).iter().filter_map(|links| links.to_str().ok()).flat_map(|links| links.split(','));
    links.filter_map(|link| link.trim().strip_prefix('<')?.split_once('>')).find_map(|(url, parameters)| {
        let mut parameters = parameters.split(';').map(|parameter| parameter.replace([' ', '"'], ""));
        parameters.any(|parameter| parameter.eq_ignore_ascii_case("rel=next")).then(|| url.to_owned())
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use reqwest::header::HeaderValue;

    #[test]
    fn only_https_and_this_machine_s_own_http_pass() {
        let allowing = Caller::new(Policy::allowing(["127.0.0.0/8"]).unwrap());
        for fine in ["https://lms.example.org/token?x=1", "http://127.0.0.1:8080/token"] {
            assert!(allowing.check(fine).is_ok(), "{fine}");
        }
        let usual = Caller::new(Policy::public());
        for wrong in [
            "http://lms.example.org/",
            "http://127.0.0.1/",
            "https://127.0.0.1/",
            "https://169.254.169.254/latest",
            "https://u:p@lms.example.org/",
            "https://lms.example.org/#x",
            "file:///etc/passwd",
            "lms.example.org",
            &format!("https://lms.example.org/{}", "x".repeat(2000)),
        ] {
            assert!(usual.check(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn finds_the_next_page_among_links() {
        let links = |value| [(HeaderName::from_static("link"), HeaderValue::from_static(value))].into_iter().collect();
        let found: HeaderMap = links("<https://a/1>; rel=\"first\", <https://a/3?p=3>; rel=\"next\"");
        assert_eq!(next_page(&found).as_deref(), Some("https://a/3?p=3"));
        for none in ["", "<https://a/1>; rel=differences", "https://a/1; rel=next"] {
            assert_eq!(next_page(&links(none)), None, "{none}");
        }
    }
}
