//! Requests that are sent twice, wait for the end, or ask for page after page.

use crate::support::{App, JOBS, long, short, study};
use serde_json::{Value, json};
use std::collections::BTreeSet;

#[tokio::test]
async fn the_same_request_with_the_same_key_makes_one_job() {
    let app = App::new().await;
    let key = [("idempotency-key", "k-1")];
    let first = app.post_with(JOBS, study(&[short("proposed")]).to_string(), &key).await;
    assert_eq!((first.status.as_u16(), first.header("idempotency-replayed")), (202, ""));
    // Written in another way, with a default spelt out.
    let mut same = study(&[short("proposed")]);
    same["priority"] = json!(0);
    same["spec"]["scenarios"][0]["robot"] = json!("crs_a465");
    let again = app.post_with(JOBS, serde_json::to_string_pretty(&same).unwrap(), &key).await;
    assert_eq!(again.header("idempotency-replayed"), "true");
    assert_eq!(again.header("location"), first.header("location"));
    assert_eq!(app.get(JOBS).await.json()["jobs"].as_array().unwrap().len(), 1);
    for (pointer, value) in [
        ("/label", json!("x")),
        ("/priority", json!(1)),
        ("/webhook", json!({ "url": "https://example.org/", "secret": "0123456789abcdef" })),
        ("/spec/scenarios", json!([short("slotine_li")])),
    ] {
        let mut other = json!({ "label": null, "webhook": null, "priority": 0, "kind": "study", "spec": same["spec"] });
        *other.pointer_mut(pointer).unwrap() = value;
        let problem = app.post_with(JOBS, other.to_string(), &key).await.problem(422, "/problems/idempotency-key");
        assert_eq!(problem["value"], "k-1", "{pointer}");
    }
    let other_key = [("idempotency-key", "k-2")];
    let other = app.post_with(JOBS, study(&[short("proposed")]).to_string(), &other_key).await;
    assert_ne!(other.header("location"), first.header("location"));
}

#[tokio::test]
async fn requests_with_one_key_at_the_same_time_make_one_job() {
    let app = App::new().await;
    let body = study(&[short("proposed")]).to_string();
    let send = || app.post_with(JOBS, body.clone(), &[("idempotency-key", "race")]);
    let (a, b, c, d) = tokio::join!(send(), send(), send(), send());
    let all = [a, b, c, d];
    let jobs: BTreeSet<_> = all.iter().map(|answer| answer.header("location")).collect();
    assert_eq!((jobs.len(), all.iter().all(|answer| answer.status.is_success())), (1, true), "{all:?}");
}

#[tokio::test]
async fn keys_that_are_none_are_refused() {
    let app = App::new().await;
    for key in ["", "with space", &"x".repeat(201)] {
        let refused = app.post_with(JOBS, study(&[short("proposed")]).to_string(), &[("idempotency-key", key)]).await;
        let problem = refused.problem(400, "/problems/malformed-header");
        assert_eq!(problem["header"], "Idempotency-Key");
    }
}

#[tokio::test]
async fn who_waits_gets_the_end_if_it_comes_in_time() {
    let app = App::new().await;
    let ended = app.post_with(JOBS, study(&[short("proposed")]).to_string(), &[("prefer", "wait=600")]).await;
    assert_eq!((ended.status.as_u16(), ended.header("preference-applied")), (200, "wait=60"));
    assert_eq!(ended.json()["state"], "succeeded");
    assert!(ended.header("location").starts_with("/api/v1/jobs/"));
    let under_way = app.post_with(JOBS, study(&[long()]).to_string(), &[("prefer", "wait=1")]).await;
    assert_eq!((under_way.status.as_u16(), under_way.header("preference-applied")), (202, "wait=1"));
    assert_eq!(under_way.json()["state"], "running");
    let ignored = app.post_with(JOBS, study(&[short("slotine_li")]).to_string(), &[("prefer", "wait=soon")]).await;
    assert_eq!((ignored.status.as_u16(), ignored.header("preference-applied")), (202, ""));
}

#[tokio::test]
async fn an_end_by_cancel_ends_the_wait_too() {
    let app = App::new().await;
    let waiting = app.post_with(JOBS, study(&[long()]).to_string(), &[("prefer", "wait=50")]);
    let cancel = async {
        loop {
            if let Some(job) = app.get("/api/v1/jobs?state=running").await.json()["jobs"].get(0) {
                return app.ask("POST", job["links"]["cancel"].as_str().unwrap(), &[]).await;
            }
        }
    };
    let (answer, _) = tokio::join!(waiting, cancel);
    assert_eq!((answer.status.as_u16(), &answer.json()["state"]), (200, &json!("canceled")));
}

#[tokio::test]
async fn pages_hold_every_job_once_newest_first() {
    let app = App::with(|config| config.threads = Some(0)).await;
    let mut submitted = Vec::new();
    for n in 0..7 {
        let mut body = study(&[short("proposed")]);
        body["label"] = json!(if n % 2 == 0 { "even" } else { "odd" });
        submitted.push(app.post(JOBS, body.to_string()).await.header("location").to_owned());
    }
    submitted.reverse();
    let mut listed = Vec::new();
    let mut path = "/api/v1/jobs?limit=3".to_owned();
    let mut cursors = Vec::new();
    loop {
        let page = app.get(&path).await.json();
        listed.extend(
            page["jobs"].as_array().unwrap().iter().map(|job| job["links"]["self"].as_str().unwrap().to_owned()),
        );
        // A page goes on even if the job that it ended with is deleted.
        app.ask("DELETE", listed.last().unwrap(), &[]).await;
        let Some(cursor) = page["next_cursor"].as_str() else { break };
        cursors.push(cursor.to_owned());
        path = format!("/api/v1/jobs?limit=3&cursor={cursor}");
    }
    assert_eq!((listed, cursors.len()), (submitted, 2));
    let count = async |query: &str| app.get(&format!("{JOBS}?{query}")).await.json()["jobs"].as_array().unwrap().len();
    assert_eq!(count("label=even&state=queued&kind=study").await + count("label=odd").await, 4);
    assert_eq!((count("state=failed").await, count("label=none").await), (0, 0));
}

#[tokio::test]
async fn questions_that_make_no_sense_are_refused() {
    let app = App::new().await;
    for (query, status, kind) in [
        ("limit=0", 422, "/problems/out-of-range"),
        ("limit=201", 422, "/problems/out-of-range"),
        ("limit=-1", 422, "/problems/out-of-range"),
        ("state=done", 422, "/problems/unknown"),
        ("kind=survey", 422, "/problems/unknown"),
        ("cursor=abc", 422, "/problems/malformed"),
        ("label=a%00", 422, "/problems/malformed"),
        ("colour=red", 400, "/problems/http"),
        ("limit=1&limit=2", 400, "/problems/http"),
    ] {
        let problem = app.get(&format!("{JOBS}?{query}")).await.problem(status, kind);
        if status == 400 {
            assert!(problem["detail"].as_str().unwrap().starts_with("query: "), "{problem}");
        } else {
            assert_eq!(problem["parameter"], query.split('=').next().unwrap());
        }
    }
}

#[tokio::test]
async fn each_quota_has_its_own_words() {
    let app = App::with(|config| {
        config.threads = Some(0);
        config.limits.unfinished_jobs_per_user = 1;
    })
    .await;
    app.submit(&[short("proposed")]).await;
    let quota = |what: &Value| what.as_str().unwrap().to_owned();
    let refused = app.post(JOBS, study(&[short("slotine_li")]).to_string()).await.problem(429, "/problems/quota");
    assert_eq!((quota(&refused["what"]), &refused["most"]), ("unfinished jobs".to_owned(), &json!(1)));
    let app = App::with(|config| config.limits.queued_steps_per_user = 600).await;
    let refused = app.post(JOBS, study(&[long()]).to_string()).await.problem(429, "/problems/quota");
    assert_eq!(quota(&refused["what"]), "integration steps waiting or under way");
}
