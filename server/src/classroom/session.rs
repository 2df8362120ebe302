//! Sessions: a secret in a cookie that scripts cannot read and other sites cannot send, and beside it, for whatever changes
//! something, a token that only our own pages know.
//!
//! Signing in always makes a new secret and ends the session that the request came with: whoever planted a cookie before
//! does not share what follows.

use super::model::{Person, Role, Session};
use super::{problems, secrets};
use crate::error::Problem;
use crate::routes::problems::database;
use crate::state::AppState;
use axum::extract::{FromRequestParts, OptionalFromRequestParts};
use axum::http::request::Parts;
use axum::http::{HeaderMap, HeaderName, HeaderValue, header};
use jiff::{SignedDuration, Timestamp};

/// Time without use after which a session ends, and when it ends whatever happens.
pub const IDLE: SignedDuration = SignedDuration::from_hours(12);
/// See [`IDLE`].
pub const LONGEST: SignedDuration = SignedDuration::from_hours(30 * 24);

/// How exactly a session's last use is known.
const USE_NOTED_EVERY: SignedDuration = SignedDuration::from_mins(1);

/// The cookie. Over https its name binds it to this host, the whole of it, and to https.
const PLAIN: &str = "adaptarm";
const SECURE: &str = "__Host-adaptarm";

/// The token of requests that change something.
const TOKEN: HeaderName = HeaderName::from_static("x-csrf-token");

/// Someone with a session.
#[derive(Debug, Clone)]
pub struct Signed {
    /// Who.
    pub person: Person,
    /// The session's secret.
    pub secret: String,
    /// When it ends at the latest.
    pub ends_at: Timestamp,
}

impl Signed {
    /// What the tables know the session by.
    pub fn hash(&self) -> String {
        secrets::hash(&self.secret)
    }
}

/// A teacher.
#[derive(Debug, Clone)]
pub struct Teacher(pub Person);

/// A student, and their class.
#[derive(Debug, Clone)]
pub struct Student(pub Person, pub uuid::Uuid);

impl FromRequestParts<AppState> for Signed {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, state: &AppState) -> Result<Self, Problem> {
        let signed = find(&parts.headers, state).await?.ok_or_else(problems::no_session)?;
        let shown = || parts.headers.get(TOKEN).and_then(|token| token.to_str().ok()).unwrap_or_default();
        if !parts.method.is_safe() && !secrets::equal(shown(), &secrets::csrf(&signed.secret)) {
            return Err(problems::cross_site());
        }
        state.desk.count_request(signed.person.id)?;
        Ok(signed)
    }
}

impl OptionalFromRequestParts<AppState> for Signed {
    type Rejection = Problem;

    /// For requests that anyone may make: whoever has no session has none.
    async fn from_request_parts(parts: &mut Parts, state: &AppState) -> Result<Option<Self>, Problem> {
        find(&parts.headers, state).await
    }
}

impl FromRequestParts<AppState> for Teacher {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, state: &AppState) -> Result<Self, Problem> {
        let signed = <Signed as FromRequestParts<AppState>>::from_request_parts(parts, state).await?;
        if signed.person.role == Role::Teacher { Ok(Self(signed.person)) } else { Err(problems::other_role()) }
    }
}

impl FromRequestParts<AppState> for Student {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, state: &AppState) -> Result<Self, Problem> {
        let Signed { person, .. } = <Signed as FromRequestParts<AppState>>::from_request_parts(parts, state).await?;
        match (person.role, person.class) {
            (Role::Student, Some(class)) => Ok(Self(person, class)),
            _ => Err(problems::other_role()),
        }
    }
}

/// The session that a request's cookie names, if it is good now.
async fn find(headers: &HeaderMap, state: &AppState) -> Result<Option<Signed>, Problem> {
    let Some(secret) = cookie(headers, name(state.desk.is_https(headers))) else { return Ok(None) };
    let (store, hash, now) = (&state.desk.store, secrets::hash(&secret), Timestamp::now());
    let Some(Session { person, created_at, used_at }) = store.session(&hash).await.map_err(database)? else {
        return Ok(None);
    };
    if now.duration_since(used_at) > IDLE || now.duration_since(created_at) > LONGEST {
        store.close_session(&hash).await.map_err(database)?;
        return Ok(None);
    }
    if now.duration_since(used_at) >= USE_NOTED_EVERY {
        store.touch_session(&hash).await.map_err(database)?;
    }
    Ok(Some(Signed { person, secret, ends_at: created_at + LONGEST }))
}

/// Begins a session for whoever has just shown that they may; its secret.
pub async fn begin(state: &AppState, person: &Person, before: Option<&Signed>) -> Result<Signed, Problem> {
    let secret = secrets::fresh().map_err(crate::routes::internal)?;
    let ended = before.map(Signed::hash);
    state.desk.store.open_session(&secrets::hash(&secret), person.id, ended.as_deref()).await.map_err(database)?;
    Ok(Signed { person: person.clone(), secret, ends_at: Timestamp::now() + LONGEST })
}

fn name(https: bool) -> &'static str {
    if https { SECURE } else { PLAIN }
}

/// The value for the header `Set-Cookie`; without a secret it takes the cookie away.
pub fn set_cookie(https: bool, secret: Option<&str>) -> (HeaderName, HeaderValue) {
    let (value, age) = secret.map_or(("", 0), |secret| (secret, LONGEST.as_secs()));
    let secure = if https { "; Secure" } else { "" };
    let cookie = format!("{}={value}; Path=/; Max-Age={age}; HttpOnly; SameSite=Strict{secure}", name(https));
    // Hexadecimal digits and what stands above.
    let value = HeaderValue::from_str(&cookie).unwrap_or(HeaderValue::from_static(""));
    (header::SET_COOKIE, value)
}

/// A cookie's value. One that is there twice was planted by someone, and does not count.
fn cookie(headers: &HeaderMap, name: &str) -> Option<String> {
    let pairs = headers.get_all(header::COOKIE).iter().filter_map(|cookies| cookies.to_str().ok());
    let mut values = pairs
        .flat_map(|cookies| cookies.split(';'))
        .filter_map(|pair| pair.trim().split_once('='))
        .filter(|(own, _)| *own == name)
        .map(|(_, value)| value);
    let value = values.next()?;
    values.next().is_none().then(|| value.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cookies(lines: &[&'static str]) -> HeaderMap {
        lines.iter().map(|line| (header::COOKIE, HeaderValue::from_static(line))).collect()
    }

    #[test]
    fn reads_exactly_one_cookie_of_the_name() {
        assert_eq!(cookie(&cookies(&["a=1; adaptarm=x; b=2"]), PLAIN).as_deref(), Some("x"));
        for none in
            [&["a=1"][..], &["adaptarm=x; adaptarm=y"], &["adaptarm=x", "adaptarm=y"], &["__Host-adaptarm=x"], &[]]
        {
            assert_eq!(cookie(&cookies(none), PLAIN), None, "{none:?}");
        }
    }

    #[test]
    fn the_cookie_is_out_of_reach() {
        let (_, plain) = set_cookie(false, Some("abc"));
        assert_eq!(plain, "adaptarm=abc; Path=/; Max-Age=2592000; HttpOnly; SameSite=Strict");
        let (_, secure) = set_cookie(true, None);
        assert_eq!(secure, "__Host-adaptarm=; Path=/; Max-Age=0; HttpOnly; SameSite=Strict; Secure");
    }
}
