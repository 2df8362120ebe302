//! Tokens as a platform signs them, and as someone forges them. By ring alone: what the server uses to read them is not used here.

use anyhow::{Context, Result, bail};
use base64::Engine;
use base64::engine::general_purpose::URL_SAFE_NO_PAD;
use ring::hmac;
use ring::rand::SystemRandom;
use ring::rsa::PublicKeyComponents;
use ring::signature::{RSA_PKCS1_2048_8192_SHA256, RSA_PKCS1_SHA256, RsaKeyPair, RsaPublicKeyComponents};
use rsa_keys::pkcs1::EncodeRsaPrivateKey;
use rsa_keys::rand_core::OsRng;
use serde_json::{Value, json};

/// A key and its name.
pub struct Key {
    pair: RsaKeyPair,
    kid: String,
}

impl std::fmt::Debug for Key {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Key({})", self.kid)
    }
}

/// How a token is signed.
#[derive(Debug, Clone, Copy)]
pub enum Signed<'a> {
    /// As it should be.
    By(&'a Key),
    /// With the right name of the wrong key.
    Named(&'a Key, &'a str),
    /// With the right name of the wrong key, which the token brings with it.
    Bringing(&'a Key, &'a str),
    /// Not at all, and saying so.
    Nothing(&'a str),
    /// By HMAC, with what everyone knows as its key: the public key's text.
    Symmetrically(&'a Key),
}

impl Key {
    /// A new key.
    pub fn new(kid: &str) -> Result<Self> {
        let key = rsa_keys::RsaPrivateKey::new(&mut OsRng, 2048)?;
        let der = key.to_pkcs1_der()?;
        let pair = RsaKeyPair::from_der(der.as_bytes()).map_err(|error| anyhow::anyhow!("{error}"))?;
        Ok(Self { pair, kid: kid.to_owned() })
    }

    /// Its public half.
    pub fn jwk(&self) -> Value {
        let PublicKeyComponents::<Vec<u8>> { n, e } = PublicKeyComponents::from(self.pair.public());
        let [n, e] = [n, e].map(|number| URL_SAFE_NO_PAD.encode(number));
        json!({ "kty": "RSA", "alg": "RS256", "use": "sig", "kid": self.kid, "n": n, "e": e })
    }

    fn sign(&self, message: &str) -> Result<Vec<u8>> {
        let mut signature = vec![0; self.pair.public().modulus_len()];
        let signed = self.pair.sign(&RSA_PKCS1_SHA256, &SystemRandom::new(), message.as_bytes(), &mut signature);
        signed.map_err(|_| anyhow::anyhow!("ring does not sign"))?;
        Ok(signature)
    }
}

impl Signed<'_> {
    /// A token with these claims.
    pub fn token(self, claims: &Value) -> Result<String> {
        let (algorithm, kid) = match self {
            Self::By(key) => ("RS256", key.kid.as_str()),
            Self::Named(_, kid) | Self::Bringing(_, kid) => ("RS256", kid),
            Self::Nothing(kid) => ("none", kid),
            Self::Symmetrically(key) => ("HS256", key.kid.as_str()),
        };
        let part = |value: &Value| URL_SAFE_NO_PAD.encode(value.to_string());
        let mut header = json!({ "alg": algorithm, "typ": "JWT", "kid": kid });
        if let Self::Bringing(key, _) = self {
            header["jwk"] = key.jwk();
        }
        let message = format!("{}.{}", part(&header), part(claims));
        let signature = match self {
            Self::By(key) | Self::Named(key, _) | Self::Bringing(key, _) => key.sign(&message)?,
            Self::Nothing(_) => Vec::new(),
            Self::Symmetrically(key) => {
                let public = key.jwk()["n"].as_str().context("no modulus")?.to_owned();
                let known = hmac::Key::new(hmac::HMAC_SHA256, public.as_bytes());
                hmac::sign(&known, message.as_bytes()).as_ref().to_vec()
            }
        };
        Ok(format!("{message}.{}", URL_SAFE_NO_PAD.encode(signature)))
    }
}

/// The claims of a token, if one of these keys signed it by RS256.
pub(super) fn verify(token: &str, keys: &Value) -> Result<Value> {
    let (message, signature) = token.rsplit_once('.').context("no token")?;
    let (header, claims) = message.split_once('.').context("no token")?;
    let read = |part: &str| -> Result<Value> { Ok(serde_json::from_slice(&URL_SAFE_NO_PAD.decode(part)?)?) };
    let header = read(header)?;
    if header["alg"] != "RS256" {
        bail!("signed by {}", header["alg"]);
    }
    let own = |key: &&Value| key["kid"] == header["kid"];
    let key = keys["keys"].as_array().into_iter().flatten().find(own).context("no such key is published")?;
    let number = |name: &str| URL_SAFE_NO_PAD.decode(key[name].as_str().unwrap_or_default());
    let key = RsaPublicKeyComponents { n: number("n")?, e: number("e")? };
    let signature = URL_SAFE_NO_PAD.decode(signature)?;
    let good = key.verify(&RSA_PKCS1_2048_8192_SHA256, message.as_bytes(), &signature);
    good.map_err(|_| anyhow::anyhow!("the signature is wrong"))?;
    read(claims)
}
