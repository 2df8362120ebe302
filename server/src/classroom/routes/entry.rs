//! Coming in and going: sessions, invitations, joining a class.

use super::super::model::{NewPerson, Person, Role};
use super::super::session::{Signed, Teacher, begin, set_cookie};
use super::super::store::Entered;
use super::super::{passwords, problems, secrets, texts, views};
use super::read;
use crate::api::JsonBytes;
use crate::auth::peer;
use crate::error::Problem;
use crate::routes::problems::database;
use crate::state::AppState;
use axum::Json;
use axum::extract::State;
use axum::http::request::Parts;
use axum::http::{HeaderMap, StatusCode};
use axum::response::{IntoResponse, Response};
use jiff::Timestamp;
use serde::Deserialize;
use serde_json::json;
use uuid::Uuid;

/// Most students of a class.
pub const STUDENTS: i64 = 1000;

/// Whose session it is, if it is one.
pub(super) async fn show(State(state): State<AppState>, signed: Option<Signed>) -> Result<Response, Problem> {
    let Some(signed) = signed else { return Ok(Json(json!({ "role": null })).into_response()) };
    let mut view = views::session(&signed, class_of(&state, &signed.person).await?.as_ref(), None);
    if state.lti.store.is_course_account(signed.person.id).await.map_err(database)? {
        view["course_account"] = json!(true);
    }
    Ok(Json(view).into_response())
}

async fn class_of(state: &AppState, person: &Person) -> Result<Option<super::super::model::Class>, Problem> {
    match person.class {
        Some(class) => state.desk.store.class(class).await.map_err(database),
        None => Ok(None),
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SignIn {
    key: Option<String>,
    login: Option<String>,
    password: Option<String>,
}

/// Signs in by a key, or by login and password.
pub(super) async fn sign_in(
    State(state): State<AppState>,
    before: Option<Signed>,
    parts: Parts,
    JsonBytes(bytes): JsonBytes,
) -> Result<Response, Problem> {
    let (desk, address) = (&state.desk, peer(&parts));
    let person = match read(&bytes)? {
        SignIn { key: Some(key), login: None, password: None } => {
            desk.check_code(address)?;
            let found = desk.store.person_by_key(&secrets::hash(&key)).await.map_err(database)?;
            if found.is_none() {
                desk.wrong_code(address);
            }
            found
        }
        SignIn { key: None, login: Some(login), password: Some(password) } => {
            desk.check_password(address, &login)?;
            let found = desk.store.person_by_login(&login).await.map_err(database)?;
            let kept = found.as_ref().and_then(|person| person.password.clone());
            let fits = passwords::verify(password, kept).await?;
            if !fits {
                desk.wrong_password(address);
            }
            found.filter(|_| fits)
        }
        _ => return Err(texts::malformed("", "either key, or login and password are needed").into()),
    };
    let person = person.ok_or_else(problems::sign_in)?;
    welcome(&state, &parts.headers, &person, before.as_ref(), None).await
}

/// Begins a session and says so.
async fn welcome(
    state: &AppState,
    headers: &HeaderMap,
    person: &Person,
    before: Option<&Signed>,
    key: Option<&str>,
) -> Result<Response, Problem> {
    let signed = begin(state, person, before).await?;
    let link = key.map(|key| secrets::link(&state.desk.base(headers), person, key));
    let class = class_of(state, person).await?;
    let view = views::session(&signed, class.as_ref(), key.zip(link.as_deref()));
    let cookie = set_cookie(state.desk.is_https(headers), Some(&signed.secret));
    Ok((StatusCode::CREATED, [cookie], Json(view)).into_response())
}

/// Ends the session.
pub(super) async fn sign_out(
    State(state): State<AppState>,
    signed: Signed,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    state.desk.store.close_session(&signed.hash()).await.map_err(database)?;
    Ok((StatusCode::NO_CONTENT, [set_cookie(state.desk.is_https(&headers), None)]).into_response())
}

/// Ends all of the person's sessions.
pub(super) async fn sign_out_everywhere(
    State(state): State<AppState>,
    signed: Signed,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    state.desk.store.close_sessions(signed.person.id, "").await.map_err(database)?;
    Ok((StatusCode::NO_CONTENT, [set_cookie(state.desk.is_https(&headers), None)]).into_response())
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Redeem {
    invitation: String,
    name: String,
    login: String,
    password: Option<String>,
}

/// Makes a teacher of whoever has an invitation.
pub(super) async fn redeem(
    State(state): State<AppState>,
    before: Option<Signed>,
    parts: Parts,
    JsonBytes(bytes): JsonBytes,
) -> Result<Response, Problem> {
    let Redeem { invitation, name, login, password } = read(&bytes)?;
    let name = texts::cell("/name", &name, texts::NAME_CHARS)?;
    let login = texts::login("/login", &login)?;
    let (desk, address) = (&state.desk, peer(&parts));
    desk.check_code(address)?;
    let password = match password {
        Some(password) => {
            passwords::check("/password", &password)?;
            desk.check_password(address, &login)?;
            Some(passwords::hash(password).await?)
        }
        None => None,
    };
    let (new, key) = new_person(Role::Teacher, name, login, password)?;
    match desk.store.redeem(&secrets::hash(&invitation), &new).await.map_err(database)? {
        Entered::Done => welcome(&state, &parts.headers, &new.person, before.as_ref(), Some(&key)).await,
        Entered::Taken => Err(problems::taken()),
        Entered::Refused | Entered::Full => {
            desk.wrong_code(address);
            Err(problems::sign_in())
        }
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Join {
    code: String,
    name: String,
}

/// Makes a student of whoever has a class's code.
pub(super) async fn join(
    State(state): State<AppState>,
    before: Option<Signed>,
    parts: Parts,
    JsonBytes(bytes): JsonBytes,
) -> Result<Response, Problem> {
    let Join { code, name } = read(&bytes)?;
    let name = texts::cell("/name", &name, texts::NAME_CHARS)?;
    let (desk, address) = (&state.desk, peer(&parts));
    desk.check_code(address)?;
    let login = secrets::code().map_err(crate::routes::internal)?;
    let (mut new, key) = new_person(Role::Student, name, login, None)?;
    // People write small letters, and groups of letters with blanks or hyphens between them.
    let code: String = code.chars().filter(|c| !c.is_whitespace() && *c != '-').collect();
    let code = secrets::hash(&code.to_ascii_uppercase());
    match desk.store.join(&code, &new, STUDENTS).await.map_err(database)? {
        (Entered::Done, class) => {
            new.person.class = class;
            welcome(&state, &parts.headers, &new.person, before.as_ref(), Some(&key)).await
        }
        (Entered::Full, _) => Err(problems::full("students", STUDENTS)),
        (Entered::Refused | Entered::Taken, _) => {
            desk.wrong_code(address);
            Err(problems::sign_in())
        }
    }
}

/// Someone new, and their secret key.
pub fn new_person(
    role: Role,
    name: String,
    login: String,
    password: Option<String>,
) -> Result<(NewPerson, String), Problem> {
    let key = secrets::fresh().map_err(crate::routes::internal)?;
    let (id, created_at) = (Uuid::now_v7(), Timestamp::now());
    let person = Person { id, role, class: None, name, number: None, login, password, created_at };
    Ok((NewPerson { person, key_hash: secrets::hash(&key) }, key))
}

/// A link for one more teacher.
pub(super) async fn invite(
    State(state): State<AppState>,
    Teacher(teacher): Teacher,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    state.lti.refuse_course_account(teacher.id).await?;
    let invited = state.desk.invite(&state.desk.base(&headers), false).await;
    let (link, expires_at) = invited.map_err(crate::routes::internal)?;
    Ok((StatusCode::CREATED, Json(json!({ "link": link, "expires_at": expires_at }))).into_response())
}
