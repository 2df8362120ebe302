//! Forgetting what nobody needs any more: old jobs, results without a job, checkpoints of shards that are done.

use super::{JobStore, Queue};
use crate::config::Retention;
use crate::results::Results;
use jiff::{SignedDuration, Timestamp};

/// Results removed between two looks at the tables.
const BATCH: i64 = 500;

/// What was forgotten.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Forgotten {
    /// Jobs.
    pub jobs: u64,
    /// Results, with their samples.
    pub results: u64,
    /// Checkpoints.
    pub checkpoints: u64,
}

/// Forgets what is older than it should become.
pub async fn collect_garbage(
    store: &dyn JobStore,
    queue: &dyn Queue,
    results: &Results,
    retention: &Retention,
) -> anyhow::Result<Forgotten> {
    let mut forgotten =
        Forgotten { jobs: store.forget_jobs(days_ago(retention.finished_jobs_days)).await?, ..Forgotten::default() };
    let before = days_ago(retention.results_days);
    loop {
        let (unused, already) = (store.unused_results(before, BATCH).await?, forgotten.results);
        for (hash, core_version) in &unused {
            // First the row: a row without samples would promise what is not there. A job may have come for it meanwhile.
            if store.forget_unused_result(hash, core_version).await? {
                results.remove(hash, core_version, before).await?;
                forgotten.results += 1;
            }
        }
        if forgotten.results == already {
            break;
        }
    }
    for (job, shard) in results.checkpoints().await? {
        if !store.has_shard(job, shard).await? {
            results.discard(job, shard).await?;
            forgotten.checkpoints += 1;
        }
    }
    queue.sweep().await?;
    Ok(forgotten)
}

fn days_ago(days: u32) -> Timestamp {
    let now = Timestamp::now();
    // Further back than time goes, nothing is that old.
    now.checked_sub(SignedDuration::from_hours(24 * i64::from(days))).unwrap_or(Timestamp::MIN)
}
