//! From what jobs computed to grades: looks for attempts whose jobs have ended, and ends each of them once.
//!
//! A grade follows from stored reports alone, and is written only where there is none: any number of servers may look, and any
//! may die at any moment. Where a job failed, or its reports are gone, that was no fault of the gains: the attempt is given back.

use super::desk::Desk;
use super::model::{Attempt, Feedback};
use super::session::{IDLE, LONGEST};
use super::store::{Outcome, Ripe};
use super::{secrets, work};
use crate::jobs::{JobState, JobStore, StoreError};
use crate::receipts::{Nonce, Receipt, Statement};
use adaptarm_core::scenario::Report;
use jiff::Timestamp;
use serde_json::json;
use std::sync::Arc;
use std::time::Duration;
use tokio::sync::watch;
use tokio::task::spawn_blocking;
use tokio::time::timeout;

/// Time between two looks where nothing was found, and where the tables failed.
const LOOK_INTERVAL: Duration = Duration::from_millis(200);
const LOOK_AGAIN: Duration = Duration::from_secs(2);

/// Attempts graded between two looks.
const AT_A_TIME: i64 = 64;

/// Most reports of one attempt; exercises have fewer variants.
const REPORTS: i64 = 1000;

/// Grades until told to stop.
pub async fn grade(desk: Arc<Desk>, jobs: Arc<dyn JobStore>, mut stop: watch::Receiver<bool>) {
    loop {
        let pause = match look(&desk, &*jobs).await {
            Ok(0) => LOOK_INTERVAL,
            Ok(_) => Duration::ZERO,
            Err(error) => {
                tracing::warn!("cannot grade at the moment: {error}");
                LOOK_AGAIN
            }
        };
        if timeout(pause, stop.wait_for(|stop| *stop)).await.is_ok() {
            return;
        }
    }
}

/// Grades what is ripe; how many.
async fn look(desk: &Arc<Desk>, jobs: &dyn JobStore) -> Result<usize, StoreError> {
    let ripe = desk.store.ripe(AT_A_TIME).await?;
    for Ripe { attempt, job } in &ripe {
        let outcome = match job {
            Some((JobState::Succeeded, _)) => of_reports(desk, jobs, attempt).await?,
            Some((_, reason)) => Err(reason.clone().unwrap_or_else(|| "the job that grades it ended early".to_owned())),
            None => Err("the job that grades it is gone".to_owned()),
        };
        let outcome = outcome.unwrap_or_else(|reason| {
            tracing::error!(attempt = %attempt.id, "an attempt is given back: {reason}");
            // What failed is for the log; a student is told whose fault it was not.
            Outcome::Returned(
                "the server failed while grading; the attempt does not count, hand it in again".to_owned(),
            )
        });
        desk.store.finish(attempt.id, &outcome).await?;
    }
    Ok(ripe.len())
}

/// The grade of an attempt whose runs are computed, or why there is none.
async fn of_reports(
    desk: &Arc<Desk>,
    jobs: &dyn JobStore,
    attempt: &Attempt,
) -> Result<Result<Outcome, String>, StoreError> {
    let Some(assignment) = desk.store.assignment(attempt.assignment).await? else {
        return Ok(Err("its assignment is gone".to_owned()));
    };
    let mut reports = Vec::new();
    for row in jobs.scenarios(attempt.job, 0, REPORTS).await? {
        match row.report.as_deref().map(serde_json::from_str::<Report>) {
            Some(Ok(report)) => reports.push(report),
            Some(Err(error)) => return Ok(Err(format!("report {} cannot be read: {error}", row.n))),
            None => return Ok(Err(format!("report {} is gone", row.n))),
        }
    }
    let (desk, attempt) = (desk.clone(), attempt.clone());
    let graded = spawn_blocking(move || {
        let secret = &desk.secret;
        let exercise = work::exercise(&assignment)?;
        let gains = work::gains(&attempt.gains).ok_or("its gains cannot be read")?;
        let visibility = work::graded_on(&exercise);
        let seed = secrets::seed(secret, attempt.assignment, attempt.student, visibility);
        let grade = exercise.grade(&gains, seed, visibility, &reports).map_err(|error| error.to_string())?;
        let criteria = grade.public().criteria.iter().map(|criterion| json!(criterion)).collect();
        let feedback = json!(Feedback { score: grade.score, criteria }).to_string();
        let (now, nonce) = (Timestamp::now(), Nonce::try_from(secrets::nonce(secret, attempt.id))?);
        // To the microsecond, which is what the tables keep: all places tell the same time.
        let graded_at = Timestamp::from_microsecond(now.as_microsecond()).unwrap_or(now);
        let statement = Statement::new(attempt.id.to_string(), graded_at, gains, &grade, seed, &nonce);
        let receipt = json!(Receipt::sign(statement, &desk.key)).to_string();
        Ok(Outcome::Graded { feedback, grade: json!(grade).to_string(), receipt, graded_at })
    });
    Ok(graded.await.unwrap_or_else(|panic| Err(format!("grading failed: {panic}"))))
}

/// Forgets sessions that have ended.
pub async fn forget_sessions(desk: &Desk) -> Result<u64, StoreError> {
    let now = Timestamp::now();
    desk.store.forget_sessions(now - IDLE, now - LONGEST).await
}
