//! The platform's gradebook: columns, and every score that was posted to one.

use serde_json::{Value, json};

/// A score as it arrived.
#[derive(Debug, Clone, PartialEq)]
pub struct Posted {
    /// Address of its column.
    pub column: String,
    /// What came.
    pub score: Value,
}

/// Columns and scores.
#[derive(Debug, Default)]
pub(super) struct Gradebook {
    pub(super) columns: Vec<Value>,
    pub(super) posted: Vec<Posted>,
}

impl Gradebook {
    /// Adds a column of these properties.
    pub(super) fn add(&mut self, url: &str, properties: &Value) -> Value {
        let mut column = properties.clone();
        // Real ones have queries in their addresses: /scores goes before them.
        column["id"] = json!(format!("{url}/columns/{}/lineitem?type_id=3", self.columns.len()));
        self.columns.push(column.clone());
        column
    }

    /// Takes a score, if it is complete and no later one of the student's is there.
    pub(super) fn post(&mut self, column: usize, score: Value) -> Result<(), &'static str> {
        let column =
            self.columns.get(column).and_then(|column| column["id"].as_str()).ok_or("no such column")?.to_owned();
        let text = |name: &str| score[name].as_str().unwrap_or_default().to_owned();
        let Ok(at) = text("timestamp").parse::<jiff::Timestamp>() else { return Err("no timestamp") };
        let given = score["scoreGiven"].as_f64();
        let graded = text("activityProgress") == "Completed" && text("gradingProgress") == "FullyGraded";
        let complete = match given {
            Some(given) => graded && given >= 0.0 && score["scoreMaximum"].as_f64().is_some_and(|most| most > 0.0),
            None => !graded && !text("gradingProgress").is_empty(),
        };
        if text("userId").is_empty() || !complete {
            return Err("not a whole score");
        }
        let later = self.posted.iter().any(|posted| {
            let time = posted.score["timestamp"].as_str().and_then(|time| time.parse::<jiff::Timestamp>().ok());
            posted.column == column && posted.score["userId"] == score["userId"] && time.is_some_and(|time| time >= at)
        });
        // It is noted all the same: tests count what arrives.
        self.posted.push(Posted { column, score });
        if later { Err("a score of that time or a later one is there") } else { Ok(()) }
    }
}
