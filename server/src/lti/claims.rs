//! What a launch says, and whether it may: LTI 1.3 Core, sections 5.3 and 5.4; LTI security framework, section 5.1.3.
//!
//! Signature, issuer, audience and expiry have been checked by then ([`super::jwt`]); the rest is checked here.

use super::handshake::State;
use super::jwt::LEEWAY_S;
use super::model::Platform;
use super::refusal::Refusal;
use crate::classroom::secrets::equal;
use crate::document::brief;
use serde::Deserialize;
use serde_json::{Map, Value};
use url::Url;

/// Longest name that a platform may have for something of its own; LTI allows 255.
const NAME_CHARS: usize = 255;

/// Oldest launch that is taken, whatever its expiry says, s.
const OLDEST_S: f64 = 3600.0;

/// Prefix of the roles that someone has in a course. Those in the institution say nothing about the course.
const ROLES: &str = "http://purl.imsglobal.org/vocab/lis/v2/membership";

/// Scope of making columns in a gradebook.
pub const LINE_ITEM_SCOPE: &str = "https://purl.imsglobal.org/spec/lti-ags/scope/lineitem";
/// Scope of sending scores.
pub const SCORE_SCOPE: &str = "https://purl.imsglobal.org/spec/lti-ags/scope/score";

/// What someone is in a course.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// Teaches it.
    Teacher,
    /// Attends it.
    Student,
}

/// One or several texts.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(untagged)]
enum OneOrMore {
    One(String),
    More(Vec<String>),
}

#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
struct ContextClaim {
    id: String,
    title: Option<String>,
}

#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
struct LinkClaim {
    id: String,
}

#[derive(Debug, Clone, PartialEq, Eq, Default, Deserialize)]
struct Presentation {
    return_url: Option<String>,
}

#[derive(Debug, Clone, PartialEq, Eq, Default, Deserialize)]
struct Members {
    context_memberships_url: Option<String>,
}

/// The course's gradebook (LTI AGS 2.0, 3.1).
#[derive(Debug, Clone, PartialEq, Eq, Default, Deserialize)]
pub struct Gradebook {
    #[serde(default)]
    scope: Vec<String>,
    lineitems: Option<String>,
    lineitem: Option<String>,
}

/// Where the choice of content goes (LTI Deep Linking 2.0, 4.4.1).
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
pub struct Choosing {
    /// Where the answer is posted to.
    pub deep_link_return_url: String,
    /// Kinds of content that may be chosen.
    pub accept_types: Vec<String>,
    /// Comes back with the answer.
    pub data: Option<String>,
}

/// A launch's claims, those that count here.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Claims {
    sub: Option<String>,
    aud: OneOrMore,
    azp: Option<String>,
    iat: Option<f64>,
    nonce: Option<String>,
    name: Option<String>,
    given_name: Option<String>,
    family_name: Option<String>,
    #[serde(rename = "https://purl.imsglobal.org/spec/lti/claim/message_type")]
    message_type: Option<String>,
    #[serde(rename = "https://purl.imsglobal.org/spec/lti/claim/version")]
    version: Option<String>,
    #[serde(rename = "https://purl.imsglobal.org/spec/lti/claim/deployment_id")]
    deployment: Option<String>,
    #[serde(rename = "https://purl.imsglobal.org/spec/lti/claim/target_link_uri")]
    target: Option<String>,
    #[serde(default, rename = "https://purl.imsglobal.org/spec/lti/claim/roles")]
    roles: Vec<String>,
    #[serde(rename = "https://purl.imsglobal.org/spec/lti/claim/context")]
    context: Option<ContextClaim>,
    #[serde(rename = "https://purl.imsglobal.org/spec/lti/claim/resource_link")]
    link: Option<LinkClaim>,
    #[serde(default, rename = "https://purl.imsglobal.org/spec/lti/claim/custom")]
    custom: Option<Map<String, Value>>,
    #[serde(default, rename = "https://purl.imsglobal.org/spec/lti/claim/launch_presentation")]
    presentation: Option<Presentation>,
    #[serde(default, rename = "https://purl.imsglobal.org/spec/lti-nrps/claim/namesroleservice")]
    members: Option<Members>,
    #[serde(default, rename = "https://purl.imsglobal.org/spec/lti-ags/claim/endpoint")]
    gradebook: Option<Gradebook>,
    #[serde(rename = "https://purl.imsglobal.org/spec/lti-dl/claim/deep_linking_settings")]
    choosing: Option<Choosing>,
}

/// What the user wants.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Wish {
    /// To follow a link in a course.
    Open {
        /// The platform's name for the link.
        link: String,
        /// What was said about it when it was made.
        assignment: Option<String>,
        /// Or which exercise it is for.
        exercise: Option<String>,
    },
    /// To choose what a link is to lead to.
    Choose(Choosing),
}

/// A launch that may be followed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Launch {
    /// The platform's user.
    pub subject: String,
    /// What they are called, if the platform tells.
    pub name: Option<String>,
    /// What they are in the course.
    pub role: Role,
    /// From which deployment.
    pub deployment: String,
    /// The course.
    pub context: String,
    /// What the course is called.
    pub title: Option<String>,
    /// What they want.
    pub wish: Wish,
    /// Where members are listed.
    pub members_url: Option<String>,
    /// Where the gradebook's columns are, if we may make one.
    pub line_items_url: Option<String>,
    /// The link's own column.
    pub line_item: Option<String>,
    /// Where users go when they are done: tells the platform's address as browsers know it.
    pub return_url: Option<String>,
}

impl Claims {
    /// The launch, if all of it is as it must be. `base` is this server as browsers reach it.
    pub fn check(
        self,
        platform: &Platform,
        state: &State,
        nonce: &str,
        base: &str,
        now_s: i64,
    ) -> Result<Launch, Refusal> {
        self.check_time_and_audience(platform, now_s)?;
        let deployment = self.check_origin(platform, state, nonce, base)?;
        let subject = named(self.sub.as_deref(), "sub")?;
        let role = role(&self.roles).ok_or_else(|| {
            Refusal::new("role", "only those who teach or attend a course come in; the launch names no such role")
        })?;
        let context =
            self.context.as_ref().ok_or_else(|| Refusal::new("context", "the launch comes from no course"))?;
        let (context, title) = (named(Some(&context.id), "context.id")?, context.title.clone());
        let gradebook = self.gradebook.clone().unwrap_or_default();
        let may = |scope: &str| gradebook.scope.iter().any(|own| own == scope);
        Ok(Launch {
            name: self.full_name(),
            wish: self.wish(role)?,
            members_url: self.members.and_then(|members| members.context_memberships_url),
            line_items_url: gradebook.lineitems.clone().filter(|_| may(LINE_ITEM_SCOPE) && may(SCORE_SCOPE)),
            line_item: gradebook.lineitem.clone().filter(|_| may(SCORE_SCOPE)),
            return_url: self.presentation.and_then(|presentation| presentation.return_url),
            subject,
            role,
            deployment,
            context,
            title,
        })
    }

    /// Whether it answers the login that was begun, from a deployment that is let in and for a link of ours; the deployment.
    fn check_origin(&self, platform: &Platform, state: &State, nonce: &str, base: &str) -> Result<String, Refusal> {
        if !self.nonce.as_deref().is_some_and(|own| equal(own, nonce)) {
            return Err(Refusal::new("nonce", "the launch answers another login"));
        }
        if self.version.as_deref() != Some("1.3.0") {
            let found = said(self.version.as_deref());
            return Err(Refusal::new("version", format!("the launch speaks LTI {found}; 1.3.0 is spoken here")));
        }
        let deployment = named(self.deployment.as_deref(), "deployment_id")?;
        if !platform.deployments.contains(&deployment) {
            let found = said(Some(&deployment));
            return Err(Refusal::new("deployment", format!("the deployment {found} is not registered here")));
        }
        let target = self.target.as_deref().ok_or_else(|| Refusal::new("target", "the launch has no target link"))?;
        if !is_ours(target, base) || !state.is_for(target) {
            return Err(Refusal::new(
                "target",
                "the target link is another tool's, or not the one that the login named",
            ));
        }
        Ok(deployment)
    }

    fn check_time_and_audience(&self, platform: &Platform, now_s: i64) -> Result<(), Refusal> {
        let age_s = now_s as f64 - self.iat.ok_or_else(|| Refusal::new("claim", "the launch says no \"iat\""))?;
        // Not a number is neither.
        if !(-(LEEWAY_S as f64)..=OLDEST_S).contains(&age_s) {
            let detail =
                format!("the launch is {age_s} s old, and not -{LEEWAY_S} to {OLDEST_S} s; do the clocks agree?");
            return Err(Refusal::new("time", detail));
        }
        let several = matches!(&self.aud, OneOrMore::More(names) if names.len() > 1);
        let party = self.azp.as_ref();
        if party.map_or(several, |party| *party != platform.client_id) {
            return Err(Refusal::new("audience", "the launch is meant for another tool"));
        }
        Ok(())
    }

    fn wish(&self, role: Role) -> Result<Wish, Refusal> {
        match (self.message_type.as_deref(), role) {
            (Some("LtiResourceLinkRequest"), _) => {
                let link = self.link.as_ref().map(|link| link.id.as_str());
                let custom = |name: &str| self.custom.as_ref()?.get(name)?.as_str().map(str::to_owned);
                Ok(Wish::Open {
                    link: named(link, "resource_link.id")?,
                    assignment: custom("assignment"),
                    exercise: custom("exercise"),
                })
            }
            (Some("LtiDeepLinkingRequest"), Role::Student) => {
                Err(Refusal::new("role", "only those who teach a course choose what is in it"))
            }
            (Some("LtiDeepLinkingRequest"), Role::Teacher) => {
                let settings =
                    self.choosing.clone().ok_or_else(|| Refusal::new("claim", "there is nothing to choose for"))?;
                if !settings.accept_types.iter().any(|kind| kind == "ltiResourceLink") {
                    return Err(Refusal::new("accept_types", "the platform takes no links to tools here"));
                }
                Ok(Wish::Choose(settings))
            }
            (other, _) => {
                let (found, known) = (said(other), "LtiResourceLinkRequest and LtiDeepLinkingRequest");
                Err(Refusal::new("message_type", format!("the message is of the type {found}; {known} are known here")))
            }
        }
    }

    fn full_name(&self) -> Option<String> {
        let parts = [self.given_name.as_deref(), self.family_name.as_deref()];
        let joined = parts.into_iter().flatten().collect::<Vec<_>>().join(" ");
        self.name.clone().or_else(|| (!joined.is_empty()).then_some(joined))
    }
}

/// What someone is in a course, by the roles that are named; who both teaches and attends it, teaches.
pub fn role(roles: &[String]) -> Option<Role> {
    let is = |role: &str| {
        roles.iter().any(|own| {
            // `membership#Instructor`, and `membership/Instructor#TeachingAssistant` and its like; in lists of members,
            // `Instructor` alone.
            let own = own.strip_prefix(ROLES).unwrap_or(own);
            own == role
                || own.strip_prefix('#') == Some(role)
                || own.strip_prefix('/').and_then(|own| own.split_once('#')).is_some_and(|(own, _)| own == role)
        })
    };
    if is("Instructor") {
        Some(Role::Teacher)
    } else if is("Learner") {
        Some(Role::Student)
    } else {
        None
    }
}

/// Whether a link leads to the launches of this server.
fn is_ours(target: &str, base: &str) -> bool {
    let (Ok(target), Ok(base)) = (Url::parse(target), Url::parse(base)) else { return false };
    let own = base.path().trim_end_matches('/');
    target.origin() == base.origin() && target.path().strip_prefix(own) == Some("/lti/launch")
}

/// What a launch says, as a refusal repeats it.
fn said(text: Option<&str>) -> String {
    text.map_or_else(|| "null".to_owned(), |text| format!("\"{}\"", brief(text)))
}

/// A platform's name for something of its own.
fn named(name: Option<&str>, what: &str) -> Result<String, Refusal> {
    match name {
        Some(name) if (1..=NAME_CHARS).contains(&name.chars().count()) => Ok(name.to_owned()),
        _ => Err(Refusal::new("claim", format!("the launch says no {what:?} of 1 to {NAME_CHARS} characters"))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roles_are_those_in_the_course() {
        let of = |names: &[&str]| role(&names.iter().map(|name| (*name).to_owned()).collect::<Vec<_>>());
        let in_course = |name: &str| format!("{ROLES}{name}");
        let institution = "http://purl.imsglobal.org/vocab/lis/v2/institution/person#Instructor";
        assert_eq!(of(&[institution]), None);
        assert_eq!(of(&[institution, &in_course("#Learner")]), Some(Role::Student));
        assert_eq!(of(&[&in_course("#Learner"), &in_course("#Instructor")]), Some(Role::Teacher));
        assert_eq!(of(&[&in_course("/Instructor#TeachingAssistant")]), Some(Role::Teacher));
        assert_eq!(of(&["Learner"]), Some(Role::Student));
        for none in ["", "#Mentor", "/Mentor#Learner", "#Instructors"] {
            assert_eq!(of(&[&in_course(none)]), None, "{none}");
        }
    }

    #[test]
    fn a_target_is_ours_by_origin_and_path() {
        for (target, base, ours) in [
            ("https://a.org/lti/launch", "https://a.org", true),
            ("https://a.org/lti/launch?x=1", "https://a.org", true),
            ("https://a.org:443/lti/launch", "https://a.org/", true),
            ("https://a.org/lab/lti/launch", "https://a.org/lab/", true),
            ("https://a.org/lti/launch", "https://a.org/lab", false),
            ("http://a.org/lti/launch", "https://a.org", false),
            ("https://a.org.evil.org/lti/launch", "https://a.org", false),
            ("https://a.org@evil.org/lti/launch", "https://a.org", false),
            ("https://a.org/lti/launch/x", "https://a.org", false),
            ("/lti/launch", "https://a.org", false),
        ] {
            assert_eq!(is_ours(target, base), ours, "{target} {base}");
        }
    }
}
