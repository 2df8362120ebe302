//! Classes, their people and what they hand in, as the rest of the classroom knows them. The tables are the store's, the
//! form over HTTP is the views'.

use jiff::Timestamp;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use uuid::Uuid;

/// What someone is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Role {
    /// Has classes.
    Teacher,
    /// Is in one.
    Student,
}

impl Role {
    /// Its name over HTTP and in the database.
    pub fn id(self) -> &'static str {
        match self {
            Self::Teacher => "teacher",
            Self::Student => "student",
        }
    }

    /// The role of this name.
    pub fn from_id(id: &str) -> Option<Self> {
        [Self::Teacher, Self::Student].into_iter().find(|role| role.id() == id)
    }
}

/// A teacher or a student.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Person {
    /// Identifier.
    pub id: Uuid,
    /// What they are.
    pub role: Role,
    /// A student's class.
    pub class: Option<Uuid>,
    /// What they are called.
    pub name: String,
    /// The school's own identifier for a student.
    pub number: Option<String>,
    /// With a password, a way to sign in.
    pub login: String,
    /// The password's hash.
    pub password: Option<String>,
    /// Since when.
    pub created_at: Timestamp,
}

impl Person {
    /// Whose the jobs are that grade a student's attempts. No token has such an owner: its name has a colon.
    pub fn job_owner(id: Uuid) -> String {
        format!("student:{id}")
    }
}

/// Someone who is about to be.
#[derive(Debug, Clone)]
pub struct NewPerson {
    /// As [`Person`].
    pub person: Person,
    /// Hash of their secret key.
    pub key_hash: String,
}

/// A session, and whose.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Session {
    /// Whose.
    pub person: Person,
    /// When it began.
    pub created_at: Timestamp,
    /// When it was last used, to a minute.
    pub used_at: Timestamp,
}

/// A class.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Class {
    /// Identifier.
    pub id: Uuid,
    /// Whose.
    pub teacher: Uuid,
    /// What it is called.
    pub name: String,
    /// What students join by.
    pub code: String,
    /// Whether they can.
    pub joining: bool,
    /// Since when.
    pub created_at: Timestamp,
}

/// What becomes of attempts after the deadline.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Late {
    /// What each day that has begun costs, % of the points.
    pub percent_per_day: f64,
    /// The most that lateness costs, %.
    pub cap_percent: f64,
    /// For how many days attempts are taken.
    pub days: u32,
}

/// Which attempt the mark comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Counts {
    /// The one with the most points.
    Best,
    /// The last that was graded.
    Last,
}

/// When the worked explanation is shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Explanation {
    /// When nobody can hand in any more.
    AfterDeadline,
    /// At once.
    Now,
    /// Never.
    Never,
}

/// How an exercise is given out.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Settings {
    /// What it is called.
    pub title: String,
    /// From when on students see it; at once if not set.
    pub opens_at: Option<Timestamp>,
    /// Until when attempts are in time; for ever if not set.
    pub deadline: Option<Timestamp>,
    /// How many attempts a student has; as many as they like if not set.
    pub attempts: Option<u32>,
    /// Which of them counts.
    pub counts: Counts,
    /// What full credit is worth.
    pub points: f64,
    /// What becomes of late ones; none are taken if not set.
    pub late: Option<Late>,
    /// When the explanation is shown.
    pub explanation: Explanation,
    /// Whether hints unlock.
    pub hints: bool,
    /// Whether students see the points of others, without names.
    pub leaderboard: bool,
}

/// An exercise given to a class.
#[derive(Debug, Clone, PartialEq)]
pub struct Assignment {
    /// Identifier.
    pub id: Uuid,
    /// To whom.
    pub class: Uuid,
    /// The exercise's name in the library.
    pub exercise: String,
    /// The exercise as it was then.
    pub document: String,
    /// How.
    pub settings: Settings,
    /// Since when.
    pub created_at: Timestamp,
}

/// What one student has beyond the others.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Extension {
    /// Of what.
    pub assignment: Uuid,
    /// Who.
    pub student: Uuid,
    /// A later deadline; the class's if not set.
    pub deadline: Option<Timestamp>,
    /// More attempts.
    pub attempts: u32,
    /// Why.
    pub comment: String,
}

/// Where an attempt stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum AttemptState {
    /// Its runs are computed.
    Grading,
    /// It has its grade.
    Graded,
    /// The server failed: given back, and not counted.
    Returned,
}

impl AttemptState {
    /// Its name over HTTP and in the database.
    pub fn id(self) -> &'static str {
        match self {
            Self::Grading => "grading",
            Self::Graded => "graded",
            Self::Returned => "returned",
        }
    }

    /// The state of this name.
    pub fn from_id(id: &str) -> Option<Self> {
        [Self::Grading, Self::Graded, Self::Returned].into_iter().find(|state| state.id() == id)
    }
}

/// Gains that were handed in.
#[derive(Debug, Clone, PartialEq)]
pub struct Attempt {
    /// Identifier.
    pub id: Uuid,
    /// For what.
    pub assignment: Uuid,
    /// By whom.
    pub student: Uuid,
    /// The student's first one is 1.
    pub number: i64,
    /// The gains, as JSON.
    pub gains: Value,
    /// The job that computes its runs.
    pub job: Uuid,
    /// Where it stands.
    pub state: AttemptState,
    /// Why it was given back.
    pub reason: Option<String>,
    /// When it was handed in.
    pub submitted_at: Timestamp,
    /// When it got its grade.
    pub graded_at: Option<Timestamp>,
    /// What its student may see of the grade.
    pub feedback: Option<Feedback>,
}

/// What a student may see of a grade: nothing of it comes from one hidden variant alone.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Feedback {
    /// Share of full credit, 0 to 1.
    pub score: f64,
    /// How well each criterion is met.
    pub criteria: Vec<Value>,
}

/// A teacher's own decision about a mark.
#[derive(Debug, Clone, PartialEq)]
pub struct Override {
    /// Later ones have larger identifiers.
    pub id: Uuid,
    /// Of what.
    pub assignment: Uuid,
    /// Whose mark.
    pub student: Uuid,
    /// Who decided.
    pub teacher: Uuid,
    /// The mark; without one, that of the attempts counts again.
    pub points: Option<f64>,
    /// What full credit was worth then; marks follow when that changes. Unknown for those of the first version.
    pub of: Option<f64>,
    /// Why.
    pub comment: String,
    /// When.
    pub at: Timestamp,
}

/// Something that a teacher did.
#[derive(Debug, Clone, PartialEq)]
pub struct Note {
    /// Later ones have larger identifiers.
    pub id: Uuid,
    /// In which class.
    pub class: Uuid,
    /// Who.
    pub teacher: Uuid,
    /// When.
    pub at: Timestamp,
    /// What.
    pub what: String,
    /// With which values; people by their identifiers.
    pub data: Value,
}
