//! Running jobs: a fixed number of threads, one task per scenario, in the order of arrival.
//!
//! Computation never happens inside a future. Between slices of a simulation the worker reports to the store and learns
//! whether to go on, so a cancel takes effect within a slice. A scenario that panics fails its job, nothing else.

use super::{Ending, Job, JobKind, JobStore, Order, StoreError, Study, StudyResult};
use adaptarm_core::scenario::{Run, Scenario};
use adaptarm_core::simulation::Simulation;
use anyhow::Context;
use rayon::ThreadPool;
use std::any::Any;
use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::available_parallelism;
use std::time::{Duration, Instant};
use tokio::runtime::Handle;
use uuid::Uuid;

/// Steps between two looks at the clock: a few milliseconds.
const SLICE_STEPS: u64 = 2_000;

/// Time between two reports of one scenario.
const REPORT_INTERVAL: Duration = Duration::from_millis(50);

/// Jobs with tasks on the pool, canceled ones included: their tasks go only when a thread comes past them.
const MOST_EXECUTIONS: usize = 256;

/// Simulates a scenario, looking up now and then; `None` if it was broken off there. Tests put others in its place.
pub type Simulate = fn(&Scenario, &mut dyn FnMut(&Simulation) -> ControlFlow<()>) -> Option<Run>;

/// The pool that jobs run on.
#[derive(Clone)]
pub struct Engine {
    store: Arc<dyn JobStore>,
    pool: Arc<ThreadPool>,
    simulate: Simulate,
    stopping: Arc<AtomicBool>,
    /// One reference per execution, and ours.
    executions: Arc<()>,
}

impl Engine {
    /// An engine with a thread per processor.
    pub fn new(store: Arc<dyn JobStore>) -> anyhow::Result<Self> {
        let simulate: Simulate = |scenario, look| scenario.run_in_slices(SLICE_STEPS, look);
        Self::with(store, simulate, available_parallelism().map_or(1, usize::from))
    }

    /// An engine that simulates by `simulate` on `threads` threads.
    pub fn with(store: Arc<dyn JobStore>, simulate: Simulate, threads: usize) -> anyhow::Result<Self> {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .thread_name(|n| format!("simulation-{n}"))
            .build()
            .context("cannot start the simulation threads")?;
        Ok(Self { store, pool: Arc::new(pool), simulate, stopping: Arc::default(), executions: Arc::default() })
    }

    /// Where its jobs are kept.
    pub fn store(&self) -> &dyn JobStore {
        &*self.store
    }

    /// Accepts a study; it runs when its turn comes. Must be called within a runtime.
    pub async fn submit(&self, study: Study, label: Option<String>) -> Result<Job, StoreError> {
        let executions = Arc::strong_count(&self.executions) - 1;
        if executions >= MOST_EXECUTIONS {
            return Err(StoreError::Full(executions));
        }
        let job = Job::new(JobKind::Study, label);
        let study = Arc::new(study);
        self.store.add(job.clone(), study.clone()).await?;
        let count = study.scenarios().len();
        let execution = Arc::new(Execution {
            id: job.id,
            store: self.store.clone(),
            runtime: Handle::current(),
            simulate: self.simulate,
            stopping: self.stopping.clone(),
            total_steps: study.steps().max(1) as f64,
            study,
            steps_done: (0..count).map(|_| AtomicU64::new(0)).collect(),
            runs: Mutex::new((0..count).map(|_| None).collect()),
            remaining: AtomicUsize::new(count),
            _counted: self.executions.clone(),
        });
        for n in 0..count {
            let execution = execution.clone();
            self.pool.spawn_fifo(move || execution.perform(n));
        }
        Ok(job)
    }

    /// Makes every worker stop within a slice. Jobs that have not ended stay as they are.
    pub fn stop(&self) {
        self.stopping.store(true, Ordering::Relaxed);
    }
}

/// One job on the pool.
struct Execution {
    id: Uuid,
    study: Arc<Study>,
    store: Arc<dyn JobStore>,
    /// The store is asynchronous; the pool's threads wait for it here.
    runtime: Handle,
    simulate: Simulate,
    stopping: Arc<AtomicBool>,
    total_steps: f64,
    steps_done: Vec<AtomicU64>,
    runs: Mutex<Vec<Option<Run>>>,
    remaining: AtomicUsize,
    _counted: Arc<()>,
}

impl Execution {
    /// Simulates scenario `n`; whoever does the last one ends the job.
    fn perform(&self, n: usize) {
        if self.begin() == Order::Stop {
            return;
        }
        let mut reported = Instant::now();
        let run = catch_unwind(AssertUnwindSafe(|| {
            (self.simulate)(&self.study.scenarios()[n], &mut |simulation| {
                if reported.elapsed() < REPORT_INTERVAL {
                    return self.order().into();
                }
                reported = Instant::now();
                self.report(n, simulation.progress()).into()
            })
        }));
        let failure = match run {
            Ok(Some(run)) => {
                self.runs.lock().unwrap_or_else(PoisonError::into_inner)[n] = Some(run);
                self.report(n, 1.0);
                None
            }
            Ok(None) => None,
            Err(panic) => Some(format!("scenario {n} made the simulation fail: {}", words(&*panic))),
        };
        if let Some(reason) = failure {
            tracing::error!(job = %self.id, "{reason}");
            self.finish(Ending::Failed(reason));
        }
        // Everyone's runs are visible to whoever comes last.
        if self.remaining.fetch_sub(1, Ordering::AcqRel) == 1 {
            let runs = std::mem::take(&mut *self.runs.lock().unwrap_or_else(PoisonError::into_inner));
            // Absent where the job was stopped or failed: then there is no result.
            if let Some(runs) = runs.into_iter().collect() {
                self.finish(Ending::Succeeded(StudyResult::new(runs)));
            }
        }
    }

    fn order(&self) -> Order {
        if self.stopping.load(Ordering::Relaxed) { Order::Stop } else { Order::Continue }
    }

    fn begin(&self) -> Order {
        match self.order() {
            Order::Stop => Order::Stop,
            Order::Continue => self.obey(self.runtime.block_on(self.store.start(self.id))),
        }
    }

    fn report(&self, n: usize, share: f64) -> Order {
        let steps = self.study.scenarios()[n].settings().steps() as f64;
        self.steps_done[n].store((share * steps) as u64, Ordering::Relaxed);
        let done: u64 = self.steps_done.iter().map(|steps| steps.load(Ordering::Relaxed)).sum();
        let progress = done as f64 / self.total_steps;
        self.obey(self.runtime.block_on(self.store.report_progress(self.id, progress)))
    }

    fn finish(&self, ending: Ending) {
        if let Err(error) = self.runtime.block_on(self.store.finish(self.id, ending)) {
            tracing::error!(job = %self.id, "cannot note how the job ended: {error}");
        }
    }

    /// The store's order; a store that cannot be asked is no reason to throw work away.
    fn obey(&self, order: Result<Order, StoreError>) -> Order {
        order.unwrap_or_else(|error| {
            tracing::error!(job = %self.id, "cannot reach the job: {error}");
            Order::Continue
        })
    }
}

/// What a panic said.
fn words(panic: &(dyn Any + Send)) -> &str {
    panic
        .downcast_ref::<String>()
        .map(String::as_str)
        .or_else(|| panic.downcast_ref::<&str>().copied())
        .unwrap_or("it did not say why")
}
