//! The statements of LTI, beside those of the classroom and in the same transactions where an arrival makes a person.

mod arrive;
mod passback;
mod platforms;

use super::SqlStore;
use crate::jobs::StoreError;
use crate::lti::{
    Arrival, Arrived, Context, DueItem, DueScore, Enrolled, Link, LtiStore, Member, Platform, Score, StaleLink,
    Standing,
};
use async_trait::async_trait;
use jiff::Timestamp;
use std::time::Duration;
use uuid::Uuid;

#[async_trait]
impl LtiStore for SqlStore {
    async fn kept_secret(&self, name: &str) -> Result<Option<String>, StoreError> {
        platforms::kept_secret(&self.read, name).await
    }

    async fn add_platform(&self, platform: &Platform) -> Result<bool, StoreError> {
        platforms::add(&self.write, platform).await
    }

    async fn platform(&self, id: Uuid) -> Result<Option<Platform>, StoreError> {
        platforms::find(&self.read, id).await
    }

    async fn platforms(&self) -> Result<Vec<Platform>, StoreError> {
        platforms::all(&self.read).await
    }

    async fn remove_platform(&self, id: Uuid, teacher: Option<Uuid>) -> Result<bool, StoreError> {
        platforms::remove(&self.write, id, teacher).await
    }

    async fn use_nonce(&self, nonce: &str, expires_at: Timestamp) -> Result<bool, StoreError> {
        platforms::use_nonce(&self.write, nonce, expires_at).await
    }

    async fn keep_ticket(&self, hash: &str, data: &str, expires_at: Timestamp) -> Result<(), StoreError> {
        platforms::keep_ticket(&self.write, hash, data, expires_at).await
    }

    async fn take_ticket(&self, hash: &str) -> Result<Option<String>, StoreError> {
        platforms::take_ticket(&self.write, hash).await
    }

    async fn arrive(&self, arrival: &Arrival, most: i64) -> Result<Arrived, StoreError> {
        arrive::arrive(&self.write, arrival, most).await
    }

    async fn known_as(&self, student: Uuid) -> Result<Option<(String, String)>, StoreError> {
        arrive::known_as(&self.read, student).await
    }

    async fn is_course_account(&self, person: Uuid) -> Result<bool, StoreError> {
        arrive::is_course_account(&self.read, person).await
    }

    async fn context_of(&self, class: Uuid) -> Result<Option<Context>, StoreError> {
        arrive::context_of(&self.read, class).await
    }

    async fn link(&self, context: Uuid, link: &str) -> Result<Option<Link>, StoreError> {
        arrive::link(&self.read, context, link).await
    }

    async fn set_link(
        &self,
        context: Uuid,
        link: &str,
        assignment: Uuid,
        line_item: Option<&str>,
    ) -> Result<(), StoreError> {
        arrive::set_link(&self.write, context, link, assignment, line_item).await
    }

    async fn enroll(&self, context: Uuid, members: &[Member], most: i64) -> Result<Enrolled, StoreError> {
        arrive::enroll(&self.write, context, members, most).await
    }

    async fn stale_links(&self) -> Result<Vec<StaleLink>, StoreError> {
        passback::stale(&self.read).await
    }

    async fn plan_scores(&self, stale: &StaleLink, scores: &[Score]) -> Result<(), StoreError> {
        passback::plan(&self.write, stale, scores).await
    }

    async fn due_items(&self, limit: i64, lease: Duration) -> Result<Vec<DueItem>, StoreError> {
        passback::due_items(&self.write, &self.read, limit, lease).await
    }

    async fn item_found(&self, id: Uuid, line_item: &str) -> Result<(), StoreError> {
        passback::item_found(&self.write, id, line_item).await
    }

    async fn item_failed(&self, id: Uuid, pause: Duration, error: &str) -> Result<(), StoreError> {
        passback::item_failed(&self.write, id, pause, error).await
    }

    async fn retry_all(&self) -> Result<(), StoreError> {
        passback::retry_all(&self.write).await
    }

    async fn due_scores(&self, limit: i64, lease: Duration) -> Result<Vec<DueScore>, StoreError> {
        passback::due_scores(&self.write, &self.read, limit, lease).await
    }

    async fn score_sent(&self, score: &DueScore) -> Result<(), StoreError> {
        passback::score_sent(&self.write, score).await
    }

    async fn score_failed(&self, score: &DueScore, pause: Duration, error: &str) -> Result<(), StoreError> {
        passback::score_failed(&self.write, score, pause, error).await
    }

    async fn standing(&self, assignment: Uuid) -> Result<Standing, StoreError> {
        passback::standing(&self.read, assignment).await
    }
}
