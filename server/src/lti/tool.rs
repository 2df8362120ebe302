//! What LTI's requests and its background work share: tables, the classroom's desk, this server's key, platforms' keys and
//! access tokens.

use super::access::AccessTokens;
use super::client::Caller;
use super::key::{ToolKey, generate};
use super::model::Platform;
use super::platform_keys::PlatformKeys;
use super::refusal::LtiError;
use super::store::LtiStore;
use crate::classroom::{Desk, secrets};
use crate::config::Config;
use crate::error::Problem;
use anyhow::Context;
use axum::http::StatusCode;
use std::sync::Arc;
use std::time::Duration;
use tokio::sync::OnceCell;
use tokio::task::spawn_blocking;
use uuid::Uuid;

/// Names of the secrets among the classroom's.
const KEY: &str = "lti key";
const STATES: &str = "lti states";

/// What asks platforms, as the settings allow.
pub fn caller(config: &Config) -> anyhow::Result<Caller> {
    Ok(Caller::new(config.lti.policy().context("lti.allow")?))
}

/// Shared by all requests.
pub struct Tool {
    /// The tables.
    pub store: Arc<dyn LtiStore>,
    /// The classroom.
    pub desk: Arc<Desk>,
    /// Asks platforms.
    pub caller: Caller,
    /// What they publish.
    pub platform_keys: PlatformKeys,
    /// What they let us in by.
    pub access: AccessTokens,
    /// The pause before a grade that could not be delivered is tried again.
    pub first_pause: Duration,
    /// The longest pause between two tries.
    pub longest_pause: Duration,
    key: OnceCell<ToolKey>,
    secret: OnceCell<String>,
}

impl Tool {
    /// Over these tables.
    pub fn new(store: Arc<dyn LtiStore>, desk: Arc<Desk>, config: &Config) -> anyhow::Result<Self> {
        Ok(Self {
            store,
            desk,
            caller: caller(config)?,
            platform_keys: PlatformKeys::default(),
            access: AccessTokens::default(),
            first_pause: Duration::from_secs_f64(config.lti.first_retry_s),
            longest_pause: Duration::from_secs_f64(config.lti.longest_retry_s),
            key: OnceCell::new(),
            secret: OnceCell::new(),
        })
    }

    /// This server's key; whoever needs it first makes it.
    pub async fn key(&self) -> Result<&ToolKey, LtiError> {
        self.key
            .get_or_try_init(|| async {
                let kept = if let Some(kept) = self.store.kept_secret(KEY).await? {
                    kept
                } else {
                    let fresh = spawn_blocking(generate).await.context("making the key was broken off")??;
                    // Another server may have been quicker: then its key is ours, too.
                    self.desk.store.secret(KEY, &fresh).await?
                };
                Ok(ToolKey::read(&kept)?)
            })
            .await
    }

    /// What states and nonces are made from.
    pub async fn secret(&self) -> Result<&str, LtiError> {
        let make = || async {
            let fresh = secrets::fresh().context("the system gives no random numbers")?;
            Ok::<_, LtiError>(self.desk.store.secret(STATES, &fresh).await?)
        };
        Ok(self.secret.get_or_try_init(make).await?)
    }

    /// Refuses to a course's account whatever would let people in by another way than the platform: it is all its teachers', and
    /// who does not teach the course any more must not have kept a key.
    pub async fn refuse_course_account(&self, person: Uuid) -> Result<(), Problem> {
        if !self.store.is_course_account(person).await.map_err(LtiError::from)? {
            return Ok(());
        }
        let detail = "this account is all the course's teachers', who come in by the learning platform alone";
        Err(Problem::new(StatusCode::FORBIDDEN, "/problems/course-account", "Not with a course's account", detail))
    }

    /// An access token of this scope.
    pub async fn token(&self, platform: &Platform, scope: &str) -> Result<String, LtiError> {
        self.access.token(&self.caller, self.key().await?, platform, scope).await
    }
}
