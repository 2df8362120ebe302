//! From a launch to a person in a class, and to the place in the classroom that the link leads to.

use super::claims::{Claims, Launch, Role, Wish};
use super::handshake::{LOGIN_S, State};
use super::jwt;
use super::model::{Arrival, Arrived, Context, Platform};
use super::refusal::{LtiError, Refusal};
use super::tool::Tool;
use crate::classroom::model::{Class, NewPerson, Role as ClassRole};
use crate::classroom::{STUDENTS, give_out, new_person, secrets, texts};
use crate::error::Problem;
use anyhow::Context as _;
use jiff::{SignedDuration, Timestamp};
use uuid::Uuid;

/// What someone is called whose platform does not tell, or whose name would not go into a gradebook.
const NAMELESS: &str = "Student";
const TITLELESS: &str = "Course";

/// Checks a launch: signature, times, names, and that this browser asked for it, once.
pub async fn check(
    tool: &Tool,
    token: &str,
    state: &str,
    browser: impl FnOnce(&str) -> Option<String>,
    base: &str,
) -> Result<(Platform, Launch), LtiError> {
    let state = State::parse(state).ok_or_else(|| Refusal::new("state", "the launch belongs to no login"))?;
    let (secret, now) = (tool.secret().await?, Timestamp::now());
    state.check(secret, browser(&state.cookie()).as_deref(), now.as_second())?;
    let platform = tool.store.platform(state.platform).await?;
    let platform = platform.ok_or_else(|| Refusal::new("platform", "the platform is not registered here any more"))?;
    let key = tool.platform_keys.key(&tool.caller, &platform, &jwt::kid(token)?).await?;
    let claims: Claims = jwt::verify(token, &key, &platform.issuer, &platform.client_id)?;
    let nonce = state.nonce(secret);
    let launch = claims.check(&platform, &state, &nonce, base, now.as_second())?;
    // After that long the state itself is too old.
    let expires_at = now + SignedDuration::from_secs(2 * LOGIN_S);
    if !tool.store.use_nonce(&nonce, expires_at).await? {
        return Err(Refusal::new("replay", "this launch was used already; open the link again").into());
    }
    Ok((platform, launch))
}

/// Finds or makes the person and the class of a launch.
pub async fn arrive(tool: &Tool, platform: &Platform, launch: &Launch) -> Result<(Uuid, Context), Problem> {
    let called = launch.name.as_deref().unwrap_or_default();
    let title = name_or(launch.title.as_deref().unwrap_or_default(), TITLELESS);
    let staff = person(ClassRole::Teacher, title.clone())?;
    let code = secrets::code().map_err(crate::routes::internal)?;
    let arrival = Arrival {
        platform: platform.id,
        deployment: launch.deployment.clone(),
        context: launch.context.clone(),
        role: launch.role,
        subject: launch.subject.clone(),
        student: person(ClassRole::Student, name_or(called, NAMELESS))?,
        class: Class {
            id: Uuid::now_v7(),
            teacher: staff.person.id,
            name: title,
            code,
            // Who is in the course comes by the platform; the teacher can open the code, too.
            joining: false,
            created_at: Timestamp::now(),
        },
        staff,
        members_url: launch.members_url.clone(),
        line_items_url: launch.line_items_url.clone(),
    };
    match tool.store.arrive(&arrival, STUDENTS).await.map_err(LtiError::from)? {
        Arrived::In { person, context } => Ok((person, context)),
        Arrived::Full => Err(crate::classroom::problems::full("students", STUDENTS)),
    }
}

/// Someone new of this name. Nobody knows their key: they come by the platform, until a new one is made for them.
pub fn person(role: ClassRole, name: String) -> Result<NewPerson, Problem> {
    let login = secrets::code().map_err(crate::routes::internal)?;
    Ok(new_person(role, name, login, None)?.0)
}

/// A name as platforms have it, if it can stand in a gradebook.
pub fn name_or(name: &str, otherwise: &str) -> String {
    texts::cell("", name, texts::NAME_CHARS).unwrap_or_else(|_| otherwise.to_owned())
}

/// Where a link leads: the classroom's page, and in it the assignment or the class.
pub async fn destination(tool: &Tool, launch: &Launch, staff: Uuid, context: &Context) -> Result<String, Problem> {
    let Wish::Open { link, assignment, exercise } = &launch.wish else {
        return Err(crate::routes::internal("only links lead somewhere"));
    };
    let found = match tool.store.link(context.id, link).await.map_err(LtiError::from)? {
        Some(known) => Some(known.assignment),
        None => named(tool, assignment.as_deref(), context).await?,
    };
    let found = match (found, exercise, launch.role) {
        (None, Some(exercise), Role::Teacher) => Some(give_out(&tool.desk, context.class, staff, exercise).await?.id),
        (found, ..) => found,
    };
    let Some(found) = found else {
        return match launch.role {
            Role::Teacher => Ok(format!("/teach.html#class/{}", context.class)),
            Role::Student => {
                let detail =
                    "this link leads to no exercise yet; your teacher must open it once, or choose an exercise for it";
                Err(Refusal::new("link", detail).into())
            }
        };
    };
    let line_item = launch.line_item.as_deref();
    tool.store.set_link(context.id, link, found, line_item).await.map_err(LtiError::from)?;
    Ok(match launch.role {
        Role::Teacher => format!("/teach.html#assignment/{found}"),
        Role::Student => format!("/learn.html#{found}"),
    })
}

/// The assignment that was named when the link was made, if it is one of this course.
async fn named(tool: &Tool, assignment: Option<&str>, context: &Context) -> Result<Option<Uuid>, Problem> {
    let Some(id) = assignment.and_then(|id| id.parse().ok()) else { return Ok(None) };
    let found = tool.desk.store.assignment(id).await.map_err(LtiError::from)?;
    Ok(found.filter(|assignment| assignment.class == context.class).map(|assignment| assignment.id))
}

/// Keeps what a page of ours is to hand in once; the ticket to hand in.
pub async fn ticket(tool: &Tool, data: &impl serde::Serialize, good_for: SignedDuration) -> Result<String, LtiError> {
    let ticket = secrets::fresh().context("the system gives no random numbers")?;
    let data = serde_json::to_string(data).context("a ticket")?;
    tool.store.keep_ticket(&secrets::hash(&ticket), &data, Timestamp::now() + good_for).await?;
    Ok(ticket)
}

/// What a ticket is good for.
pub async fn redeem<T: serde::de::DeserializeOwned>(tool: &Tool, ticket: &str) -> Result<T, LtiError> {
    let data = tool.store.take_ticket(&secrets::hash(ticket)).await?;
    let used = || Refusal::new("ticket", "this page was used already or is too old; open the link again");
    // A ticket for something else is none.
    data.and_then(|data| serde_json::from_str(&data).ok()).ok_or_else(|| used().into())
}
