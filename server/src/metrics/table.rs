//! The table of metrics: what each is called, what kind it is, and what it means. `docs/operations.md` repeats it.

use ::metrics::{describe_counter, describe_gauge, describe_histogram};

/// What a metric does over time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Only grows.
    Counter,
    /// Goes up and down.
    Gauge,
    /// Counts values by their size.
    Histogram,
}

impl Kind {
    /// Prometheus' word for it.
    pub fn id(self) -> &'static str {
        match self {
            Self::Counter => "counter",
            Self::Gauge => "gauge",
            Self::Histogram => "histogram",
        }
    }
}

/// One metric.
#[derive(Debug)]
pub struct Metric {
    /// Its name, which ends in its unit.
    pub name: &'static str,
    /// What it does over time.
    pub kind: Kind,
    /// Its labels.
    pub labels: &'static [&'static str],
    /// What it means.
    pub help: &'static str,
}

const fn metric(name: &'static str, kind: Kind, labels: &'static [&'static str], help: &'static str) -> Metric {
    Metric { name, kind, labels, help }
}

/// All metrics.
pub const METRICS: &[Metric] = &[
    metric("adaptarm_queue_depth", Kind::Gauge, &["state"], "Jobs in each state that is not final."),
    metric("adaptarm_jobs_total", Kind::Counter, &["kind", "outcome"], "Jobs that reached a final state."),
    metric("adaptarm_job_failures_total", Kind::Counter, &["reason"], "Jobs that failed, by reason."),
    metric("adaptarm_shard_seconds", Kind::Histogram, &[], "Time that a shard of a job took to compute."),
    metric("adaptarm_simulated_seconds_total", Kind::Counter, &[], "Time of the arm's movement that was simulated."),
    metric("adaptarm_simulation_steps_total", Kind::Counter, &[], "Integration steps taken."),
    metric("adaptarm_results_bytes_total", Kind::Counter, &[], "Bytes of results stored."),
    metric("adaptarm_http_requests_total", Kind::Counter, &["method", "route", "status"], "Requests answered."),
    metric("adaptarm_http_request_seconds", Kind::Histogram, &["route"], "Time until an answer began."),
    metric("adaptarm_sse_subscribers", Kind::Gauge, &[], "Clients that follow a job's events now."),
    metric("adaptarm_webhook_deliveries_total", Kind::Counter, &["outcome"], "Attempts to deliver a webhook."),
    metric("process_resident_memory_bytes", Kind::Gauge, &[], "Memory of this process that is in RAM (Linux)."),
    metric("process_start_time_seconds", Kind::Gauge, &[], "Start of this process, since 1970 (Linux)."),
];

/// Tells the recorder what each metric means.
pub(super) fn describe() {
    for metric in METRICS {
        match metric.kind {
            Kind::Counter => describe_counter!(metric.name, metric.help),
            Kind::Gauge => describe_gauge!(metric.name, metric.help),
            Kind::Histogram => describe_histogram!(metric.name, metric.help),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_manual_lists_every_metric() {
        let manual = include_str!("../../../docs/operations.md");
        for Metric { name, kind, labels, help } in METRICS {
            let row = format!("| `{name}` | {} | {} | {help} |\n", kind.id(), labels.join(", "));
            assert!(manual.contains(&row), "docs/operations.md lacks this row:\n{row}");
        }
    }
}
