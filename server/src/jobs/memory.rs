//! Jobs kept in memory: bounded, and gone with the process.

use super::{Ending, Job, JobState, JobStore, Order, StoreError, Study, StudyResult};
use crate::config::Capacity;
use async_trait::async_trait;
use jiff::Timestamp;
use std::collections::{HashMap, VecDeque};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use uuid::Uuid;

/// A store in memory.
#[derive(Debug)]
pub struct MemoryStore {
    capacity: Capacity,
    jobs: Mutex<Jobs>,
}

#[derive(Debug, Default)]
struct Jobs {
    entries: HashMap<Uuid, Entry>,
    /// Oldest first.
    finished: VecDeque<Uuid>,
    /// Finished jobs that still have recordings, oldest first, and what these take.
    recorded: VecDeque<(Uuid, usize)>,
    recording_bytes: usize,
}

#[derive(Debug)]
struct Entry {
    job: Job,
    result: Option<Arc<StudyResult>>,
}

impl MemoryStore {
    /// Empty, for this much.
    pub fn new(capacity: Capacity) -> Self {
        Self { capacity, jobs: Mutex::default() }
    }

    fn lock(&self) -> MutexGuard<'_, Jobs> {
        // No method panics halfway through a change, so a poisoned lock still guards a consistent state.
        self.jobs.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Jobs {
    fn unfinished(&self) -> usize {
        self.entries.len() - self.finished.len()
    }

    /// The job, if it has not ended.
    fn open(&mut self, id: Uuid) -> Option<&mut Entry> {
        self.entries.get_mut(&id).filter(|entry| !entry.job.state.is_final())
    }

    /// Ends a job that has not ended, and makes room for it among the finished.
    fn end(&mut self, id: Uuid, capacity: Capacity, state: JobState, change: impl FnOnce(&mut Entry)) {
        let Some(entry) = self.open(id) else { return };
        entry.job.state = state;
        entry.job.finished_at = Some(Timestamp::now());
        change(entry);
        let bytes = entry.result.as_ref().map_or(0, |result| result.recording_bytes());
        self.finished.push_back(id);
        if bytes > 0 {
            self.recorded.push_back((id, bytes));
            self.recording_bytes += bytes;
        }
        while self.recording_bytes > capacity.recording_bytes {
            self.drop_oldest_recordings();
        }
        while self.finished.len() > capacity.finished {
            let oldest = self.finished.pop_front();
            if self.recorded.front().map(|(id, _)| *id) == oldest {
                self.drop_oldest_recordings();
            }
            oldest.and_then(|id| self.entries.remove(&id));
        }
    }

    fn drop_oldest_recordings(&mut self) {
        let Some((id, bytes)) = self.recorded.pop_front() else { return };
        self.recording_bytes -= bytes;
        if let Some(result) = self.entries.get_mut(&id).and_then(|entry| entry.result.as_mut()) {
            *result = Arc::new(StudyResult { reports: result.reports.clone(), recordings: Vec::new() });
        }
    }
}

#[async_trait]
impl JobStore for MemoryStore {
    /// The worker in this process holds the study already; memory has no other to hand it to.
    async fn add(&self, job: Job, _study: Arc<Study>) -> Result<(), StoreError> {
        let mut jobs = self.lock();
        if jobs.unfinished() >= self.capacity.unfinished {
            return Err(StoreError::Full(jobs.unfinished()));
        }
        jobs.entries.insert(job.id, Entry { job, result: None });
        Ok(())
    }

    async fn job(&self, id: Uuid) -> Result<Option<Job>, StoreError> {
        Ok(self.lock().entries.get(&id).map(|entry| entry.job.clone()))
    }

    async fn result(&self, id: Uuid) -> Result<Option<Arc<StudyResult>>, StoreError> {
        Ok(self.lock().entries.get(&id).and_then(|entry| entry.result.clone()))
    }

    async fn start(&self, id: Uuid) -> Result<Order, StoreError> {
        let mut jobs = self.lock();
        let Some(entry) = jobs.open(id) else { return Ok(Order::Stop) };
        entry.job.state = JobState::Running;
        entry.job.started_at.get_or_insert_with(Timestamp::now);
        Ok(Order::Continue)
    }

    async fn report_progress(&self, id: Uuid, progress: f64) -> Result<Order, StoreError> {
        let mut jobs = self.lock();
        let Some(entry) = jobs.open(id) else { return Ok(Order::Stop) };
        // Several threads report on one job; the one that was overtaken must not turn it back.
        entry.job.progress = entry.job.progress.max(progress.clamp(0.0, 1.0));
        Ok(Order::Continue)
    }

    async fn finish(&self, id: Uuid, ending: Ending) -> Result<(), StoreError> {
        let mut jobs = self.lock();
        match ending {
            Ending::Succeeded(result) => jobs.end(id, self.capacity, JobState::Succeeded, |entry| {
                entry.job.progress = 1.0;
                entry.result = Some(Arc::new(result));
            }),
            Ending::Failed(reason) => {
                jobs.end(id, self.capacity, JobState::Failed, |entry| entry.job.reason = Some(reason));
            }
        }
        Ok(())
    }

    async fn cancel(&self, id: Uuid) -> Result<Option<Job>, StoreError> {
        let mut jobs = self.lock();
        jobs.end(id, self.capacity, JobState::Canceled, |entry| entry.job.reason = Some("canceled on request".into()));
        Ok(jobs.entries.get(&id).map(|entry| entry.job.clone()))
    }

    async fn unfinished(&self) -> Result<usize, StoreError> {
        Ok(self.lock().unfinished())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::jobs::JobKind;
    use adaptarm_core::scenario::{Scenario, Scheme};

    fn short_study() -> Study {
        let mut document = Scheme::SlotineLi.paper();
        document.integration.duration_s = 0.1;
        document.recording.samples = 10;
        Study::new(vec![document], "").unwrap()
    }

    async fn finished(store: &MemoryStore) -> Uuid {
        let study = short_study();
        let job = Job::new(JobKind::Study, None);
        let id = job.id;
        let result = StudyResult::new(study.scenarios().iter().map(Scenario::run).collect());
        store.add(job, Arc::new(study)).await.unwrap();
        store.finish(id, Ending::Succeeded(result)).await.unwrap();
        id
    }

    #[tokio::test]
    async fn the_oldest_finished_job_makes_room_and_recordings_go_first() {
        let one = short_study().scenarios()[0].run().recording;
        let bytes = size_of_val(one.rows());
        let store = MemoryStore::new(Capacity { unfinished: 1, finished: 3, recording_bytes: 2 * bytes });
        let mut ids = Vec::new();
        for _ in 0..4 {
            ids.push(finished(&store).await);
        }
        assert_eq!(store.job(ids[0]).await, Ok(None));
        let recordings = |id| {
            let store = &store;
            async move { store.result(id).await.unwrap().unwrap().recordings.len() }
        };
        assert_eq!([recordings(ids[1]).await, recordings(ids[2]).await, recordings(ids[3]).await], [0, 1, 1]);
    }

    #[tokio::test]
    async fn what_arrives_after_a_cancel_changes_nothing() {
        let store = MemoryStore::new(Capacity { unfinished: 1, ..Capacity::default() });
        let job = Job::new(JobKind::Study, None);
        let (id, study) = (job.id, Arc::new(short_study()));
        store.add(job.clone(), study.clone()).await.unwrap();
        assert_eq!(store.add(Job::new(JobKind::Study, None), study).await, Err(StoreError::Full(1)));
        assert_eq!(store.start(id).await, Ok(Order::Continue));
        assert_eq!(store.cancel(id).await.unwrap().unwrap().state, JobState::Canceled);
        assert_eq!(store.report_progress(id, 0.5).await, Ok(Order::Stop));
        store.finish(id, Ending::Failed("late".into())).await.unwrap();
        let job = store.job(id).await.unwrap().unwrap();
        assert_eq!((job.state, job.reason.as_deref()), (JobState::Canceled, Some("canceled on request")));
        assert_eq!(store.unfinished().await, Ok(0));
    }
}
