//! The public keys of platforms, as they publish them (JWK sets, RFC 7517). Kept for a while; a key that is not among them is
//! looked for once more, not too often: platforms change keys, and anyone can name one that does not exist.

use super::client::Caller;
use super::model::Platform;
use super::refusal::{LtiError, Refusal};
use jsonwebtoken::DecodingKey;
use serde_json::Value;
use std::collections::HashMap;
use std::time::{Duration, Instant};
use tokio::sync::Mutex;
use uuid::Uuid;

/// How long keys are kept: one that was withdrawn is good for no longer.
const KEPT: Duration = Duration::from_hours(1);

/// How often a platform may be asked about keys.
const ASKED_EVERY: Duration = Duration::from_secs(10);

/// Most keys of one platform.
const MOST: usize = 100;

struct Known {
    keys: HashMap<String, DecodingKey>,
    asked_at: Instant,
}

/// Keys by platform.
#[derive(Default)]
pub struct PlatformKeys(Mutex<HashMap<Uuid, Known>>);

impl PlatformKeys {
    /// A platform's key of this name.
    pub async fn key(&self, caller: &Caller, platform: &Platform, kid: &str) -> Result<DecodingKey, LtiError> {
        let missing =
            || Refusal::new("key", "the platform publishes no key of the name that the launch is signed with");
        {
            let known = self.0.lock().await;
            if let Some(Known { keys, asked_at }) = known.get(&platform.id) {
                let age = asked_at.elapsed();
                match keys.get(kid) {
                    Some(key) if age < KEPT => return Ok(key.clone()),
                    None if age < ASKED_EVERY => return Err(missing().into()),
                    _ => {}
                }
            }
        }
        // Not while holding the lock: a platform that does not answer must not keep others out.
        let asked_at = Instant::now();
        let answer = caller.get(&platform.keys_url, "application/json", None).await?;
        let keys = read(&answer.success("its public keys")?);
        let found = keys.get(kid).cloned();
        self.0.lock().await.insert(platform.id, Known { keys, asked_at });
        Ok(found.ok_or_else(missing)?)
    }

    /// Forgets a platform's keys: it was registered anew.
    pub async fn forget(&self, platform: Uuid) {
        self.0.lock().await.remove(&platform);
    }
}

/// Those keys of a set that can sign by RS256. Others, of kinds that may not even be known here, are left out.
fn read(set: &Value) -> HashMap<String, DecodingKey> {
    let keys = set["keys"].as_array().into_iter().flatten().take(MOST);
    keys.filter_map(|key| {
        let text = |name: &str| key[name].as_str();
        let fits = text("kty") == Some("RSA")
            && text("use").is_none_or(|purpose| purpose == "sig")
            && text("alg").is_none_or(|algorithm| algorithm == "RS256");
        let read = DecodingKey::from_rsa_components(text("n")?, text("e")?).ok()?;
        fits.then(|| Some((text("kid")?.to_owned(), read)))?
    })
    .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn only_keys_that_sign_by_rs256_are_taken() {
        let key = |changes: Value| {
            let mut key = json!({ "kty": "RSA", "kid": "a", "use": "sig", "alg": "RS256", "n": "3q2-7w", "e": "AQAB" });
            for (name, value) in changes.as_object().unwrap() {
                key[name] = value.clone();
            }
            read(&json!({ "keys": [{ "kty": "OKP" }, 7, key] })).contains_key("a")
        };
        assert!(key(json!({})) && key(json!({ "use": null, "alg": null })));
        for wrong in [
            json!({ "kty": "oct" }),
            json!({ "use": "enc" }),
            json!({ "alg": "HS256" }),
            json!({ "n": "+/" }),
            json!({ "kid": 1 }),
        ] {
            assert!(!key(wrong.clone()), "{wrong}");
        }
        assert!(read(&json!({})).is_empty() && read(&Value::Null).is_empty());
    }
}
