//! Logs: one line per event on standard error, so that standard output stays for results; for people or as JSON.
//!
//! Every line names the request and the job it belongs to: they are spans, and spans are part of each line.

use crate::config::{Log, LogFormat};
use std::io::IsTerminal;
use tracing::Span;
use tracing_subscriber::EnvFilter;
use tracing_subscriber::fmt::MakeWriter;
use uuid::Uuid;

/// Starts logging for the rest of the process. Where someone in this process logs already, they may go on doing so.
pub fn start(log: &Log) {
    let colours = std::io::stderr().is_terminal();
    // One that is there already is no failure.
    let _ = tracing::subscriber::set_global_default(subscriber(log, std::io::stderr, colours));
}

/// What turns events into lines.
fn subscriber<W>(log: &Log, writer: W, colours: bool) -> Box<dyn tracing::Subscriber + Send + Sync>
where
    W: for<'a> MakeWriter<'a> + Send + Sync + 'static,
{
    // The settings have checked it; one made by hand without checking logs what is logged by default.
    let filter = EnvFilter::try_new(&log.filter).unwrap_or_else(|_| EnvFilter::new(Log::default().filter));
    let lines = tracing_subscriber::fmt().with_env_filter(filter).with_writer(writer);
    match log.format {
        LogFormat::Text => Box::new(lines.with_ansi(colours).finish()),
        // All spans, from the outermost: a job's line names the request too, where one caused it.
        LogFormat::Json => Box::new(lines.json().flatten_event(true).with_current_span(false).finish()),
    }
}

/// The span of work on a job; whatever is logged within it names the job.
pub fn job_span(id: Uuid) -> Span {
    // So that a failure names its job even where only failures are logged.
    tracing::error_span!("job", %id)
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::Value;
    use std::io;
    use std::sync::{Arc, Mutex};

    /// Keeps what is written.
    #[derive(Clone, Default)]
    struct Kept(Arc<Mutex<Vec<u8>>>);

    impl io::Write for Kept {
        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            self.0.lock().unwrap().extend_from_slice(bytes);
            Ok(bytes.len())
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    fn logged(log: &Log, what: impl FnOnce()) -> String {
        let kept = Kept::default();
        let writer = kept.clone();
        tracing::subscriber::with_default(subscriber(log, move || writer.clone(), false), what);
        let bytes = kept.0.lock().unwrap().clone();
        String::from_utf8(bytes).unwrap()
    }

    #[test]
    fn json_lines_name_the_job_and_carry_every_field() {
        let log = Log { format: LogFormat::Json, ..Log::default() };
        let id = Uuid::now_v7();
        let text = logged(&log, || job_span(id).in_scope(|| tracing::warn!(scenario = 3, "it \"stopped\"\nearly")));
        assert_eq!(text.lines().count(), 1, "{text}");
        let line: Value = serde_json::from_str(&text).unwrap();
        assert_eq!(line["level"], "WARN");
        assert_eq!(line["message"], "it \"stopped\"\nearly");
        assert_eq!(line["scenario"], 3);
        assert_eq!(line["spans"][0]["name"], "job");
        assert_eq!(line["spans"][0]["id"], id.to_string());
    }

    #[test]
    fn text_lines_name_the_job_and_the_filter_decides() {
        let log = Log { filter: "warn".to_owned(), ..Log::default() };
        let id = Uuid::now_v7();
        let text = logged(&log, || {
            let _job = job_span(id).entered();
            tracing::info!("unheard");
            tracing::warn!("heard");
        });
        assert!(text.contains(&id.to_string()) && text.contains("heard") && !text.contains("unheard"), "{text}");
    }

    #[test]
    fn starting_twice_is_no_failure() {
        start(&Log::default());
        start(&Log { format: LogFormat::Json, ..Log::default() });
    }
}
