//! Access tokens for a platform's services: client credentials, where the credential is a token signed by us
//! (RFC 7523; LTI security framework, section 4.1). Kept until shortly before they end.

use super::client::Caller;
use super::key::ToolKey;
use super::model::Platform;
use super::refusal::LtiError;
use jiff::Timestamp;
use serde_json::json;
use std::collections::HashMap;
use std::time::{Duration, Instant};
use tokio::sync::Mutex;
use uuid::Uuid;

/// What our assertion is.
const ASSERTION_TYPE: &str = "urn:ietf:params:oauth:client-assertion-type:jwt-bearer";

/// For how long an assertion is good, s.
const ASSERTION_S: i64 = 300;

/// How long before its end a token is not used any more, and how long it is used where its end is not told.
const MARGIN: Duration = Duration::from_secs(30);
const UNTOLD_S: u64 = 300;
const LONGEST_S: u64 = 3600;

struct Kept {
    token: String,
    good_until: Instant,
}

/// Tokens by platform and scope.
#[derive(Default)]
pub struct AccessTokens(Mutex<HashMap<(Uuid, String), Kept>>);

impl AccessTokens {
    /// A token of this scope.
    pub async fn token(
        &self,
        caller: &Caller,
        key: &ToolKey,
        platform: &Platform,
        scope: &str,
    ) -> Result<String, LtiError> {
        let name = (platform.id, scope.to_owned());
        if let Some(kept) = self.0.lock().await.get(&name)
            && Instant::now() < kept.good_until
        {
            return Ok(kept.token.clone());
        }
        let asked_at = Instant::now();
        let now_s = Timestamp::now().as_second();
        let assertion = key.sign(&json!({
            "iss": platform.client_id,
            "sub": platform.client_id,
            "aud": platform.token_url,
            "iat": now_s,
            "exp": now_s + ASSERTION_S,
            "jti": Uuid::now_v7().to_string(),
        }))?;
        let form = [
            ("grant_type", "client_credentials"),
            ("client_assertion_type", ASSERTION_TYPE),
            ("client_assertion", assertion.as_str()),
            ("scope", scope),
        ];
        let answer = caller.post_form(&platform.token_url, &form).await?.success("an access token")?;
        let token = answer["access_token"].as_str().filter(|token| !token.is_empty() && token.is_ascii());
        let token = token.ok_or_else(|| LtiError::Platform("an access token: the platform gave none".to_owned()))?;
        let lasts = Duration::from_secs(answer["expires_in"].as_u64().unwrap_or(UNTOLD_S).min(LONGEST_S));
        let kept = Kept { token: token.to_owned(), good_until: asked_at + lasts.saturating_sub(MARGIN) };
        self.0.lock().await.insert(name, kept);
        Ok(token.to_owned())
    }

    /// Forgets a token that the platform does not take any more.
    pub async fn forget(&self, platform: Uuid, scope: &str) {
        self.0.lock().await.remove(&(platform, scope.to_owned()));
    }
}
