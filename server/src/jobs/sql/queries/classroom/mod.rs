//! The classroom's statements, beside those of the jobs and in the same transactions where an attempt is a job.

mod attempts;
mod change;
mod people;
mod read;
mod sessions;

use super::SqlStore;
use crate::classroom::model::{Assignment, Attempt, Class, Extension, NewPerson, Note, Override, Person, Session};
use crate::classroom::store::{Change, ClassroomStore, Entered, Handed, NewAttempt, Outcome, Papers, Ripe};
use crate::config::Limits;
use crate::jobs::StoreError;
use async_trait::async_trait;
use jiff::Timestamp;
use uuid::Uuid;

#[async_trait]
impl ClassroomStore for SqlStore {
    async fn secret(&self, name: &str, fresh: &str) -> Result<String, StoreError> {
        people::secret(&self.write, name, fresh).await
    }

    async fn teachers(&self) -> Result<i64, StoreError> {
        people::teachers(&self.read).await
    }

    async fn invite(&self, hash: &str, printed: bool, expires_at: Timestamp) -> Result<(), StoreError> {
        people::invite(&self.write, hash, printed, expires_at).await
    }

    async fn redeem(&self, invitation: &str, teacher: &NewPerson) -> Result<Entered, StoreError> {
        people::redeem(&self.write, invitation, teacher).await
    }

    async fn join(&self, code: &str, student: &NewPerson, most: i64) -> Result<(Entered, Option<Uuid>), StoreError> {
        people::join(&self.write, code, student, most).await
    }

    async fn person(&self, id: Uuid) -> Result<Option<Person>, StoreError> {
        people::person(&self.read, id).await
    }

    async fn person_by_login(&self, login: &str) -> Result<Option<Person>, StoreError> {
        people::by_login(&self.read, login).await
    }

    async fn person_by_key(&self, hash: &str) -> Result<Option<Person>, StoreError> {
        people::by_key(&self.read, hash).await
    }

    async fn set_password(&self, id: Uuid, password: Option<&str>, spared: &str) -> Result<(), StoreError> {
        people::set_password(&self.write, id, password, spared).await
    }

    async fn set_key(&self, id: Uuid, hash: &str, spared: &str) -> Result<(), StoreError> {
        people::set_key(&self.write, id, hash, spared).await
    }

    async fn erase(&self, id: Uuid) -> Result<(), StoreError> {
        change::erase(&self.write, id).await
    }

    async fn students(&self, class: Uuid) -> Result<Vec<Person>, StoreError> {
        people::students(&self.read, class).await
    }

    async fn open_session(&self, hash: &str, person: Uuid, ended: Option<&str>) -> Result<(), StoreError> {
        sessions::open(&self.write, hash, person, ended).await
    }

    async fn session(&self, hash: &str) -> Result<Option<Session>, StoreError> {
        sessions::find(&self.read, hash).await
    }

    async fn touch_session(&self, hash: &str) -> Result<(), StoreError> {
        sessions::touch(&self.write, hash).await
    }

    async fn close_session(&self, hash: &str) -> Result<(), StoreError> {
        sessions::close(&self.write, hash).await
    }

    async fn close_sessions(&self, person: Uuid, spared: &str) -> Result<(), StoreError> {
        let mut connection = self.write.acquire().await?;
        sessions::close_all(&mut connection, person, spared).await
    }

    async fn forget_sessions(&self, used_before: Timestamp, begun_before: Timestamp) -> Result<u64, StoreError> {
        sessions::forget(&self.write, used_before, begun_before).await
    }

    async fn class(&self, id: Uuid) -> Result<Option<Class>, StoreError> {
        read::class(&self.read, id).await
    }

    async fn classes(&self, teacher: Uuid) -> Result<Vec<(Class, i64)>, StoreError> {
        read::classes(&self.read, teacher).await
    }

    async fn change(&self, change: &Change, note: &Note) -> Result<bool, StoreError> {
        change::change(&self.write, change, note).await
    }

    async fn notes(&self, class: Uuid, limit: i64) -> Result<Vec<Note>, StoreError> {
        read::notes(&self.read, class, limit).await
    }

    async fn assignment(&self, id: Uuid) -> Result<Option<Assignment>, StoreError> {
        read::assignment(&self.read, id).await
    }

    async fn assignments(&self, class: Uuid) -> Result<Vec<Assignment>, StoreError> {
        read::assignments(&self.read, class).await
    }

    async fn extensions(&self, assignment: Uuid) -> Result<Vec<Extension>, StoreError> {
        read::extensions(&self.read, assignment).await
    }

    async fn overrides(&self, assignment: Uuid) -> Result<Vec<Override>, StoreError> {
        read::overrides(&self.read, assignment).await
    }

    async fn hand_in(&self, attempt: &NewAttempt, limits: &Limits) -> Result<Handed, StoreError> {
        let handed = attempts::hand_in(&self.write, attempt, limits).await;
        self.ring();
        handed
    }

    async fn attempt(&self, id: Uuid) -> Result<Option<Attempt>, StoreError> {
        attempts::attempt(&self.read, id).await
    }

    async fn attempts(&self, assignment: Uuid, student: Option<Uuid>) -> Result<Vec<Attempt>, StoreError> {
        attempts::attempts(&self.read, assignment, student).await
    }

    async fn papers(&self, attempt: Uuid) -> Result<Papers, StoreError> {
        attempts::papers(&self.read, attempt).await
    }

    async fn ripe(&self, limit: i64) -> Result<Vec<Ripe>, StoreError> {
        attempts::ripe(&self.read, limit).await
    }

    async fn finish(&self, attempt: Uuid, outcome: &Outcome) -> Result<bool, StoreError> {
        attempts::finish(&self.write, attempt, outcome).await
    }
}
