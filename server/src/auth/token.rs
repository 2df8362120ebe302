//! Bearer tokens: `adaptarm_<id>_<secret>`, 12 and 64 lower-case hexadecimal digits.
//!
//! The id is public and finds the token; the secret is shown once and stored only as its SHA-256. A slow hash would add
//! nothing: it defends guessable passwords, and nobody guesses 256 random bits.

use super::owner::Owner;
use super::scope::{Scope, Scopes};
use jiff::Timestamp;
use rand::TryRng;
use rand::rngs::{SysError, SysRng};
use serde::Serialize;
use sha2::{Digest, Sha256};
use std::fmt;
use std::str::FromStr;
use subtle::ConstantTimeEq;
use thiserror::Error;

/// What every token's text begins with, so that scanners for leaked secrets can find it.
const PREFIX: &str = "adaptarm_";

/// Longest name, characters.
const LONGEST_NAME: usize = 64;

/// A token's public identifier.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct TokenId([u8; 6]);

/// A token as it is stored.
#[derive(Clone, PartialEq, Eq, Serialize)]
pub struct Token {
    /// Finds it.
    pub id: TokenId,
    /// Whose requests it marks.
    pub owner: Owner,
    /// Its owner's name for it.
    pub name: String,
    /// What it allows.
    pub scopes: Scopes,
    /// When it was issued.
    pub created_at: Timestamp,
    /// From when on it is refused, if ever.
    pub expires_at: Option<Timestamp>,
    /// Since when it has been withdrawn, if it has.
    pub revoked_at: Option<Timestamp>,
    /// Recognises its secret.
    #[serde(skip)]
    pub secret_hash: SecretHash,
}

/// SHA-256 of a secret's 32 bytes. Written as 64 hexadecimal digits, for storage only.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct SecretHash([u8; 32]);

/// A new token's text, to be shown once. Only [`TokenText::reveal`] gives it away.
pub struct TokenText(String);

/// A token as a request presents it; not known to be right.
#[derive(Clone)]
pub struct Presented {
    id: TokenId,
    secret: [u8; 32],
}

/// A token that cannot be issued or read.
#[derive(Debug, Error)]
pub enum TokenError {
    /// A name that is empty, too long or not printable.
    #[error(
        "a token's name has 1 to {LONGEST_NAME} characters and no control characters; this one has {chars}: {name:?}"
    )]
    Name {
        /// The name, shortened.
        name: String,
        /// Its length.
        chars: usize,
    },
    /// It would be refused from the start.
    #[error("the token would expire at {expires_at}, which is not after now ({now})")]
    Expiry {
        /// When.
        expires_at: Timestamp,
        /// Now.
        now: Timestamp,
    },
    /// Not of a token's form. The text is not repeated: it may be someone's secret.
    #[error("not a token: adaptarm_, 12 hexadecimal digits, _, and 64 hexadecimal digits are needed, in lower case")]
    Form,
    /// Not of an identifier's form.
    #[error("not a token's identifier: 12 hexadecimal digits in lower case are needed")]
    Id,
    /// Not of a stored hash's form.
    #[error("not the hash of a token's secret: 64 hexadecimal digits in lower case are needed")]
    Hash,
    /// The system gave no random numbers.
    #[error("the system gives no random numbers: {0}")]
    Random(#[from] SysError),
}

/// Why a token is not accepted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum Denied {
    /// Another secret than the one that was issued, or another token.
    #[error("the token is not known")]
    Unknown,
    /// Withdrawn by its owner or the operator.
    #[error("the token was revoked")]
    Revoked,
    /// Past its time.
    #[error("the token expired at {0}")]
    Expired(Timestamp),
    /// Good, but not for this.
    #[error("the token lacks the scope {}", .0.name())]
    Scope(Scope),
}

impl Token {
    /// A new token, to be stored, and its text, to be shown.
    pub fn issue(
        owner: Owner,
        name: &str,
        scopes: Scopes,
        expires_at: Option<Timestamp>,
        now: Timestamp,
    ) -> Result<(Self, TokenText), TokenError> {
        let chars = name.chars().count();
        if !(1..=LONGEST_NAME).contains(&chars) || name.contains(char::is_control) {
            return Err(TokenError::Name { name: name.chars().take(LONGEST_NAME).collect(), chars });
        }
        if let Some(expires_at) = expires_at.filter(|at| *at <= now) {
            return Err(TokenError::Expiry { expires_at, now });
        }
        let (mut id, mut secret) = ([0; 6], [0; 32]);
        SysRng.try_fill_bytes(&mut id)?;
        SysRng.try_fill_bytes(&mut secret)?;
        let id = TokenId(id);
        let text = TokenText(format!("{PREFIX}{id}_{}", hex::encode(secret)));
        let (name, secret_hash) = (name.to_owned(), SecretHash::of(&secret));
        Ok((Self { id, owner, name, scopes, created_at: now, expires_at, revoked_at: None, secret_hash }, text))
    }

    /// Whether `presented` is this token and is good now.
    pub fn check(&self, presented: &Presented, now: Timestamp) -> Result<(), Denied> {
        let fits = SecretHash::of(&presented.secret).0.ct_eq(&self.secret_hash.0);
        if presented.id != self.id || !bool::from(fits) {
            return Err(Denied::Unknown);
        }
        if self.revoked_at.is_some() {
            return Err(Denied::Revoked);
        }
        self.expires_at.filter(|at| *at <= now).map_or(Ok(()), |at| Err(Denied::Expired(at)))
    }

    /// Whether it is good for requests of this kind.
    pub fn allow(&self, scope: Scope) -> Result<(), Denied> {
        if self.scopes.allow(scope) { Ok(()) } else { Err(Denied::Scope(scope)) }
    }
}

impl fmt::Debug for Token {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Token").field("id", &self.id).field("owner", &self.owner).finish_non_exhaustive()
    }
}

impl SecretHash {
    fn of(secret: &[u8; 32]) -> Self {
        Self(Sha256::digest(secret).into())
    }
}

impl FromStr for SecretHash {
    type Err = TokenError;

    fn from_str(text: &str) -> Result<Self, TokenError> {
        digits(text).map(Self).ok_or(TokenError::Hash)
    }
}

impl fmt::Display for SecretHash {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&hex::encode(self.0))
    }
}

impl fmt::Debug for SecretHash {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("SecretHash(hidden)")
    }
}

impl TokenText {
    /// The text.
    pub fn reveal(&self) -> &str {
        &self.0
    }
}

impl fmt::Debug for TokenText {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("TokenText(hidden)")
    }
}

impl Presented {
    /// Reads a token's text.
    pub fn parse(text: &str) -> Result<Self, TokenError> {
        let (id, secret) = text.strip_prefix(PREFIX).and_then(|rest| rest.split_once('_')).ok_or(TokenError::Form)?;
        let id = digits(id).ok_or(TokenError::Form)?;
        Ok(Self { id: TokenId(id), secret: digits(secret).ok_or(TokenError::Form)? })
    }

    /// Which token it claims to be.
    pub fn id(&self) -> TokenId {
        self.id
    }
}

impl fmt::Debug for Presented {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Presented").field("id", &self.id).finish_non_exhaustive()
    }
}

/// Lower-case hexadecimal digits, as many as `N` bytes need.
fn digits<const N: usize>(text: &str) -> Option<[u8; N]> {
    let mut bytes = [0; N];
    hex::decode_to_slice(text, &mut bytes).ok()?;
    // One token, one text.
    (!text.contains(|c: char| c.is_ascii_uppercase())).then_some(bytes)
}

impl FromStr for TokenId {
    type Err = TokenError;

    fn from_str(text: &str) -> Result<Self, TokenError> {
        digits(text).map(Self).ok_or(TokenError::Id)
    }
}

impl fmt::Display for TokenId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&hex::encode(self.0))
    }
}

impl Serialize for TokenId {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;
    use std::time::Duration;

    fn now() -> Timestamp {
        "2025-06-01T00:00:00Z".parse().unwrap()
    }

    fn issue(name: &str, expires_at: Option<Timestamp>) -> Result<(Token, TokenText), TokenError> {
        let owner = Owner::new("ana").unwrap();
        Token::issue(owner, name, "jobs:read".parse().unwrap(), expires_at, now())
    }

    #[test]
    fn the_text_that_was_shown_is_accepted() {
        let (token, text) = issue("laptop", None).unwrap();
        let presented = Presented::parse(text.reveal()).unwrap();
        assert_eq!(text.reveal().len(), 9 + 12 + 1 + 64);
        assert_eq!(presented.id(), token.id);
        assert_eq!(token.id.to_string().parse::<TokenId>().unwrap(), token.id);
        assert_eq!(token.check(&presented, now()), Ok(()));
        assert_eq!(token.allow(Scope::JobsRead), Ok(()));
        assert_eq!(token.allow(Scope::JobsWrite), Err(Denied::Scope(Scope::JobsWrite)));
        assert_eq!(Denied::Scope(Scope::JobsWrite).to_string(), "the token lacks the scope jobs:write");
    }

    #[test]
    fn another_secret_or_another_token_is_not() {
        let ((token, text), (other, other_text)) = (issue("a", None).unwrap(), issue("b", None).unwrap());
        let secret = text.reveal().rsplit_once('_').unwrap().1;
        let one_digit_off = format!("{}{}", if secret.starts_with('0') { '1' } else { '0' }, &secret[1..]);
        for wrong in [
            other_text.reveal().to_owned(),
            format!("{PREFIX}{}_{secret}", other.id),
            format!("{PREFIX}{}_{one_digit_off}", token.id),
        ] {
            assert_eq!(token.check(&Presented::parse(&wrong).unwrap(), now()), Err(Denied::Unknown), "{wrong}");
        }
    }

    #[test]
    fn revoked_and_expired_tokens_are_refused() {
        let end = now() + Duration::from_hours(1);
        let (mut token, text) = issue("laptop", Some(end)).unwrap();
        let presented = Presented::parse(text.reveal()).unwrap();
        assert_eq!(token.check(&presented, end - Duration::from_secs(1)), Ok(()));
        assert_eq!(token.check(&presented, end), Err(Denied::Expired(end)));
        token.revoked_at = Some(now());
        assert_eq!(token.check(&presented, now()), Err(Denied::Revoked));
    }

    #[test]
    fn no_two_tokens_are_alike_and_the_secret_is_not_stored() {
        let tokens: Vec<_> = (0..50).map(|_| issue("x", None).unwrap()).collect();
        let secrets: BTreeSet<_> = tokens.iter().map(|(_, text)| text.reveal().rsplit_once('_').unwrap().1).collect();
        let ids: BTreeSet<_> = tokens.iter().map(|(token, _)| token.id).collect();
        assert_eq!((secrets.len(), ids.len()), (50, 50));
        let (token, text) = &tokens[0];
        let (secret, digest) = (text.reveal().rsplit_once('_').unwrap().1, token.secret_hash.to_string());
        let presented = Presented::parse(text.reveal()).unwrap();
        let json = serde_json::to_string(token).unwrap();
        assert_ne!(secret, digest);
        assert_eq!(digest.parse::<SecretHash>().unwrap(), token.secret_hash);
        assert!(matches!(digest[1..].parse::<SecretHash>(), Err(TokenError::Hash)));
        for shown in [format!("{token:?} {:?} {text:?} {presented:?}", token.secret_hash), json] {
            assert!(!shown.contains(secret) && !shown.contains(&digest), "{shown}");
        }
    }

    #[test]
    fn only_the_exact_form_is_read() {
        let (id, secret) = ("0123456789ab", "0123456789abcdef".repeat(4));
        assert!(Presented::parse(&format!("adaptarm_{id}_{secret}")).is_ok());
        for text in [
            String::new(),
            "adaptarm_".to_owned(),
            format!("adaptarm_{id}"),
            format!("adaptarm_{id}_"),
            format!("{id}_{secret}"),
            format!("Adaptarm_{id}_{secret}"),
            format!(" adaptarm_{id}_{secret}"),
            format!("adaptarm_{id}_{secret}\n"),
            format!("adaptarm_{id}_{secret}0"),
            format!("adaptarm_{id}_{secret}_{secret}"),
            format!("adaptarm_{id}0_{secret}"),
            format!("adaptarm_{}_{secret}", id.to_uppercase()),
            format!("adaptarm_{id}_{}", secret.to_uppercase()),
            format!("adaptarm_{id}_{}", "é".repeat(32)),
            "x".repeat(1 << 20),
        ] {
            let error = Presented::parse(&text).unwrap_err();
            assert!(matches!(error, TokenError::Form) && !error.to_string().contains(&secret), "{text}");
        }
        for text in ["", "0123456789a", "0123456789abc", "0123456789AB", "0123456789ag"] {
            assert!(matches!(text.parse::<TokenId>(), Err(TokenError::Id)), "{text}");
        }
    }

    #[test]
    fn names_and_expiry_are_checked() {
        assert!(issue(&"é".repeat(64), None).is_ok());
        for name in ["", &"x".repeat(65), "two\nlines"] {
            assert!(matches!(issue(name, None), Err(TokenError::Name { .. })), "{name:?}");
        }
        let error = issue("late", Some(now())).unwrap_err();
        assert_eq!(
            error.to_string(),
            "the token would expire at 2025-06-01T00:00:00Z, which is not after now (2025-06-01T00:00:00Z)"
        );
    }
}
