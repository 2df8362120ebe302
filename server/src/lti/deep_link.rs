//! Choosing an exercise from within the platform (LTI Deep Linking 2.0): the answer is a token of ours that the browser posts.

use super::claims::Choosing;
use super::model::Platform;
use super::refusal::{LtiError, Refusal};
use super::tool::Tool;
use crate::classroom::model::Assignment;
use crate::classroom::{secrets, views};
use anyhow::Context as _;
use jiff::Timestamp;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use url::Url;
use uuid::Uuid;

/// For how long the answer is good, s.
const ANSWER_S: i64 = 300;

/// What a page on which an exercise is chosen is good for.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Choice {
    /// Whose course it is.
    pub platform: Uuid,
    /// From which deployment.
    pub deployment: String,
    /// For which class.
    pub class: Uuid,
    /// Who has it.
    pub staff: Uuid,
    /// Where the answer goes.
    pub return_url: String,
    /// Comes back with it.
    pub data: Option<String>,
}

impl Choice {
    /// For what a launch asked for; the place where the answer goes must be one to which a browser may carry it.
    pub fn new(
        tool: &Tool,
        platform: &Platform,
        deployment: &str,
        class: Uuid,
        staff: Uuid,
        asked: &Choosing,
    ) -> Result<Self, LtiError> {
        let url = tool.caller.check(&asked.deep_link_return_url);
        url.map_err(|problem| Refusal::new("return_url", format!("the place for the answer {problem}")))?;
        let (deployment, return_url) = (deployment.to_owned(), asked.deep_link_return_url.clone());
        Ok(Self { platform: platform.id, deployment, class, staff, return_url, data: asked.data.clone() })
    }

    /// The answer: a link to this assignment, with a column in the gradebook.
    pub async fn answer(
        &self,
        tool: &Tool,
        platform: &Platform,
        assignment: &Assignment,
        base: &str,
    ) -> Result<String, LtiError> {
        let title = views::title(assignment);
        let title = title["en"].as_str().unwrap_or(&assignment.exercise);
        let content = json!([{
            "type": "ltiResourceLink",
            "title": title,
            "url": target(base),
            "custom": { "assignment": assignment.id },
            "lineItem": { "scoreMaximum": assignment.settings.points, "label": title, "resourceId": assignment.id },
            // Canvas and others show the link in a window of its own then: docs/lti.md.
            "window": { "targetName": "_blank" },
        }]);
        let now_s = Timestamp::now().as_second();
        let nonce = secrets::fresh().context("the system gives no random numbers")?;
        let mut claims = json!({
            "iss": platform.client_id,
            "aud": platform.issuer,
            "iat": now_s,
            "exp": now_s + ANSWER_S,
            "nonce": nonce,
            "https://purl.imsglobal.org/spec/lti/claim/deployment_id": self.deployment,
            "https://purl.imsglobal.org/spec/lti/claim/message_type": "LtiDeepLinkingResponse",
            "https://purl.imsglobal.org/spec/lti/claim/version": "1.3.0",
            "https://purl.imsglobal.org/spec/lti-dl/claim/content_items": content,
        });
        if let Some(data) = &self.data {
            claims["https://purl.imsglobal.org/spec/lti-dl/claim/data"] = Value::from(data.clone());
        }
        Ok(tool.key().await?.sign(&claims)?)
    }
}

/// Where launches go.
pub fn target(base: &str) -> String {
    format!("{base}/lti/launch")
}

/// The origin of an address, for a policy of the browser.
pub fn origin(url: &str) -> Option<String> {
    let origin = Url::parse(url).ok()?.origin();
    origin.is_tuple().then(|| origin.ascii_serialization())
}
