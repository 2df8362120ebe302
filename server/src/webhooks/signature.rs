//! The signature by which a receiver knows that a call is ours, whole and recent.
//!
//! ```text
//! Adaptarm-Signature: t=<unix seconds>,v1=<hex of HMAC-SHA256(secret, "<t>.<body>")>
//! ```
//!
//! A receiver computes the same over the body as it arrived, byte for byte, compares in constant time, and refuses old
//! calls; [`verify`] is the model.

use super::target::Secret;
use hmac::{Hmac, KeyInit, Mac};
use sha2::Sha256;
use std::time::Duration;
use thiserror::Error;

/// The signature's header.
pub const SIGNATURE_HEADER: &str = "adaptarm-signature";

/// Why a call is not to be trusted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum SignatureError {
    /// The header is not in the form above.
    #[error("the signature is not of the form t=<unix seconds>,v1=<64 hexadecimal digits>")]
    Malformed,
    /// Signed too long ago, or in the future: a replay, or clocks that disagree.
    #[error("signed at {signed_at_s}, which is too far from now ({now_s}); both in unix seconds")]
    Stale {
        /// When it says it was signed.
        signed_at_s: i64,
        /// The receiver's time.
        now_s: i64,
    },
    /// Another secret, another time or another body.
    #[error("the signature does not fit the secret, the time and the body")]
    Mismatch,
}

/// The header's value for `body`, signed now.
pub fn sign(secret: &Secret, now_s: i64, body: &str) -> String {
    let digest = mac(secret, now_s, body).finalize().into_bytes();
    format!("t={now_s},v1={}", hex::encode(digest))
}

/// Checks a header's value against the body as it arrived. `tolerance` bounds the age; five minutes are usual.
pub fn verify(
    secret: &Secret,
    header: &str,
    body: &str,
    now_s: i64,
    tolerance: Duration,
) -> Result<(), SignatureError> {
    let mut signed_at_s = None;
    let mut digests = Vec::new();
    for part in header.split(',') {
        match part.trim().split_once('=').ok_or(SignatureError::Malformed)? {
            ("t", seconds) if signed_at_s.is_none() => {
                signed_at_s = Some(seconds.parse::<i64>().map_err(|_| SignatureError::Malformed)?);
            }
            ("v1", digits) => {
                let mut digest = [0; 32];
                hex::decode_to_slice(digits, &mut digest).map_err(|_| SignatureError::Malformed)?;
                digests.push(digest);
            }
            ("t", _) => return Err(SignatureError::Malformed),
            // Later versions may stand beside this one.
            _ => {}
        }
    }
    let signed_at_s = signed_at_s.filter(|_| !digests.is_empty()).ok_or(SignatureError::Malformed)?;
    if now_s.abs_diff(signed_at_s) > tolerance.as_secs() {
        return Err(SignatureError::Stale { signed_at_s, now_s });
    }
    let expected = mac(secret, signed_at_s, body);
    // Compares in constant time.
    let fits = digests.iter().any(|digest| expected.clone().verify_slice(digest).is_ok());
    if fits { Ok(()) } else { Err(SignatureError::Mismatch) }
}

fn mac(secret: &Secret, signed_at_s: i64, body: &str) -> Hmac<Sha256> {
    // HMAC takes keys of every length.
    let mut mac = Hmac::<Sha256>::new_from_slice(secret.bytes()).expect("any key fits");
    mac.update(format!("{signed_at_s}.").as_bytes());
    mac.update(body.as_bytes());
    mac
}

#[cfg(test)]
mod tests {
    use super::*;

    const NOW_S: i64 = 1_700_000_000;
    const BODY: &str = r#"{"id":"42","state":"succeeded"}"#;
    const TOLERANCE: Duration = Duration::from_mins(5);

    fn secret() -> Secret {
        Secret::new("whsec_0123456789abcdef")
    }

    #[test]
    fn is_what_other_implementations_compute() {
        // python3 -c 'import hmac; print(hmac.new(b"whsec_0123456789abcdef", b"1700000000." + BODY, "sha256").hexdigest())'
        let expected = "2a5fc1cf9dd8cee8f770a896ddbc262245cdd5dde6ad6d5cfdbc29b72872a941";
        assert_eq!(sign(&secret(), NOW_S, BODY), format!("t=1700000000,v1={expected}"));
    }

    #[test]
    fn fits_only_its_secret_time_and_body() {
        let header = sign(&secret(), NOW_S, BODY);
        let check = |secret: &Secret, header: &str, body: &str| verify(secret, header, body, NOW_S, TOLERANCE);
        assert_eq!(check(&secret(), &header, BODY), Ok(()));
        assert_eq!(check(&secret(), &header, &BODY.replace("succeeded", "failed")), Err(SignatureError::Mismatch));
        assert_eq!(check(&Secret::new("whsec_0123456789abcdeF"), &header, BODY), Err(SignatureError::Mismatch));
        let later = header.replace("t=1700000000", "t=1700000001");
        assert_eq!(check(&secret(), &later, BODY), Err(SignatureError::Mismatch));
    }

    #[test]
    fn grows_old() {
        let header = sign(&secret(), NOW_S, BODY);
        for (now_s, fine) in [
            (NOW_S - 300, true),
            (NOW_S - 301, false),
            (NOW_S + 300, true),
            (NOW_S + 301, false),
            (i64::MIN, false),
            (i64::MAX, false),
        ] {
            let stale = Err(SignatureError::Stale { signed_at_s: NOW_S, now_s });
            let expected = if fine { Ok(()) } else { stale };
            assert_eq!(verify(&secret(), &header, BODY, now_s, TOLERANCE), expected);
        }
    }

    #[test]
    fn one_of_several_signatures_is_enough() {
        let header = sign(&secret(), NOW_S, BODY);
        let other = sign(&Secret::new("the secret that is replaced"), NOW_S, BODY);
        let both = format!("{header},{},v2=later", other.split_once(',').unwrap().1);
        assert_eq!(verify(&secret(), &both, BODY, NOW_S, TOLERANCE), Ok(()));
    }

    #[test]
    fn malformed_headers_are_refused() {
        let digest = "0".repeat(64);
        for header in [
            "",
            "t=1700000000",
            &format!("v1={digest}"),
            &format!("t=now,v1={digest}"),
            &format!("t=1700000000,t=1700000000,v1={digest}"),
            "t=1700000000,v1=00",
            &format!("t=1700000000,v1={}", "g".repeat(64)),
            &format!("t=1700000000,v1={digest},rest"),
        ] {
            let verdict = verify(&secret(), header, BODY, NOW_S, TOLERANCE);
            assert_eq!(verdict, Err(SignatureError::Malformed), "{header}");
        }
    }
}
