//! Signed tokens (JWT, RFC 7519) by RS256, which LTI's security framework requires, and by nothing else.
//!
//! `jsonwebtoken` reads and writes them; ring makes and checks the signatures. A token that names another algorithm, `none` and
//! the symmetric ones among them, finds nothing here that could check it.

use jsonwebtoken::crypto::{CryptoProvider, JwtSigner, JwtVerifier, KeyUtils};
use jsonwebtoken::errors::{Error, ErrorKind, Result};
use jsonwebtoken::signature::{Error as BadSignature, Signer, Verifier};
use jsonwebtoken::{Algorithm, DecodingKey, DecodingKeyKind, EncodingKey, Header, Validation};
use ring::rand::SystemRandom;
use ring::signature::{RSA_PKCS1_2048_8192_SHA256, RSA_PKCS1_SHA256, RsaKeyPair, RsaPublicKeyComponents};
use serde::Serialize;
use serde::de::DeserializeOwned;

/// How far the clocks of a platform and of this server may differ, s.
pub const LEEWAY_S: u64 = 60;

static RS256: CryptoProvider = CryptoProvider {
    signer_factory: |algorithm, key| match algorithm {
        Algorithm::RS256 => Ok(Box::new(Signing(pair(key.as_bytes())?))),
        _ => Err(ErrorKind::UnsupportedAlgorithm.into()),
    },
    verifier_factory: |algorithm, key| match (algorithm, key.kind()) {
        (Algorithm::RS256, DecodingKeyKind::RsaModulusExponent { n, e }) => {
            Ok(Box::new(Verifying { n: unpadded(n), e: unpadded(e) }))
        }
        _ => Err(ErrorKind::UnsupportedAlgorithm.into()),
    },
    // For making public keys out of private ones; ours is made by ring.
    key_utils: KeyUtils::new_unimplemented(),
};

/// A private key as ring reads it, PKCS#1.
pub fn pair(der: &[u8]) -> Result<RsaKeyPair> {
    RsaKeyPair::from_der(der).map_err(|error| ErrorKind::InvalidRsaKey(error.to_string()).into())
}

struct Signing(RsaKeyPair);

impl Signer<Vec<u8>> for Signing {
    fn try_sign(&self, message: &[u8]) -> std::result::Result<Vec<u8>, BadSignature> {
        let mut signature = vec![0; self.0.public().modulus_len()];
        let signed = self.0.sign(&RSA_PKCS1_SHA256, &SystemRandom::new(), message, &mut signature);
        signed.map(|()| signature).map_err(|_| BadSignature::new())
    }
}

impl JwtSigner for Signing {
    fn algorithm(&self) -> Algorithm {
        Algorithm::RS256
    }
}

/// A public key of 2048 to 8192 bits; ring refuses others.
struct Verifying {
    n: Vec<u8>,
    e: Vec<u8>,
}

impl Verifier<Vec<u8>> for Verifying {
    fn verify(&self, message: &[u8], signature: &Vec<u8>) -> std::result::Result<(), BadSignature> {
        let key = RsaPublicKeyComponents { n: &self.n, e: &self.e };
        key.verify(&RSA_PKCS1_2048_8192_SHA256, message, signature).map_err(|_| BadSignature::new())
    }
}

impl JwtVerifier for Verifying {
    fn algorithm(&self) -> Algorithm {
        Algorithm::RS256
    }
}

/// Some platforms write numbers with zeros in front, which ring does not take.
fn unpadded(number: &[u8]) -> Vec<u8> {
    number.iter().copied().skip_while(|byte| *byte == 0).collect()
}

fn install() {
    // The error says that it is there already.
    let _ = RS256.install_default();
}

/// A signed token with these claims.
pub fn sign<T: Serialize>(kid: &str, key: &EncodingKey, claims: &T) -> Result<String> {
    install();
    let header = Header { kid: Some(kid.to_owned()), ..Header::new(Algorithm::RS256) };
    jsonwebtoken::encode(&header, claims, key)
}

/// The name of the key that a token says it is signed with. Nothing of it is checked, but that it could be good at all.
pub fn kid(token: &str) -> Result<String> {
    let header = jsonwebtoken::decode_header(token)?;
    if header.alg != Algorithm::RS256 {
        return Err(Error::from(ErrorKind::InvalidAlgorithm));
    }
    header.kid.ok_or_else(|| ErrorKind::MissingRequiredClaim("kid".to_owned()).into())
}

/// The claims of a token, behind its signature, issuer, audience and expiry.
pub fn verify<T: DeserializeOwned>(token: &str, key: &DecodingKey, issuer: &str, audience: &str) -> Result<T> {
    install();
    let mut validation = Validation::new(Algorithm::RS256);
    validation.leeway = LEEWAY_S;
    validation.validate_nbf = true;
    validation.set_issuer(&[issuer]);
    validation.set_audience(&[audience]);
    validation.set_required_spec_claims(&["exp", "iss", "aud", "sub"]);
    Ok(jsonwebtoken::decode(token, key, &validation)?.claims)
}

#[cfg(test)]
mod tests {
    use super::super::key::{ToolKey, generate};
    use super::*;
    use serde_json::{Value, json};

    #[test]
    fn only_rs256_by_the_right_key_counts() {
        let [ours, theirs] = [(); 2].map(|()| ToolKey::read(&generate().unwrap()).unwrap());
        let now = jsonwebtoken::get_current_timestamp();
        let claims = json!({ "iss": "i", "aud": ["a", "b"], "sub": "s", "exp": now + 60 });
        let token = ours.sign(&claims).unwrap();
        let key = |key: &ToolKey| {
            let jwk = &key.public()["keys"][0];
            DecodingKey::from_rsa_components(jwk["n"].as_str().unwrap(), jwk["e"].as_str().unwrap()).unwrap()
        };
        assert_eq!(kid(&token).unwrap(), ours.public()["keys"][0]["kid"]);
        assert_eq!(verify::<Value>(&token, &key(&ours), "i", "a").unwrap()["sub"], "s");
        assert!(verify::<Value>(&token, &key(&theirs), "i", "a").is_err());
        assert!(verify::<Value>(&token, &key(&ours), "j", "a").is_err());
        assert!(verify::<Value>(&token, &key(&ours), "i", "c").is_err());
        assert!(verify::<Value>(&token, &DecodingKey::from_secret(b"x"), "i", "a").is_err());
        let late = ours.sign(&json!({ "iss": "i", "aud": "a", "sub": "s", "exp": now - LEEWAY_S - 5 })).unwrap();
        assert!(verify::<Value>(&late, &key(&ours), "i", "a").is_err());
        // {"alg":"none","kid":"x"} and {"alg":"HS256","kid":"x"}
        for header in ["eyJhbGciOiJub25lIiwia2lkIjoieCJ9", "eyJhbGciOiJIUzI1NiIsImtpZCI6IngifQ"] {
            let (_, rest) = token.split_once('.').unwrap();
            assert!(kid(&format!("{header}.{rest}")).is_err());
            assert!(verify::<Value>(&format!("{header}.{rest}"), &key(&ours), "i", "a").is_err());
        }
    }
}
