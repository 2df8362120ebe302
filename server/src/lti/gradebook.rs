//! A platform's gradebook (LTI Assignment and Grade Services 2.0): the column of a link, and scores in it.

use super::claims::{LINE_ITEM_SCOPE, SCORE_SCOPE};
use super::model::{DueItem, DueScore, Platform};
use super::refusal::LtiError;
use super::tool::Tool;
use reqwest::StatusCode;
use serde_json::{Value, json};
use url::Url;

const ITEM: &str = "application/vnd.ims.lis.v2.lineitem+json";
const ITEMS: &str = "application/vnd.ims.lis.v2.lineitemcontainer+json";
const SCORE: &str = "application/vnd.ims.lis.v1.score+json";

/// Longest title of a column, characters.
const LABEL_CHARS: usize = 120;

/// Finds a link's column, or makes it. One that an earlier attempt made without hearing of it is found again.
pub async fn column(tool: &Tool, item: &DueItem, label: &str, most: f64) -> Result<String, LtiError> {
    let token = tool.token(&item.platform, LINE_ITEM_SCOPE).await?;
    let assignment = item.assignment.to_string();
    let mut search = parse(&item.line_items_url)?;
    search.query_pairs_mut().append_pair("resource_link_id", &item.link).append_pair("limit", "100");
    let answer = tool.caller.get(search.as_str(), ITEMS, Some(&token)).await?;
    let found = check(tool, &item.platform, LINE_ITEM_SCOPE, answer, "looking for a column").await?;
    let own =
        |column: &&Value| column["resourceLinkId"] == item.link.as_str() && column["resourceId"] == assignment.as_str();
    let column = if let Some(column) = found.as_array().into_iter().flatten().find(own) {
        column.clone()
    } else {
        let label: String = label.chars().take(LABEL_CHARS).collect();
        let column = json!({
            "scoreMaximum": most, "label": label, "resourceId": assignment, "resourceLinkId": item.link, "tag": "grade",
        });
        let answer = tool.caller.post(&item.line_items_url, ITEM, &token, &column).await?;
        check(tool, &item.platform, LINE_ITEM_SCOPE, answer, "making a column").await?
    };
    let id =
        column["id"].as_str().ok_or_else(|| LtiError::Platform("the platform's column has no address".to_owned()))?;
    Ok(id.to_owned())
}

/// Sends a score. Sent again it is the same score: the platform knows it by its time.
pub async fn send(tool: &Tool, score: &DueScore) -> Result<(), LtiError> {
    let token = tool.token(&score.platform, SCORE_SCOPE).await?;
    let mut url = parse(&score.line_item)?;
    let path = format!("{}/scores", url.path().trim_end_matches('/'));
    url.set_path(&path);
    let at = score.at.strftime("%Y-%m-%dT%H:%M:%S%.3fZ").to_string();
    let mut body = json!({ "userId": score.subject, "timestamp": at });
    let more = match score.points {
        Some(points) => json!({
            "scoreGiven": points, "scoreMaximum": score.most, "activityProgress": "Completed", "gradingProgress": "FullyGraded",
        }),
        None => json!({ "activityProgress": "Initialized", "gradingProgress": "NotReady" }),
    };
    for (name, value) in more.as_object().into_iter().flatten() {
        body[name] = value.clone();
    }
    let answer = tool.caller.post(url.as_str(), SCORE, &token, &body).await?;
    // It has this score, or a later one.
    if answer.status == StatusCode::CONFLICT {
        return Ok(());
    }
    check(tool, &score.platform, SCORE_SCOPE, answer, "sending a score").await?;
    Ok(())
}

/// A success's body. A token that is not taken any more is forgotten.
async fn check(
    tool: &Tool,
    platform: &Platform,
    scope: &str,
    answer: super::client::Answer,
    what: &str,
) -> Result<Value, LtiError> {
    if answer.status == StatusCode::UNAUTHORIZED {
        tool.access.forget(platform.id, scope).await;
    }
    answer.success(what)
}

fn parse(url: &str) -> Result<Url, LtiError> {
    Url::parse(url).map_err(|error| LtiError::Platform(format!("the gradebook's address is wrong: {error}")))
}
