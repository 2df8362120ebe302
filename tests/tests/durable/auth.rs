//! A server for several users: who is nobody, who is somebody else, whose token has ended, and how much one may ask.

use adaptarm_tests::client::Client;
use adaptarm_tests::workload::{scenario, study};
use adaptarm_tests::{Launch, Server};
use anyhow::{Context, Result, ensure};
use serde_json::json;
use std::time::Duration;

/// What may be asked about a job, by method and what follows its path.
const QUESTIONS: [(&str, &str); 9] = [
    ("GET", ""),
    ("GET", "/result"),
    ("GET", "/result/series"),
    ("GET", "/result/figures/tracking_errors.svg"),
    ("GET", "/result/figures/tracking_errors.png"),
    ("GET", "/scenarios/0"),
    ("GET", "/events"),
    ("POST", "/cancel"),
    ("DELETE", ""),
];

fn serve() -> Result<Server> {
    Launch::new().bind("0.0.0.0:0").serve()
}

fn small(seed: u64) -> serde_json::Value {
    let mut scenario = scenario("slotine_li", &json!({"duration_s": 0.1}));
    scenario["seed"] = json!(seed);
    study(&[scenario])
}

pub fn strangers() -> Result<()> {
    let server = serve()?;
    let nobody = Client::new(&server.url);
    let ada = nobody.with_token(&server.token("ada", &[])?);
    let eve = nobody.with_token(&server.token("eve", &[])?);
    let id = ada.submit(&small(1))?;
    ensure!(ada.wait(&id, Duration::from_mins(1))?["state"] == "succeeded", "her own job");
    ada.submit(&small(2))?;
    let path = format!("/api/v1/jobs/{id}");

    let forged = server.token("mallory", &[])?;
    let (start, last) = forged.split_at(forged.len() - 1);
    let forged = format!("{start}{}", if last == "0" { "1" } else { "0" });
    for stranger in [&nobody, &nobody.with_token("adaptarm_no"), &nobody.with_token(&forged)] {
        for (method, rest) in QUESTIONS {
            let answer = stranger.send(method, &format!("{path}{rest}"), &[], &[])?;
            ensure!(answer.status == 401, "{method} {rest} without a token: {answer}");
            ensure!(answer.header("www-authenticate").starts_with("Bearer"), "{method} {rest}: {answer}");
        }
        stranger.get("/api/v1/jobs")?.expect_status(401)?;
        stranger.get("/metrics")?.expect_status(401)?;
        stranger.post("/api/v1/jobs", &small(3))?.expect_status(401)?;
    }
    for public in ["/healthz", "/readyz", "/api/v1/presets", "/api/v1/openapi.json"] {
        nobody.get(public)?.expect_status(200)?;
    }

    let unknown = "/api/v1/jobs/01890a5d-ac96-774b-bcce-b302099a8057";
    for (method, rest) in QUESTIONS {
        let answer = eve.send(method, &format!("{path}{rest}"), &[], &[])?;
        let nothing = eve.send(method, &format!("{unknown}{rest}"), &[], &[])?;
        ensure!((answer.status, nothing.status) == (404, 404), "{method} {rest} of another user's: {answer}");
    }
    ensure!(eve.jobs("")?.is_empty() && ada.jobs("")?.len() == 2, "lists show one's own jobs");
    let page = ada.get("/api/v1/jobs?limit=1")?.expect(200)?;
    let cursor = page["next_cursor"].as_str().context("no cursor")?;
    let stolen = format!("/api/v1/jobs?limit=1&cursor={cursor}");
    eve.get(&stolen)?.expect_status(404)?;
    ada.get(&stolen)?.expect_status(200)?;
    // All of this harmed nothing.
    ensure!(ada.job(&id)?["state"] == "succeeded" && ada.result(&id)?["complete"] == true, "her job was harmed");
    for (method, rest) in &QUESTIONS[..5] {
        ada.send(method, &format!("{path}{rest}"), &[], &[])?.expect_status(200)?;
    }
    Ok(())
}

pub fn limits() -> Result<()> {
    let server = serve()?;
    let nobody = Client::new(&server.url);
    let secret = server.token("ada", &[])?;
    let ada = nobody.with_token(&secret);
    let reader = nobody.with_token(&server.token("ada", &["--scopes", "jobs:read"])?);
    let id = ada.submit(&small(1))?;
    reader.get(&format!("/api/v1/jobs/{id}"))?.expect_status(200)?;
    reader.post("/api/v1/jobs", &small(2))?.expect_status(403)?;
    reader.cancel(&id)?.expect_status(403)?;
    reader.delete(&format!("/api/v1/jobs/{id}"))?.expect_status(403)?;
    reader.get("/metrics")?.expect_status(403)?;
    let watcher = nobody.with_token(&server.token("watch", &["--scopes", "metrics:read"])?);
    watcher.get("/metrics")?.expect_status(200)?;
    watcher.get("/api/v1/jobs")?.expect_status(403)?;

    let public = secret.split('_').nth(1).context("a token without a public part")?;
    ensure!(server.tokens(&["list"])?.contains(public), "the list shows which tokens there are");
    ensure!(!server.tokens(&["list"])?.contains(&secret), "the list shows a secret");
    server.tokens(&["revoke", public])?;
    ada.get("/api/v1/jobs")?.expect_status(401)?;
    reader.get("/api/v1/jobs")?.expect_status(200)?;

    drop(server);
    let server = Launch::new().bind("0.0.0.0:0").variable("ADAPTARM_AUTH_REQUESTS_PER_MINUTE", "20").serve()?;
    let nobody = Client::new(&server.url);
    let busy = nobody.with_token(&server.token("ada", &[])?);
    let calm = nobody.with_token(&server.token("bob", &[])?);
    let answers = (0..60).map(|_| busy.get("/api/v1/jobs")).collect::<Result<Vec<_>>>()?;
    let refused = answers.iter().find(|answer| answer.status != 200).context("sixty requests at once were answered")?;
    ensure!(refused.status == 429 && !refused.header("retry-after").is_empty(), "{refused}");
    calm.get("/api/v1/jobs")?.expect_status(200)
}
