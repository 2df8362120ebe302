//! Learning platforms: a whole one in this process, and the real server as its tool.

mod forged;
mod grades;
mod lessons;

pub use forged::forged_launches;
pub use grades::crashes;
pub use lessons::{on_postgres, on_sqlite};

use adaptarm_tests::classroom::{Visitor, school};
use adaptarm_tests::client::Answer;
use adaptarm_tests::platform::{Browser, CLAIM, Platform, User};
use adaptarm_tests::{Launch, Server};
use anyhow::{Context, Result, ensure};
use serde_json::{Value, json};
use std::time::{Duration, Instant};

/// Longer than anything takes on a busy machine.
const PATIENCE: Duration = Duration::from_mins(1);

/// A server that a teacher registered a platform with.
struct Setting {
    platform: Platform,
    server: Server,
    teacher: Visitor,
    _exercises: tempfile::TempDir,
}

impl Setting {
    fn new() -> Result<Self> {
        Self::with(&[])
    }

    /// On the database that these arguments name.
    fn with(database: &[&str]) -> Result<Self> {
        let platform = Platform::start()?;
        let launch = Launch::new().arguments(database).variable("ADAPTARM_LTI_ALLOW", "127.0.0.0/8");
        let launch = launch.variable("ADAPTARM_LTI_LONGEST_RETRY_S", "1");
        let (server, folder) = school(launch)?;
        platform.knows(&server.url);
        let teacher = Visitor::teacher(&server, "ana.diaz", database)?;
        teacher.post("/lti/platforms", &platform.registration())?.expect(201)?;
        Ok(Self { platform, server, teacher, _exercises: folder })
    }

    fn browser(&self) -> Browser {
        Browser::new(&self.server.url)
    }

    /// Someone follows a link that was made for an assignment, or for none.
    fn follow(&self, user: &User, link: &str, assignment: Option<&str>) -> Result<(Browser, Answer)> {
        let mut browser = self.browser();
        let answer = browser.launch(&self.platform, |nonce| {
            let mut claims = self.platform.claims(user, link, nonce);
            if let Some(assignment) = assignment {
                claims[format!("{CLAIM}/custom")] = json!({ "assignment": assignment });
            }
            claims
        })?;
        Ok((browser, answer))
    }

    /// The same, and in.
    fn enter(&self, user: &User, link: &str, assignment: Option<&str>) -> Result<Visitor> {
        let (browser, answer) = self.follow(user, link, assignment)?;
        ensure!(answer.status == 303, "{answer}");
        browser.visitor()
    }

    /// A course's teacher makes an assignment, with a link of this name that leads to it; its identifier.
    fn assignment(&self, teacher: &User, link: &str) -> Result<String> {
        let mut browser = self.browser();
        let answer = browser.launch(&self.platform, |nonce| {
            let mut claims = self.platform.claims(teacher, link, nonce);
            claims[format!("{CLAIM}/custom")] = json!({ "exercise": "hold" });
            claims
        })?;
        let led = answer.header("location").to_owned();
        ensure!(answer.status == 303, "{answer}");
        Ok(led.split_once("/teach.html#assignment/").with_context(|| led.clone())?.1.to_owned())
    }
}

/// How the passing back of an assignment's grades stands, once it is as it should be. Asks as seldom as a page would.
fn standing(teacher: &Visitor, assignment: &str, wanted: impl Fn(&Value) -> bool) -> Result<Value> {
    let end = Instant::now() + PATIENCE;
    loop {
        let standing = teacher.get(&format!("/assignments/{assignment}/lti"))?.expect(200)?;
        if wanted(&standing) {
            return Ok(standing);
        }
        ensure!(Instant::now() < end, "grades are passed back so far: {standing}");
        std::thread::sleep(Duration::from_millis(500));
    }
}

/// Why a launch was refused.
fn reason(answer: &Answer) -> Result<String> {
    let problem = answer.expect(403)?;
    ensure!(problem["type"] == "/problems/lti", "{problem}");
    Ok(problem["reason"].as_str().context("no reason")?.to_owned())
}
