//! The seam between LTI and its tables, which lie beside those of the classroom: whoever arrives from a platform becomes a person
//! of a class in one transaction.

use super::model::{
    Arrival, Arrived, Context, DueItem, DueScore, Enrolled, Link, Member, Platform, Score, StaleLink, Standing,
};
use crate::jobs::StoreError;
use async_trait::async_trait;
use jiff::Timestamp;
use std::time::Duration;
use uuid::Uuid;

/// Where platforms are kept, and what of theirs is what of ours.
#[async_trait]
pub trait LtiStore: Send + Sync + 'static {
    /// The secret of this name, if there is one; the classroom's tables hold it.
    async fn kept_secret(&self, name: &str) -> Result<Option<String>, StoreError>;

    /// Keeps a platform; whether its issuer has not registered this client before.
    async fn add_platform(&self, platform: &Platform) -> Result<bool, StoreError>;

    /// A platform.
    async fn platform(&self, id: Uuid) -> Result<Option<Platform>, StoreError>;

    /// Platforms, oldest first.
    async fn platforms(&self) -> Result<Vec<Platform>, StoreError>;

    /// Forgets a platform, and whom and what it calls how; classes stay. Whether there was one, of this teacher if one is named.
    async fn remove_platform(&self, id: Uuid, teacher: Option<Uuid>) -> Result<bool, StoreError>;

    /// Uses up a nonce; whether it had not been used. Those that are past their time are forgotten.
    async fn use_nonce(&self, nonce: &str, expires_at: Timestamp) -> Result<bool, StoreError>;

    /// Keeps a ticket.
    async fn keep_ticket(&self, hash: &str, data: &str, expires_at: Timestamp) -> Result<(), StoreError>;

    /// What a ticket is good for, once.
    async fn take_ticket(&self, hash: &str) -> Result<Option<String>, StoreError>;

    /// Finds or makes class and person of whoever arrives. A class has at most so many students.
    async fn arrive(&self, arrival: &Arrival, most: i64) -> Result<Arrived, StoreError>;

    /// A student's platform, and what it calls them, if they came by one.
    async fn known_as(&self, student: Uuid) -> Result<Option<(String, String)>, StoreError>;

    /// Whether an account has the class of a course.
    async fn is_course_account(&self, person: Uuid) -> Result<bool, StoreError>;

    /// The course of a class.
    async fn context_of(&self, class: Uuid) -> Result<Option<Context>, StoreError>;

    /// A link of a course.
    async fn link(&self, context: Uuid, link: &str) -> Result<Option<Link>, StoreError>;

    /// Notes what a link leads to, and its column in the gradebook if that is known.
    async fn set_link(
        &self,
        context: Uuid,
        link: &str,
        assignment: Uuid,
        line_item: Option<&str>,
    ) -> Result<(), StoreError>;

    /// Takes over a list of members: new ones come in, names and numbers are brought up to date, nobody is removed.
    async fn enroll(&self, context: Uuid, members: &[Member], most: i64) -> Result<Enrolled, StoreError>;

    /// Links whose assignment's marks may have changed since scores were last made from them.
    async fn stale_links(&self) -> Result<Vec<StaleLink>, StoreError>;

    /// Notes which scores a platform should have by the marks of that probe; those that have changed are to be sent.
    async fn plan_scores(&self, stale: &StaleLink, scores: &[Score]) -> Result<(), StoreError>;

    /// Takes links whose column must be looked for or made; for this long nobody else takes them.
    async fn due_items(&self, limit: i64, lease: Duration) -> Result<Vec<DueItem>, StoreError>;

    /// A link's column is known.
    async fn item_found(&self, id: Uuid, line_item: &str) -> Result<(), StoreError>;

    /// A link's column could not be had; to be tried again after this pause.
    async fn item_failed(&self, id: Uuid, pause: Duration, error: &str) -> Result<(), StoreError>;

    /// Whatever waits is due at once: whoever was sending it is known to be dead.
    async fn retry_all(&self) -> Result<(), StoreError>;

    /// Takes scores that are to be sent; for this long nobody else takes them.
    async fn due_scores(&self, limit: i64, lease: Duration) -> Result<Vec<DueScore>, StoreError>;

    /// The platform has this score; a later one still is to be sent.
    async fn score_sent(&self, score: &DueScore) -> Result<(), StoreError>;

    /// It could not be sent; to be tried again after this pause.
    async fn score_failed(&self, score: &DueScore, pause: Duration, error: &str) -> Result<(), StoreError>;

    /// How the passing back of an assignment's grades stands.
    async fn standing(&self, assignment: Uuid) -> Result<Standing, StoreError>;
}
