//! Passwords by Argon2id (RFC 9106) at its library's usual cost: 19 MiB, two passes. A few at a time, on threads of their own.
//!
//! Where there is no password to compare with, one that nobody has is compared all the same: the answer takes as long.

use super::texts::{PASSWORD_CHARS, check_length, malformed};
use crate::error::Problem;
use adaptarm_core::scenario::ScenarioError;
use argon2::Argon2;
use argon2::password_hash::phc::PasswordHash;
use argon2::password_hash::{PasswordHasher, PasswordVerifier};
use axum::http::StatusCode;
use rand::TryRng;
use rand::rngs::SysRng;
use std::sync::LazyLock;
use tokio::sync::Semaphore;
use tokio::task::spawn_blocking;

/// Most that are computed at a time: each takes 19 MiB and a processor.
static AT_A_TIME: Semaphore = Semaphore::const_new(2);

/// The hash of a password that nobody knows.
static NOBODY: LazyLock<Option<String>> = LazyLock::new(|| digest(&super::secrets::fresh().ok()?));

/// Whether a password has a length that is allowed, and is more than blanks.
pub fn check(pointer: &str, password: &str) -> Result<(), ScenarioError> {
    if !password.is_empty() && password.trim().is_empty() {
        return Err(malformed(pointer, "is made of blanks alone"));
    }
    check_length(pointer, password, PASSWORD_CHARS)
}

/// What is kept of a password.
pub async fn hash(password: String) -> Result<String, Problem> {
    let hashed = aside(move || digest(&password)).await?;
    hashed.ok_or_else(|| crate::routes::internal("a password cannot be hashed: the system gives no random numbers"))
}

/// Whether a password is the one that this was kept of; where nothing was kept, it is not.
pub async fn verify(password: String, kept: Option<String>) -> Result<bool, Problem> {
    aside(move || {
        let (real, kept) = (kept.is_some(), kept.or_else(|| NOBODY.clone()).unwrap_or_default());
        let fits = PasswordHash::new(&kept)
            .is_ok_and(|kept| Argon2::default().verify_password(password.as_bytes(), &kept).is_ok());
        fits && real
    })
    .await
}

/// Elsewhere than on the threads that answer requests.
async fn aside<T: Send + 'static>(work: impl FnOnce() -> T + Send + 'static) -> Result<T, Problem> {
    let closed = |_| Problem::status(StatusCode::SERVICE_UNAVAILABLE, "the server is shutting down");
    let _permit = AT_A_TIME.acquire().await.map_err(closed)?;
    spawn_blocking(work).await.map_err(crate::routes::internal)
}

fn digest(password: &str) -> Option<String> {
    let mut salt = [0; 16];
    SysRng.try_fill_bytes(&mut salt).ok()?;
    let hash: PasswordHash = Argon2::default().hash_password_with_salt(password.as_bytes(), &salt).ok()?;
    Some(hash.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[tokio::test]
    async fn only_the_password_itself_fits() {
        let (one, two) =
            (hash("correct horse".to_owned()).await.unwrap(), hash("correct horse".to_owned()).await.unwrap());
        assert!(one.starts_with("$argon2id$v=19$m=19456,t=2,p=1$") && one != two, "{one} {two}");
        assert!(verify("correct horse".to_owned(), Some(one.clone())).await.unwrap());
        for (wrong, kept) in
            [("correct horsf", Some(one)), ("correct horse", None), ("", None), ("x", Some("damaged".to_owned()))]
        {
            assert!(!verify(wrong.to_owned(), kept).await.unwrap(), "{wrong}");
        }
    }
}
