//! Counts and times for Prometheus: names, help and units stand in one table, and a typed function records each.
//!
//! Labels come from enums, routes and status codes, never from what clients send: the number of series is bounded.
//! The recorder is the process's only one; starting it again changes nothing, so several applications can share it.

mod http;
mod process;
mod table;

pub use http::observe;
pub use table::{Kind, METRICS, Metric};

use crate::jobs::JobState;
use crate::webhooks::Outcome;
use ::metrics::{counter, gauge, histogram};
use metrics_exporter_prometheus::{PrometheusBuilder, PrometheusHandle, PrometheusRecorder};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

/// Bounds of the histograms' buckets, seconds: from a page's file to an hour of simulation.
const BUCKETS_S: [f64; 15] =
    [0.001, 0.0025, 0.005, 0.01, 0.025, 0.05, 0.1, 0.25, 0.5, 1.0, 2.5, 10.0, 60.0, 600.0, 3600.0];

/// How often samples of histograms are put into their buckets; until then each takes memory of its own.
const UPKEEP_INTERVAL: Duration = Duration::from_secs(5);

/// Starts recording, for the rest of the process.
pub fn start() {
    handle();
}

/// Everything recorded so far, in Prometheus' text format.
pub fn render() -> String {
    let handle = handle();
    process::record();
    handle.render()
}

/// Keeps what is recorded small where nobody comes to read it. Never ends.
pub async fn keep_small() {
    let mut interval = tokio::time::interval(UPKEEP_INTERVAL);
    loop {
        interval.tick().await;
        handle().run_upkeep();
    }
}

fn handle() -> &'static PrometheusHandle {
    static HANDLE: OnceLock<PrometheusHandle> = OnceLock::new();
    HANDLE.get_or_init(|| {
        let recorder = recorder();
        let handle = recorder.handle();
        if ::metrics::set_global_recorder(recorder).is_err() {
            tracing::warn!("another recorder of metrics is at work in this process; ours stays empty");
        }
        table::describe();
        begin_at_zero();
        handle
    })
}

fn recorder() -> PrometheusRecorder {
    let builder = PrometheusBuilder::new().set_buckets(&BUCKETS_S);
    // Only an empty list of buckets is refused.
    builder.unwrap_or_else(|_| PrometheusBuilder::new()).build_recorder()
}

/// A counter that is absent until its first event looks like no event at all, and its first increase is lost.
fn begin_at_zero() {
    counter!("adaptarm_simulated_seconds_total").increment(0);
    counter!("adaptarm_simulation_steps_total").increment(0);
    counter!("adaptarm_results_bytes_total").increment(0);
    gauge!("adaptarm_sse_subscribers").increment(0.0);
    for reason in FailureReason::ALL {
        counter!("adaptarm_job_failures_total", "reason" => reason.id()).increment(0);
    }
    for outcome in DELIVERY_OUTCOMES {
        counter!("adaptarm_webhook_deliveries_total", "outcome" => outcome).increment(0);
    }
}

/// So many jobs are in this state.
pub fn queue_depth(state: JobState, jobs: u64) {
    gauge!("adaptarm_queue_depth", "state" => state.id()).set(jobs as f64);
}

/// A shard took this long.
pub fn shard_took(time: Duration) {
    histogram!("adaptarm_shard_seconds").record(time);
}

/// So much was simulated: time of the arm's movement, and steps of the integration.
pub fn simulated(seconds: f64, steps: u64) {
    static SECONDS: WholeSeconds = WholeSeconds(AtomicU64::new(0));
    counter!("adaptarm_simulated_seconds_total").increment(SECONDS.add(seconds));
    counter!("adaptarm_simulation_steps_total").increment(steps);
}

/// Counters are whole numbers; what is left of a second, in microseconds, waits here for more.
struct WholeSeconds(AtomicU64);

impl WholeSeconds {
    /// How many seconds became whole.
    fn add(&self, seconds: f64) -> u64 {
        // Saturates; nothing that was simulated took negative or infinite time.
        let more = (seconds * 1e6).round() as u64;
        let before = self.0.fetch_add(more, Ordering::Relaxed);
        before.saturating_add(more) / 1_000_000 - before / 1_000_000
    }
}

/// A job of this kind reached this final state.
pub fn job_ended(kind: &'static str, outcome: JobState) {
    counter!("adaptarm_jobs_total", "kind" => kind, "outcome" => outcome.id()).increment(1);
}

/// Why a job failed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FailureReason {
    /// Its simulation panicked.
    Panicked,
    /// It used up its computing time.
    OutOfTime,
    /// Its workers died, as often as it may be tried.
    OutOfAttempts,
    /// Its result could not be stored or read.
    Storage,
    /// Its document is not understood by this version.
    Document,
}

impl FailureReason {
    /// All there are.
    pub const ALL: [Self; 5] = [Self::Panicked, Self::OutOfTime, Self::OutOfAttempts, Self::Storage, Self::Document];

    /// The label's value.
    pub fn id(self) -> &'static str {
        match self {
            Self::Panicked => "panicked",
            Self::OutOfTime => "out_of_time",
            Self::OutOfAttempts => "out_of_attempts",
            Self::Storage => "storage",
            Self::Document => "document",
        }
    }
}

/// A job failed for this reason.
pub fn job_failed(reason: FailureReason) {
    counter!("adaptarm_job_failures_total", "reason" => reason.id()).increment(1);
}

/// An attempt to deliver a webhook ended like this.
pub fn webhook_delivery(outcome: &Outcome) {
    let outcome = match outcome {
        Outcome::Delivered => DELIVERY_OUTCOMES[0],
        Outcome::Retry { .. } => DELIVERY_OUTCOMES[1],
        Outcome::GiveUp { .. } => DELIVERY_OUTCOMES[2],
    };
    counter!("adaptarm_webhook_deliveries_total", "outcome" => outcome).increment(1);
}

/// Delivered, to be tried again, never to be tried again.
const DELIVERY_OUTCOMES: [&str; 3] = ["delivered", "retry", "give_up"];

/// So many bytes of results were stored.
pub fn result_stored(bytes: u64) {
    counter!("adaptarm_results_bytes_total").increment(bytes);
}

/// Someone who follows a job's events; counted as long as this value lives.
#[derive(Debug)]
pub struct SseSubscriber(());

impl SseSubscriber {
    /// One more.
    pub fn enter() -> Self {
        gauge!("adaptarm_sse_subscribers").increment(1.0);
        Self(())
    }
}

impl Drop for SseSubscriber {
    fn drop(&mut self) {
        gauge!("adaptarm_sse_subscribers").decrement(1.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What a test of its own recorded, untouched by other tests of this process.
    pub(super) struct Recorded(PrometheusHandle);

    impl Recorded {
        pub(super) fn text(&self) -> String {
            process::record();
            self.0.render()
        }

        /// Value of a series, named as Prometheus names it.
        pub(super) fn value(&self, series: &str) -> Option<f64> {
            self.text().lines().find_map(|line| line.strip_prefix(series)?.strip_prefix(' ')?.parse().ok())
        }
    }

    /// Records what this thread does until the guard is dropped.
    pub(super) fn record(recorder: &PrometheusRecorder) -> (Recorded, ::metrics::LocalRecorderGuard<'_>) {
        let guard = ::metrics::set_default_local_recorder(recorder);
        table::describe();
        begin_at_zero();
        (Recorded(recorder.handle()), guard)
    }

    #[test]
    fn everything_recorded_is_in_the_table_with_help() {
        let recorder = recorder();
        let (recorded, _guard) = record(&recorder);
        queue_depth(JobState::Queued, 7);
        shard_took(Duration::from_millis(30));
        job_ended("study", JobState::Succeeded);
        http::record("GET", "/api/v1/jobs", 200, Duration::from_millis(3));
        let text = recorded.text();
        for metric in METRICS {
            if !cfg!(target_os = "linux") && metric.name.starts_with("process_") {
                continue;
            }
            assert!(text.contains(&format!("# HELP {} {}\n", metric.name, metric.help)), "{}:\n{text}", metric.name);
            let kind = format!("# TYPE {} {}\n", metric.name, metric.kind.id());
            assert!(text.contains(&kind), "{kind} is missing:\n{text}");
            let of_metric = |line: &&str| line.starts_with(metric.name) && !line.contains("_bucket");
            let series = text.lines().find(of_metric).unwrap();
            for label in metric.labels {
                assert!(series.contains(&format!("{label}=\"")), "{series}");
            }
        }
        let count = |what| text.lines().filter(|line| line.starts_with(what)).count();
        assert_eq!(count("# TYPE "), METRICS.len(), "a metric is not in the table:\n{text}");
    }

    #[test]
    fn values_are_those_recorded() {
        let recorder = recorder();
        let (recorded, _guard) = record(&recorder);
        queue_depth(JobState::Running, 3);
        assert_eq!(recorded.value(r#"adaptarm_queue_depth{state="running"}"#), Some(3.0));
        shard_took(Duration::from_millis(700));
        assert_eq!(recorded.value(r#"adaptarm_shard_seconds_bucket{le="0.5"}"#), Some(0.0));
        assert_eq!(recorded.value(r#"adaptarm_shard_seconds_bucket{le="1"}"#), Some(1.0));
        job_ended("test", JobState::Failed);
        assert_eq!(recorded.value(r#"adaptarm_jobs_total{kind="test",outcome="failed"}"#), Some(1.0));
        job_failed(FailureReason::OutOfTime);
        assert_eq!(recorded.value(r#"adaptarm_job_failures_total{reason="out_of_time"}"#), Some(1.0));
        assert_eq!(recorded.value(r#"adaptarm_job_failures_total{reason="storage"}"#), Some(0.0));
        webhook_delivery(&Outcome::GiveUp { why: String::new() });
        assert_eq!(recorded.value(r#"adaptarm_webhook_deliveries_total{outcome="give_up"}"#), Some(1.0));
        assert_eq!(recorded.value(r#"adaptarm_webhook_deliveries_total{outcome="delivered"}"#), Some(0.0));
        result_stored(1234);
        assert_eq!(recorded.value("adaptarm_results_bytes_total"), Some(1234.0));
        simulated(12.0, 12_000);
        assert_eq!(recorded.value("adaptarm_simulation_steps_total"), Some(12_000.0));
        let (one, two) = (SseSubscriber::enter(), SseSubscriber::enter());
        assert_eq!(recorded.value("adaptarm_sse_subscribers"), Some(2.0));
        drop((one, two));
        assert_eq!(recorded.value("adaptarm_sse_subscribers"), Some(0.0));
    }

    #[test]
    fn parts_of_seconds_add_up() {
        let seconds = WholeSeconds(AtomicU64::new(0));
        let whole: u64 = (0..10).map(|_| seconds.add(0.35)).sum();
        assert_eq!(whole, 3);
        assert_eq!(seconds.add(0.5), 1);
        assert_eq!(seconds.add(f64::NAN) + seconds.add(-1.0), 0);
    }

    #[test]
    fn starting_again_changes_nothing() {
        start();
        start();
        assert!(render().contains("adaptarm_results_bytes_total"));
    }
}
