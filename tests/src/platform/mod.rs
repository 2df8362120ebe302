//! A learning platform in this process, as LTI 1.3 wants one: it signs its users' launches, publishes its keys, gives out access
//! tokens to whoever shows a good assertion, lists members, and keeps a gradebook. Everything that the tool sends is checked.

mod browser;
mod forge;
mod gradebook;
mod services;

pub use browser::{Begun, Browser, hidden};
pub use forge::{Key, Signed};
pub use gradebook::Posted;

use anyhow::{Context, Result, ensure};
use gradebook::Gradebook;
use serde_json::{Value, json};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use tokio::net::TcpListener;
use tokio::runtime::{self, Runtime};

/// What the platform calls the tool.
pub const CLIENT: &str = "adaptarm-client";
/// Its only deployment that is registered.
pub const DEPLOYMENT: &str = "deployment-1";

/// Prefix of LTI's claims.
pub const CLAIM: &str = "https://purl.imsglobal.org/spec/lti/claim";
const ROLE: &str = "http://purl.imsglobal.org/vocab/lis/v2/membership#";

/// What requests share.
#[derive(Debug)]
struct Shared {
    url: String,
    key: Key,
    /// Where the tool is, once it is known.
    tool: Mutex<String>,
    tokens: Mutex<Vec<(String, String)>>,
    members: Mutex<Vec<Value>>,
    gradebook: Mutex<Gradebook>,
    /// Whether it answers 503 to everything but logins.
    down: AtomicBool,
    /// Whether it takes scores without ever saying so.
    mute: AtomicBool,
}

/// A running platform; it ends with this value.
#[derive(Debug)]
pub struct Platform {
    shared: Arc<Shared>,
    _runtime: Runtime,
}

/// What is said even by one who panicked.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A user, and their course.
#[derive(Debug, Clone)]
pub struct User {
    /// The platform's name for them.
    pub subject: String,
    /// What they are called.
    pub name: String,
    /// `Instructor` or `Learner`.
    pub role: String,
    /// The course.
    pub context: String,
}

impl User {
    /// Someone in the course `robotics`.
    pub fn new(subject: &str, role: &str) -> Self {
        let [subject, name, role, context] = [subject, subject, role, "robotics"].map(str::to_owned);
        Self { subject, name, role, context }
    }

    /// In another course.
    pub fn of(self, context: &str) -> Self {
        Self { context: context.to_owned(), ..self }
    }
}

impl Platform {
    /// Starts one on a free port of the loopback address.
    pub fn start() -> Result<Self> {
        let runtime = runtime::Builder::new_multi_thread().worker_threads(1).enable_all().build()?;
        let listener = runtime.block_on(TcpListener::bind("127.0.0.1:0"))?;
        let shared = Arc::new(Shared {
            url: format!("http://{}", listener.local_addr()?),
            key: Key::new("key-1")?,
            tool: Mutex::default(),
            tokens: Mutex::default(),
            members: Mutex::default(),
            gradebook: Mutex::default(),
            down: AtomicBool::new(false),
            mute: AtomicBool::new(false),
        });
        let app = services::router(shared.clone());
        runtime.spawn(async move { axum::serve(listener, app).await });
        Ok(Self { shared, _runtime: runtime })
    }

    /// Address; also what it calls itself.
    pub fn url(&self) -> &str {
        &self.shared.url
    }

    /// Tells it where the tool is.
    pub fn knows(&self, tool: &str) {
        tool.clone_into(&mut lock(&self.shared.tool));
    }

    /// What a teacher registers.
    pub fn registration(&self) -> Value {
        let url = self.url();
        json!({
            "issuer": url, "client_id": CLIENT, "auth_url": format!("{url}/auth"), "token_url": format!("{url}/token"),
            "keys_url": format!("{url}/keys"), "deployments": [DEPLOYMENT],
        })
    }

    /// Members that its list names, two on a page.
    pub fn set_members(&self, members: Vec<Value>) {
        *lock(&self.shared.members) = members;
    }

    /// Stops answering for its services, or begins again.
    pub fn set_down(&self, down: bool) {
        self.shared.down.store(down, Ordering::SeqCst);
    }

    /// Takes scores without ever saying so, or answers again.
    pub fn set_mute(&self, mute: bool) {
        self.shared.mute.store(mute, Ordering::SeqCst);
    }

    /// Scores that arrived, in order; each has its column.
    pub fn scores(&self) -> Vec<Posted> {
        lock(&self.shared.gradebook).posted.clone()
    }

    /// Adds a column and gives its address.
    pub fn add_column(&self, link: &str) -> String {
        let mut gradebook = lock(&self.shared.gradebook);
        let column = gradebook.add(self.url(), &json!({ "resourceLinkId": link, "label": link, "scoreMaximum": 100 }));
        column["id"].as_str().unwrap_or_default().to_owned()
    }

    /// Columns of its gradebook.
    pub fn columns(&self) -> Vec<Value> {
        lock(&self.shared.gradebook).columns.clone()
    }

    /// Claims of a user who follows a link in their course.
    pub fn claims(&self, user: &User, link: &str, nonce: &str) -> Value {
        let (url, now) = (self.url(), jiff::Timestamp::now().as_second());
        let tool = lock(&self.shared.tool).clone();
        let mut claims = json!({
            "iss": url, "aud": CLIENT, "sub": user.subject, "name": user.name, "iat": now, "exp": now + 60, "nonce": nonce,
            "https://purl.imsglobal.org/spec/lti-nrps/claim/namesroleservice": {
                "context_memberships_url": format!("{url}/members"), "service_versions": ["2.0"],
            },
            "https://purl.imsglobal.org/spec/lti-ags/claim/endpoint": {
                "scope": [
                    "https://purl.imsglobal.org/spec/lti-ags/scope/lineitem",
                    "https://purl.imsglobal.org/spec/lti-ags/scope/score",
                ],
                "lineitems": format!("{url}/columns"),
            },
        });
        let own = [
            ("message_type", json!("LtiResourceLinkRequest")),
            ("version", json!("1.3.0")),
            ("deployment_id", json!(DEPLOYMENT)),
            ("target_link_uri", json!(format!("{tool}/lti/launch"))),
            ("roles", json!([format!("{ROLE}{}", user.role)])),
            ("context", json!({ "id": user.context, "title": "Robotics" })),
            ("resource_link", json!({ "id": link })),
        ];
        for (name, value) in own {
            claims[format!("{CLAIM}/{name}")] = value;
        }
        claims
    }

    /// The same, choosing an exercise.
    pub fn choosing(&self, user: &User, nonce: &str) -> Value {
        let mut claims = self.claims(user, "none", nonce);
        claims[format!("{CLAIM}/message_type")] = json!("LtiDeepLinkingRequest");
        claims["https://purl.imsglobal.org/spec/lti-dl/claim/deep_linking_settings"] = json!({
            "deep_link_return_url": format!("{}/chosen", self.url()), "accept_types": ["ltiResourceLink"],
            "accept_presentation_document_targets": ["iframe", "window"], "data": "opaque <data>",
        });
        claims
    }

    /// Its own key.
    pub fn key(&self) -> &Key {
        &self.shared.key
    }

    /// The claims of a token that the tool signed, which must be good.
    pub fn read_tool_s_token(&self, token: &str) -> Result<Value> {
        let tool = lock(&self.shared.tool).clone();
        ensure!(!tool.is_empty(), "nobody told where the tool is");
        let keys = crate::client::Client::new(&tool).get("/lti/keys")?.expect(200)?;
        forge::verify(token, &keys).context("the tool's token")
    }
}
