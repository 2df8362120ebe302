//! Pages of a list of jobs: what a query asks for, and where a page ends.
//!
//! A cursor names the last job of a page and is bound to its owner by a hash. That is no secret and need not be one: a
//! cursor only says where in one's own list to go on, and the job that it names may have been deleted since.

use super::jobs::{LABEL_CHARS, check_label};
use crate::document::brief;
use crate::error::Problem;
use crate::jobs::{Filter, JobKind, JobState};
use adaptarm_core::scenario::Problem as Wrong;
use axum::http::StatusCode;
use serde::Deserialize;
use utoipa::IntoParams;
use uuid::Uuid;

/// Allowed numbers of jobs on a page, and the usual one.
const LIMITS: [i64; 2] = [1, 200];
const USUAL_LIMIT: i64 = 50;

/// Bytes of a cursor that bind it to its owner.
const BINDING: usize = 8;

/// Which jobs to list.
#[derive(Debug, Clone, Default, Deserialize, IntoParams)]
#[serde(deny_unknown_fields, default)]
#[into_params(parameter_in = Query)]
pub struct JobsQuery {
    /// Only those in this state.
    #[param(value_type = Option<JobState>)]
    pub state: Option<String>,
    /// Only those of this kind.
    #[param(value_type = Option<JobKind>)]
    pub kind: Option<String>,
    /// Only those with exactly this label.
    #[param(max_length = 200, pattern = r"^[^\u0000-\u001f\u007f-\u009f]*$")]
    pub label: Option<String>,
    /// At most so many; 50 without this.
    #[param(value_type = Option<u32>, minimum = 1, maximum = 200)]
    pub limit: Option<String>,
    /// `next_cursor` of the page before; the other parameters stay the same.
    #[param(pattern = "^[0-9a-f]{48}$")]
    pub cursor: Option<String>,
}

/// A page that is asked for, everything checked.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PageRequest {
    /// Which jobs.
    pub filter: Filter,
    /// How many at most.
    pub limit: i64,
}

impl JobsQuery {
    /// Checks everything in it.
    pub fn check(self, owner: &str) -> Result<PageRequest, Problem> {
        let state = self.state.map(|state| name("state", &state, JobState::from_id, &JobState::ALL.map(JobState::id)));
        let kind = self.kind.map(|kind| name("kind", &kind, asked_kind, &JobKind::ALL.map(JobKind::id)));
        if let Some(label) = &self.label {
            check_label(label).map_err(|wrong| wrong_label(label, &wrong))?;
        }
        let before = self.cursor.map(|cursor| read_cursor(owner, &cursor)).transpose()?;
        let limit = self.limit.map_or(Ok(USUAL_LIMIT), |limit| read_limit(&limit))?;
        let filter = Filter { state: state.transpose()?, kind: kind.transpose()?, label: self.label, before };
        Ok(PageRequest { filter, limit })
    }
}

/// A kind that can be asked for.
fn asked_kind(id: &str) -> Option<JobKind> {
    JobKind::from_id(id).filter(|kind| JobKind::ALL.contains(kind))
}

fn invalid(kind: &'static str, title: &'static str, parameter: &str, value: &str, message: &str) -> Problem {
    Problem::new(StatusCode::UNPROCESSABLE_ENTITY, kind, title, format!("{parameter}: {message}"))
        .with("parameter", parameter)
        .with("value", brief(value))
}

fn name<T>(parameter: &str, value: &str, read: impl Fn(&str) -> Option<T>, allowed: &[&str]) -> Result<T, Problem> {
    read(value).ok_or_else(|| {
        let allowed = allowed.join(", ");
        let message = format!("{:?} is not known; allowed: {allowed}", brief(value));
        invalid("/problems/unknown", "A name is not known", parameter, value, &message).with("allowed", allowed)
    })
}

fn wrong_label(label: &str, wrong: &Wrong) -> Problem {
    let message = wrong.to_string();
    match wrong {
        Wrong::TooMany { found, .. } => invalid("/problems/too-long", "Longer than allowed", "label", label, &message)
            .with("found", *found)
            .with("most", LABEL_CHARS),
        _ => invalid("/problems/malformed", "Not the text that is needed", "label", label, &message)
            .with("message", message),
    }
}

fn read_limit(text: &str) -> Result<i64, Problem> {
    let [min, max] = LIMITS;
    let number = text.parse().ok().filter(|number| (min..=max).contains(number));
    number.ok_or_else(|| {
        let message = format!("{:?} is not a whole number from {min} to {max}", brief(text));
        let title = "A number is outside its allowed range";
        invalid("/problems/out-of-range", title, "limit", text, &message).with("min", min).with("max", max)
    })
}

/// Where the page that ends with this job goes on.
pub fn cursor(owner: &str, last: Uuid) -> String {
    hex::encode([&binding(owner, last)[..], &last.as_bytes()[..]].concat())
}

fn binding(owner: &str, last: Uuid) -> [u8; BINDING] {
    let mut hasher = blake3::Hasher::new_derive_key("adaptarm 2026 cursor of a list of jobs");
    hasher.update(last.as_bytes());
    hasher.update(owner.as_bytes());
    let mut binding = [0; BINDING];
    hasher.finalize_xof().fill(&mut binding);
    binding
}

fn read_cursor(owner: &str, text: &str) -> Result<Uuid, Problem> {
    let mut bytes = [0; BINDING + 16];
    if hex::decode_to_slice(text, &mut bytes).is_err() {
        let message = "not a cursor: use `next_cursor` of the page before as it is";
        let problem = invalid("/problems/malformed", "Not the text that is needed", "cursor", text, message);
        return Err(problem.with("message", message));
    }
    let (bound, id) = bytes.split_at(BINDING);
    let id = Uuid::from_slice(id).unwrap_or_default();
    // Another user's list is as unknown as that user's jobs.
    if bound == binding(owner, id) { Ok(id) } else { Err(Problem::not_found("page of your jobs at the cursor", text)) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_cursor_leads_its_owner_on_and_nobody_else() {
        let id = Uuid::now_v7();
        let cursor = cursor("ana", id);
        assert_eq!(read_cursor("ana", &cursor), Ok(id));
        assert_eq!(read_cursor("bob", &cursor).unwrap_err().status, 404);
        for wrong in ["", "x", &cursor[2..], &id.to_string(), &cursor.replace(|_| true, "é")] {
            let problem = read_cursor("ana", wrong).unwrap_err();
            assert_eq!((problem.status, &problem.fields["parameter"]), (422, &"cursor".into()), "{wrong}");
        }
    }

    #[test]
    fn every_parameter_says_what_it_takes() {
        let check = |query: JobsQuery| query.check("ana");
        let text = |text: &str| Some(text.to_owned());
        let usual = PageRequest { filter: Filter::default(), limit: 50 };
        assert_eq!(check(JobsQuery::default()), Ok(usual.clone()));
        assert_eq!(
            check(JobsQuery { limit: text("200"), ..JobsQuery::default() }),
            Ok(PageRequest { limit: 200, ..usual })
        );
        for (query, kind, words) in [
            (JobsQuery { limit: text("0"), ..JobsQuery::default() }, "/problems/out-of-range", "from 1 to 200"),
            (JobsQuery { limit: text("201"), ..JobsQuery::default() }, "/problems/out-of-range", "from 1 to 200"),
            (JobsQuery { limit: text("ten"), ..JobsQuery::default() }, "/problems/out-of-range", "from 1 to 200"),
            (JobsQuery { state: text("done"), ..JobsQuery::default() }, "/problems/unknown", "queued, running"),
            (JobsQuery { kind: text("sprint"), ..JobsQuery::default() }, "/problems/unknown", "study"),
            (JobsQuery { label: text(&"x".repeat(201)), ..JobsQuery::default() }, "/problems/too-long", "200"),
            (JobsQuery { label: text("a\0"), ..JobsQuery::default() }, "/problems/malformed", "control characters"),
        ] {
            let problem = check(query).unwrap_err();
            assert_eq!((problem.status, problem.kind), (422, kind), "{problem:?}");
            assert!(problem.detail.contains(words), "{problem:?}");
        }
    }

    proptest! {
        #[test]
        fn takes_any_text(text in ".{0,80}") {
            let some = || Some(text.clone());
            let query = JobsQuery { state: None, kind: None, label: some(), limit: some(), cursor: some() };
            if let Err(problem) = query.check("ana") {
                prop_assert!(problem.detail.chars().count() < 1000);
            }
        }
    }
}
