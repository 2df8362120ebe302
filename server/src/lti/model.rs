//! Platforms, and what of theirs is what of ours. The tables are the store's, the form over HTTP is the routes'.

use super::claims::Role;
use crate::classroom::model::{Class, NewPerson};
use jiff::Timestamp;
use serde::Serialize;
use uuid::Uuid;

/// A learning platform that a teacher registered.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Platform {
    /// Identifier.
    pub id: Uuid,
    /// Who registered it.
    #[serde(skip)]
    pub teacher: Uuid,
    /// What it calls itself.
    pub issuer: String,
    /// What it calls us.
    pub client_id: String,
    /// Where a login is answered.
    pub auth_url: String,
    /// Where access tokens are given out.
    pub token_url: String,
    /// Where its public keys are.
    pub keys_url: String,
    /// The deployments from which launches are taken.
    pub deployments: Vec<String>,
    /// Since when.
    pub created_at: Timestamp,
}

/// A platform's course and our class.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Context {
    /// Identifier.
    pub id: Uuid,
    /// Whose.
    pub platform: Uuid,
    /// Our class.
    pub class: Uuid,
    /// Where its members are listed.
    pub members_url: Option<String>,
    /// Where its gradebook's columns are.
    pub line_items_url: Option<String>,
}

/// Someone who comes by a launch. What is new is made ready here; the tables take of it what they need.
#[derive(Debug, Clone)]
pub struct Arrival {
    /// From where.
    pub platform: Uuid,
    /// From which deployment.
    pub deployment: String,
    /// From which course.
    pub context: String,
    /// As what.
    pub role: Role,
    /// Who, in the platform's words.
    pub subject: String,
    /// Who, if they have not been here before.
    pub student: NewPerson,
    /// Who has the course's class, if it has none yet.
    pub staff: NewPerson,
    /// The course's class, if it has none yet.
    pub class: Class,
    /// Where members are listed.
    pub members_url: Option<String>,
    /// Where the gradebook's columns are.
    pub line_items_url: Option<String>,
}

/// What became of them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Arrived {
    /// They are this person, in this course.
    In {
        /// Who.
        person: Uuid,
        /// Where.
        context: Context,
    },
    /// The class has as many students as it may have.
    Full,
}

/// A link in a course and our assignment.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Link {
    /// Identifier.
    pub id: Uuid,
    /// Our assignment.
    pub assignment: Uuid,
}

/// A member of a course, as the platform lists it.
#[derive(Debug, Clone)]
pub struct Member {
    /// Who, in the platform's words.
    pub subject: String,
    /// Who, if they have not been here before; name and number are taken over if they have.
    pub person: NewPerson,
}

/// What a list of members changed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
pub struct Enrolled {
    /// Students in the list.
    pub listed: usize,
    /// New ones.
    pub added: usize,
    /// Those for whom there was no room.
    pub left_out: usize,
}

/// A link whose assignment's marks may have changed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct StaleLink {
    /// The link.
    pub link: Link,
    /// What the marks follow from, as it is now.
    pub probe: String,
    /// Students who came by the platform.
    pub students: Vec<Uuid>,
}

/// A score that a platform should have.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Score {
    /// Whose.
    pub student: Uuid,
    /// None: there is no mark, and if there was one, it was taken back.
    pub points: Option<f64>,
    /// What full credit is worth.
    pub most: f64,
}

/// A link whose column in the gradebook is not known yet.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DueItem {
    /// Its identifier.
    pub id: Uuid,
    /// The platform's name for it.
    pub link: String,
    /// Our assignment.
    pub assignment: Uuid,
    /// Whose gradebook.
    pub platform: Platform,
    /// Where its columns are.
    pub line_items_url: String,
    /// Attempts so far.
    pub tries: u32,
}

/// A score to be sent.
#[derive(Debug, Clone, PartialEq)]
pub struct DueScore {
    /// Its identifier.
    pub id: Uuid,
    /// To whom.
    pub platform: Platform,
    /// Whose, in the platform's words.
    pub subject: String,
    /// The gradebook's column.
    pub line_item: String,
    /// Points; none if the mark was taken back.
    pub points: Option<f64>,
    /// What full credit is worth.
    pub most: f64,
    /// When it became this.
    pub at: Timestamp,
    /// Attempts so far.
    pub tries: u32,
}

/// How the passing back of an assignment's grades stands.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize)]
pub struct Standing {
    /// Links in courses.
    pub links: i64,
    /// Of them, those whose column in the gradebook is known.
    pub columns: i64,
    /// Scores that platforms have.
    pub sent: i64,
    /// Scores that wait.
    pub waiting: i64,
    /// What went wrong last with one that waits.
    pub error: Option<String>,
}
