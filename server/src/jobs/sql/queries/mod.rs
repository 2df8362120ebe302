//! The statements, the same for every database; compiled once for each.

mod change;
mod claim;
mod experiment;
mod keep;
mod queue;
mod read;
mod submit;
mod tokens;
mod work;

use super::{
    Connection, Db, ONE_WRITER, Pool, QueueConfig, SWEEP, begin, now, one_at_a_time, push, storage, while_forgetting,
    while_submitting,
};
use crate::config::Limits;
use crate::jobs::sql::rows;
use crate::jobs::{
    Claim, Delivered, Event, ExperimentRow, Filter, Folded, Job, JobStore, MadeRuns, NewJob, Order, Pulse, ScenarioRow,
    StoreError, StoredResult, StoredToken, Submitted, Tick,
};
use async_trait::async_trait;
use jiff::Timestamp;
use std::sync::Arc;
use std::time::Duration;
use submit::{TOGETHER, Waiting};
use tokio::sync::{mpsc, oneshot, watch};
use uuid::Uuid;

/// Jobs in the tables of one database.
#[derive(Debug, Clone)]
pub(in crate::jobs::sql) struct SqlStore {
    write: Pool,
    read: Pool,
    /// Counts up when this process has pushed something into the queue.
    pushed: Arc<watch::Sender<u64>>,
    /// Where jobs wait to be accepted together, where there is one writer.
    submissions: Option<mpsc::Sender<Waiting>>,
}

impl SqlStore {
    /// Within a runtime, which goes on accepting jobs for as long as the store lives.
    pub(in crate::jobs::sql) fn new(write: Pool, read: Pool) -> Self {
        let submissions = ONE_WRITER.then(|| {
            let (submissions, waiting) = mpsc::channel(TOGETHER);
            tokio::spawn(submit::accept_together(write.clone(), waiting));
            submissions
        });
        Self { write, read, pushed: Arc::new(watch::Sender::new(0)), submissions }
    }

    fn ring(&self) {
        self.pushed.send_modify(|count| *count = count.wrapping_add(1));
    }
}

#[async_trait]
impl JobStore for SqlStore {
    async fn submit(&self, job: NewJob, limits: &Limits) -> Result<Submitted, StoreError> {
        let submitted = match &self.submissions {
            None => submit::submit(&self.write, &job, limits).await,
            Some(submissions) => {
                let (answer, answered) = oneshot::channel();
                let waiting = Waiting { job, limits: limits.clone(), answer };
                let gone = || StoreError::Queue("nobody accepts jobs any more".to_owned());
                submissions.send(waiting).await.map_err(|_| gone())?;
                answered.await.map_err(|_| gone())?
            }
        };
        self.ring();
        submitted
    }

    async fn job(&self, owner: &str, id: Uuid) -> Result<Option<Job>, StoreError> {
        read::job(&self.read, owner, id).await
    }

    async fn jobs(&self, owner: &str, filter: &Filter, limit: i64) -> Result<Vec<Job>, StoreError> {
        read::jobs(&self.read, owner, filter, limit).await
    }

    async fn cancel(&self, owner: &str, id: Uuid) -> Result<Option<Job>, StoreError> {
        work::cancel(&self.write, owner, id).await?;
        self.ring();
        read::job(&self.write, owner, id).await
    }

    async fn delete(&self, owner: &str, id: Uuid) -> Result<bool, StoreError> {
        keep::delete(&self.write, owner, id).await
    }

    async fn scenarios(&self, id: Uuid, from: i64, limit: i64) -> Result<Vec<ScenarioRow>, StoreError> {
        read::scenarios(&self.read, id, from, limit).await
    }

    async fn scenario(&self, id: Uuid, n: i64) -> Result<Option<(ScenarioRow, String)>, StoreError> {
        read::scenario(&self.read, id, n).await
    }

    async fn events(&self, id: Uuid, after: i64, limit: i64) -> Result<Vec<Event>, StoreError> {
        read::events(&self.read, id, after, limit).await
    }

    async fn pulses(&self, ids: &[Uuid]) -> Result<Vec<Pulse>, StoreError> {
        read::pulses(&self.read, ids).await
    }

    async fn unfinished(&self) -> Result<[i64; 2], StoreError> {
        read::unfinished(&self.read).await
    }

    async fn claim(&self, worker: &str, lease: Duration) -> Result<Option<Claim>, StoreError> {
        claim::claim(&self.write, worker, lease).await
    }

    async fn tick(&self, claim: &Claim, tick: Tick, lease: Duration, limits: &Limits) -> Result<Order, StoreError> {
        work::tick(&self.write, claim, tick, lease, limits).await
    }

    async fn deliver(
        &self,
        claim: &Claim,
        result: &StoredResult,
        counted: i64,
        computed: Duration,
    ) -> Result<Delivered, StoreError> {
        let delivered = work::deliver(&self.write, claim, result, counted, computed).await?;
        if delivered.ended.is_some() {
            self.ring();
        }
        Ok(delivered)
    }

    async fn deliver_runs(
        &self,
        claim: &Claim,
        made: &MadeRuns,
        counted: i64,
        computed: Duration,
    ) -> Result<Delivered, StoreError> {
        let delivered = experiment::deliver_runs(&self.write, claim, made, counted, computed).await?;
        self.ring();
        Ok(delivered)
    }

    async fn deliver_fold(&self, claim: &Claim, folded: &Folded, computed: Duration) -> Result<Delivered, StoreError> {
        let delivered = experiment::deliver_fold(&self.write, claim, folded, computed).await?;
        self.ring();
        Ok(delivered)
    }

    async fn experiment(&self, id: Uuid) -> Result<Option<ExperimentRow>, StoreError> {
        experiment::find(&self.read, id).await
    }

    async fn packed_rows(&self, id: Uuid, step: i64, from: i64, limit: i64) -> Result<Vec<(i64, Vec<u8>)>, StoreError> {
        experiment::packed_rows(&self.read, id, step, from, limit).await
    }

    async fn release(&self, claim: &Claim) -> Result<(), StoreError> {
        work::release(&self.write, claim).await?;
        self.ring();
        Ok(())
    }

    async fn fail(&self, claim: &Claim, reason: &str) -> Result<(), StoreError> {
        work::fail(&self.write, claim, reason).await?;
        self.ring();
        Ok(())
    }

    async fn bury_all(&self) -> Result<u64, StoreError> {
        claim::bury_all(&self.write).await
    }

    async fn forget_jobs(&self, before: Timestamp) -> Result<u64, StoreError> {
        keep::forget_jobs(&self.write, before).await
    }

    async fn unused_results(&self, before: Timestamp, limit: i64) -> Result<Vec<(String, String)>, StoreError> {
        keep::unused_results(&self.read, before, limit).await
    }

    async fn forget_unused_result(&self, hash: &str, core_version: &str) -> Result<bool, StoreError> {
        keep::forget_unused_result(&self.write, hash, core_version).await
    }

    async fn forget_lost_result(&self, hash: &str, core_version: &str) -> Result<(), StoreError> {
        keep::forget_lost_result(&self.write, hash, core_version).await
    }

    async fn has_shard(&self, job: Uuid, shard: i64) -> Result<bool, StoreError> {
        keep::has_shard(&self.read, job, shard).await
    }

    async fn add_token(&self, token: &StoredToken) -> Result<(), StoreError> {
        tokens::add(&self.write, token).await
    }

    async fn token(&self, id: &str) -> Result<Option<StoredToken>, StoreError> {
        tokens::find(&self.read, id).await
    }

    async fn tokens(&self) -> Result<Vec<StoredToken>, StoreError> {
        tokens::all(&self.read).await
    }

    async fn revoke_token(&self, id: &str) -> Result<bool, StoreError> {
        tokens::revoke(&self.write, id).await
    }

    async fn touch_token(&self, id: &str) -> Result<(), StoreError> {
        tokens::touch(&self.write, id).await
    }
}
