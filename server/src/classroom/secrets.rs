//! Random secrets, what is kept of them, and what is derived from them.
//!
//! Links, sessions and invitations are 256 random bits; the tables hold their SHA-256 and find them by it, so no comparison
//! tells how near a guess came. A slow hash is for passwords, which can be guessed; these cannot.

use super::model::Person;
use adaptarm_core::exercises::Visibility;
use hmac::{Hmac, KeyInit, Mac};
use rand::TryRng;
use rand::rngs::{SysError, SysRng};
use sha2::{Digest, Sha256};
use subtle::ConstantTimeEq;
use uuid::Uuid;

/// Letters and digits that nobody takes for another.
const ALPHABET: &[u8; 32] = b"ABCDEFGHJKLMNPQRSTUVWXYZ23456789";

/// Characters of a class's code: 40 bits, which the limit on wrong guesses protects.
pub const CODE_CHARS: usize = 8;

/// Seeds that every reader of JSON keeps exact.
const SEED_BITS: u32 = 53;

/// A new secret: 64 hexadecimal digits.
pub fn fresh() -> Result<String, SysError> {
    let mut bytes = [0; 32];
    SysRng.try_fill_bytes(&mut bytes)?;
    Ok(hex::encode(bytes))
}

/// What is kept of a secret.
pub fn hash(secret: &str) -> String {
    hex::encode(Sha256::digest(secret))
}

/// A new code for a class, or a login: random, and easy to read out.
pub fn code() -> Result<String, SysError> {
    let mut bytes = [0; CODE_CHARS];
    SysRng.try_fill_bytes(&mut bytes)?;
    // 256 is a multiple of 32: every character is as likely.
    Ok(bytes.iter().map(|byte| char::from(ALPHABET[usize::from(byte % 32)])).collect())
}

/// What pages show beside a session's cookie, which other sites' pages can send but not read.
pub fn csrf(session: &str) -> String {
    let mut hasher = blake3::Hasher::new_derive_key("adaptarm 2026 token against cross-site requests");
    hasher.update(session.as_bytes());
    hasher.finalize().to_hex().to_string()
}

/// Whether two texts are equal, in a time that tells nothing of where they differ.
pub fn equal(one: &str, other: &str) -> bool {
    one.as_bytes().ct_eq(other.as_bytes()).into()
}

/// The seed of a student's variants: no one without the server's secret can compute it, and from the seed of the visible
/// ones nothing follows about that of the hidden ones.
pub fn seed(secret: &str, assignment: Uuid, student: Uuid, visibility: Visibility) -> u64 {
    let purpose = match visibility {
        Visibility::Visible => "visible",
        Visibility::Hidden => "hidden",
    };
    let digest = mac(secret, &format!("variants {purpose} {assignment} {student}"));
    let mut first = [0; 8];
    first.copy_from_slice(&digest[..8]);
    u64::from_be_bytes(first) >> (u64::BITS - SEED_BITS)
}

/// What makes the commitments of an attempt's receipt tell nothing: 64 hexadecimal digits, the same ones whenever it is graded.
pub fn nonce(secret: &str, attempt: Uuid) -> String {
    hex::encode(mac(secret, &format!("receipt {attempt}")))
}

/// HMAC-SHA256 with a secret of the server's.
pub fn mac(secret: &str, message: &str) -> [u8; 32] {
    // HMAC takes keys of any length.
    let Ok(mut mac) = Hmac::<Sha256>::new_from_slice(secret.as_bytes()) else {
        unreachable!("HMAC refuses no key");
    };
    mac.update(message.as_bytes());
    mac.finalize().into_bytes().into()
}

/// A person's way back in: the address's part behind `#`, which browsers do not send.
pub fn link(base: &str, person: &Person, key: &str) -> String {
    let page = match person.role {
        super::model::Role::Teacher => "teach",
        super::model::Role::Student => "learn",
    };
    format!("{base}/{page}.html#key={key}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn secrets_and_codes_have_their_forms_and_do_not_repeat() {
        let secrets: BTreeSet<_> = (0..100).map(|_| fresh().unwrap()).collect();
        let codes: BTreeSet<_> = (0..100).map(|_| code().unwrap()).collect();
        assert_eq!((secrets.len(), codes.len()), (100, 100));
        assert!(secrets.iter().all(|secret| secret.len() == 64 && hash(secret) != *secret));
        assert!(codes.iter().all(|code| code.len() == CODE_CHARS && code.bytes().all(|byte| ALPHABET.contains(&byte))));
    }

    #[test]
    fn seeds_differ_by_student_assignment_visibility_and_server() {
        let ids = [Uuid::from_u128(1), Uuid::from_u128(2)];
        let mut seeds = BTreeSet::new();
        for server in ["a", "b"] {
            for assignment in ids {
                for student in ids {
                    for visibility in [Visibility::Visible, Visibility::Hidden] {
                        let own = seed(server, assignment, student, visibility);
                        assert_eq!(own, seed(server, assignment, student, visibility));
                        assert!(own < 1 << SEED_BITS);
                        seeds.insert(own);
                    }
                }
            }
        }
        assert_eq!(seeds.len(), 16);
    }

    #[test]
    fn the_token_of_a_session_is_not_its_secret() {
        let session = fresh().unwrap();
        assert_eq!(csrf(&session), csrf(&session));
        assert_ne!(csrf(&session), csrf(&fresh().unwrap()));
        assert!(!csrf(&session).contains(&session) && csrf(&session) != hash(&session));
        assert!(equal("a", "a") && !equal("a", "b") && !equal("a", "aa"));
    }
}
