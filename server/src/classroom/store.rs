//! The seam between the classroom and its tables, which lie beside those of the jobs: an attempt and the job that grades it
//! are written in one transaction.

use super::model::{Assignment, Attempt, Class, Extension, NewPerson, Note, Override, Person, Session, Settings};
use crate::config::Limits;
use crate::jobs::{JobState, NewJob, StoreError};
use async_trait::async_trait;
use jiff::Timestamp;
use serde_json::Value;
use uuid::Uuid;

/// What became of a link that was used, or of a code.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Entered {
    /// They are in.
    Done,
    /// There is no such link or code, or it is not good any more.
    Refused,
    /// The login is another's.
    Taken,
    /// The class has as many students as it may have.
    Full,
}

/// What a teacher changes. Each is written down together with what it was.
#[derive(Debug, Clone, PartialEq)]
pub enum Change {
    /// A new class.
    AddClass(Class),
    /// Its name, code and whether it is open.
    SetClass(Class),
    /// A class with everything in it.
    RemoveClass(Uuid),
    /// A student's name and number.
    SetStudent(Person),
    /// A student and everything of theirs.
    RemoveStudent(Uuid),
    /// An exercise is given out.
    AddAssignment(Assignment),
    /// Under other conditions.
    SetAssignment(Uuid, Settings),
    /// With its attempts.
    RemoveAssignment(Uuid),
    /// For one student.
    SetExtension(Extension),
    /// The student's extension ends.
    RemoveExtension {
        /// Of what.
        assignment: Uuid,
        /// Whose.
        student: Uuid,
    },
    /// A mark.
    Decide(Override),
}

/// An attempt that is handed in.
#[derive(Debug)]
pub struct NewAttempt {
    /// For what.
    pub assignment: Uuid,
    /// By whom.
    pub student: Uuid,
    /// Gains.
    pub gains: Value,
    /// The request's own name.
    pub key: Option<String>,
    /// The job that grades it.
    pub job: NewJob,
}

/// What became of it.
#[derive(Debug, Clone, PartialEq)]
pub enum Handed {
    /// It is on disk, and so is its job.
    In(Attempt),
    /// The same request made it before.
    Before(Attempt),
    /// It came too early or too late.
    Closed,
    /// So many were allowed, and they are used up.
    NoneLeft(u32),
    /// There is no such assignment any more.
    Gone,
}

/// An attempt whose job has ended.
#[derive(Debug, Clone, PartialEq)]
pub struct Ripe {
    /// The attempt.
    pub attempt: Attempt,
    /// How its job ended; nothing where nobody knows any more.
    pub job: Option<(JobState, Option<String>)>,
}

/// What an attempt ends with.
#[derive(Debug, Clone, PartialEq)]
pub enum Outcome {
    /// With its grade: JSON each.
    Graded {
        /// What its student may see.
        feedback: String,
        /// All of it.
        grade: String,
        /// The signed receipt.
        receipt: String,
        /// When, as the receipt says.
        graded_at: Timestamp,
    },
    /// Given back, for this reason.
    Returned(String),
}

/// What is kept of a grade beside what the student sees: JSON.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Papers {
    /// All of the grade.
    pub grade: Option<String>,
    /// The signed receipt.
    pub receipt: Option<String>,
}

/// Where the classroom is kept.
#[async_trait]
pub trait ClassroomStore: Send + Sync + 'static {
    /// The secret of this name; `fresh` becomes it if there is none yet.
    async fn secret(&self, name: &str, fresh: &str) -> Result<String, StoreError>;

    /// How many teachers there are.
    async fn teachers(&self) -> Result<i64, StoreError>;

    /// Keeps an invitation by its hash. `printed`: it is one that the server prints, of which the first one used voids the others.
    async fn invite(&self, hash: &str, printed: bool, expires_at: Timestamp) -> Result<(), StoreError>;

    /// Makes a teacher of whoever has this invitation, once.
    async fn redeem(&self, invitation: &str, teacher: &NewPerson) -> Result<Entered, StoreError>;

    /// Makes a student of whoever has a class's code; the student's class is set here.
    async fn join(&self, code: &str, student: &NewPerson, most: i64) -> Result<(Entered, Option<Uuid>), StoreError>;

    /// A person.
    async fn person(&self, id: Uuid) -> Result<Option<Person>, StoreError>;

    /// The person of this login.
    async fn person_by_login(&self, login: &str) -> Result<Option<Person>, StoreError>;

    /// The person whose key has this hash.
    async fn person_by_key(&self, hash: &str) -> Result<Option<Person>, StoreError>;

    /// Sets the password's hash, or takes it away; all sessions but one end.
    async fn set_password(&self, id: Uuid, password: Option<&str>, spared: &str) -> Result<(), StoreError>;

    /// Sets the key's hash; all sessions but one end.
    async fn set_key(&self, id: Uuid, hash: &str, spared: &str) -> Result<(), StoreError>;

    /// Forgets a student: attempts, jobs, sessions, marks.
    async fn erase(&self, id: Uuid) -> Result<(), StoreError>;

    /// Students of a class, in the order in which they joined.
    async fn students(&self, class: Uuid) -> Result<Vec<Person>, StoreError>;

    /// Begins a session and ends the one that the request came with.
    async fn open_session(&self, hash: &str, person: Uuid, ended: Option<&str>) -> Result<(), StoreError>;

    /// The session of this hash.
    async fn session(&self, hash: &str) -> Result<Option<Session>, StoreError>;

    /// Notes that a session was used.
    async fn touch_session(&self, hash: &str) -> Result<(), StoreError>;

    /// Ends a session.
    async fn close_session(&self, hash: &str) -> Result<(), StoreError>;

    /// Ends all sessions of a person but one; an empty hash spares none.
    async fn close_sessions(&self, person: Uuid, spared: &str) -> Result<(), StoreError>;

    /// Forgets sessions last used or begun before these moments.
    async fn forget_sessions(&self, used_before: Timestamp, begun_before: Timestamp) -> Result<u64, StoreError>;

    /// A class.
    async fn class(&self, id: Uuid) -> Result<Option<Class>, StoreError>;

    /// A teacher's classes, with their numbers of students.
    async fn classes(&self, teacher: Uuid) -> Result<Vec<(Class, i64)>, StoreError>;

    /// Changes something, and writes down who did it; whether there was something to change.
    async fn change(&self, change: &Change, note: &Note) -> Result<bool, StoreError>;

    /// What was written down about a class, newest first.
    async fn notes(&self, class: Uuid, limit: i64) -> Result<Vec<Note>, StoreError>;

    /// An assignment.
    async fn assignment(&self, id: Uuid) -> Result<Option<Assignment>, StoreError>;

    /// A class's assignments, oldest first.
    async fn assignments(&self, class: Uuid) -> Result<Vec<Assignment>, StoreError>;

    /// Extensions of an assignment.
    async fn extensions(&self, assignment: Uuid) -> Result<Vec<Extension>, StoreError>;

    /// Overrides of an assignment, oldest first.
    async fn overrides(&self, assignment: Uuid) -> Result<Vec<Override>, StoreError>;

    /// Takes an attempt, if its student may make one, and its job; all of it is on disk when this returns, or nothing.
    async fn hand_in(&self, attempt: &NewAttempt, limits: &Limits) -> Result<Handed, StoreError>;

    /// An attempt.
    async fn attempt(&self, id: Uuid) -> Result<Option<Attempt>, StoreError>;

    /// Attempts at an assignment, of one student or all, in the order of their numbers.
    async fn attempts(&self, assignment: Uuid, student: Option<Uuid>) -> Result<Vec<Attempt>, StoreError>;

    /// The rest of what is kept of an attempt's grade.
    async fn papers(&self, attempt: Uuid) -> Result<Papers, StoreError>;

    /// Attempts without a grade whose jobs have ended.
    async fn ripe(&self, limit: i64) -> Result<Vec<Ripe>, StoreError>;

    /// Ends an attempt that has not ended; whether this call did.
    async fn finish(&self, attempt: Uuid, outcome: &Outcome) -> Result<bool, StoreError>;
}
