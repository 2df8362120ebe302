//! Reading a stream of server-sent events. Source: HTML standard, section 9.2.

use anyhow::{Context, Result};
use serde_json::Value;
use std::io::{BufRead, BufReader};

/// One event.
#[derive(Debug, Clone, PartialEq)]
pub struct Event {
    /// What `Last-Event-ID` names; progress has none.
    pub id: Option<String>,
    /// `state`, `summary` or `progress`.
    pub kind: String,
    /// Data, which is JSON.
    pub data: Value,
}

/// Events as they come; ends when the server ends the stream.
pub struct Events {
    input: BufReader<ureq::BodyReader<'static>>,
    comments: usize,
}

impl Events {
    pub(crate) fn new(input: ureq::BodyReader<'static>) -> Self {
        Self { input: BufReader::with_capacity(4096, input), comments: 0 }
    }

    /// Comments seen so far: what keeps a quiet stream open.
    pub fn comments(&self) -> usize {
        self.comments
    }

    fn read(&mut self) -> Result<Option<Event>> {
        let (mut id, mut kind, mut data) = (None, String::new(), String::new());
        let mut line = String::new();
        loop {
            line.clear();
            // An event that the end of the stream cuts off is none.
            if self.input.read_line(&mut line)? == 0 {
                return Ok(None);
            }
            let text = line.trim_end_matches(['\r', '\n']);
            if text.is_empty() {
                if data.is_empty() {
                    continue;
                }
                let data = serde_json::from_str(&data).with_context(|| format!("an event's data: {data}"))?;
                return Ok(Some(Event { id, kind, data }));
            }
            let (field, value) = text.split_once(':').unwrap_or((text, ""));
            let value = value.strip_prefix(' ').unwrap_or(value);
            match field {
                "" => self.comments += 1,
                "id" => id = Some(value.to_owned()),
                "event" => value.clone_into(&mut kind),
                "data" => data.push_str(value),
                _ => {}
            }
        }
    }
}

impl Iterator for Events {
    type Item = Result<Event>;

    fn next(&mut self) -> Option<Result<Event>> {
        self.read().transpose()
    }
}
