//! What the classroom's requests share: its tables, the library, the server's secret, and who may ask how often.

use super::store::ClassroomStore;
use super::{problems, secrets};
use crate::auth::{FailureLimiter, Rate, RateLimiter};
use crate::config::Config;
use crate::error::Problem;
use crate::exercises::{Library, LibraryError};
use crate::laboratory::data_folder;
use crate::receipts::ReceiptKey;
use anyhow::Context;
use axum::http::{HeaderMap, HeaderName, header};
use jiff::{SignedDuration, Timestamp};
use std::net::IpAddr;
use std::num::NonZeroU32;
use std::sync::Arc;
use uuid::Uuid;

/// Name of the secret from which seeds are made.
const SEEDS: &str = "seeds";

/// For how long a printed link, and an invitation by a teacher, is good.
const PRINTED_FOR: SignedDuration = SignedDuration::from_hours(24);
const INVITED_FOR: SignedDuration = SignedDuration::from_hours(72);

/// Wrong passwords per minute from one address and for one login, whatever the address.
const PASSWORDS_PER_MINUTE: NonZeroU32 = NonZeroU32::new(30).unwrap();
const PASSWORDS_PER_LOGIN: NonZeroU32 = NonZeroU32::new(10).unwrap();

/// Wrong codes and links per minute from one address: a school has one address, and its pupils mistype.
const CODES_PER_MINUTE: NonZeroU32 = NonZeroU32::new(300).unwrap();

/// Requests and attempts of one person.
const REQUESTS_PER_MINUTE: NonZeroU32 = NonZeroU32::new(600).unwrap();
const ATTEMPTS_PER_MINUTE: NonZeroU32 = NonZeroU32::new(30).unwrap();

/// What a proxy says of the connection before it.
const FORWARDED_PROTO: HeaderName = HeaderName::from_static("x-forwarded-proto");

/// Shared by all requests of the classroom.
pub struct Desk {
    /// The tables.
    pub store: Arc<dyn ClassroomStore>,
    /// Exercises.
    pub library: Library,
    /// What seeds are made from.
    pub secret: String,
    /// What signs receipts.
    pub key: ReceiptKey,
    public_url: Option<String>,
    passwords: FailureLimiter,
    codes: FailureLimiter,
    logins: RateLimiter<String>,
    requests: RateLimiter<Uuid>,
    attempts: RateLimiter<Uuid>,
}

impl Desk {
    /// A desk over these tables, which make the server's secret if there is none.
    pub async fn open(store: Arc<dyn ClassroomStore>, config: &Config) -> anyhow::Result<Self> {
        let rate = |per_minute| Rate { per_minute, burst: per_minute };
        let fresh = secrets::fresh().context("the system gives no random numbers")?;
        Ok(Self {
            secret: store.secret(SEEDS, &fresh).await?,
            library: library(config).context("classroom.exercises")?,
            key: ReceiptKey::open(&data_folder(config)).context("the key that signs receipts")?,
            store,
            public_url: config.classroom.public_url.clone(),
            passwords: FailureLimiter::new(rate(PASSWORDS_PER_MINUTE)),
            codes: FailureLimiter::new(rate(CODES_PER_MINUTE)),
            logins: RateLimiter::new(rate(PASSWORDS_PER_LOGIN)),
            requests: RateLimiter::new(rate(REQUESTS_PER_MINUTE)),
            attempts: RateLimiter::new(rate(ATTEMPTS_PER_MINUTE)),
        })
    }

    /// Whether the browser at the other end speaks https, perhaps to a proxy. Only the asker's own cookie depends on it.
    pub fn is_https(&self, headers: &HeaderMap) -> bool {
        self.public_url.as_ref().is_some_and(|url| url.starts_with("https://"))
            || headers.get(FORWARDED_PROTO).is_some_and(|scheme| scheme.as_bytes().eq_ignore_ascii_case(b"https"))
    }

    /// Where pages are, as the asker's browser reaches them.
    pub fn base(&self, headers: &HeaderMap) -> String {
        if let Some(url) = &self.public_url {
            return url.trim_end_matches('/').to_owned();
        }
        let scheme = if self.is_https(headers) { "https" } else { "http" };
        let host = headers.get(header::HOST).and_then(|host| host.to_str().ok()).unwrap_or("localhost");
        format!("{scheme}://{host}")
    }

    /// A link that makes its first user a teacher.
    pub async fn invite(&self, base: &str, printed: bool) -> anyhow::Result<(String, Timestamp)> {
        invite(&*self.store, base, printed).await
    }

    /// The link for the first teacher, as long as there is none.
    pub async fn first_link(&self, bound: &str) -> anyhow::Result<Option<String>> {
        if self.store.teachers().await? > 0 {
            return Ok(None);
        }
        let base = self.public_url.clone().unwrap_or_else(|| bound.to_owned());
        Ok(Some(self.invite(base.trim_end_matches('/'), true).await?.0))
    }

    /// Before a password from this address is looked at.
    pub fn check_password(&self, peer: IpAddr, login: &str) -> Result<(), Problem> {
        self.passwords.check(peer).map_err(problems::too_often)?;
        self.logins.check(&secrets::hash(login)).map_err(problems::too_often)
    }

    /// A password was wrong.
    pub fn wrong_password(&self, peer: IpAddr) {
        self.passwords.record(peer);
    }

    /// Before a code or link from this address is looked at.
    pub fn check_code(&self, peer: IpAddr) -> Result<(), Problem> {
        self.codes.check(peer).map_err(problems::too_often)
    }

    /// A code or link was wrong.
    pub fn wrong_code(&self, peer: IpAddr) {
        self.codes.record(peer);
    }

    /// Counts a request of this person.
    pub fn count_request(&self, person: Uuid) -> Result<(), Problem> {
        self.requests.check(&person).map_err(problems::too_often)
    }

    /// Counts an attempt of this person.
    pub fn count_attempt(&self, person: Uuid) -> Result<(), Problem> {
        self.attempts.check(&person).map_err(problems::too_often)
    }
}

/// The exercises that can be given out.
fn library(config: &Config) -> Result<Library, LibraryError> {
    config.classroom.exercises.as_deref().map_or_else(Library::shipped, Library::with_folder)
}

/// Makes a link that makes its first user a teacher, once and within its time.
pub async fn invite(store: &dyn ClassroomStore, base: &str, printed: bool) -> anyhow::Result<(String, Timestamp)> {
    let secret = secrets::fresh().context("the system gives no random numbers")?;
    let expires_at = Timestamp::now() + if printed { PRINTED_FOR } else { INVITED_FOR };
    store.invite(&secrets::hash(&secret), printed, expires_at).await?;
    Ok((format!("{base}/teach.html#invitation={secret}"), expires_at))
}
