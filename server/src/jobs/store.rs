//! The seam between jobs and where they are kept.
//!
//! Every method may take as long as a database does. Writes are fenced by the job's state: what arrives for a job that
//! has reached a final state meanwhile changes nothing.

use super::{Job, Study, StudyResult};
use async_trait::async_trait;
use std::ops::ControlFlow;
use std::sync::Arc;
use thiserror::Error;
use uuid::Uuid;

/// Why a store did not do what it was asked.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum StoreError {
    /// As many jobs wait or run as may.
    #[error("{0} jobs are waiting or running already")]
    Full(usize),
}

/// Whether to go on with a job.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Order {
    /// Go on.
    Continue,
    /// Stop; what was computed is not wanted any more.
    Stop,
}

impl From<Order> for ControlFlow<()> {
    fn from(order: Order) -> Self {
        match order {
            Order::Continue => Self::Continue(()),
            Order::Stop => Self::Break(()),
        }
    }
}

/// How work on a job ended.
#[derive(Debug, Clone, PartialEq)]
pub enum Ending {
    /// With its whole result.
    Succeeded(StudyResult),
    /// Without one, for this reason.
    Failed(String),
}

/// Where jobs are kept.
#[async_trait]
pub trait JobStore: Send + Sync + 'static {
    /// Keeps a new job.
    async fn add(&self, job: Job, study: Arc<Study>) -> Result<(), StoreError>;

    /// The job with this identifier.
    async fn job(&self, id: Uuid) -> Result<Option<Job>, StoreError>;

    /// The result of a job that succeeded.
    async fn result(&self, id: Uuid) -> Result<Option<Arc<StudyResult>>, StoreError>;

    /// Takes a queued job for running; a running one runs on.
    async fn start(&self, id: Uuid) -> Result<Order, StoreError>;

    /// Notes the share done and asks whether to go on.
    async fn report_progress(&self, id: Uuid, progress: f64) -> Result<Order, StoreError>;

    /// Ends a running job.
    async fn finish(&self, id: Uuid, ending: Ending) -> Result<(), StoreError>;

    /// Cancels a job that has not ended, and gives it as it is then.
    async fn cancel(&self, id: Uuid) -> Result<Option<Job>, StoreError>;

    /// Jobs waiting or running.
    async fn unfinished(&self) -> Result<usize, StoreError>;
}
