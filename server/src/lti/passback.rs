//! Brings grades to platforms, in every process that serves: looks again and again which scores they should have, sends those
//! that changed, and tries again for as long as it takes.
//!
//! What is to be sent stands in the tables before it is sent, with its time. A process that dies between the platform's answer
//! and our note of it sends the score again, with the same time: the platform knows it by that.

use super::gradebook;
use super::model::{DueItem, DueScore, Score, StaleLink};
use super::refusal::LtiError;
use super::tool::Tool;
use crate::classroom::views;
use crate::classroom::work::Work;
use crate::webhooks::pause_after;
use futures_util::future::join_all;
use std::sync::Arc;
use std::time::Duration;
use tokio::sync::watch;
use tokio::time::timeout;

/// Pause between two looks.
const LOOK_EVERY: Duration = Duration::from_secs(1);

/// For how long a score or column is this process's to send: longer than a call may take.
const LEASE: Duration = Duration::from_mins(1);

/// Calls made at a time.
const AT_A_TIME: i64 = 8;

/// Failed attempts after which the pause does not grow any more.
const LAST_PAUSE: u32 = 7;

/// Passes grades back until told to stop.
pub async fn run(tool: Arc<Tool>, mut stop: watch::Receiver<bool>) {
    while !*stop.borrow() {
        if let Err(error) = round(&tool).await {
            tracing::warn!("passing grades back: {error:?}; trying again");
        }
        // Either way it is time to look again.
        let _ = timeout(LOOK_EVERY, stop.wait_for(|stop| *stop)).await;
    }
}

/// One look at everything, and what there is to do.
async fn round(tool: &Tool) -> Result<(), LtiError> {
    let items = tool.store.due_items(AT_A_TIME, LEASE).await?;
    for done in join_all(items.iter().map(|item| look_for_column(tool, item))).await {
        done?;
    }
    for stale in tool.store.stale_links().await? {
        plan(tool, &stale).await?;
    }
    loop {
        let scores = tool.store.due_scores(AT_A_TIME, LEASE).await?;
        if scores.is_empty() {
            return Ok(());
        }
        for done in join_all(scores.iter().map(|score| deliver(tool, score))).await {
            done?;
        }
    }
}

/// Notes what scores follow from an assignment's marks as they are now.
async fn plan(tool: &Tool, stale: &StaleLink) -> Result<(), LtiError> {
    let Some(assignment) = tool.desk.store.assignment(stale.link.assignment).await? else { return Ok(()) };
    let most = assignment.settings.points;
    let work = Work::load(&*tool.desk.store, assignment, None).await?;
    let score = |student| Score { student, points: work.of(student).mark().map(|mark| mark.points), most };
    let scores: Vec<_> = stale.students.iter().copied().map(score).collect();
    Ok(tool.store.plan_scores(stale, &scores).await?)
}

async fn look_for_column(tool: &Tool, item: &DueItem) -> Result<(), LtiError> {
    let Some(assignment) = tool.desk.store.assignment(item.assignment).await? else { return Ok(()) };
    let title = views::title(&assignment);
    let label = title["en"].as_str().unwrap_or(&assignment.exercise);
    match gradebook::column(tool, item, label, assignment.settings.points).await {
        Ok(line_item) => tool.store.item_found(item.id, &line_item).await?,
        Err(error) => {
            let (pause, why) = (pause(tool, item.tries), told(error)?);
            tracing::info!(link = %item.id, "no column in the gradebook yet: {why}");
            tool.store.item_failed(item.id, pause, &why).await?;
        }
    }
    Ok(())
}

async fn deliver(tool: &Tool, score: &DueScore) -> Result<(), LtiError> {
    match gradebook::send(tool, score).await {
        Ok(()) => tool.store.score_sent(score).await?,
        Err(error) => {
            let (pause, why) = (pause(tool, score.tries), told(error)?);
            tracing::info!(score = %score.id, "not delivered, to be tried again in {:.0} s: {why}", pause.as_secs_f64());
            tool.store.score_failed(score, pause, &why).await?;
        }
    }
    Ok(())
}

/// Longer and longer, up to what the settings say, but never given up.
fn pause(tool: &Tool, tries: u32) -> Duration {
    let attempt = tries.saturating_add(1).min(LAST_PAUSE);
    pause_after(attempt, tool.first_pause, None).unwrap_or(tool.longest_pause).min(tool.longest_pause)
}

/// Why the platform has not got it; our own failures are not told as the platform's.
fn told(error: LtiError) -> Result<String, LtiError> {
    match error {
        LtiError::Platform(why) => Ok(why),
        LtiError::Refused(refusal) => Ok(refusal.detail),
        LtiError::Store(_) | LtiError::Ours(_) => Err(error),
    }
}
