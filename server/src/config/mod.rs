//! What a server or worker is started with: every setting with its default and range, in one place.
//!
//! Settings come from a TOML file, the environment and flags, later ones winning ([`Sources`]). Whatever is wrong is
//! refused with its key, value, range and place. Keys of S3 are not among them: they come from the usual `AWS_` variables.

mod error;
mod layers;
mod load;
mod print;
mod setting;
#[cfg(test)]
mod tests;
mod values;

pub use error::ConfigError;
pub use load::{Loaded, Sources};
pub use print::{effective, example};
pub use setting::{Form, Rule, Setting};
pub use values::{DatabaseUrl, LogFormat, ResultsPlace};

use crate::webhooks::{Policy, PolicyError, Timing};
use setting::section;
use std::net::{Ipv4Addr, SocketAddr};
use std::path::PathBuf;
use std::thread::available_parallelism;
use std::time::Duration;
use values::{check, check_address, check_filter, check_folder, check_public_url, check_receiver};

section! {
    /// Settings of one server or worker.
    Config [""] {
        /// Address and port to listen on; port 0 means any free one.
        bind: SocketAddr = SocketAddr::from((Ipv4Addr::LOCALHOST, 8080)), Rule::text(check_address);
        /// Folder for the database (adaptarm.sqlite3) and for results, made if it does not exist; adaptarm-data if not set.
        data: Option<PathBuf> = None, Rule::text(check_folder).example(r#""/var/lib/adaptarm""#);
        /// PostgreSQL database in place of the file in the data folder; several machines need one.
        database: Option<DatabaseUrl> = None,
            Rule::text(check::<DatabaseUrl>).example(r#""postgres://adaptarm:PASSWORD@db.example.org/adaptarm""#).secret();
        /// Where recordings are kept in place of the data folder: a folder, or s3://bucket/prefix.
        /// Endpoint, region and keys of S3 come from AWS_ENDPOINT_URL, AWS_REGION, AWS_ACCESS_KEY_ID and AWS_SECRET_ACCESS_KEY.
        results: Option<ResultsPlace> = None, Rule::text(check::<ResultsPlace>).example(r#""s3://bucket/prefix""#);
        /// Threads that simulate; as many as processors if not set. 0: this process only answers requests.
        threads: Option<usize> = None, Rule::integer(0, 1024, "threads").example("4");
    }
    sections {
        /// The log.
        log: Log;
        /// Bounds on jobs and users.
        limits: Limits;
        /// How long things are kept.
        retention: Retention;
        /// How work is handed out.
        queue: Queue;
        /// Connections and their time limits.
        server: Server;
        /// Who may do how much.
        auth: Auth;
        /// Messages to other servers.
        webhooks: Webhooks;
        /// Classes.
        classroom: Classroom;
    }
}

section! {
    /// The log, written to standard error.
    Log ["log"] {
        /// "text" for people, "json" for one object per line.
        format: LogFormat = LogFormat::Text, Rule::text(check::<LogFormat>);
        /// What is logged, by level and module; the variable RUST_LOG sets it too.
        filter: String = DEFAULT_FILTER.to_owned(), Rule::text(check_filter);
    }
}

section! {
    /// Bounds on one job, one user and one request. All are inclusive.
    Limits ["limits"] {
        /// Most scenarios of one job.
        scenarios_per_job: usize = 10_000, Rule::integer(1, 100_000, "scenarios");
        /// Most integration steps of one job, all scenarios together.
        steps_per_job: u64 = 10_000_000_000, Rule::integer(1, 1_000_000_000_000_000, "steps");
        /// Most recorded samples of one job, all scenarios together.
        samples_per_job: u64 = 4_000_000, Rule::integer(1, 1_000_000_000, "samples");
        /// Longest computing time of one job, summed over its threads; then it fails.
        compute_s_per_job: u64 = 86_400, Rule::integer(1, 31_536_000, "s");
        /// Most jobs that one user may have waiting or running.
        unfinished_jobs_per_user: u64 = 10_000, Rule::integer(1, 1_000_000, "jobs");
        /// Most integration steps that one user's unfinished jobs may have together.
        queued_steps_per_user: u64 = 100_000_000_000, Rule::integer(1, 100_000_000_000_000_000, "steps");
        /// Most that one user's results may take, bytes (20 GiB).
        stored_bytes_per_user: u64 = 20 << 30, Rule::integer(1 << 20, 1 << 50, "bytes");
        /// Largest request body, bytes (8 MiB).
        request_bytes: usize = 8 << 20, Rule::integer(64 << 10, 256 << 20, "bytes");
        /// Longest that `Prefer: wait` may hold an answer back.
        wait_s: u64 = 60, Rule::integer(0, 600, "s");
    }
}

section! {
    /// How long things are kept; `adaptarm gc` removes what is older.
    Retention ["retention"] {
        /// Finished jobs.
        finished_jobs_days: u32 = 30, Rule::integer(1, 36_500, "days");
        /// Results without a job; equal scenarios are answered from them. At least as long as jobs.
        results_days: u32 = 90, Rule::integer(1, 36_500, "days");
    }
}

section! {
    /// How work is handed out to threads and machines.
    Queue ["queue"] {
        /// A worker that is silent for this long is taken for dead, and others do its work.
        lease_s: f64 = 15.0, Rule::number(0.5, 3600.0, "s");
        /// How often a worker says that it lives, and hears of cancelled jobs.
        heartbeat_ms: u64 = 250, Rule::integer(10, 60_000, "ms");
        /// How long a thread works for one job before another user's job may have its turn.
        slice_s: f64 = 2.0, Rule::number(0.01, 600.0, "s");
    }
}

section! {
    /// Connections and their time limits.
    Server ["server"] {
        /// Connections served at a time, event streams included; more wait to be accepted.
        connections: usize = 1024, Rule::integer(1, 65_536, "connections");
        /// Longest time for a request's headers to arrive.
        header_timeout_s: f64 = 10.0, Rule::number(0.1, 600.0, "s");
        /// Longest time to read a request's body and begin the answer; must exceed limits.wait_s.
        request_timeout_s: f64 = 90.0, Rule::number(0.1, 3600.0, "s");
        /// Longest time that a shutdown waits for answers under way.
        drain_s: f64 = 10.0, Rule::number(0.0, 3600.0, "s");
    }
}

section! {
    /// Who may do how much.
    Auth ["auth"] {
        /// Most requests per minute with one token.
        requests_per_minute: u32 = 600, Rule::integer(1, 1_000_000, "requests per minute");
    }
}

section! {
    /// Messages to other servers when a job changes its state.
    Webhooks ["webhooks"] {
        /// Receivers allowed although their addresses are not public: host names, and networks such as 10.0.0.0/8.
        allow: Vec<String> = Vec::new(), Rule::list(check_receiver);
        /// Allows every receiver, this machine and its private network included. For tests only.
        allow_all: bool = false, Rule::switch();
        /// Wait before the first repetition of a failed delivery; later ones wait longer.
        first_retry_s: f64 = 5.0, Rule::number(0.01, 3600.0, "s");
    }
}

section! {
    /// Classes, their pages and their exercises.
    Classroom ["classroom"] {
        /// Address under which people reach this server, where a proxy stands before it; links are made from it.
        public_url: Option<String> = None, Rule::text(check_public_url).example(r#""https://lab.example.org""#);
        /// Folder with exercises of your own, beside those of this program.
        exercises: Option<PathBuf> = None, Rule::text(check_folder).example(r#""/var/lib/adaptarm/exercises""#);
    }
}

/// What is logged where nobody says otherwise; the page's files would be listed one by one.
const DEFAULT_FILTER: &str = "info,memory_serve=warn,apalis_core=warn,sqlx=warn";

impl Config {
    /// Threads that simulate.
    pub fn thread_count(&self) -> usize {
        self.threads.unwrap_or_else(|| available_parallelism().map_or(1, usize::from))
    }
}

impl Queue {
    /// [`Self::lease_s`].
    pub fn lease(&self) -> Duration {
        Duration::from_secs_f64(self.lease_s)
    }

    /// [`Self::heartbeat_ms`].
    pub fn heartbeat(&self) -> Duration {
        Duration::from_millis(self.heartbeat_ms)
    }

    /// [`Self::slice_s`].
    pub fn slice(&self) -> Duration {
        Duration::from_secs_f64(self.slice_s)
    }
}

impl Server {
    /// [`Self::header_timeout_s`].
    pub fn header_timeout(&self) -> Duration {
        Duration::from_secs_f64(self.header_timeout_s)
    }

    /// [`Self::request_timeout_s`].
    pub fn request_timeout(&self) -> Duration {
        Duration::from_secs_f64(self.request_timeout_s)
    }

    /// [`Self::drain_s`].
    pub fn drain(&self) -> Duration {
        Duration::from_secs_f64(self.drain_s)
    }
}

impl Webhooks {
    /// Whom they may reach.
    pub fn policy(&self) -> Result<Policy, PolicyError> {
        if self.allow_all { Ok(Policy::all()) } else { Policy::allowing(&self.allow) }
    }

    /// How long they may take, and when they are repeated.
    pub fn timing(&self) -> Timing {
        Timing { first_pause: Duration::from_secs_f64(self.first_retry_s), ..Timing::default() }
    }
}

/// Largest document read from a file or standard input, bytes; requests have a limit of their own.
pub const DOCUMENT_BYTES: usize = 1 << 20;
