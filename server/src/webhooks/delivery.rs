//! One attempt at one call: what is sent, and what its outcome means for the queue.
//!
//! Only the answer's status counts.

use super::guard::{GuardedResolver, Policy, Refused};
use super::retry::{asked_pause, pause_after};
use super::signature::{SIGNATURE_HEADER, sign};
use super::target::Secret;
use super::tls::install_crypto_provider;
use jiff::Timestamp;
use reqwest::header::{CONTENT_TYPE, RETRY_AFTER};
use reqwest::{Client, Response, StatusCode, redirect};
use serde::{Deserialize, Serialize};
use std::error::Error;
use std::sync::{Arc, OnceLock};
use std::time::Duration;
use url::Url;
use uuid::Uuid;

/// Most of an answer that is read before hanging up, bytes.
const ANSWER_BYTES: usize = 16 << 10;

/// One call to make; holds all that it takes, so that it can wait in a queue.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Delivery {
    /// The event's identifier. The same in every attempt: by it a receiver knows what it has seen.
    pub event_id: String,
    /// What happened: `job.<state>`.
    pub event_type: String,
    /// The job it happened to.
    pub job: Uuid,
    /// Where to send.
    pub url: String,
    /// Key of the signature.
    pub secret: Secret,
    /// The body, JSON, sent as it stands.
    pub body: String,
    /// Number of the attempt; the first is 1.
    pub attempt: u32,
}

/// What an attempt came to. `why` is for the owner and for logs; it shows neither secret nor address.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Outcome {
    /// The receiver has it.
    Delivered,
    /// To be tried once more, as attempt number `attempt + 1`.
    Retry {
        /// How long to wait before that.
        after: Duration,
        /// What went wrong.
        why: String,
    },
    /// Never to be tried again.
    GiveUp {
        /// What went wrong.
        why: String,
    },
}

/// How long things may take.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Timing {
    /// To connect, TLS included.
    pub connect: Duration,
    /// For the whole call.
    pub total: Duration,
    /// The pause after the first failed attempt; the later ones are multiples of it.
    pub first_pause: Duration,
}

impl Default for Timing {
    fn default() -> Self {
        let [connect, total, first_pause] = [5, 10, 5].map(Duration::from_secs);
        Self { connect, total, first_pause }
    }
}

/// Makes calls. Cheap to clone.
#[derive(Debug, Clone)]
pub struct Sender {
    policy: Arc<Policy>,
    timing: Timing,
    // Built when first needed: it reads the system's certificates, which a server without webhooks need not have.
    client: Arc<OnceLock<Client>>,
}

/// A failed attempt.
enum Failure {
    /// Another attempt may do better, after the pause that the receiver asked for.
    Passing { why: String, asked: Option<Duration> },
    /// No attempt will do better.
    Lasting { why: String },
}

impl Sender {
    /// A sender with the usual patience.
    pub fn new(policy: Policy) -> Self {
        Self::with_timing(policy, Timing::default())
    }

    /// A sender with other patience.
    pub fn with_timing(policy: Policy, timing: Timing) -> Self {
        Self { policy: Arc::new(policy), timing, client: Arc::default() }
    }

    /// Makes one attempt.
    pub async fn deliver(&self, delivery: &Delivery) -> Outcome {
        match self.attempt(delivery).await {
            Ok(()) => Outcome::Delivered,
            Err(Failure::Lasting { why }) => Outcome::GiveUp { why },
            Err(Failure::Passing { why, asked }) => {
                match pause_after(delivery.attempt, self.timing.first_pause, asked) {
                    Some(after) => Outcome::Retry { after, why },
                    None => Outcome::GiveUp { why: format!("{why}; attempt {} was the last", delivery.attempt) },
                }
            }
        }
    }

    async fn attempt(&self, delivery: &Delivery) -> Result<(), Failure> {
        let url = Url::parse(&delivery.url)
            .map_err(|error| Failure::Lasting { why: format!("the webhook's address is wrong: {error}") })?;
        // The client's resolver is not asked about addresses.
        self.policy.check_literal(&url).map_err(|refused| Failure::Lasting { why: refused.to_string() })?;
        let now = Timestamp::now();
        let response = self
            .client()?
            .post(url)
            .header(CONTENT_TYPE, "application/json")
            .header("adaptarm-event-id", &delivery.event_id)
            .header("adaptarm-event-type", &delivery.event_type)
            .header(SIGNATURE_HEADER, sign(&delivery.secret, now.as_second(), &delivery.body))
            .body(delivery.body.clone())
            .send()
            .await
            .map_err(|error| Failure::of(&error))?;
        judge(&response, now)?;
        finish(response).await;
        Ok(())
    }

    fn client(&self) -> Result<&Client, Failure> {
        if let Some(client) = self.client.get() {
            return Ok(client);
        }
        let client = guarded_client(&self.policy, self.timing)
            .map_err(|error| Failure::Passing { why: causes(&error), asked: None })?;
        Ok(self.client.get_or_init(|| client))
    }
}

/// A client that connects only where the policy lets it, and nowhere by way of others: neither by redirects, because the place
/// they lead to was never checked, nor by the system's proxy.
pub fn guarded_client(policy: &Arc<Policy>, timing: Timing) -> reqwest::Result<Client> {
    install_crypto_provider();
    Client::builder()
        .user_agent(concat!("adaptarm/", env!("CARGO_PKG_VERSION")))
        .dns_resolver(GuardedResolver(Arc::clone(policy)))
        .redirect(redirect::Policy::none())
        .no_proxy()
        // Calls are rare; a connection kept for the next one would only go stale.
        .pool_max_idle_per_host(0)
        .connect_timeout(timing.connect)
        .timeout(timing.total)
        .build()
}

/// What an answer means.
fn judge(response: &Response, now: Timestamp) -> Result<(), Failure> {
    let status = response.status();
    if status.is_success() {
        return Ok(());
    }
    if status == StatusCode::GONE {
        return Err(Failure::Lasting { why: "the receiver answered 410 Gone".to_owned() });
    }
    let redirect = if status.is_redirection() { "; redirects are not followed" } else { "" };
    let asked = response.headers().get(RETRY_AFTER).and_then(|value| value.to_str().ok());
    Err(Failure::Passing {
        why: format!("the receiver answered {status}{redirect}"),
        asked: asked.and_then(|asked| asked_pause(asked, now)),
    })
}

/// Reads a little of an answer, since some receivers take a connection closed at once for a failure.
async fn finish(mut response: Response) {
    let mut read = 0;
    while let Ok(Some(chunk)) = response.chunk().await {
        read += chunk.len();
        if read > ANSWER_BYTES {
            break;
        }
    }
}

impl Failure {
    fn of(error: &reqwest::Error) -> Self {
        let mut cause: Option<&dyn Error> = Some(error);
        while let Some(error) = cause {
            if let Some(refused) = error.downcast_ref::<Refused>() {
                return Self::Lasting { why: refused.to_string() };
            }
            cause = error.source();
        }
        if error.is_builder() {
            return Self::Lasting { why: format!("the call cannot be written down: {}", causes(error)) };
        }
        let why = if error.is_timeout() { "the receiver took too long".to_owned() } else { causes(error) };
        Self::Passing { why, asked: None }
    }
}

/// What led to an error, outermost first. The client's own words hold the address, which may hold a key: left out.
pub fn causes(error: &reqwest::Error) -> String {
    let mut words = String::from(if error.is_connect() { "cannot connect" } else { "the call failed" });
    let mut cause = error.source();
    while let Some(error) = cause {
        let said = error.to_string();
        // Wrappers often repeat what they wrap.
        if !words.contains(&said) {
            words.push_str(": ");
            words.push_str(&said);
        }
        cause = error.source();
    }
    words
}
