//! This server's own key: platforms check by it what we send them. RSA of 2048 bits, made once, kept among the database's
//! secrets, where all servers of a database find the same one; its public half is at `/lti/keys`.

use super::jwt;
use anyhow::Context;
use base64::Engine;
use base64::engine::general_purpose::URL_SAFE_NO_PAD;
use jsonwebtoken::EncodingKey;
use ring::rsa::PublicKeyComponents;
use rsa::RsaPrivateKey;
use rsa::pkcs1::EncodeRsaPrivateKey;
use rsa::rand_core::OsRng;
use serde::Serialize;
use serde_json::{Value, json};
use sha2::{Digest, Sha256};

/// Size of the key, bits: the least that is allowed, and what every platform takes.
const BITS: usize = 2048;

/// A new key as it is kept: PKCS#1, hexadecimal. Takes a moment, and is for a thread that may.
pub fn generate() -> anyhow::Result<String> {
    let key = RsaPrivateKey::new(&mut OsRng, BITS).context("cannot make an RSA key")?;
    Ok(hex::encode(key.to_pkcs1_der().context("cannot write an RSA key down")?.as_bytes()))
}

/// The key, ready for use.
pub struct ToolKey {
    key: EncodingKey,
    kid: String,
    public: Value,
}

impl ToolKey {
    /// From what [`generate`] gave.
    pub fn read(kept: &str) -> anyhow::Result<Self> {
        let der = hex::decode(kept).context("the kept key is damaged")?;
        let pair = jwt::pair(&der).context("the kept key is damaged")?;
        let PublicKeyComponents::<Vec<u8>> { n, e } = pair.public().into();
        let kid = hex::encode(&Sha256::digest(&n)[..16]);
        let [n, e] = [n, e].map(|number| URL_SAFE_NO_PAD.encode(number));
        let public = json!({ "keys": [{ "kty": "RSA", "use": "sig", "alg": "RS256", "kid": kid, "n": n, "e": e }] });
        Ok(Self { key: EncodingKey::from_rsa_der(&der), kid, public })
    }

    /// The public half as a JWK set (RFC 7517).
    pub fn public(&self) -> &Value {
        &self.public
    }

    /// A token with these claims, signed.
    pub fn sign<T: Serialize>(&self, claims: &T) -> anyhow::Result<String> {
        jwt::sign(&self.kid, &self.key, claims).context("cannot sign")
    }
}
