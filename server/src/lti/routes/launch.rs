//! A user's way in: login, launch, and from there into the classroom or to the choice of an exercise.
//!
//! The laboratory is never shown inside a platform's page: its session's cookie stays `SameSite=Strict`. What is shown there are
//! three small pages that carry a ticket, good once (decision 0020). Only the login's own cookie can be sent from a frame.

use super::super::arrive::{self, arrive, destination, redeem, ticket};
use super::super::claims::{Launch, Wish};
use super::super::deep_link::{Choice, target};
use super::super::handshake::{self, LOGIN_S};
use super::super::model::Platform;
use super::super::pages::{self, Language};
use super::super::refusal::{LtiError, Refusal};
use crate::api::Query;
use crate::classroom::give_out;
use crate::classroom::session::{Signed, begin, cookie, set_cookie};
use crate::error::Problem;
use crate::state::AppState;
use adaptarm_core::exercises::Exercise;
use axum::Form;
use axum::extract::State;
use axum::http::{HeaderMap, HeaderName, HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Response};
use jiff::{SignedDuration, Timestamp};
use serde::{Deserialize, Serialize};
use url::Url;
use uuid::Uuid;

/// For how long a ticket is good: to open the laboratory, and to choose an exercise.
const ENTER_WITHIN: SignedDuration = SignedDuration::from_mins(10);
const CHOOSE_WITHIN: SignedDuration = SignedDuration::from_hours(1);

/// Where the browser puts what it asked for.
const DESTINATION: HeaderName = HeaderName::from_static("sec-fetch-dest");

/// What a platform says when it begins a login (LTI security framework, 5.1.1.1).
#[derive(Debug, Deserialize)]
pub(super) struct Login {
    iss: String,
    #[serde(rename = "login_hint")]
    user_hint: String,
    target_link_uri: String,
    lti_message_hint: Option<String>,
    client_id: Option<String>,
    lti_deployment_id: Option<String>,
}

pub(super) async fn login_by_query(
    State(state): State<AppState>,
    headers: HeaderMap,
    Query(login): Query<Login>,
) -> Result<Response, Problem> {
    begin_login(&state, &headers, &login).await
}

pub(super) async fn login_by_form(
    State(state): State<AppState>,
    headers: HeaderMap,
    Form(login): Form<Login>,
) -> Result<Response, Problem> {
    begin_login(&state, &headers, &login).await
}

/// Sends the browser to the platform that is registered under that name, to ask for a launch.
async fn begin_login(state: &AppState, headers: &HeaderMap, login: &Login) -> Result<Response, Problem> {
    let tool = &state.lti;
    let platforms = tool.store.platforms().await.map_err(LtiError::from)?;
    let mut fitting = platforms.into_iter().filter(|platform| {
        platform.issuer == login.iss
            && login.client_id.as_ref().is_none_or(|client| *client == platform.client_id)
            && login.lti_deployment_id.as_ref().is_none_or(|deployment| platform.deployments.contains(deployment))
    });
    let platform = fitting.next().ok_or_else(|| {
        let issuer = crate::document::brief(&login.iss);
        let detail = format!("no platform \"{issuer}\" with the login's client_id and deployment is registered here");
        Refusal::new("platform", detail)
    })?;
    if fitting.next().is_some() {
        return Err(Refusal::new(
            "platform",
            "several such platforms are registered; the login must name its client_id",
        )
        .into());
    }
    let https = state.desk.is_https(headers);
    let begun =
        handshake::begin(tool.secret().await?, platform.id, &login.target_link_uri, Timestamp::now().as_second())
            .map_err(crate::routes::internal)?;
    let mut url = Url::parse(&platform.auth_url).map_err(crate::routes::internal)?;
    let redirect = target(&state.desk.base(headers));
    url.query_pairs_mut().extend_pairs([
        ("scope", "openid"),
        ("response_type", "id_token"),
        ("response_mode", "form_post"),
        ("prompt", "none"),
        ("client_id", platform.client_id.as_str()),
        ("redirect_uri", redirect.as_str()),
        ("state", begun.state.as_str()),
        ("nonce", begun.nonce.as_str()),
        ("login_hint", login.user_hint.as_str()),
    ]);
    if let Some(hint) = &login.lti_message_hint {
        url.query_pairs_mut().append_pair("lti_message_hint", hint);
    }
    let cookie = browser_cookie(https, &begun.cookie, &begun.browser, LOGIN_S);
    let location = HeaderValue::from_str(url.as_str()).map_err(crate::routes::internal)?;
    Ok((StatusCode::FOUND, [(header::LOCATION, location), (header::SET_COOKIE, cookie)]).into_response())
}

/// The login's cookie. Over https it may be sent from a frame, kept apart for each site that has one (CHIPS).
fn browser_cookie(https: bool, name: &str, value: &str, age_s: i64) -> HeaderValue {
    let rest = if https { "SameSite=None; Secure; Partitioned" } else { "SameSite=Lax" };
    let cookie = format!("{}={value}; Path=/; Max-Age={age_s}; HttpOnly; {rest}", cookie_name(https, name));
    // Hexadecimal digits and what stands above.
    HeaderValue::from_str(&cookie).unwrap_or(HeaderValue::from_static(""))
}

fn cookie_name(https: bool, name: &str) -> String {
    if https { format!("__Host-{name}") } else { name.to_owned() }
}

/// What the platform sends through the browser; an error in place of the token if it let nobody in.
#[derive(Debug, Deserialize)]
pub(super) struct Launched {
    state: String,
    id_token: Option<String>,
    error: Option<String>,
}

/// What a ticket into the classroom is good for.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Entry {
    person: Uuid,
    destination: String,
}

/// Lets in whoever has a good launch.
pub(super) async fn launch(
    State(state): State<AppState>,
    headers: HeaderMap,
    Form(launched): Form<Launched>,
) -> Result<Response, Problem> {
    let Some(token) = launched.id_token else {
        let said = crate::document::brief(launched.error.as_deref().unwrap_or("no id_token"));
        return Err(Refusal::new("token", format!("the platform let nobody in: {said}")).into());
    };
    let (tool, https, base) = (&state.lti, state.desk.is_https(&headers), state.desk.base(&headers));
    let browser = |name: &str| cookie(&headers, &cookie_name(https, name));
    let (platform, launch) = arrive::check(tool, &token, &launched.state, browser, &base).await?;
    let (person, context) = arrive(tool, &platform, &launch).await?;
    if let Wish::Choose(asked) = &launch.wish {
        let choice = Choice::new(tool, &platform, &launch.deployment, context.class, person, asked)?;
        return offer(&state, &headers, &platform, &choice).await;
    }
    let destination = destination(tool, &launch, person, &context).await?;
    let entry = Entry { person, destination };
    if is_framed(&headers) {
        return in_window(&state, &headers, &platform, &launch, &entry).await;
    }
    admit(&state, &headers, &entry, None).await
}

/// Whether the browser shows the answer inside another page.
fn is_framed(headers: &HeaderMap) -> bool {
    let framed = [&b"iframe"[..], b"frame", b"embed", b"object"];
    headers.get(DESTINATION).is_some_and(|destination| framed.contains(&destination.as_bytes()))
}

async fn in_window(
    state: &AppState,
    headers: &HeaderMap,
    platform: &Platform,
    launch: &Launch,
    entry: &Entry,
) -> Result<Response, Problem> {
    let ticket = ticket(&state.lti, entry, ENTER_WITHIN).await?;
    let frames = pages::origins(platform, launch.return_url.as_deref());
    Ok(pages::open(Language::of(headers), &frames, &ticket))
}

/// The exercises to choose from.
async fn offer(
    state: &AppState,
    headers: &HeaderMap,
    platform: &Platform,
    choice: &Choice,
) -> Result<Response, Problem> {
    let ticket = ticket(&state.lti, choice, CHOOSE_WITHIN).await?;
    let frames = pages::origins(platform, Some(&choice.return_url));
    let exercises =
        state.desk.library.iter().map(Exercise::document).map(|exercise| (exercise.id.as_str(), &exercise.title));
    Ok(pages::choose(Language::of(headers), &frames, &ticket, exercises))
}

/// Begins a session and goes where the link leads.
async fn admit(
    state: &AppState,
    headers: &HeaderMap,
    entry: &Entry,
    before: Option<&Signed>,
) -> Result<Response, Problem> {
    let person = state.desk.store.person(entry.person).await.map_err(LtiError::from)?;
    let person = person.ok_or_else(|| Refusal::new("ticket", "who was to come in here has been erased"))?;
    let signed = begin(state, &person, before).await?;
    let cookie = set_cookie(state.desk.is_https(headers), Some(&signed.secret));
    let location = HeaderValue::from_str(&entry.destination).map_err(crate::routes::internal)?;
    Ok((StatusCode::SEE_OTHER, [cookie, (header::LOCATION, location)]).into_response())
}

#[derive(Debug, Deserialize)]
pub(super) struct Enter {
    ticket: String,
}

/// Lets in whoever has a ticket; only our own pages can hand one in.
pub(super) async fn enter(
    State(state): State<AppState>,
    before: Option<Signed>,
    headers: HeaderMap,
    Form(Enter { ticket }): Form<Enter>,
) -> Result<Response, Problem> {
    let entry: Entry = redeem(&state.lti, &ticket).await?;
    admit(&state, &headers, &entry, before.as_ref()).await
}

#[derive(Debug, Deserialize)]
pub(super) struct Chosen {
    ticket: String,
    exercise: String,
}

/// Gives the chosen exercise out, and carries the answer back.
pub(super) async fn choose(
    State(state): State<AppState>,
    headers: HeaderMap,
    Form(Chosen { ticket, exercise }): Form<Chosen>,
) -> Result<Response, Problem> {
    let (tool, choice): (_, Choice) = (&state.lti, redeem(&state.lti, &ticket).await?);
    let platform = tool.store.platform(choice.platform).await.map_err(LtiError::from)?;
    let platform = platform.ok_or_else(|| Refusal::new("platform", "the platform is not registered here any more"))?;
    let assignment = give_out(&tool.desk, choice.class, choice.staff, &exercise).await?;
    let answer = choice.answer(tool, &platform, &assignment, &state.desk.base(&headers)).await?;
    let frames = pages::origins(&platform, Some(&choice.return_url));
    Ok(pages::carry(Language::of(&headers), &frames, &choice.return_url, &answer))
}
