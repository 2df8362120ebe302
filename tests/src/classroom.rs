//! People of a classroom: visitors with a browser's cookie and the token of its session, and an exercise for them that is
//! graded within milliseconds.

use crate::client::{Answer, Client, surely};
use crate::events::Events;
use crate::server::{Launch, Server};
use anyhow::{Context, Result, ensure};
use serde_json::{Value, json};
use std::path::Path;
use std::time::Duration;

/// Where all of it is.
pub const ROOT: &str = "/api/v1/classroom";

/// Longer than a grade takes on a busy machine.
const PATIENCE: Duration = Duration::from_mins(2);

/// A pendulum held by PD against gravity, which differs from variant to variant. Stiff gains solve it, soft ones do not.
pub const HOLD: &str = r#"
format = "adaptarm.exercise/1"
id = "hold"
level = "first"
minutes = 10
title = { en = "Hold it", es = "Sujétalo" }
goal = { en = "Hold a pendulum", es = "Sujetar un péndulo" }
statement = { en = "Find gains.", es = "Encuentra ganancias." }
explanation = { en = "EXPLANATION-OF-HOLD", es = "EXPLICACIÓN" }
teacher_note = { en = "NOTE-FOR-TEACHERS", es = "NOTA" }
hints = [
    { after_attempts = 0, text = { en = "HINT-ONE", es = "PISTA" } },
    { after_attempts = 2, text = { en = "HINT-TWO", es = "PISTA" } },
]
moves = [
    { name = "k_p", label = { en = "k_p", es = "k_p" }, fields = ["/scheme/gains/k_p/0"], min = 0.0, max = 500.0, start = 20.0 },
    { name = "k_d", label = { en = "k_d", es = "k_d" }, fields = ["/scheme/gains/k_d/0"], min = 0.0, max = 50.0, start = 2.0 },
]
criteria = [
    { id = "error", label = { en = "error", es = "error" }, metric = "e_peak_deg", full = 2.0, zero = 12.0, weight = 6.0 },
    { id = "effort", label = { en = "effort", es = "esfuerzo" }, metric = "tau_peak_nm", full = 30.0, zero = 60.0, weight = 4.0 },
]
solutions = [{ name = "solution-stiff", gains = { k_p = 400.0, k_d = 20.0 } }]

[scenario]
format = "adaptarm.scenario/1"
robot = "pendulum"
scheme = { kind = "pd", gains = { k_p = [20.0], k_d = [2.0] } }
integration = { duration_s = 1.0 }
recording = { samples = 100 }

[visible]
count = 2
fields = [{ field = "/plant/theta_scale/3", distribution = { kind = "uniform", min = 0.8, max = 1.2 } }]

[hidden]
count = 3
vary_seed = true
fields = [{ field = "/plant/theta_scale/3", distribution = { kind = "uniform", min = 0.7, max = 1.3 } }]
"#;

/// Gains that solve it, and some that do not.
pub fn stiff() -> Value {
    json!({ "k_p": 400.0, "k_d": 20.0 })
}

/// See [`stiff`].
pub fn soft() -> Value {
    json!({ "k_p": 20.0, "k_d": 2.0 })
}

/// A server whose library has that exercise, from a folder that lives as long as the server.
pub fn school(launch: Launch) -> Result<(Server, tempfile::TempDir)> {
    let folder = tempfile::tempdir()?;
    std::fs::write(folder.path().join("hold.toml"), HOLD)?;
    let path = folder.path().to_str().context("the folder's name is not UTF-8")?;
    let server = launch.variable("ADAPTARM_CLASSROOM_EXERCISES", path).serve()?;
    Ok((server, folder))
}

/// A link for a teacher of a server with these data.
pub fn teacher_link(server: &Server, arguments: &[&str]) -> Result<String> {
    let mut command = std::process::Command::new(crate::binary()?);
    let data: &Path = server.data.path();
    let output = command.args(["teacher", "link", "--data"]).arg(data).args(arguments).output()?;
    ensure!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    Ok(String::from_utf8(output.stdout)?.trim().to_owned())
}

/// What stands behind `#name=` in a link.
pub fn secret(link: &str, name: &str) -> Result<String> {
    let found = link.split_once(&format!("#{name}=")).context("not such a link")?;
    Ok(found.1.to_owned())
}

/// Someone with a browser.
#[derive(Debug, Clone)]
pub struct Visitor {
    client: Client,
    /// The session's cookie as it is sent.
    pub cookie: Option<String>,
    /// The session's token.
    pub csrf: String,
    /// What the server said of the session.
    pub session: Value,
}

impl Visitor {
    /// Someone whom the server does not know.
    pub fn new(url: &str) -> Self {
        Self { client: Client::new(url), cookie: None, csrf: String::new(), session: Value::Null }
    }

    /// The same browser with this cookie instead of its own.
    pub fn with_cookie(self, cookie: Option<String>) -> Self {
        Self { cookie, ..self }
    }

    /// The first teacher of a server.
    pub fn teacher(server: &Server, login: &str, arguments: &[&str]) -> Result<Self> {
        let mut visitor = Self::new(&server.url);
        let invitation = secret(&teacher_link(server, arguments)?, "invitation")?;
        visitor.enter("/teachers", &json!({ "invitation": invitation, "name": "Teacher", "login": login }))?;
        Ok(visitor)
    }

    /// Someone who joins a class.
    pub fn student(url: &str, code: &str, name: &str) -> Result<Self> {
        let mut visitor = Self::new(url);
        visitor.enter("/students", &json!({ "code": code, "name": name }))?;
        Ok(visitor)
    }

    /// Sends what lets someone in, which must work, and keeps the session.
    pub fn enter(&mut self, path: &str, body: &Value) -> Result<()> {
        let answer = self.post(path, body)?;
        self.session = answer.expect(201)?;
        let cookie = answer.header("set-cookie").split(';').next().unwrap_or_default();
        self.cookie = Some(cookie.to_owned());
        self.csrf = self.text("csrf")?;
        Ok(())
    }

    /// A text of what the server said of the session.
    pub fn text(&self, field: &str) -> Result<String> {
        Ok(self.session[field].as_str().with_context(|| format!("{field}: {}", self.session))?.to_owned())
    }

    /// Identifier.
    pub fn id(&self) -> Result<String> {
        self.text("id")
    }

    /// Sends a request as this person's browser does; `path` is below the classroom's.
    pub fn send(&self, method: &str, path: &str, more: &[(&str, &str)], body: Option<&Value>) -> Result<Answer> {
        let mut headers = more.to_vec();
        headers.extend(self.cookie.as_deref().map(|cookie| ("cookie", cookie)));
        if !self.csrf.is_empty() && !more.iter().any(|(name, _)| *name == "x-csrf-token") {
            headers.push(("x-csrf-token", &self.csrf));
        }
        let body = body.map(Value::to_string);
        if body.is_some() {
            headers.push(("content-type", "application/json"));
        }
        self.client.send(method, &format!("{ROOT}{path}"), &headers, body.unwrap_or_default().as_bytes())
    }

    /// GET.
    pub fn get(&self, path: &str) -> Result<Answer> {
        self.send("GET", path, &[], None)
    }

    /// POST of JSON.
    pub fn post(&self, path: &str, body: &Value) -> Result<Answer> {
        self.send("POST", path, &[], Some(body))
    }

    /// PUT of JSON.
    pub fn put(&self, path: &str, body: &Value) -> Result<Answer> {
        self.send("PUT", path, &[], Some(body))
    }

    /// PATCH of JSON.
    pub fn patch(&self, path: &str, body: &Value) -> Result<Answer> {
        self.send("PATCH", path, &[], Some(body))
    }

    /// DELETE.
    pub fn delete(&self, path: &str) -> Result<Answer> {
        self.send("DELETE", path, &[], None)
    }

    /// Makes a class; its identifier and its code.
    pub fn class(&self, name: &str) -> Result<(String, String)> {
        let class = self.post("/classes", &json!({ "name": name }))?.expect(201)?;
        let text = |field: &str| Ok::<_, anyhow::Error>(class[field].as_str().context("no text")?.to_owned());
        Ok((text("id")?, text("code")?))
    }

    /// Gives an exercise to a class under these conditions; its identifier.
    pub fn give(&self, class: &str, conditions: &Value) -> Result<String> {
        let given = self.post(&format!("/classes/{class}/assignments"), conditions)?.expect(201)?;
        Ok(given["id"].as_str().context("no identifier")?.to_owned())
    }

    /// Hands gains in, which must be taken; the attempt's identifier.
    pub fn hand_in(&self, assignment: &str, gains: &Value) -> Result<String> {
        let answer = self.post(&format!("/assignments/{assignment}/attempts"), &json!({ "gains": gains }))?;
        Ok(answer.expect(202)?["id"].as_str().context("no identifier")?.to_owned())
    }

    /// Hands gains in under a key, again and again until an answer comes, as one does when servers die.
    pub fn hand_in_surely(&self, assignment: &str, gains: &Value, key: &str) -> Result<String> {
        let (path, body) = (format!("/assignments/{assignment}/attempts"), json!({ "gains": gains }));
        let answer = surely(PATIENCE, || {
            let answer = self.send("POST", &path, &[("idempotency-key", key)], Some(&body));
            Ok(answer.ok().filter(|answer| answer.status < 500))
        })?;
        Ok(answer.expect(202)?["id"].as_str().context("no identifier")?.to_owned())
    }

    /// An attempt once it is graded or given back. A server that does not answer is asked again.
    pub fn graded(&self, attempt: &str) -> Result<Value> {
        surely(PATIENCE, || {
            let Ok(answer) = self.get(&format!("/attempts/{attempt}")) else { return Ok(None) };
            if answer.status >= 500 {
                return Ok(None);
            }
            let attempt = answer.expect(200)?;
            Ok((attempt["state"] != "grading").then_some(attempt))
        })
    }

    /// The events of an attempt, to their end.
    pub fn events(&self, attempt: &str) -> Result<Vec<crate::events::Event>> {
        let cookie = self.cookie.as_deref().unwrap_or_default();
        let path = format!("{ROOT}/attempts/{attempt}/events");
        let events: Events = self.client.stream(&path, &[("cookie", cookie)])?;
        events.collect()
    }
}
