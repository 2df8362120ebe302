//! The members of a course (LTI Names and Role Provisioning Services 2.0): those who attend it become students of the class.
//!
//! Nobody is removed: work that was handed in stays, until the teacher erases it.

use super::arrive::{name_or, person};
use super::claims::{Role, role};
use super::client::next_page;
use super::model::{Context, Enrolled, Member, Platform};
use super::refusal::LtiError;
use super::tool::Tool;
use crate::classroom::model::Role as ClassRole;
use crate::classroom::{STUDENTS, texts};
use crate::error::Problem;
use serde::Deserialize;
use serde_json::Value;
use url::Url;

/// Scope of reading lists of members.
pub const SCOPE: &str = "https://purl.imsglobal.org/spec/lti-nrps/scope/contextmembership.readonly";
const MEDIA_TYPE: &str = "application/vnd.ims.lti-nrps.v2.membershipcontainer+json";

/// Most pages of a list, and most members on all of them.
const PAGES: usize = 50;
const MEMBERS: usize = 5000;

#[derive(Debug, Deserialize)]
struct Listed {
    user_id: String,
    #[serde(default)]
    status: Option<String>,
    #[serde(default)]
    roles: Vec<String>,
    name: Option<String>,
    given_name: Option<String>,
    family_name: Option<String>,
    lis_person_sourcedid: Option<String>,
}

/// Fetches a course's list of members and takes it over.
pub async fn fetch(tool: &Tool, platform: &Platform, context: &Context) -> Result<Enrolled, Problem> {
    let first = context.members_url.clone().ok_or_else(|| {
        LtiError::Platform("the platform named no list of members; allow this tool names and roles there".to_owned())
    })?;
    let token = tool.token(platform, SCOPE).await?;
    let (mut members, mut next) = (Vec::new(), Some(first.clone()));
    for _ in 0..PAGES {
        let Some(url) = next.take() else { break };
        // The token is for the place that the launch named.
        if !same_origin(&url, &first) {
            return Err(LtiError::Platform("the list of members goes on elsewhere".to_owned()).into());
        }
        let answer = tool.caller.get(&url, MEDIA_TYPE, Some(&token)).await?;
        if answer.status == reqwest::StatusCode::UNAUTHORIZED {
            tool.access.forget(platform.id, SCOPE).await;
        }
        next = next_page(&answer.headers);
        let page = answer.success("the list of members")?;
        for member in page["members"].as_array().into_iter().flatten() {
            members.extend(student(member)?);
        }
        if members.len() > MEMBERS {
            return Err(LtiError::Platform(format!("the list of members has more than {MEMBERS}")).into());
        }
    }
    if next.is_some() {
        return Err(LtiError::Platform(format!("the list of members has more than {PAGES} pages")).into());
    }
    Ok(tool.store.enroll(context.id, &members, STUDENTS).await.map_err(LtiError::from)?)
}

/// A member who attends the course and has not left it.
fn student(member: &Value) -> Result<Option<Member>, Problem> {
    let Ok(listed) = Listed::deserialize(member) else { return Ok(None) };
    let active = listed.status.as_deref().is_none_or(|status| status == "Active");
    if !active || role(&listed.roles) != Some(Role::Student) || !(1..=255).contains(&listed.user_id.chars().count()) {
        return Ok(None);
    }
    let parts = [listed.given_name.as_deref(), listed.family_name.as_deref()];
    let joined = parts.into_iter().flatten().collect::<Vec<_>>().join(" ");
    let mut new = person(ClassRole::Student, name_or(listed.name.as_deref().unwrap_or(&joined), "Student"))?;
    let number = listed.lis_person_sourcedid;
    new.person.number = number.and_then(|number| texts::cell("", &number, texts::NUMBER_CHARS).ok());
    Ok(Some(Member { subject: listed.user_id, person: new }))
}

fn same_origin(one: &str, other: &str) -> bool {
    matches!((Url::parse(one), Url::parse(other)), (Ok(one), Ok(other)) if one.origin() == other.origin())
}
