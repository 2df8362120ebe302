//! What ties a launch to the login that asked for it, and both to one browser (OpenID Connect Core 1.0, 3.1.2.1).
//!
//! `state` is `platform.expiry.random.target.mac`: the target link's hash, and a MAC over all of it and over the browser's cookie.
//! The nonce is a MAC of the state. So a login writes nothing anywhere; a launch is let in once, by its nonce.

use super::refusal::Refusal;
use crate::classroom::secrets::{self, equal};
use rand::TryRng;
use rand::rngs::{SysError, SysRng};
use sha2::{Digest, Sha256};
use uuid::Uuid;

/// How long after the login a launch may come, s.
pub const LOGIN_S: i64 = 600;

/// A login that has begun.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Handshake {
    /// Comes back with the launch.
    pub state: String,
    /// Comes back inside the launch.
    pub nonce: String,
    /// Name of the browser's cookie, without what https puts before it.
    pub cookie: String,
    /// Its value.
    pub browser: String,
}

/// A state that came back, not yet checked.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct State {
    /// Whose login it was.
    pub platform: Uuid,
    expires_s: i64,
    random: String,
    target: String,
    mac: String,
}

/// Begins a login.
pub fn begin(secret: &str, platform: Uuid, target: &str, now_s: i64) -> Result<Handshake, SysError> {
    let (mut random, mut browser) = ([0; 16], [0; 32]);
    SysRng.try_fill_bytes(&mut random)?;
    SysRng.try_fill_bytes(&mut browser)?;
    let (random, browser) = (hex::encode(random), hex::encode(browser));
    let mut state = State { platform, expires_s: now_s + LOGIN_S, random, target: digest(target), mac: String::new() };
    state.mac = state.sealed(secret, &browser);
    let nonce = state.nonce(secret);
    Ok(Handshake { state: state.to_string(), nonce, cookie: state.cookie(), browser })
}

impl State {
    /// Reads a state.
    pub fn parse(text: &str) -> Option<Self> {
        let parts: Vec<&str> = text.split('.').collect();
        let [platform, expires_s, random, target, mac] = parts[..] else { return None };
        let digits = |text: &str, length| text.len() == length && text.bytes().all(|byte| byte.is_ascii_hexdigit());
        let state = Self {
            platform: platform.parse().ok()?,
            expires_s: expires_s.parse().ok()?,
            random: random.to_owned(),
            target: target.to_owned(),
            mac: mac.to_owned(),
        };
        // One state, one text: the nonce is made from it.
        let plain = digits(random, 32) && digits(target, 64) && digits(mac, 64) && state.to_string() == text;
        plain.then_some(state)
    }

    /// Name of the cookie that the login left in the browser.
    pub fn cookie(&self) -> String {
        format!("adaptarm-lti-{}", &self.random[..8])
    }

    /// The nonce that the launch must have.
    pub fn nonce(&self, secret: &str) -> String {
        mac(secret, &format!("nonce {self}"))
    }

    /// Whether a login of this server's gave it to the browser with this cookie, not too long ago.
    pub fn check(&self, secret: &str, browser: Option<&str>, now_s: i64) -> Result<(), Refusal> {
        let Some(browser) = browser else {
            let detail =
                "the browser did not keep the login's cookie; open the link in a new window, or allow cookies here";
            return Err(Refusal::new("browser", detail));
        };
        if !equal(&self.mac, &self.sealed(secret, browser)) {
            return Err(Refusal::new("state", "the launch belongs to no login of this browser"));
        }
        if now_s > self.expires_s {
            return Err(Refusal::new("time", "the launch came too long after its login; open the link again"));
        }
        Ok(())
    }

    /// Whether the login was for this link.
    pub fn is_for(&self, target: &str) -> bool {
        equal(&self.target, &digest(target))
    }

    fn sealed(&self, secret: &str, browser: &str) -> String {
        let Self { platform, expires_s, random, target, .. } = self;
        mac(secret, &format!("state {platform} {expires_s} {random} {target} {browser}"))
    }
}

impl std::fmt::Display for State {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { platform, expires_s, random, target, mac } = self;
        write!(f, "{}.{expires_s}.{random}.{target}.{mac}", platform.simple())
    }
}

fn digest(text: &str) -> String {
    hex::encode(Sha256::digest(text))
}

fn mac(secret: &str, text: &str) -> String {
    hex::encode(secrets::mac(secret, text))
}

#[cfg(test)]
mod tests {
    use super::*;

    const NOW_S: i64 = 1_800_000_000;

    #[test]
    fn a_state_is_good_for_its_browser_target_and_time_only() {
        let login = begin("secret", Uuid::from_u128(7), "https://tool/x", NOW_S).unwrap();
        let state = State::parse(&login.state).unwrap();
        let browser = Some(login.browser.as_str());
        assert_eq!(
            (state.platform, state.cookie(), state.nonce("secret")),
            (Uuid::from_u128(7), login.cookie, login.nonce)
        );
        assert_eq!(state.check("secret", browser, NOW_S + LOGIN_S), Ok(()));
        assert!(state.is_for("https://tool/x") && !state.is_for("https://tool/y"));
        let reason = |refused: Result<(), Refusal>| refused.unwrap_err().reason;
        assert_eq!(reason(state.check("secret", browser, NOW_S + LOGIN_S + 1)), "time");
        assert_eq!(reason(state.check("secret", None, NOW_S)), "browser");
        assert_eq!(reason(state.check("secret", Some(&"0".repeat(64)), NOW_S)), "state");
        assert_eq!(reason(state.check("other", browser, NOW_S)), "state");
        for (part, other) in [(0, Uuid::nil().simple().to_string()), (1, (NOW_S + 9999).to_string()), (3, digest("y"))]
        {
            let mut parts: Vec<_> = login.state.split('.').collect();
            parts[part] = &other;
            let forged = State::parse(&parts.join(".")).unwrap();
            assert_eq!(reason(forged.check("secret", browser, NOW_S)), "state", "{part}");
        }
    }

    #[test]
    fn a_state_has_one_form() {
        let good = begin("secret", Uuid::from_u128(7), "t", NOW_S).unwrap().state;
        assert!(State::parse(&good).is_some());
        let hyphens = good.replacen(&Uuid::from_u128(7).simple().to_string(), &Uuid::from_u128(7).to_string(), 1);
        for text in ["", "....", &good[1..], &format!("{good}0"), &format!("{good}.x"), &hyphens, "é.é.é.é.é"] {
            assert_eq!(State::parse(text), None, "{text}");
        }
    }
}
